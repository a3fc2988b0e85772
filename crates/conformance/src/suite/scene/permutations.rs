//! Every permutation of the fragment stage that the feature model can reach, drawn on one specimen and judged like a scene.
//!
//! Scenes show what scenes call for; here is the rest. In the ordinary run each pair of values of two fields of the feature set is in one
//! of the permutations drawn, in the full run all permutations are.
//!
//! - `permutations`: one case for each kind of shading, published and hardened;
//! - `cutoff`: an alpha that *is* the cutoff, which is kept, and the next float below it, which is not. Texels of one value, read without
//!   filtering, leave the alpha test nothing to be undecided about;
//! - `horizon`: an embossed sheet under a light that lies in its plane, which is none.

use std::collections::BTreeSet;

use bossage_runner::Filter;
use bossage_scene::Draw;
use bossage_shaders::{Albedo, Alpha, FeatureSet, Form, Lights, Shading, Stage};

use super::expected::Expectations;
use super::judge::judged;
use super::pixels::{Object, modules, passes};
use super::specimen::{self, SIZE};
use super::{alone, demanding};
use crate::bench::Bench;
use crate::case::{Case, Outcome};
use crate::case_id::CaseId;
use crate::compare::Comparison;
use crate::module::Module;
use crate::tolerance::UNDECIDED_LIMIT_FILTERED;
use crate::verdict::Verdict;

/// Names of permutations that a report lists.
const LISTED: usize = 5;

/// The permutations of one kind of shading in one form.
struct Permutations {
    id: CaseId,
    sets: Vec<FeatureSet>,
    expectations: Expectations,
}

/// The cases of all kinds of shading.
pub fn cases(full: bool) -> impl Iterator<Item = Box<dyn Case>> {
    let kinds = Shading::ALL
        .into_iter()
        .flat_map(|shading| [Form::Published, Form::Hardened].map(|form| (shading, form)));
    let permutations = kinds.filter_map(move |(shading, form)| {
        let all: Vec<FeatureSet> = FeatureSet::reachable()
            .into_iter()
            .filter(|set| (set.shading, set.form) == (shading, form))
            .collect();
        let sets = if full { all } else { covering(&all) };
        let id = CaseId::new("surface", Some(form.as_str()), "permutations")
            .with("shading", shading.as_str())
            .with("variants", sets.len());
        let case = Permutations {
            id,
            sets,
            expectations: Expectations::default(),
        };
        (!case.sets.is_empty()).then(|| Box::new(case) as Box<dyn Case>)
    });
    let cutoffs = [Shading::BlinnPhong, Shading::WrapLambert].map(|shading| {
        let id = CaseId::new("surface", None, "cutoff").with("shading", shading.as_str());
        Box::new(Cutoff { id, shading }) as Box<dyn Case>
    });
    let horizon = Horizon {
        id: CaseId::new("surface", None, "horizon"),
    };
    permutations
        .chain(cutoffs)
        .chain([Box::new(horizon) as Box<dyn Case>])
}

/// The fields of a feature set, each as a number.
fn fields(set: &FeatureSet) -> [u8; 13] {
    [
        set.relief as u8,
        set.shadow as u8,
        u8::from(set.pixel_depth),
        set.normal as u8,
        set.lights as u8,
        set.normaliser as u8,
        u8::from(set.specular),
        u8::from(set.environment),
        set.albedo as u8,
        set.alpha as u8,
        set.transform as u8,
        set.space as u8,
        u8::from(set.mirrored_uv),
    ]
}

/// Two fields and their values.
type Pair = (usize, u8, usize, u8);

fn pairs(set: &FeatureSet) -> BTreeSet<Pair> {
    let fields = fields(set);
    let of = |i: usize| (i + 1..fields.len()).map(move |j| (i, fields[i], j, fields[j]));
    (0..fields.len()).flat_map(of).collect()
}

/// Sets that together have every pair of values that some set has: always the one with the most pairs that are missing, the first of
/// several.
fn covering(all: &[FeatureSet]) -> Vec<FeatureSet> {
    let of_each: Vec<BTreeSet<Pair>> = all.iter().map(pairs).collect();
    let mut missing: BTreeSet<Pair> = of_each.iter().flatten().copied().collect();
    let mut chosen = BTreeSet::new();
    while !missing.is_empty() {
        let gain = |at: &usize| of_each[*at].intersection(&missing).count();
        let Some(best) = (0..all.len()).rev().max_by_key(gain) else {
            break;
        };
        missing = missing.difference(&of_each[best]).copied().collect();
        chosen.insert(best);
    }
    chosen.into_iter().map(|at| all[at]).collect()
}

impl Permutations {
    fn judge(&self, bench: &Bench<'_>) -> Result<Outcome, String> {
        let (mut comparison, mut inputs, mut refused) = (Comparison::default(), 0, Vec::new());
        for (number, features) in self.sets.iter().enumerate() {
            let draw = specimen::draw(features)?;
            let object = Object {
                bench,
                number,
                size: SIZE,
                filter: Filter::Linear,
                expectations: &self.expectations,
            };
            for stage in passes(&draw) {
                let drawn = object
                    .render(&draw, stage)
                    .map_err(|error| format!("{}: {error}", features.module_name(stage)))?;
                let (part, pixels) = alone(&drawn, demanding(&draw));
                if part.refused > 0 {
                    refused.push(features.module_name(stage));
                }
                comparison.merge(part);
                inputs += pixels;
            }
        }
        let outcome = Outcome::of(inputs, comparison, UNDECIDED_LIMIT_FILTERED);
        Ok(named(outcome, &refused))
    }
}

