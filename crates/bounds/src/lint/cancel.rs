//! Catastrophic cancellation: a sum or difference that loses its digits, *and* an output that is far off because of the formula.
//!
//! A difference of nearly equal numbers is known badly relative to itself. That is harmless as long as it stays small (the scalar product
//! of perpendicular vectors is off by no more than rounding), and it is no fault of the formula where the inputs' own last digits move
//! the result as far (the direction of a cross product of nearly parallel vectors). So a finding needs three things at one point:
//!
//! 1. an operation whose operands are known well and whose result is known badly ([`crate::exec::watch`]);
//! 2. an output at which a perfect machine is off by more than [`FAR_OFF`] of what the output usually amounts to, measured against the
//!    formula in `f64`;
//! 3. that error is [`FORMULA`] times what half a unit in the last place of every input makes of the exact result, so that another way
//!    to compute the same would be better; or no inputs within as much give what the machine returned, although the output depends on one vector alone, so
//!    that it is the formula that takes nearly equal numbers from each other ([`backward`](super::backward)); or the
//!    accuracy rules allow that nothing is left of the difference, and then that output is no number: it is divided by, unguarded.
//!
//! Points where a comparison or a step could go either way are not judged by the first of the two: a step is a step.
//!
//! One loss does not show in any of this, because no operation errs: the sum of an input near the opposite of a constant, `1 + n.z`, is exact, but
//! of the input's 24 digits only the last are left in it. It is a finding where an output is moved by more than [`FAR_OFF`] both when the sum
//! grows and when it shrinks by half a unit in the last place of its largest term, which is what rounding made of the input.

use super::backward::{self, Moved};
use super::rule::Rule;
use super::search::{self, Search, Shown};
use crate::domain::point::{F32, F64};
use crate::exec::watch::{Event, Suspicion};
use crate::interval::Accept;
use crate::kind::Kind;
use crate::limits::{Move, Nudge};
use crate::ranges::{Point, Seed, Style};
use rayon::prelude::*;
use std::time::Instant;

/// An error of this share of an output's usual magnitude is far off: of 24 bits, 4 are left.
const FAR_OFF: f64 = 1.0 / 16.0;

/// An error this many times what the inputs' last digits explain is the formula's.
pub(super) const FORMULA: f64 = 16.0;

/// Inputs whose last digits are tried; more are taken not to matter.
const MOVED: usize = 64;

/// Points that say what an output usually amounts to.
const USUAL: usize = 128;

const CHUNK: usize = 64;

/// A point, the exact outputs there, and what counts as large of each.
struct Here<'a> {
    point: &'a Point,
    outputs: &'a [f64],
    sizes: Vec<f64>,
}

