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
//!    to compute the same would be better.
//!
//! Points where a comparison or a step could go either way are not judged: a step is a step.

use super::rule::Rule;
use super::search::{self, Search, Shown};
use crate::domain::point::{F32, F64};
use crate::exec::watch::Event;
use crate::interval::Accept;
use crate::kind::Kind;
use crate::ranges::Point;
use rayon::prelude::*;
use std::time::Instant;

/// An error of this share of an output's usual magnitude is far off: of 24 bits, 4 are left.
const FAR_OFF: f64 = 1.0 / 16.0;

/// An error this many times what the inputs' last digits explain is the formula's.
const FORMULA: f64 = 16.0;

/// Inputs whose last digits are tried; more are taken not to matter.
const MOVED: usize = 64;

/// Points that say what an output usually amounts to.
const USUAL: usize = 128;

const CHUNK: usize = 64;

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
            let shown: Vec<Option<(u32, Point, Event)>> = numbers
                .into_par_iter()
                .filter(|_| Instant::now() < until)
                .map(|n| {
                    let point = self.point(n);
                    let (span, event) = self.loses(&point, &scale)?;
                    Some((span, point, event))
                })
                .collect();
            for (span, point, event) in shown.into_iter().flatten() {
                let shown = Shown {
                    point,
                    event: Some(event),
                };
                self.found.entry((span, Rule::Cancellation)).or_insert(shown);
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

    /// The worst cancellation at a point, if an output is far off there.
    fn loses(&self, point: &Point, scale: &[f64]) -> Option<(u32, Event)> {
        let machine = search::run::<F32>(self.program, self.inputs, point, self.seed).ok()?;
        let exact = search::run::<F64>(self.program, self.inputs, point, self.seed).ok()?;
        let errors = machine
            .outputs
            .iter()
            .zip(&exact.outputs)
            .map(|(x, y)| (x - y).abs());
        let sizes = exact
            .outputs
            .iter()
            .zip(scale)
            .map(|(y, usual)| usual.max(y.abs()));
        let far: Vec<(usize, f64)> = errors
            .zip(sizes)
            .enumerate()
            .filter(|(_, (error, size))| *size > 0.0 && error.is_finite() && *error > FAR_OFF * size)
            .map(|(k, (error, _))| (k, error))
            .collect();
        if far.is_empty() {
            return None;
        }
        let moved = self.moved(point, &exact.outputs)?;
        if !far.iter().any(|(k, error)| *error > FORMULA * moved[*k]) {
            return None;
        }
        let run = search::run::<Accept>(self.program, self.inputs, point, self.seed).ok()?;
        if run.undecided {
            return None;
        }
        let events = run
            .events
            .into_iter()
            .filter(|((_, rule), _)| *rule == Rule::Cancellation);
        events
            .max_by(|a, b| a.1.weight().total_cmp(&b.1.weight()))
            .map(|((span, _), event)| (span, event))
    }

    /// How far the last digits of the inputs move each exact output.
    fn moved(&self, point: &Point, here: &[f64]) -> Option<Vec<f64>> {
        let exact = |point: &Point| {
            let run = search::run::<F64>(self.program, self.inputs, point, self.seed).ok()?;
            Some(run.outputs)
        };
        let mut moved = vec![0.0; here.len()];
        let floats = self.inputs.scalars.iter().enumerate();
        for (k, _) in floats
            .filter(|(_, s)| matches!(s.kind, Kind::Float(_)))
            .take(MOVED)
        {
            let mut other = point.clone();
            other.values[k] *= 1.0 + f64::from(f32::EPSILON) / 2.0;
            if other.values[k] == point.values[k] {
                continue;
            }
            for (sum, (a, b)) in moved.iter_mut().zip(here.iter().zip(exact(&other)?)) {
                *sum += (a - b).abs();
            }
        }
        Some(moved)
    }
}