/// Says which permutations were refused.
fn named(outcome: Outcome, refused: &[String]) -> Outcome {
    if outcome.verdict != Verdict::Fail {
        return outcome;
    }
    let shown = refused[..refused.len().min(LISTED)].join(", ");
    let rest = match refused.len().saturating_sub(LISTED) {
        0 => String::new(),
        more => format!(" and {more} more"),
    };
    let reason = outcome.reason.unwrap_or_default();
    Outcome {
        reason: Some(format!("{reason}; in {shown}{rest}")),
        ..outcome
    }
}

impl Case for Permutations {
    fn id(&self) -> &CaseId {
        &self.id
    }

    fn basis(&self) -> Vec<&'static str> {
        crate::oracle::BASIS.to_vec()
    }

    fn modules(&self) -> Result<Vec<Module>, String> {
        let mut all = BTreeSet::new();
        for features in &self.sets {
            all.extend(modules(&specimen::draw(features)?));
        }
        Ok(all.into_iter().collect())
    }

    fn run(&self, bench: &Bench<'_>) -> Outcome {
        self.judge(bench).unwrap_or_else(Outcome::failed)
    }
}

/// An alpha at the cutoff, and one just below it.
struct Cutoff {
    id: CaseId,
    shading: Shading,
}

impl Cutoff {
    fn features(&self) -> FeatureSet {
        FeatureSet {
            lights: Lights::Point,
            shading: self.shading,
            albedo: Albedo::Map,
            alpha: Alpha::Mask,
            ..FeatureSet::default()
        }
        .canonical()
    }

    fn judge(&self, bench: &Bench<'_>) -> Result<Outcome, String> {
        let (mut comparison, mut inputs) = (Comparison::default(), 0);
        for (number, below) in [false, true].into_iter().enumerate() {
            let draw = specimen::at_cutoff(&self.features(), below)?;
            let object = Object {
                bench,
                number,
                size: SIZE,
                filter: Filter::Nearest,
                expectations: &Expectations::default(),
            };
            let drawn = object.render(&draw, Stage::Fragment)?;
            inputs += drawn.pixels.len();
            comparison.merge(judged(&drawn.pixels, demanding(&draw)));
        }
        // No pixel is undecided here.
        Ok(Outcome::of(inputs, comparison, 0.0))
    }
}

impl Case for Cutoff {
    fn id(&self) -> &CaseId {
        &self.id
    }

    fn basis(&self) -> Vec<&'static str> {
        crate::oracle::BASIS.to_vec()
    }

    fn modules(&self) -> Result<Vec<Module>, String> {
        Ok(modules(&specimen::at_cutoff(&self.features(), false)?))
    }

    fn run(&self, bench: &Bench<'_>) -> Outcome {
        self.judge(bench).unwrap_or_else(Outcome::failed)
    }
}

/// A light exactly in the plane of an embossed sheet: neither above it nor below.
struct Horizon {
    id: CaseId,
}

impl Horizon {
    fn draw() -> Result<Draw, String> {
        let features = FeatureSet {
            lights: Lights::Directional,
            shading: Shading::Emboss,
            ..FeatureSet::default()
        };
        specimen::at_horizon(&features.canonical())
    }

    fn judge(&self, bench: &Bench<'_>) -> Result<Outcome, String> {
        let draw = Self::draw()?;
        let object = Object {
            bench,
            number: 0,
            size: SIZE,
            filter: Filter::Linear,
            expectations: &Expectations::default(),
        };
        let drawn = object.render(&draw, Stage::Fragment)?;
        let mut comparison = Comparison::default();
        comparison.merge(judged(&drawn.pixels, demanding(&draw)));
        // Which side the light is on is decided at every pixel.
        Ok(Outcome::of(drawn.pixels.len(), comparison, 0.0))
    }
}

impl Case for Horizon {
    fn id(&self) -> &CaseId {
        &self.id
    }

    fn basis(&self) -> Vec<&'static str> {
        crate::oracle::BASIS.to_vec()
    }

    fn modules(&self) -> Result<Vec<Module>, String> {
        Ok(modules(&Self::draw()?))
    }

    fn run(&self, bench: &Bench<'_>) -> Outcome {
        self.judge(bench).unwrap_or_else(Outcome::failed)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn few_sets_have_every_pair_that_all_have() {
        let all = FeatureSet::reachable();
        let chosen = covering(&all);
        let have: BTreeSet<Pair> = chosen.iter().flat_map(pairs).collect();
        let wanted: BTreeSet<Pair> = all.iter().flat_map(pairs).collect();
        assert_eq!(have, wanted);
        assert!(chosen.len() < all.len() / 10, "{} of {}", chosen.len(), all.len());
    }

    #[test]
    fn in_a_full_run_no_fragment_module_is_left_out() {
        let drawn: usize = FeatureSet::reachable().len();
        let names = cases(true).map(|case| {
            case.id()
                .params
                .get("variants")
                .map_or(0, |n| n.parse().unwrap_or(0))
        });
        assert_eq!(names.sum::<usize>(), drawn);
    }
}