impl Search<'_> {
    /// Looks for cancellation at that many points, or until the time is up.
    pub(super) fn cancellation(&mut self, points: usize, until: Instant) {
        let scale = self.usual(until);
        if scale.is_empty() {
            return;
        }
        let mut at = 0;
        while at < points && Instant::now() < until {
            let numbers: Vec<u64> = (at..(at + CHUNK).min(points)).map(|n| n as u64).collect();
            let shown: Vec<(Point, Vec<(u32, Event)>)> = numbers
                .into_par_iter()
                .filter(|_| Instant::now() < until)
                .map(|n| {
                    let point = self.related(n);
                    let lost = self.losses(&point, &scale).unwrap_or_default();
                    (point, lost)
                })
                .collect();
            for (point, (span, event)) in shown
                .iter()
                .flat_map(|(point, lost)| lost.iter().map(move |one| (point, one)))
            {
                self.found
                    .entry((*span, Rule::Cancellation))
                    .or_insert_with(|| Shown {
                        point: point.clone(),
                        event: Some(*event),
                    });
            }
            at += CHUNK;
        }
    }

    /// The magnitude that each output stays below at nine of ten random points.
    fn usual(&self, until: Instant) -> Vec<f64> {
        let runs = (0..USUAL as u64)
            .filter(|_| Instant::now() < until)
            .map(|n| search::run::<F32>(self.program, self.inputs, &self.point(4 * n + 3), self.seed));
        let outputs: Vec<Vec<f64>> = runs
            .filter_map(|run| run.ok().map(|run| run.outputs))
            .filter(|outputs| !outputs.is_empty())
            .collect();
        let Some(n) = outputs.iter().map(Vec::len).min() else {
            return Vec::new();
        };
        (0..n)
            .map(|k| {
                let mut all: Vec<f64> = outputs
                    .iter()
                    .map(|list| list[k].abs())
                    .filter(|x| x.is_finite())
                    .collect();
                all.sort_by(f64::total_cmp);
                all.get(all.len() * 9 / 10).copied().unwrap_or(0.0)
            })
            .collect()
    }

    /// Every other point is one that [`Search::explore`] tries, every other one has inputs that are related to each other.
    fn related(&self, number: u64) -> Point {
        if number.is_multiple_of(2) {
            return self.point(number / 2);
        }
        let mut seed = Seed::new(self.seed ^ number.wrapping_mul(0x9e6c_63d0_876a_3f35));
        self.inputs.sample(&mut seed, Style::Related)
    }

    /// What loses its digits at a point, with an output that is far off for it.
    fn losses(&self, point: &Point, scale: &[f64]) -> Option<Vec<(u32, Event)>> {
        let machine = search::run::<F32>(self.program, self.inputs, point, self.seed).ok()?;
        let exact = search::run::<F64>(self.program, self.inputs, point, self.seed).ok()?;
        let sizes = exact.outputs.iter().zip(scale);
        let here = Here {
            point,
            sizes: sizes.map(|(y, usual)| usual.max(y.abs())).collect(),
            outputs: &exact.outputs,
        };
        let mut found: Vec<(u32, Event)> = self.cancels(&machine.outputs, &here).into_iter().collect();
        let near = machine
            .suspects
            .iter()
            .filter(|((_, suspicion), _)| *suspicion == Suspicion::NearConstant);
        let amplified = near.filter(|((span, _), _)| {
            let known = self.found.contains_key(&(*span, Rule::Cancellation));
            !known && (0..scale.len()).any(|k| self.moves(&here, *span, k, true))
        });
        found.extend(amplified.map(|((span, _), event)| (*span, *event)));
        Some(found)
    }

    /// The worst cancellation at a point, if an output of the machine is far off for it.
    fn cancels(&self, machine: &[f64], here: &Here<'_>) -> Option<(u32, Event)> {
        let errors: Vec<f64> = machine.iter().zip(here.outputs).map(|(x, y)| x - y).collect();
        let far: Vec<(usize, f64)> = errors
            .iter()
            .map(|error| error.abs())
            .enumerate()
            .filter(|(k, error)| error.is_finite() && *error > FAR_OFF * here.sizes[*k])
            .filter(|(k, _)| here.sizes[*k] > 0.0)
            .collect();
        if far.is_empty() {
            return None;
        }
        let moves = self.moves_of_inputs(here)?;
        let run = search::run::<Accept>(self.program, self.inputs, here.point, self.seed).ok()?;
        let mut events: Vec<(u32, Event)> = run
            .events
            .iter()
            .filter(|((_, rule), _)| *rule == Rule::Cancellation)
            .map(|((span, _), event)| (*span, *event))
            .collect();
        events.sort_by(|a, b| b.1.weight().total_cmp(&a.1.weight()));
        let moved = |k: usize| moves.iter().map(|m| m.of[k].abs()).sum::<f64>();
        let by_formula = far.iter().any(|(k, error)| *error > FORMULA * moved(*k))
            || backward::unreachable(&errors, &here.sizes, &moves).is_some_and(|left| left > FAR_OFF);
        if by_formula && !run.undecided {
            return events.first().copied();
        }
        let mut causes = events.into_iter();
        causes.find(|(span, event)| {
            let [lo, hi] = event.operands();
            lo <= 0.0
                && hi >= 0.0
                && far.iter().any(|(k, _)| self.moves(here, *span, *k, false))
                && self.fails_at_zero(here, *span)
        })
    }

    /// Whether an output is no number where what is left of the terms at a place is nothing.
    fn fails_at_zero(&self, here: &Here<'_>, span: u32) -> bool {
        let nudge = Some(Nudge {
            span,
            how: Move::Vanish,
        });
        let run = search::run_nudged::<F32>(self.program, self.inputs, here.point, self.seed, nudge);
        run.is_ok_and(|run| run.outputs.iter().any(|x| !x.is_finite()))
    }

    /// Whether half a unit in the last place of what is added at a place moves an output far: up and down, or either.
    fn moves(&self, here: &Here<'_>, span: u32, output: usize, both: bool) -> bool {
        let far = |how: Move| {
            let nudge = Some(Nudge { span, how });
            let run = search::run_nudged::<F64>(self.program, self.inputs, here.point, self.seed, nudge);
            let (x, size) = (here.outputs[output], here.sizes[output]);
            let moved = run
                .ok()
                .and_then(|run| Some((run.outputs.get(output)? - x).abs()));
            moved.is_some_and(|moved| size > 0.0 && moved > FAR_OFF * size)
        };
        if both {
            far(Move::Up) && far(Move::Down)
        } else {
            far(Move::Up) || far(Move::Down)
        }
    }

    /// How far half a unit in the last place of each input moves the exact outputs.
    fn moves_of_inputs(&self, here: &Here<'_>) -> Option<Vec<Moved>> {
        let mut moves = Vec::new();
        for (group, scalars) in self.inputs.groups.iter().map(|g| g.scalars.clone()).enumerate() {
            for k in scalars {
                let mut other = here.point.clone();
                other.values[k] *= 1.0 + f64::from(f32::EPSILON) / 2.0;
                let float = matches!(self.inputs.scalars[k].kind, Kind::Float(_));
                if !float || other.values[k] == here.point.values[k] || moves.len() == MOVED {
                    continue;
                }
                let run = search::run::<F64>(self.program, self.inputs, &other, self.seed).ok()?;
                let of = run.outputs.iter().zip(here.outputs).map(|(x, y)| x - y).collect();
                moves.push(Moved { group, of });
            }
        }
        Some(moves)
    }
}
