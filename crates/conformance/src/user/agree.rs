//! The routes' outputs against each other.
//!
//! The first cell that ran to its end is what the others are compared with: `embedded`, our own evaluator, where it did. Two results that
//! differ are allowed where the interval admits both. Where it admits one of them, or none, they *disagree*. Where the rules say nothing
//! at all they differ by right; that is counted and a warning. Of fragments only inputs are compared at which both rasterisers interpolated the
//! same numbers.

use bossage_bounds::ranges::Point;
use bossage_bounds::{F32, Scalar};

use super::judge::{bound, number, worst};
use super::ready::Ready;
use super::{Cell, accepted};
use crate::bound::Bound;
use crate::case::Outcome;
use crate::compare::{Comparison, OtherResult, Refusal};
use crate::report::json::Number;
use crate::route::Route;
use crate::ulp::ulp_distance;

/// One outcome a cell; none for the one that the others are compared with.
pub(super) fn outcomes(ready: &Ready, cells: &[Cell]) -> Vec<Option<Outcome>> {
    let complete = |cell: &&Cell| cell.stopped.is_none() && !cell.got.is_empty();
    let first = cells
        .iter()
        .filter(complete)
        .find(|cell| cell.route == Route::Embedded)
        .or_else(|| cells.iter().find(complete));
    let one = |cell: &Cell| match first {
        None => Some(Outcome::skipped(
            "no route ran to its end, so there is nothing to compare with",
        )),
        Some(first) if std::ptr::eq(first, cell) => (cells.iter().filter(complete).count() == 1)
            .then(|| Outcome::skipped("no other route ran to its end")),
        Some(first) => Some(match &cell.stopped {
            Some(stop) => Outcome::skipped(stop.to_string()),
            None => outcome(ready, cell, first),
        }),
    };
    cells.iter().map(one).collect()
}

fn outcome(ready: &Ready, cell: &Cell, first: &Cell) -> Outcome {
    let mut comparison = Comparison::default();
    let mut by_right = 0;
    let mut inputs = 0;
    for (at, (ran, other)) in cell.got.iter().zip(&first.got).enumerate() {
        if !same_inputs(&ran.points, &other.points) {
            continue;
        }
        inputs += 1;
        for (output, (got, other)) in ran.got.iter().zip(&other.got).enumerate() {
            let bound = cell.expected[at]
                .as_ref()
                .as_ref()
                .map_or(Bound::OPEN, |expected| bound(&expected.allowed[output]));
            let differ = !same(got, other);
            by_right += usize::from(differ && !bound.is_decided());
            let disagree = differ && !(bound.contains(number(got)) && bound.contains(number(other)));
            let refusal = disagree.then_some(Refusal::Disagree);
            let distance = distance(got, other);
            let badness = match refusal {
                Some(_) => 1e30 * (1.0 + distance.unwrap_or(1e20).ln_1p() / 1e3),
                None if bound.is_settled() => distance.unwrap_or(0.0),
                None => 0.0,
            };
            comparison.count(&bound, refusal);
            comparison.keep_worst(badness, refusal, || {
                let mut worst = worst(ready, (at, ran), output, &bound, None);
                worst.ulp = distance;
                worst.abs = Some((number(got) - number(other)).abs()).filter(|x| x.is_finite());
                worst.other = Some(OtherResult {
                    from: first.name(),
                    got: Number(number(other)),
                });
                worst
            });
        }
    }
    if inputs == 0 && !cell.got.is_empty() {
        return Outcome::skipped(format!(
            "its rasteriser interpolates otherwise than that of {} at every input, so no outputs are comparable",
            first.name()
        ));
    }
    if comparison.refusal.is_some() || comparison.outputs == 0 {
        return Outcome::of(inputs, comparison, 1.0);
    }
    let warning = (by_right > 0).then(|| {
        format!(
            "{by_right} of {} outputs differ from {} where the rules leave the result open: allowed, but not portable",
            comparison.outputs,
            first.name()
        )
    });
    accepted(inputs, comparison, warning)
}

/// Whether two machines got the same inputs, to the bit.
fn same_inputs(a: &[Point], b: &[Point]) -> bool {
    let bits = |points: &[Point]| -> Vec<u64> {
        points
            .iter()
            .flat_map(|point| &point.values)
            .map(|x| x.to_bits())
            .collect()
    };
    bits(a) == bits(b)
}

/// Equal numbers; two NaNs are the same.
fn same(a: &Scalar<F32>, b: &Scalar<F32>) -> bool {
    let (a, b) = (number(a), number(b));
    a == b || (a.is_nan() && b.is_nan())
}

/// How many f32 numbers apart.
fn distance(a: &Scalar<F32>, b: &Scalar<F32>) -> Option<f64> {
    ulp_distance(number(a) as f32, number(b) as f32).map(|n| n as f64)
}
