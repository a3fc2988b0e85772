//! Numeric lint: which operations of a shader can go wrong for inputs in their declared ranges, and with which input they do.
//!
//! Two engines work together:
//!
//! - A **walk** (`walk`) over intervals excludes. With every input in its range, each operation's operands are bounded; conditions narrow
//!   what is walked under them, and relations between values (no component exceeds the largest, a vector over its length is a unit
//!   vector) close what intervals alone leave open. Where alarms remain, the box of inputs is cut in two and walked again (`prove`).
//! - A **search** (`search`) shows. Seeded points, at the edges of the ranges first, run over the perfect machine
//!   ([`F32`](crate::F32)) with every operation watched, between points on both sides of a zero by bisection, and over [`Accept`](crate::Accept) for lost digits (`cancel`). Where an output is not finite, the sums and
//!   products that it comes from are named as well (`cause`).
//!
//! A finding with a witness does happen. A finding without one could neither be excluded nor shown, and says so. What neither raises is
//! excluded, unless [`Report::unfinished`] says that a loop or a budget kept the walk from seeing all.
//!
//! Integer division by zero, shifts and indices out of bounds have an answer in the language and are no findings here. Integers in floats
//! are floats. Of races between invocations nothing is seen.

mod backward;
mod cancel;
mod cause;
mod prove;
mod relate;
pub(crate) mod rule;
mod search;
mod size;
mod space;
mod state;
mod step;
mod table;
mod texels;
mod walk;

pub use rule::Rule;
pub(crate) use step::rule_at;

use crate::compile::program::Program;
use crate::ranges::{Inputs, Seed};
use naga::Span;
use search::{Search, Shown};
use std::collections::BTreeSet;
use std::time::{Duration, Instant};

/// How much to try.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Options {
    /// Where random choices start; printed with every witness.
    pub seed: u64,
    /// Points that are run in search of witnesses.
    pub points: usize,
    /// Boxes that are walked to exclude alarms.
    pub boxes: usize,
    /// An end to both, whatever is left.
    pub time: Duration,
}

impl Default for Options {
    fn default() -> Self {
        Self {
            seed: 1,
            points: 4096,
            boxes: 512,
            time: Duration::from_secs(4),
        }
    }
}

/// Inputs with which it happens.
#[derive(Clone, Debug, PartialEq)]
pub struct Witness {
    /// Values of the inputs, by the name of the vector or scalar. Textures are left out: their texels come from the seed.
    pub inputs: Vec<(String, Vec<f64>)>,
    /// What the operation had there, in words.
    pub operands: String,
}

/// One operation that can go wrong.
#[derive(Clone, Debug, PartialEq)]
pub struct Finding {
    /// What goes wrong.
    pub rule: Rule,
    /// The operation.
    pub span: Span,
    /// With which inputs; `None` where none was found.
    pub witness: Option<Witness>,
}

/// What the lint has to say about one entry point.
#[derive(Clone, Debug, PartialEq)]
pub struct Report {
    /// Findings, in source order.
    pub findings: Vec<Finding>,
    /// Whether loops or budgets kept some operations from being judged by the walk.
    pub unfinished: bool,
}

/// Lints an entry point.
pub fn lint(program: &Program, inputs: &Inputs, options: &Options) -> Report {
    let start = Instant::now();
    let until = |share: f64| start + options.time.mul_f64(share);
    let mut search = Search::new(program, inputs, options.seed);
    search.explore(options.points, until(0.4));
    search.cancellation(options.points / 4, until(0.6));
    let mut seed = Seed::new(options.seed);
    let known: BTreeSet<prove::Site> = search.found.keys().copied().collect();
    let proved = until(0.9);
    let verdict = prove::prove(program, inputs, options.boxes, proved, &mut seed, |point| {
        let mut found = search.attempt(point, proved);
        found.extend(&known);
        found
    });
    search.close_in(&verdict.open, until(1.1));
    search.simplify(until(1.3));
    let mut findings: Vec<Finding> = search
        .found
        .iter()
        .map(|(&(span, rule), shown)| finding(program, inputs, span, rule, Some(shown)))
        .collect();
    let open = verdict
        .open
        .iter()
        .filter(|site| !search.found.contains_key(site));
    findings.extend(open.map(|&(span, rule)| finding(program, inputs, span, rule, None)));
    let ends = |span: &u32| search.found.contains_key(&(*span, Rule::UnboundedLoop));
    let loops = verdict.loops.iter().filter(|span| !ends(span));
    findings.extend(loops.map(|&span| finding(program, inputs, span, Rule::UnboundedLoop, None)));
    findings.sort_by_key(|f| (f.span.to_range().map_or(0, |r| r.start), f.rule));
    findings.dedup_by_key(|f| (f.span.to_range(), f.rule));
    Report {
        findings,
        unfinished: !verdict.loops.is_empty() || verdict.stopped,
    }
}

fn finding(program: &Program, inputs: &Inputs, span: u32, rule: Rule, shown: Option<&Shown>) -> Finding {
    Finding {
        rule,
        span: program.code.spans.get(span as usize).copied().unwrap_or_default(),
        witness: shown.map(|shown| witness(inputs, rule, shown)),
    }
}

fn witness(inputs: &Inputs, rule: Rule, shown: &Shown) -> Witness {
    let values = inputs.groups.iter().map(|group| {
        let values = shown.point.values[group.scalars.clone()].to_vec();
        (group.name.clone(), values)
    });
    let operands = match (rule, shown.event) {
        (Rule::UnboundedLoop, _) => format!("the loop runs for more than {} operations", search::OPERATIONS),
        (Rule::Cancellation, Some(event)) => {
            format!("the relative error grows by a factor of {:.0}", event.weight())
        }
        (Rule::DivisionByZero | Rule::NormaliseZero, Some(event)) => {
            let [a, b] = event.operands();
            format!("{a:?} / {b:?}")
        }
        (Rule::VanishingSum, Some(_)) => "the terms cancel to nothing".to_owned(),
        (Rule::Underflow, Some(event)) => {
            let [a, b] = event.operands();
            format!("{a:?} · {b:?} is zero")
        }
        (Rule::PowerDomain, Some(event)) => {
            let [a, b] = event.operands();
            format!("pow({a:?}, {b:?})")
        }
        (_, Some(event)) => format!("with {:?}", event.operands()[0]),
        (_, None) => String::new(),
    };
    Witness {
        inputs: values.collect(),
        operands,
    }
}
