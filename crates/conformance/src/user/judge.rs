//! One route's outputs against what the shader's IR allows.

use std::ops::Range;

use bossage_bounds::{Accept, F32, F64, Scalar, Truth};

use super::expect::{Expected, Unknown};
use super::ready::{Ran, Ready};
use super::{Cell, Stop, accepted};
use crate::bound::Bound;
use crate::case::Outcome;
use crate::compare::{Comparison, Refusal, Worst};
use crate::report::json::Number;
use crate::ulp::{error_ulps, ulp};
use crate::verdict::Verdict;

/// What an output may be, as an interval of real numbers; integers and truth values are numbers too.
pub(crate) fn bound(allowed: &Scalar<Accept>) -> Bound {
    match *allowed {
        Scalar::Float(interval) => Bound::from(interval),
        // Nothing is known of an integer that may be any of 32 bits.
        Scalar::Int(lo, hi) if hi - lo >= i128::from(u32::MAX) => Bound::OPEN,
        Scalar::Int(lo, hi) if lo < hi => Bound::between(lo as f64, hi as f64).forked(),
        Scalar::Int(lo, _) => Bound::exactly(lo as f64),
        Scalar::Bool(Truth::Maybe) => Bound::between(0.0, 1.0).forked(),
        Scalar::Bool(truth) => Bound::exactly(f64::from(truth == Truth::True)),
    }
}

/// A value as a number. Integers beyond 2^53 are compared by the nearest double, which can only hide a difference below that.
pub(crate) fn number(got: &Scalar<F32>) -> f64 {
    match *got {
        Scalar::Float(x) => x,
        Scalar::Int(lo, _) => lo as f64,
        Scalar::Bool(truth) => f64::from(truth == Truth::True),
    }
}

/// The formula's value as a number.
pub(crate) fn formula(scalar: &Scalar<F64>) -> Option<f64> {
    match *scalar {
        Scalar::Float(x) => Some(x),
        Scalar::Int(lo, _) => Some(lo as f64),
        Scalar::Bool(_) => None,
    }
}

/// Why an output is refused, if it is.
pub(super) fn refusal(got: &Scalar<F32>, bound: &Bound, starts_unwritten: bool) -> Option<Refusal> {
    let x = number(got);
    // Where one result alone follows, an output that still holds what it held before was never written.
    let stayed = starts_unwritten && Ready::is_unwritten(got);
    if stayed && bound.is_settled() && (bound.low(), bound.high()) != (x, x) {
        return Some(Refusal::Unwritten);
    }
    if bound.contains(x) {
        return None;
    }
    Some(if x.is_finite() {
        Refusal::Outside
    } else {
        Refusal::NotFinite
    })
}

/// All outputs of a cell at some of its inputs.
pub(super) fn outcome(ready: &Ready, cell: &Cell, inputs: Range<usize>) -> Outcome {
    let mut comparison = Comparison::default();
    let mut unknown = None;
    let all = cell.got.iter().zip(&cell.expected).enumerate();
    let wanted = inputs.end;
    for (at, (ran, expected)) in all.take(inputs.end).skip(inputs.start) {
        match expected.as_ref() {
            Ok(expected) => compare(ready, at, ran, expected, &mut comparison),
            Err(reason) => {
                comparison.outputs += ran.got.len();
                comparison.undecided += ran.got.len();
                unknown.get_or_insert(reason);
            }
        }
    }
    // What stopped it after these inputs is none of their business.
    let stopped = cell.stopped.as_ref().filter(|_| cell.got.len() < wanted);
    let inputs = cell.got.len().min(wanted).saturating_sub(inputs.start);
    match stopped {
        Some(Stop::Failed(reason)) => {
            return Outcome {
                inputs,
                comparison,
                verdict: Verdict::Fail,
                reason: Some(reason.clone()),
            };
        }
        Some(Stop::Lacks(reason)) => return Outcome::skipped(reason.clone()),
        None => {}
    }
    if let Some(Unknown::Endless(reason)) = unknown {
        return Outcome {
            inputs,
            comparison,
            verdict: Verdict::Fail,
            reason: Some(reason.clone()),
        };
    }
    let nothing = comparison.outputs > 0 && comparison.undecided == comparison.outputs;
    let warning = match unknown {
        Some(Unknown::Endless(reason) | Unknown::Limited(reason)) => {
            Some(format!("no interval for some inputs: {reason}"))
        }
        None if nothing => {
            Some("the rules leave every output open at these inputs: nothing was judged".to_owned())
        }
        None => None,
    };
    if comparison.refusal.is_some() || comparison.outputs == 0 {
        return Outcome::of(inputs, comparison, 1.0);
    }
    accepted(inputs, comparison, warning)
}

fn compare(ready: &Ready, at: usize, ran: &Ran, expected: &Expected, comparison: &mut Comparison) {
    for (output, (got, allowed)) in ran.got.iter().zip(&expected.allowed).enumerate() {
        let bound = bound(allowed);
        let refusal = refusal(got, &bound, ready.starts_unwritten(output));
        let truth = expected
            .formula
            .as_ref()
            .and_then(|all| formula(&all[output]))
            .filter(|x| bound.is_decided() && bound.contains(*x));
        let badness = badness(number(got), &bound, truth, refusal);
        comparison.count(&bound, refusal);
        comparison.keep_worst(badness, refusal, || {
            worst(ready, (at, ran), output, &bound, truth)
        });
    }
}

/// Refusals by how far they lie outside, then accepted outputs by the share of the allowed error that they use.
fn badness(x: f64, bound: &Bound, truth: Option<f64>, refusal: Option<Refusal>) -> f64 {
    let outside = (bound.low() - x).max(x - bound.high()).max(0.0);
    match refusal {
        Some(Refusal::Unwritten) => 4e30,
        Some(Refusal::NotFinite) => 2e30,
        Some(Refusal::Outside | Refusal::OraclesDisagree | Refusal::Open | Refusal::Disagree) => {
            1e30 * (1.0 + (outside / ulp(x)).min(1e30).ln_1p() / 1e3)
        }
        None if !bound.is_settled() => 0.0,
        None => share(x, bound, truth).unwrap_or(0.0),
    }
}

/// The error as a share of the room on that side of the formula's value.
fn share(x: f64, bound: &Bound, truth: Option<f64>) -> Option<f64> {
    let truth = truth?;
    let room = if x < truth {
        truth - bound.low()
    } else {
        bound.high() - truth
    };
    let share = (x - truth).abs() / room;
    (x != truth).then_some(share).filter(|share| share.is_finite())
}

pub(super) fn worst(
    ready: &Ready,
    (at, ran): (usize, &Ran),
    output: usize,
    bound: &Bound,
    truth: Option<f64>,
) -> Worst {
    let x = number(&ran.got[output]);
    let finite = |x: f64| x.is_finite().then_some(x);
    let name = ready.name(output);
    let point = &ran.points[ready.lane(output)];
    Worst {
        ulp: truth.and_then(|truth| finite(error_ulps(x, truth))),
        abs: truth.and_then(|truth| finite((x - truth).abs())),
        of_bound: share(x, bound, truth),
        input: point.values.iter().map(|x| *x as f32).collect(),
        output,
        written: true,
        got: Number(x),
        truth: Number(truth.unwrap_or(f64::NAN)),
        interval: [Number(bound.low()), Number(bound.high())],
        inputs: ready.named_inputs(point, &name),
        place: Some(format!("{name} at input {at}")),
        other: None,
    }
}
