//! Which quotients are components of vectors over their own length: `v / length(v)`, `normalize(v)`, `s / sqrt(dot(s, s))`, and the
//! same with `s = v / m`, every component divided by one divisor first.
//!
//! What is recognised are rows, so it holds through `let`, swizzles and vector arithmetic, within one function. A root of a sum of
//! products of which one is no square, and a product with `inverseSqrt`, are left alone.

use super::builder::{Builder, Frame};
use super::code::{Op, Part, Row, Unit};
use crate::domain::ops::{FloatBinary, FloatUnary};
use crate::error::Result;
use crate::kind::Kind;
use crate::width::Width;
use std::collections::HashMap;

/// The most components that a vector has.
const MAX_PARTS: usize = 4;

/// What is known of rows.
#[derive(Default)]
pub(crate) struct Units {
    squares: HashMap<Row, Row>,
    sums: HashMap<Row, Vec<Row>>,
    /// A root, and the sum of squares below it.
    roots: HashMap<Row, Row>,
    quotients: HashMap<Row, (Row, Row)>,
}

impl Units {
    /// Notes what an instruction makes.
    pub(crate) fn note(&mut self, op: &Op) {
        match op {
            Op::FloatUnary {
                op: FloatUnary::Square,
                dst,
                a,
                ..
            } => {
                self.squares.insert(*dst, *a);
            }
            Op::FloatUnary {
                op: FloatUnary::Sqrt,
                dst,
                a,
                ..
            } => {
                self.roots.insert(*dst, *a);
            }
            Op::FloatBinary {
                op: FloatBinary::Divide,
                dst,
                a,
                b,
                ..
            } => {
                self.quotients.insert(*dst, (*a, *b));
            }
            Op::FloatBinary {
                op: FloatBinary::Add,
                dst,
                a,
                b,
                ..
            } => self.sum(*dst, &[*a, *b]),
            Op::Chain(chain) if chain.op == FloatBinary::Add => self.sum(chain.dst, &[chain.a, chain.b]),
            Op::Sum { dst, terms, n, .. } => self.sum(*dst, &terms[..usize::from(*n)]),
            // Every other instruction makes nothing that this file looks for.
            _ => {}
        }
    }

    /// Remembers a sum where each term is a square, or a sum of squares.
    fn sum(&mut self, dst: Row, terms: &[Row]) {
        let of = |row: &Row| match self.squares.get(row) {
            Some(&side) => Some(vec![side]),
            None => self.sums.get(row).cloned(),
        };
        if let Some(sides) = terms.iter().map(of).collect::<Option<Vec<_>>>() {
            self.sums.insert(dst, sides.concat());
        }
    }

    /// The quotient `a / b` as a component over a length.
    fn unit(&self, w: Width, a: Row, b: Row) -> Option<Unit> {
        let sum = *self.roots.get(&b)?;
        let sides = self.sums.get(&sum).filter(|sides| sides.len() <= MAX_PARTS)?;
        let at = sides.iter().position(|&side| side == a)?;
        let whole: Option<Vec<(Row, Row)>> = sides
            .iter()
            .map(|side| self.quotients.get(side).copied())
            .collect();
        let divided = whole.filter(|list| list.iter().all(|&(_, m)| m == list[0].1));
        let divisor = divided.as_ref().map(|list| list[0].1);
        let part = |(k, &scaled): (usize, &Row)| Part {
            scaled,
            whole: divided.as_ref().map_or(scaled, |list| list[k].0),
        };
        Some(Unit {
            w,
            dst: 0,
            quotient: 0,
            sum,
            parts: sides.iter().enumerate().map(part).collect(),
            divisor,
            at,
        })
    }
}

impl<'m> Builder<'m> {
    /// The row of the quotient `a / b`, which is in `quotient`, with what more is known of it.
    pub(crate) fn over_length(
        &mut self,
        frame: &mut Frame<'m>,
        w: Width,
        quotient: Row,
        a: Row,
        b: Row,
    ) -> Result<Row> {
        match self.units.unit(w, a, b) {
            Some(unit) => self.emit(frame, Kind::Float(w), |dst| {
                Op::Unit(Box::new(Unit {
                    dst,
                    quotient,
                    ..unit
                }))
            }),
            None => Ok(quotient),
        }
    }
}
