//! Which relief technique, with which settings: the one place that decides.
//!
//! Every candidate searches the same rays of this scene in f64; what it misses is its error, and its steps times the cost profile's
//! figures are its time. A candidate meets an error budget if the **upper bound** of its 99th percentile does (see `percentile.rs`).
//! It starts with [`FIRST_RAYS`]. While a cheaper candidate than the cheapest that does is in doubt, it gets four times as many, up to
//! [`MOST_RAYS`]; what was chosen, and what is shown beside it, gets at least [`RAYS`].
//!
//! | budget | chosen | where nothing meets it |
//! |---|---|---|
//! | `error_px` | the cheapest within it | the one of least error |
//! | `time_ms` | the one of least error within it | – (no relief takes no time) |
//! | both | the cheapest within both | the one of least error within `time_ms` |
//!
//! Equal ones: the one named first, or the cheaper one. Techniques without figures in the profile are no candidates.

use serde::Serialize;

use crate::model::Scene;
use crate::predict::{Error, Sample, Sampler};
use crate::profile::Profile;
use crate::technique::{Settings, Technique};
use crate::views::View;

/// Rays by which a candidate is first looked at.
const FIRST_RAYS: u32 = 1024;
/// Rays behind a figure that is shown.
pub(crate) const RAYS: u32 = 4096;
/// Rays of a material at most.
const MOST_RAYS: u32 = 1 << 18;

/// A technique that could be used, with what it would cost.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Candidate {
    /// The technique and its settings as one value.
    #[serde(skip)]
    pub how: Technique,
    /// Technique id, or `none`.
    pub technique: &'static str,
    /// Its settings.
    pub settings: Settings,
    /// The error to expect.
    #[serde(flatten)]
    pub error: Error,
    /// What the 99th percentile in pixels does not exceed, by all that the rays say; none where they are too few to say.
    pub error_px_p99_at_most: Option<f64>,
    /// Mean steps a ray.
    pub steps: f64,
    /// The time to expect of it in a frame, milliseconds.
    pub time_ms: f64,
    /// Rays that were searched.
    pub rays: usize,
}

/// What was chosen and what it was chosen over.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Choice {
    /// The chosen technique.
    pub chosen: Candidate,
    /// Whether it meets the budget.
    pub meets_budget: bool,
    /// What would have been chosen without it.
    pub runner_up: Option<Candidate>,
    /// What less budget would buy: of the cheaper ones, the one of least error.
    pub cheaper: Option<Candidate>,
    /// What more budget would buy: of the more accurate ones, the cheapest.
    pub more_accurate: Option<Candidate>,
    /// All others, cheapest first.
    pub others: Vec<Candidate>,
}

impl Choice {
    /// The choice and what plans show beside it.
    fn shown(&self) -> impl Iterator<Item = &Candidate> {
        let beside = [&self.runner_up, &self.cheaper, &self.more_accurate];
        beside.into_iter().flatten().chain([&self.chosen])
    }
}

/// What a material may cost. At least one is given.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Limits {
    pub(crate) error_px: Option<f64>,
    pub(crate) time_ms: Option<f64>,
}

impl Limits {
    fn times(&self, candidate: &Candidate) -> bool {
        self.time_ms.is_none_or(|most| candidate.time_ms <= most)
    }

    fn errors(&self, candidate: &Candidate) -> bool {
        self.error_px
            .is_none_or(|most| candidate.error_px_p99_at_most.is_some_and(|error| error <= most))
    }
}

/// What a technique on so many pixels costs.
#[derive(Clone, Copy)]
pub(crate) struct Price<'a> {
    pub(crate) profile: &'a Profile,
    pub(crate) pixels: f64,
}

impl Price<'_> {
    /// Milliseconds of a frame; none without figures.
    pub(crate) fn time_ms(&self, technique: Technique, steps: f64) -> Option<f64> {
        if technique == Technique::None {
            return Some(0.0);
        }
        let cost = self.profile.techniques.get(technique.id())?;
        Some(self.pixels * cost.ns(steps) * 1e-6)
    }
}

/// The choice for a material of a scene among any techniques, whether the surface can draw them or not, all of the scene's time being
/// its own. None where the material has no heights or shows no ray.
#[must_use]
pub fn choice_among(scene: &Scene, material: usize, techniques: &[Technique]) -> Option<Choice> {
    let views: Vec<View> = scene
        .objects_of(material)
        .map(|object| View::new(&scene.camera, object))
        .collect();
    let material = &scene.materials[material];
    let views: Vec<&View> = views.iter().collect();
    let mut sampler = Sampler::new(material, material.height.as_ref()?, &views, None);
    let limits = Limits {
        error_px: scene.budget.error_px,
        time_ms: scene.budget.time_ms,
    };
    let price = Price {
        profile: &scene.budget.profile,
        pixels: views.iter().map(|view| view.area_px()).sum(),
    };
    choose(&mut sampler, techniques, limits, price)
}

