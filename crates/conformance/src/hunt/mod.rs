//! The hunt for hard inputs: a seeded, guided search for those at which a shader errs most, or at which least is known of its result.
//!
//! Two goals for each output: the **error** of the result in ULPs of the truth, and the **width** of the acceptance interval in ULPs. A
//! third of the budget draws inputs as the generators do, the rest breeds the best ones (`search`): steps of single bits, numbers
//! and vectors copied between inputs and within one, halfway points. What is found is made plain (`minimise`): every number
//! that may be 0, ±1, a power of two or a shorter one while half of the score stays, becomes that.
//!
//! Only outputs count on which the rules say something and one result follows: where they leave a result open every error is allowed,
//! and that is the lint's business. An output outside of its interval ends the hunt of that subject: it is a failure.
//!
//! Equal seeds breed equal inputs as long as nothing but the number of evaluations ends the hunt; how many fit into a time is the
//! machine's affair. So the inputs themselves are kept ([`corpus`]), and ordinary runs replay them.

pub mod corpus;
pub(crate) mod file;
mod library;
mod minimise;
mod role;
mod search;
mod shader;
#[cfg(test)]
mod tests;

use std::time::{Duration, Instant};

use bossage_bounds::ranges::{Point, Seed};
use serde::{Deserialize, Serialize};

pub use library::hunt as hunt_library;
pub use shader::hunt as hunt_shader;

use crate::compare::NamedInput;
use crate::report::json::Number;

/// What is maximised.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Goal {
    /// |got − truth| in ULPs of the truth.
    Error,
    /// The width of the acceptance interval in ULPs of its greater end.
    Width,
}

impl Goal {
    /// Both.
    pub const ALL: [Self; 2] = [Self::Error, Self::Width];

    /// As in reports and corpora.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Error => "error",
            Self::Width => "width",
        }
    }
}

/// How long and for what to hunt.
#[derive(Clone, Debug, PartialEq)]
pub struct Options {
    /// Only subjects with this in their name.
    pub filter: Option<String>,
    /// The seed.
    pub seed: u64,
    /// Time for all subjects together; no limit when `None`.
    pub time: Option<Duration>,
    /// The most inputs that are evaluated for one subject, those that make a finding plain among them; no limit when `None`.
    pub evaluations: Option<usize>,
    /// Only what reaches so many ULPs is a finding.
    pub threshold: f64,
}

/// The share of a budget that is kept for making plain what was found.
const PLAIN: f64 = 0.2;

/// Seconds that a hunt takes, if nothing else is said.
pub const SECONDS: f64 = 60.0;

/// ULPs from which on something counts as found, if nothing else is said.
pub const THRESHOLD: f64 = 64.0;

/// A hard input.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Finding {
    /// Probe, or shader and entry point.
    pub subject: String,
    /// What was maximised.
    pub goal: Goal,
    /// Which output: its number, or its name.
    pub output: String,
    /// How much, after the input was made plain.
    pub ulps: f64,
    /// The inputs by name.
    pub inputs: Vec<NamedInput>,
    /// The seed it was found from.
    pub seed: u64,
    /// What came back, where that is outside of the interval: a failure.
    pub refused: Option<Number>,
}

/// What came of a hunt.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Hunted {
    /// Hard inputs, subject by subject.
    pub findings: Vec<Finding>,
    /// Subjects with their numbers of evaluations.
    pub evaluated: Vec<(String, usize)>,
    /// Probes of the library with what belongs into their corpora.
    pub corpora: Vec<corpus::Corpus>,
    /// What belongs into the corpus of a shader.
    pub kept: Vec<crate::user::Found>,
    /// Subjects that could not be hunted, with the reason.
    pub skipped: Vec<(String, String)>,
}

/// A score of one output.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Score {
    pub(crate) ulps: f64,
    pub(crate) output: usize,
}

/// What one input led to: for each goal the best output of each key.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Measured {
    /// By key and goal, as [`slot`] numbers them.
    pub(crate) scores: Vec<Option<Score>>,
    /// An output outside of its interval, with its value.
    pub(crate) refused: Option<(usize, f64)>,
}

/// The place of a key's goal in [`Measured::scores`].
pub(crate) const fn slot(key: usize, goal: Goal) -> usize {
    2 * key + matches!(goal, Goal::Width) as usize
}

