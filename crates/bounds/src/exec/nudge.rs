//! Results moved on purpose, for [`crate::lint`]: what follows from an operation is seen by giving it another result.
//!
//! Sums and products only, in domains of single numbers. A sum whose terms cancelled to nothing is given a small part of its terms back, a
//! product that vanished the least normal number; a sum of which little is left moves by half a unit in the last place of its largest
//! term, which is what the rounding of that term may have been, or is taken for nothing.

use super::machine::Machine;
use crate::compile::code::{Instr, Op, Row};
use crate::domain::Domain;
use crate::domain::ops::{FloatBinary, FloatUnary};
use crate::limits::Move;
use crate::width::{Width, exp2i};

/// The part of its terms that a sum is given back.
const GIVEN_BACK: i32 = -12;

/// Less than this part of its terms is little.
const LITTLE: f64 = 1.0 / 4096.0;

/// The most terms of one instruction.
const TERMS: usize = 4;

/// Whether terms are added or multiplied.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Combines {
    Sum,
    Product,
}

/// A sum or a product.
pub(crate) struct Combination {
    pub(crate) combines: Combines,
    pub(crate) w: Width,
    pub(crate) dst: Row,
    terms: [Row; TERMS],
    n: usize,
}

impl Combination {
    /// What an instruction adds or multiplies, if it does.
    pub(crate) fn of(op: &Op) -> Option<Self> {
        let two = |combines, w, dst, a, b| Self {
            combines,
            w,
            dst,
            terms: [a, b, 0, 0],
            n: 2,
        };
        match op {
            Op::FloatBinary { op, w, dst, a, b } => Some(two(combines(*op)?, *w, *dst, *a, *b)),
            Op::Chain(chain) => Some(two(combines(chain.op)?, chain.w, chain.dst, chain.a, chain.b)),
            Op::FloatUnary {
                op: FloatUnary::Square,
                w,
                dst,
                a,
            } => Some(two(Combines::Product, *w, *dst, *a, *a)),
            Op::Sum { w, dst, terms, n } => Some(Self {
                combines: Combines::Sum,
                w: *w,
                dst: *dst,
                terms: *terms,
                n: usize::from(*n),
            }),
            _ => None,
        }
    }

    pub(crate) fn terms(&self) -> &[Row] {
        &self.terms[..self.n]
    }

    /// Whether terms that are not zero gave zero.
    pub(crate) fn vanishes(&self, terms: &[f64], result: f64) -> bool {
        let given = |x: &f64| x.is_finite() && *x != 0.0;
        let enough = match self.combines {
            Combines::Sum => terms.iter().any(given),
            Combines::Product => terms.iter().all(given),
        };
        result == 0.0 && enough
    }

    /// Whether little is left of the terms of a sum, but not nothing.
    pub(crate) fn leaves_little(&self, terms: &[f64], result: f64) -> bool {
        let most = largest(terms);
        self.combines == Combines::Sum && most.is_finite() && result != 0.0 && result.abs() < LITTLE * most
    }

    fn moved(&self, how: Move, terms: &[f64], result: f64) -> Option<f64> {
        let half = self.w.ulp(largest(terms)) / 2.0;
        match (how, self.combines) {
            (Move::Restore, _) if !self.vanishes(terms, result) => None,
            (Move::Restore, Combines::Sum) => Some(largest(terms) * exp2i(GIVEN_BACK)),
            (Move::Restore, Combines::Product) => Some(self.w.min_normal()),
            (Move::Up | Move::Down | Move::Vanish, Combines::Product) => None,
            (Move::Up | Move::Down | Move::Vanish, Combines::Sum)
                if result.abs() >= LITTLE * largest(terms) =>
            {
                None
            }
            (Move::Vanish, _) => Some(0.0),
            (Move::Up, _) => Some(result + half),
            (Move::Down, _) => Some(result - half),
        }
    }
}

fn combines(op: FloatBinary) -> Option<Combines> {
    match op {
        FloatBinary::Add | FloatBinary::Subtract => Some(Combines::Sum),
        FloatBinary::Multiply => Some(Combines::Product),
        FloatBinary::Divide
        | FloatBinary::Remainder
        | FloatBinary::Min
        | FloatBinary::Max
        | FloatBinary::Atan2
        | FloatBinary::Pow
        | FloatBinary::Step => None,
    }
}

/// The largest magnitude.
pub(crate) fn largest(terms: &[f64]) -> f64 {
    terms.iter().fold(0.0, |most, x| x.abs().max(most))
}

impl<D: Domain> Machine<'_, D> {
    /// The numbers that an instruction combines in a lane, and how many.
    pub(crate) fn numbers(&self, rows: &[Row], lane: u32) -> ([f64; TERMS], usize) {
        let mut numbers = [0.0; TERMS];
        for (to, &row) in numbers.iter_mut().zip(rows) {
            *to = D::float_bounds(self.get(row, lane)).0;
        }
        (numbers, rows.len())
    }

    /// Moves the results of an instruction, if it stands where they are to be moved.
    #[inline(never)]
    pub(crate) fn nudge(&mut self, instr: &Instr, active: &[u32], (span, how): (u32, Move)) {
        if D::UNCERTAIN || instr.span != span {
            return;
        }
        let Some(combination) = Combination::of(&instr.op) else {
            return;
        };
        for &lane in active {
            let (numbers, n) = self.numbers(combination.terms(), lane);
            let result = D::float_bounds(self.get(combination.dst, lane)).0;
            if let Some(x) = combination.moved(how, &numbers[..n], result) {
                self.set(combination.dst, lane, D::float(combination.w, x));
            }
        }
    }
}