/// Chooses among techniques. `None` if the material shows no ray or no technique has a price.
pub(crate) fn choose(
    sampler: &mut Sampler<'_>,
    techniques: &[Technique],
    limits: Limits,
    price: Price<'_>,
) -> Option<Choice> {
    let priced = techniques.iter().filter(|it| price.time_ms(**it, 0.0).is_some());
    let mut trials: Vec<Trial> = priced.copied().map(Trial::new).collect();
    let mut rays = FIRST_RAYS;
    sampler.grow(rays);
    let first = sampler.len();
    sampler.grow(RAYS);
    let shown = sampler.len();
    trials.iter_mut().for_each(|trial| trial.extend(sampler, first));
    loop {
        let candidates = cheapest_first(&trials, price);
        let choice = decide(&candidates, limits)?;
        let doubtful = doubtful(&candidates, &trials, limits);
        let thin: Vec<Technique> = choice
            .shown()
            .filter(|it| it.rays < shown)
            .map(|it| it.how)
            .collect();
        let (asked, count) = if rays < MOST_RAYS && !doubtful.is_empty() {
            rays *= 4;
            sampler.grow(rays);
            (doubtful, sampler.len())
        } else {
            (thin, shown)
        };
        if asked.is_empty() {
            return Some(choice);
        }
        for trial in trials.iter_mut().filter(|trial| asked.contains(&trial.technique)) {
            trial.extend(sampler, count);
        }
    }
}

/// A technique with all that it was asked.
struct Trial {
    technique: Technique,
    sample: Sample,
}

impl Trial {
    fn new(technique: Technique) -> Self {
        Self {
            technique,
            sample: Sample::default(),
        }
    }

    /// Asks about the first `count` rays, those that were not asked about yet.
    fn extend(&mut self, sampler: &Sampler<'_>, count: usize) {
        sampler.extend(self.technique, &mut self.sample, count);
    }

    fn candidate(&self, price: Price<'_>) -> Option<Candidate> {
        let steps = self.sample.mean_steps();
        Some(Candidate {
            how: self.technique,
            technique: self.technique.id(),
            settings: self.technique.settings(),
            error: self.sample.error()?,
            error_px_p99_at_most: Some(self.sample.px()?.at_most).filter(|most| most.is_finite()),
            steps,
            time_ms: price.time_ms(self.technique, steps)?,
            rays: self.sample.len(),
        })
    }
}

/// The candidates, cheapest first; equal ones in the order of the trials.
fn cheapest_first(trials: &[Trial], price: Price<'_>) -> Vec<Candidate> {
    let mut candidates: Vec<Candidate> = trials.iter().filter_map(|trial| trial.candidate(price)).collect();
    candidates.sort_by(|a, b| a.time_ms.total_cmp(&b.time_ms));
    candidates
}

/// Those cheaper than what would be chosen that may be within the error after all.
fn doubtful(candidates: &[Candidate], trials: &[Trial], limits: Limits) -> Vec<Technique> {
    let Some(most) = limits.error_px else {
        return Vec::new();
    };
    let may_fit = |candidate: &&Candidate| {
        let of = |trial: &&Trial| trial.technique == candidate.how;
        let px = trials.iter().find(of).and_then(|trial| trial.sample.px());
        limits.times(candidate) && px.is_some_and(|px| px.at_least <= most)
    };
    let cheaper = candidates
        .iter()
        .take_while(|candidate| !limits.errors(candidate));
    cheaper.filter(may_fit).map(|candidate| candidate.how).collect()
}

/// Chooses among candidates given cheapest first.
fn decide(candidates: &[Candidate], limits: Limits) -> Option<Choice> {
    let chosen = best(candidates, limits)?;
    let others: Vec<Candidate> = candidates
        .iter()
        .filter(|other| other.how != chosen.how)
        .cloned()
        .collect();
    let (time, px) = (chosen.time_ms, chosen.error.px_p99);
    let cheaper = others.iter().filter(|other| other.time_ms < time);
    let more_accurate = others.iter().find(|other| other.error.px_p99 < px);
    Some(Choice {
        meets_budget: limits.times(chosen) && limits.errors(chosen),
        runner_up: best(&others, limits).cloned(),
        cheaper: least_error(cheaper).cloned(),
        more_accurate: more_accurate.cloned(),
        chosen: chosen.clone(),
        others,
    })
}

fn best(candidates: &[Candidate], limits: Limits) -> Option<&Candidate> {
    let in_time = || candidates.iter().filter(|candidate| limits.times(candidate));
    let cheapest = || in_time().find(|candidate| limits.errors(candidate));
    match limits.error_px {
        Some(_) => cheapest().or_else(|| least_error(in_time())),
        None => least_error(in_time()),
    }
    .or_else(|| candidates.first())
}

/// Of equal ones the first.
fn least_error<'a>(candidates: impl Iterator<Item = &'a Candidate>) -> Option<&'a Candidate> {
    candidates.min_by(|a, b| a.error.px_p99.total_cmp(&b.error.px_p99))
}

#[cfg(test)]
mod tests;
