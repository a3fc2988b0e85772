//! A case: something to run on a bench, and what comes of it.

use crate::bench::Bench;
use crate::case_id::CaseId;
use crate::compare::Comparison;
use crate::concurrent;
use crate::module::Module;
use crate::report::CaseResult;
use crate::verdict::Verdict;

/// Something that can be run and judged.
pub trait Case: Send + Sync {
    /// Its name.
    fn id(&self) -> &CaseId;

    /// The oracles that judge it.
    fn basis(&self) -> Vec<&'static str>;

    /// What the command line needs besides its name to run it again.
    fn arguments(&self) -> Vec<String> {
        Vec::new()
    }

    /// Every module that it asks a bench for.
    ///
    /// # Errors
    /// When that depends on files, and they cannot be read.
    fn modules(&self) -> Result<Vec<Module>, String>;

    /// Runs and judges it.
    fn run(&self, bench: &Bench<'_>) -> Outcome;

    /// Runs and judges it on each bench, several machines at once. A case whose expectation is too large to keep computes it once for all of them here.
    fn run_all(&self, benches: &[Bench<'_>]) -> Vec<Outcome> {
        concurrent::on_each(benches, |bench| self.run(bench))
    }
}

/// What came of a case.
#[derive(Clone, Debug, PartialEq)]
pub struct Outcome {
    /// Inputs (items, texels, vertices or pixels).
    pub inputs: usize,
    /// The comparison, where there was something to compare.
    pub comparison: Comparison,
    /// The verdict.
    pub verdict: Verdict,
    /// Why, for every verdict but a pass.
    pub reason: Option<String>,
}

impl Outcome {
    /// The verdict that follows from a comparison. `undecided_limit` is the share above which it is a warning.
    #[must_use]
    pub fn of(inputs: usize, comparison: Comparison, undecided_limit: f64) -> Self {
        let (verdict, reason) = match comparison.refusal {
            _ if comparison.outputs == 0 => (Verdict::Fail, Some("nothing was compared".to_owned())),
            Some(refusal) => {
                let (refused, outputs) = (comparison.refused, comparison.outputs);
                (
                    Verdict::Fail,
                    Some(format!(
                        "{refused} of {outputs} outputs refused; the worst: {}",
                        refusal.reason()
                    )),
                )
            }
            None if comparison.undecided_share() > undecided_limit => {
                let (share, limit) = (100.0 * comparison.undecided_share(), 100.0 * undecided_limit);
                (
                    Verdict::Warn,
                    Some(format!(
                        "{share:.2} % of the outputs are undecided, more than {limit:.2} %"
                    )),
                )
            }
            None => (Verdict::Pass, None),
        };
        Self {
            inputs,
            comparison,
            verdict,
            reason,
        }
    }

    /// A failure without a comparison: the shader could not be made or run.
    #[must_use]
    pub fn failed(reason: impl Into<String>) -> Self {
        Self::without_comparison(Verdict::Fail, reason)
    }

    /// A skip, which always says why.
    #[must_use]
    pub fn skipped(reason: impl Into<String>) -> Self {
        Self::without_comparison(Verdict::Skip, reason)
    }

    fn without_comparison(verdict: Verdict, reason: impl Into<String>) -> Self {
        Self {
            inputs: 0,
            comparison: Comparison::default(),
            verdict,
            reason: Some(reason.into()),
        }
    }

    /// The entry of the report.
    #[must_use]
    pub fn into_result(self, case: &dyn Case, bench: &Bench<'_>) -> CaseResult {
        CaseResult {
            id: case.id().clone(),
            route: bench.route,
            adapter: bench.device.info().name.clone(),
            basis: case.basis(),
            arguments: case.arguments(),
            inputs: self.inputs,
            outputs: self.comparison.outputs,
            undecided: self.comparison.undecided,
            forked: self.comparison.forked,
            refused: self.comparison.refused,
            verdict: self.verdict,
            worst: self.comparison.worst,
            reason: self.reason,
        }
    }
}

/// What an error says, with the causes behind it.
#[must_use]
pub fn with_causes(error: &dyn std::error::Error) -> String {
    let mut text = error.to_string();
    let mut cause = error.source();
    while let Some(error) = cause {
        text = format!("{text}: {error}");
        cause = error.source();
    }
    text
}
