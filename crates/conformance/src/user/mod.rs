//! Conformance of a user's shader: no reference is needed.
//!
//! Inputs are chosen by seed from declared or inferred ranges (`bossage_bounds::ranges`); each route on each adapter runs them, in a
//! process of its own; and every output is judged against the acceptance interval that the shader's own IR has at those very inputs.
//! Then the results of the routes are compared with each other. So a case asks whether a driver and our writers compute *what the shader
//! says*; whether the shader says what its author meant it cannot know.
//!
//! Inputs that a hunt found are kept beside the shader ([`Corpus`]) and run after the chosen ones: `SHADER/corpus:…` is what came of them.
//!
//! Per entry point and cell (route, adapter) there are two more results: `SHADER/ranges:entry=E;n=N;seed=S`, the outputs against the
//! intervals, and `SHADER/agreement:…`, the outputs against those of the first cell that ran (which has no such result). Results may differ wherever the interval
//! admits both; they disagree where it does not. Where the rules say nothing (overflow, division by zero) results that differ are a
//! warning: allowed, but not portable.
//!
//! The error in ULPs is measured against the formula in f64, where that lies in the interval.
//!
//! Compute entry points are dispatched; vertex and fragment entry points are drawn between generated stages (`draw`).
//!
//! Limits: multisampled and external textures, those whose format [`Texels`] cannot name, and binding arrays are not bound,
//! and of a stage that is drawn nothing but its targets is read back; each is said as a skip. Depth textures have 16 bits a texel.

mod agree;
mod bindable;
mod child;
mod corpus;
mod draw;
pub(crate) mod expect;
pub(crate) mod judge;
mod picture;
mod plan;
mod ready;
mod request;
#[cfg(test)]
mod stage_tests;
#[cfg(test)]
mod tests;
mod texels;

use std::fmt;

use bossage_bounds::ranges::Declared;
use bossage_translate::Shader;
use serde::{Deserialize, Serialize};

pub use child::Children;
pub use corpus::{Corpus, Found};
pub use plan::Plan;
pub(crate) use plan::plans;
pub(crate) use ready::Ready;
pub use request::{
    Buffer, Companion, Job, Kept, Original, Pass, Request, Shape, Side, Texels, execute, serve,
};

use expect::{At, Known};
use ready::Ran;

use crate::case::Outcome;
use crate::case_id::CaseId;
use crate::compare::Comparison;
use crate::error::Error;
use crate::heat::{self, Heat, Wanted};
use crate::report::{CaseResult, Report};
use crate::route::Route;
use crate::run::{Progress, Selection, environment};
use crate::verdict::Verdict;

/// Inputs of an entry point in an ordinary run.
pub const ORDINARY: usize = 64;

/// Operations of an invocation in an ordinary run.
pub const OPERATIONS: u64 = 1 << 20;

/// The oracle of the outputs.
pub const BASIS: [&str; 1] = ["accuracy rules over the shader's IR"];

/// What of a shader is run, and with what.
#[derive(Clone, Debug, PartialEq)]
pub struct Options {
    /// Only this entry point; all when `None`.
    pub entry: Option<String>,
    /// Only cases with this in their name.
    pub filter: Option<String>,
    /// The seed of the inputs.
    pub seed: u64,
    /// How many inputs an entry point gets.
    pub inputs: usize,
    /// Workgroups of a dispatch; else what the sidecar says, else enough for one invocation an element of the longest array.
    pub workgroups: Option<[u32; 3]>,
    /// Operations that an invocation may take on average where its outputs' intervals are computed.
    pub operations: u64,
    /// Which output's bound is attributed to source lines.
    pub attribute: Wanted,
    /// The bytes of a shader that is SPIR-V: what the route `spirv` runs.
    pub original: Option<Vec<u8>>,
    /// Inputs that hunts found, which are run after the chosen ones.
    pub corpus: Option<Corpus>,
    /// What the command line needs besides a case's name to run it again.
    pub arguments: Vec<String>,
}

/// Who runs a request: [`Children`], or [`InProcess`].
pub trait Executor {
    /// Runs it to its end, or as far as it goes.
    fn execute(&self, request: &Request) -> Execution;
}

/// Runs requests in this process: what crashes or hangs takes it along.
#[derive(Clone, Copy, Debug)]
pub struct InProcess;

impl Executor for InProcess {
    fn execute(&self, request: &Request) -> Execution {
        execute(request)
    }
}

/// What came of a request.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Execution {
    /// For each job that ended, its written buffers, or the pixels of its targets.
    pub done: Vec<Vec<Vec<u8>>>,
    /// Why not all did.
    pub stopped: Option<Stop>,
}

/// Why a request did not run to its end.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Stop {
    /// The route or the adapter lacks something, or gave up at a limit: a skip.
    Lacks(String),
    /// It failed, crashed, or did not end.
    Failed(String),
}

impl fmt::Display for Stop {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Lacks(reason) | Self::Failed(reason) => f.write_str(reason),
        }
    }
}

/// A route on an adapter, with what it returned, job by job.
struct Cell {
    route: Route,
    adapter: String,
    got: Vec<Ran>,
    /// For each input that ran, what its outputs may be.
    expected: Vec<At>,
    stopped: Option<Stop>,
}

impl Cell {
    fn name(&self) -> String {
        format!("{} on {}", self.route, self.adapter)
    }
}

