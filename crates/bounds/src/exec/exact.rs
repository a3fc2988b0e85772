//! Operations taken for exact, for [`attribution`](fn@crate::attribution): what an instruction has just computed is narrowed to what its function makes of
//! the operands alone, without the error that the rules allow the operation itself.
//!
//! The function is evaluated in f64 at the ends and in the middle of every operand. An extremum in between, elsewhere than in the middle,
//! is not seen: for intervals as narrow as rounding leaves them that is an effect of second order. Results that are not finite are left
//! as they were.

use super::machine::Machine;
use crate::compile::code::{Instr, Op, Row};
use crate::domain::Domain;
use crate::domain::ops::Compare;
use crate::domain::point::F64;
use crate::width::Width;

/// The most operands of an operation.
const OPERANDS: usize = 4;

impl<D: Domain> Machine<'_, D> {
    /// Whether the instruction stands in a place that is taken for exact.
    #[inline(always)]
    pub(crate) fn is_exact(&self, instr: &Instr) -> bool {
        D::UNCERTAIN && self.exact.get(instr.span as usize).is_some_and(|exact| *exact)
    }

    /// Narrows the result of an instruction. Only floats have errors; everything else stays.
    #[inline(never)]
    pub(crate) fn make_exact(&mut self, instr: &Instr, active: &[u32]) {
        let number = |w: Width, x: f64| F64::float(w, x);
        match &instr.op {
            Op::FloatUnary { op, w, dst, a } => {
                let function = |x: &[f64]| F64::unary(*op, *w, number(*w, x[0]));
                self.narrow_to(*w, *dst, &[*a], active, function);
            }
            Op::FloatBinary { op, w, dst, a, b } => {
                let function = |x: &[f64]| F64::binary(*op, *w, number(*w, x[0]), number(*w, x[1]));
                self.narrow_to(*w, *dst, &[*a, *b], active, function);
            }
            Op::Chain(chain) => {
                let w = chain.w;
                let function = |x: &[f64]| F64::binary(chain.op, w, number(w, x[0]), number(w, x[1]));
                self.narrow_to(w, chain.dst, &[chain.a, chain.b], active, function);
            }
            Op::FloatTernary { op, w, dst, a, b, c } => {
                let function =
                    |x: &[f64]| F64::ternary(*op, *w, number(*w, x[0]), number(*w, x[1]), number(*w, x[2]));
                self.narrow_to(*w, *dst, &[*a, *b, *c], active, function);
            }
            Op::Sum { w, dst, terms, n } => {
                let function = |x: &[f64]| {
                    let cells: Vec<_> = x.iter().map(|x| number(*w, *x)).collect();
                    F64::sum(*w, &cells)
                };
                self.narrow_to(*w, *dst, &terms[..usize::from(*n)], active, function);
            }
            _ => {}
        }
    }

    fn narrow_to(
        &mut self,
        w: Width,
        dst: Row,
        operands: &[Row],
        active: &[u32],
        function: impl Fn(&[f64]) -> <F64 as Domain>::Cell,
    ) {
        for &lane in active {
            let mut bounds = [(0.0, 0.0); OPERANDS];
            for (to, &row) in bounds.iter_mut().zip(operands) {
                *to = D::float_bounds(self.get(row, lane));
            }
            let Some((lo, hi)) = image(&bounds[..operands.len()], |x| F64::to_float(function(x))) else {
                continue;
            };
            let cell = self.get(dst, lane);
            let (cell, _) = D::narrow(Compare::LessEqual, w, cell, D::float(w, hi), [false; 2]);
            let (cell, _) = D::narrow(Compare::GreaterEqual, w, cell, D::float(w, lo), [false; 2]);
            self.set(dst, lane, cell);
        }
    }
}

/// The least and the greatest value at the ends and middles of all operands; `None` where one is not finite.
fn image(bounds: &[(f64, f64)], function: impl Fn(&[f64]) -> f64) -> Option<(f64, f64)> {
    let (mut lo, mut hi) = (f64::INFINITY, f64::NEG_INFINITY);
    let points = 3_usize.pow(bounds.len() as u32);
    for point in 0..points {
        let (mut x, mut rest) = ([0.0; OPERANDS], point);
        for (to, (low, high)) in x.iter_mut().zip(bounds) {
            *to = match rest % 3 {
                0 => *low,
                1 => *high,
                _ => low + (high - low) / 2.0,
            };
            rest /= 3;
        }
        let y = function(&x[..bounds.len()]);
        if !y.is_finite() {
            return None;
        }
        (lo, hi) = (lo.min(y), hi.max(y));
    }
    Some((lo, hi))
}

#[cfg(test)]
mod tests {
    use super::image;

    #[test]
    fn ends_and_middles_bound_what_is_monotone() {
        assert_eq!(
            image(&[(1.0, 2.0), (-1.0, 3.0)], |x| x[0] * x[1]),
            Some((-2.0, 6.0))
        );
        assert_eq!(image(&[(-1.0, 1.0)], |x| x[0] * x[0]), Some((0.0, 1.0)));
        assert_eq!(image(&[(0.0, 1.0)], |x| 1.0 / x[0]), None);
    }
}