impl Measured {
    pub(crate) fn of(keys: usize) -> Self {
        Self {
            scores: vec![None; 2 * keys],
            refused: None,
        }
    }

    /// Keeps a score if it is the best of its key.
    pub(crate) fn keep(&mut self, key: usize, goal: Goal, score: Score) {
        let best = &mut self.scores[slot(key, goal)];
        if score.ulps.is_finite() && best.is_none_or(|best| score.ulps > best.ulps) {
            *best = Some(score);
        }
    }
}

/// Something to hunt.
pub(crate) trait Subject {
    /// What reports call it.
    fn name(&self) -> String;
    /// How many outputs are looked at apart.
    fn keys(&self) -> usize;
    /// Scalars that belong together, in order.
    fn groups(&self) -> Vec<std::ops::Range<usize>>;
    /// An input as the generators draw it.
    fn sample(&self, seed: &mut Seed) -> Point;
    /// Whether single numbers of a group may change; otherwise it is drawn and taken over whole.
    fn is_free(&self, group: &std::ops::Range<usize>) -> bool;
    /// Brings an input back into its domain.
    fn mend(&self, point: &mut Point);
    /// Evaluates inputs.
    fn measure(&self, points: &[Point]) -> Result<Vec<Measured>, String>;
    /// The name of an output.
    fn output(&self, output: usize) -> String;
    /// The inputs of a point by name.
    fn inputs(&self, point: &Point, output: usize) -> Vec<NamedInput>;
}

/// An end to a subject's hunt.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Budget {
    /// No limit when `None`.
    pub(crate) until: Option<Instant>,
    pub(crate) evaluations: usize,
}

impl Budget {
    /// How many evaluations are left after so many.
    pub(crate) fn left(&self, evaluated: usize) -> usize {
        self.evaluations.saturating_sub(evaluated)
    }
}

/// A hard input of a subject, made plain.
pub(crate) struct Prey {
    pub(crate) goal: Goal,
    pub(crate) score: Score,
    pub(crate) point: Point,
    pub(crate) refused: Option<f64>,
}

/// Hunts one subject.
pub(crate) fn hunt(
    subject: &dyn Subject,
    options: &Options,
    time: Option<Duration>,
) -> Result<(Vec<Prey>, usize), String> {
    let until = |share: f64| time.map(|time| Instant::now() + time.mul_f64(share));
    let all = options.evaluations.unwrap_or(usize::MAX);
    let searching = Budget {
        until: until(1.0 - PLAIN),
        evaluations: all - (all as f64 * PLAIN) as usize,
    };
    let mut seed = Seed::new(options.seed);
    let mut found = search::Found::new(subject);
    found.search(subject, &searching, &mut seed)?;
    if !found.reaches(options.threshold) {
        // Nothing is there to make plain yet.
        let rest = Budget {
            evaluations: all,
            ..searching
        };
        found.search(subject, &rest, &mut seed)?;
    }
    let making_plain = Budget {
        until: until(PLAIN),
        evaluations: all,
    };
    let prey = minimise::plain(subject, &mut found, options.threshold, &making_plain)?;
    Ok((prey, found.evaluated))
}

/// As a report has it.
pub(crate) fn finding(subject: &dyn Subject, prey: &Prey, seed: u64) -> Finding {
    Finding {
        subject: subject.name(),
        goal: prey.goal,
        output: subject.output(prey.score.output),
        ulps: prey.score.ulps,
        inputs: subject.inputs(&prey.point, prey.score.output),
        seed,
        refused: prey.refused.map(Number),
    }
}

/// The library's probes whose case names hold a filter.
#[must_use]
pub fn probes(filter: Option<&str>) -> Vec<&'static bossage_shaders::Probe> {
    bossage_shaders::PROBES
        .iter()
        .filter(|probe| filter.is_none_or(|filter| crate::suite::probe::id(probe, "corpus").matches(filter)))
        .collect()
}

/// Whether a time has come.
pub(crate) fn is_over(until: Option<Instant>) -> bool {
    until.is_some_and(|until| Instant::now() >= until)
}

/// Told before each subject.
pub type Told<'a> = &'a mut dyn FnMut(&str);