/// Runs a shader's entry points on the machines of a selection; of the selection only routes and adapters count.
///
/// # Errors
/// [`Error::NoEntryPoint`] when there is nothing to run, [`Error::Ranges`] when the declared ranges do not fit the shader,
/// [`Error::NoSuchCase`], and as [`Selection::pairs`]. A shader that fails is a verdict, not an error.
pub fn run(
    shader: &Shader,
    declared: Option<&Declared>,
    options: &Options,
    selection: &Selection,
    executor: &dyn Executor,
    progress: &mut dyn Progress,
) -> Result<Report, Error> {
    let plans = plans(shader, declared, options)?;
    let pairs = selection.pairs()?;
    let cells: Vec<(Route, String)> = pairs
        .adapters
        .iter()
        .flat_map(|(info, routes)| routes.iter().map(|route| (*route, info.name.clone())))
        .collect();
    let wanted = |id: &CaseId| options.filter.as_deref().is_none_or(|filter| id.matches(filter));
    let ids: Vec<CaseId> = plans.iter().flat_map(Plan::ids).collect();
    if !ids.iter().any(wanted) {
        return Err(Error::NoSuchCase {
            filter: options.filter.clone().unwrap_or_default(),
            known: ids.len(),
        });
    }
    progress.start(cells.len() * ids.iter().filter(|id| wanted(id)).count());
    let (mut results, mut heats) = (Vec::new(), Vec::new());
    for plan in plans.iter().filter(|plan| plan.ids().iter().any(wanted)) {
        let (mut of_plan, heat) = results_of(plan, shader, &cells, options, executor)?;
        heats.extend(heat);
        of_plan.retain(|result| wanted(&result.id));
        of_plan.iter().for_each(|result| progress.done(result));
        results.extend(of_plan);
    }
    let mut environment = environment(selection, &pairs);
    environment.seed = options.seed;
    let mut report = Report::new(environment, results);
    report.heats = heats;
    Ok(report)
}

fn results_of(
    plan: &Plan,
    shader: &Shader,
    cells: &[(Route, String)],
    options: &Options,
    executor: &dyn Executor,
) -> Result<(Vec<CaseResult>, Option<Heat>), Error> {
    let ready = match &plan.ready {
        Ok(ready) => ready,
        Err(reason) => {
            let skipped = |(route, adapter): &(Route, String)| {
                let cell = Cell {
                    route: *route,
                    adapter: adapter.clone(),
                    got: Vec::new(),
                    expected: Vec::new(),
                    stopped: None,
                };
                ["ranges", "agreement"].map(|generator| {
                    result(plan, &cell, options, generator, Outcome::skipped(reason.clone()))
                })
            };
            return Ok((cells.iter().flat_map(skipped).collect(), None));
        }
    };
    let mut known = Known::new(ready, shader);
    let ran: Vec<Cell> = cells
        .iter()
        .map(|cell| run_cell(plan, ready, cell, executor, &mut known))
        .collect();
    let judged = ran.iter().flat_map(|cell| {
        let chosen = result(
            plan,
            cell,
            options,
            "ranges",
            judge::outcome(ready, cell, 0..ready.chosen()),
        );
        let replayed = (ready.replayed > 0).then(|| {
            let inputs = ready.chosen()..ready.points.len();
            result(plan, cell, options, "corpus", judge::outcome(ready, cell, inputs))
        });
        std::iter::once(chosen).chain(replayed)
    });
    let agreed = agree::outcomes(ready, &ran);
    let agreed = ran
        .iter()
        .zip(agreed)
        .filter_map(|(cell, outcome)| Some(result(plan, cell, options, "agreement", outcome?)));
    let results = judged.chain(agreed).collect();
    let heat = match options.attribute {
        Wanted::Nothing => None,
        Wanted::Widest | Wanted::Named(_) => {
            let expected = known.at(ready.points.iter().map(Vec::as_slice));
            heat::of_entry(plan, ready, shader.text(), &expected, &options.attribute)?
        }
    };
    Ok((results, heat))
}

fn run_cell(
    plan: &Plan,
    ready: &Ready,
    (route, adapter): &(Route, String),
    executor: &dyn Executor,
    known: &mut Known<'_>,
) -> Cell {
    let execution = executor.execute(&ready.request(&plan.shader, *route, adapter));
    let decoded = execution
        .done
        .iter()
        .enumerate()
        .map(|(at, left)| ready.decode(at, left));
    let (got, stopped) = match decoded.collect::<Option<Vec<Ran>>>() {
        Some(got) => (got, execution.stopped),
        None => (
            Vec::new(),
            Some(Stop::Failed("it returned results of another size".to_owned())),
        ),
    };
    Cell {
        route: *route,
        adapter: adapter.clone(),
        expected: known.at(got.iter().map(|ran| ran.points.as_slice())),
        got,
        stopped,
    }
}

fn result(plan: &Plan, cell: &Cell, options: &Options, generator: &str, outcome: Outcome) -> CaseResult {
    let Outcome {
        inputs,
        comparison,
        verdict,
        reason,
    } = outcome;
    CaseResult {
        id: plan.id(generator),
        route: cell.route,
        adapter: cell.adapter.clone(),
        basis: if generator == "agreement" {
            vec!["the other routes"]
        } else {
            BASIS.to_vec()
        },
        arguments: options.arguments.clone(),
        inputs,
        outputs: comparison.outputs,
        undecided: comparison.undecided,
        forked: comparison.forked,
        refused: comparison.refused,
        verdict,
        worst: comparison.worst,
        reason,
    }
}

/// An outcome without a refusal: a pass, or a warning with its reason.
fn accepted(inputs: usize, comparison: Comparison, warning: Option<String>) -> Outcome {
    Outcome {
        inputs,
        comparison,
        verdict: if warning.is_some() {
            Verdict::Warn
        } else {
            Verdict::Pass
        },
        reason: warning,
    }
}
