//! The result of a run, and its three formats: JSON for tools, JUnit for CI, HTML for people.
//!
//! The JSON keys are stable (`"schema": 1`): keys may be added, none renamed or removed.

mod heat;
pub mod html;
pub mod json;
pub mod junit;
pub mod matrix;
pub mod page;

use std::collections::BTreeMap;

use serde::Serialize;

use crate::case_id::CaseId;
use crate::compare::Worst;
use crate::environment::Environment;
use crate::heat::Heat;
use crate::route::Route;
use crate::suite::accuracy;
use crate::verdict::Verdict;

/// The version of the report's format.
pub const SCHEMA: u32 = 1;

/// One case on one route and adapter.
#[derive(Clone, Debug, PartialEq)]
pub struct CaseResult {
    /// Its name.
    pub id: CaseId,
    /// The route.
    pub route: Route,
    /// The adapter's name.
    pub adapter: String,
    /// The oracles that judged it.
    pub basis: Vec<&'static str>,
    /// What the command line needs besides the name to run it again.
    pub arguments: Vec<String>,
    /// Inputs (items, texels, vertices or pixels).
    pub inputs: usize,
    /// Outputs compared.
    pub outputs: usize,
    /// Outputs on which the accuracy rules say nothing.
    pub undecided: usize,
    /// Outputs for which two results are allowed, since a comparison is undecidable there.
    pub forked: usize,
    /// Refused outputs.
    pub refused: usize,
    /// The verdict.
    pub verdict: Verdict,
    /// The worst output.
    pub worst: Option<Worst>,
    /// Why, for every verdict but a pass.
    pub reason: Option<String>,
}

impl CaseResult {
    /// The command that runs just this case again.
    #[must_use]
    pub fn rerun(&self) -> String {
        let quoted = |text: &str| format!("'{}'", text.replace('\'', "'\\''"));
        let plain = |c: char| c.is_ascii_alphanumeric() || "-_./".contains(c);
        let as_needed = |text: &String| {
            if text.chars().all(plain) {
                text.clone()
            } else {
                quoted(text)
            }
        };
        let (id, adapter) = (quoted(&self.id.to_string()), quoted(&self.adapter));
        let besides: String = self
            .arguments
            .iter()
            .map(|argument| format!(" {}", as_needed(argument)))
            .collect();
        format!(
            "bossage conform {id} --route {} --adapter {adapter}{besides}",
            self.route
        )
    }

    /// The share of outputs on which nothing or two things are allowed.
    #[must_use]
    pub fn undecided_share(&self) -> f64 {
        if self.outputs == 0 {
            0.0
        } else {
            (self.undecided + self.forked) as f64 / self.outputs as f64
        }
    }
}

/// Counts over all cases.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub struct Totals {
    /// Cases.
    pub cases: usize,
    /// Of those, passed.
    pub pass: usize,
    /// Of those, passed with a warning.
    pub warn: usize,
    /// Of those, failed.
    pub fail: usize,
    /// Of those, not run.
    pub skip: usize,
    /// Of those, failed as expected.
    pub expected_fail: usize,
    /// Inputs over all cases.
    pub inputs: usize,
    /// Outputs over all cases.
    pub outputs: usize,
    /// Outputs on which the rules say nothing.
    pub undecided: usize,
    /// Outputs for which two results are allowed.
    pub forked: usize,
}

impl Totals {
    /// Counts the cases.
    #[must_use]
    pub fn of<'a>(cases: impl IntoIterator<Item = &'a CaseResult>) -> Self {
        cases.into_iter().fold(Self::default(), |mut totals, case| {
            totals.cases += 1;
            totals.inputs += case.inputs;
            totals.outputs += case.outputs;
            totals.undecided += case.undecided;
            totals.forked += case.forked;
            *totals.count_mut(case.verdict) += 1;
            totals
        })
    }

    fn count_mut(&mut self, verdict: Verdict) -> &mut usize {
        match verdict {
            Verdict::Pass => &mut self.pass,
            Verdict::Warn => &mut self.warn,
            Verdict::Fail => &mut self.fail,
            Verdict::Skip => &mut self.skip,
            Verdict::ExpectedFail => &mut self.expected_fail,
        }
    }

    /// How many cases have a verdict.
    #[must_use]
    pub fn count(&self, verdict: Verdict) -> usize {
        let mut copy = *self;
        *copy.count_mut(verdict)
    }
}

/// How much of what the library itself promises stayed undecided.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Undecided {
    /// Outputs compared.
    pub outputs: usize,
    /// Outputs on which the accuracy rules say nothing.
    pub open: usize,
    /// Outputs that join several results.
    pub forked: usize,
}

impl Undecided {
    /// The share of undecided outputs; 0 where there are none.
    #[must_use]
    pub fn share(&self) -> f64 {
        (self.open + self.forked) as f64 / self.outputs.max(1) as f64
    }
}

/// A whole run.
#[derive(Clone, Debug, PartialEq)]
pub struct Report {
    /// What it ran on.
    pub environment: Environment,
    /// The cases, sorted by name, route and adapter.
    pub cases: Vec<CaseResult>,
    /// Where error bounds come from, as far as that was asked for.
    pub heats: Vec<Heat>,
}

impl Report {
    /// A report with its cases in order.
    #[must_use]
    pub fn new(environment: Environment, mut cases: Vec<CaseResult>) -> Self {
        cases.sort_by(|a, b| (&a.id, a.route, &a.adapter).cmp(&(&b.id, b.route, &b.adapter)));
        Self {
            environment,
            cases,
            heats: Vec::new(),
        }
    }

    /// Counts over all cases.
    #[must_use]
    pub fn totals(&self) -> Totals {
        Totals::of(&self.cases)
    }

    /// What stayed undecided of everything but the published forms, which are undefined in places, and the built-in functions, whose
    /// arguments are drawn from all numbers.
    #[must_use]
    pub fn undecided(&self) -> Undecided {
        let ours = |case: &&CaseResult| !case.id.is_published() && case.id.technique != accuracy::TECHNIQUE;
        let cases = self.cases.iter().filter(ours);
        cases.fold(Undecided::default(), |sum, case| Undecided {
            outputs: sum.outputs + case.outputs,
            open: sum.open + case.undecided,
            forked: sum.forked + case.forked,
        })
    }

    /// The failed cases.
    pub fn failures(&self) -> impl Iterator<Item = &CaseResult> {
        self.cases.iter().filter(|case| case.verdict == Verdict::Fail)
    }

    /// Whether nothing failed and something ran.
    #[must_use]
    pub fn is_ok(&self) -> bool {
        let totals = self.totals();
        totals.fail == 0 && totals.cases > totals.skip
    }

    /// The cases of each technique and form, for the matrix.
    #[must_use]
    pub fn by_technique(&self) -> BTreeMap<(String, Option<String>), Vec<&CaseResult>> {
        let mut rows: BTreeMap<_, Vec<&CaseResult>> = BTreeMap::new();
        for case in &self.cases {
            rows.entry((case.id.technique.clone(), case.id.form.clone()))
                .or_default()
                .push(case);
        }
        rows
    }
}

#[cfg(test)]
pub(crate) mod tests;
