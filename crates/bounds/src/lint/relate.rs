//! What follows from how values were made, beyond their ranges one by one.
//!
//! - A number is no larger in magnitude than the maximum, the sum of magnitudes or the root of the sum of squares it went into.
//! - So a vector divided by its largest component, or by its length, has components within [−1, 1]; the sum of its squares is at
//!   least 1, or is 1.
//! - A vector times the power of two that brings its largest component to [½, 1) has components within [−1, 1].
//! - The scalar product of two unit vectors lies within [−1, 1].
//!
//! Each up to rounding, for which [`SLACK`] leaves ample room; relations through squares hold where nothing underflows, which is
//! asked for.

use super::size;
use super::state::State;
use super::table::{Def, Table, Vn};
use crate::domain::ops::{FloatBinary, FloatUnary};

/// Relative room for the rounding of the few operations of a relation: 16 units in the last place of `f32`. In `f16` relations are not
/// used.
const SLACK: f64 = 2e-6;

/// A sum of squares below this may have lost a square to underflow that matters.
const SAFE_SQUARES: f64 = 1e-30;

impl State {
    fn bounds(&self, vn: Vn) -> Option<(f64, f64)> {
        self.known_float(vn)
    }

    fn is_positive(&self, vn: Vn) -> bool {
        self.bounds(vn).is_some_and(|b| b.0 >= 0.0)
    }

    /// A lower end of |x| that a guard on the magnitude or on the square gives, where x itself may have either sign.
    pub(super) fn magnitude_at_least(&self, table: &Table, x: Vn) -> Option<f64> {
        let of = |op: FloatUnary| {
            self.bounds(table.find(&Def::Unary(op, table.bare(x)))?)
                .map(|b| b.0)
        };
        let by_square = of(FloatUnary::Square)
            .filter(|square| *square >= SAFE_SQUARES)
            .map(|square| square.sqrt() * (1.0 - SLACK));
        let direct = of(FloatUnary::Abs).filter(|least| *least > 0.0);
        direct.into_iter().chain(by_square).reduce(f64::max)
    }

    /// A factor `k` with |s| ≤ k·m, if one follows from how both were made; `depth` bounds the search.
    pub(super) fn at_most(&self, table: &Table, s: Vn, m: Vn, depth: u32) -> Option<f64> {
        if depth == 0 {
            return None;
        }
        if table.bare(s) == table.bare(m) && self.is_positive(m) {
            return Some(1.0);
        }
        let below = |m: Vn| self.at_most(table, s, m, depth - 1);
        let through = match table.def(m) {
            Def::Unary(FloatUnary::Abs, x) => below(*x),
            Def::Binary(FloatBinary::Max, a, b) => below(*a).or_else(|| below(*b)),
            Def::Binary(FloatBinary::Min, a, b) => Some(below(*a)?.max(below(*b)?)),
            Def::Binary(FloatBinary::Add, a, b) => self.below_sum(&[*a, *b], below),
            Def::Sum(terms) => self.below_sum(terms, below),
            Def::Unary(FloatUnary::Sqrt, squares) => self.below_root(table, s, *squares),
            Def::Input(_)
            | Def::Constant(..)
            | Def::Unary(..)
            | Def::Binary(..)
            | Def::Ternary(..)
            | Def::Compare(..)
            | Def::Not(_)
            | Def::Bool(..)
            | Def::Pure(..)
            | Def::Opaque(..) => None,
        };
        let by_order = || self.smaller_than(m).into_iter().find_map(below);
        through
            .or_else(by_order)
            .or_else(|| self.smaller_side(table, s, m, depth))
    }

    /// The same from the other side: what the smaller value is made of.
    fn smaller_side(&self, table: &Table, s: Vn, m: Vn, depth: u32) -> Option<f64> {
        match table.def(table.bare(s)) {
            Def::Binary(FloatBinary::Min, a, b) if self.is_positive(*a) && self.is_positive(*b) => self
                .at_most(table, *a, m, depth - 1)
                .or_else(|| self.at_most(table, *b, m, depth - 1)),
            Def::Binary(FloatBinary::Multiply, a, b) => {
                let share = |x: Vn| {
                    self.bounds(x)
                        .map(|b| b.0.abs().max(b.1.abs()))
                        .filter(|k| *k <= 2.0)
                };
                let of = |x: Vn, y: Vn| Some(self.at_most(table, x, m, depth - 1)? * share(y)?);
                of(*a, *b).or_else(|| of(*b, *a))
            }
            Def::Input(_)
            | Def::Constant(..)
            | Def::Unary(..)
            | Def::Binary(..)
            | Def::Ternary(..)
            | Def::Sum(_)
            | Def::Compare(..)
            | Def::Not(_)
            | Def::Bool(..)
            | Def::Pure(..)
            | Def::Opaque(..) => None,
        }
    }

    /// A term of a sum of positive terms is below the sum.
    fn below_sum(&self, terms: &[Vn], below: impl Fn(Vn) -> Option<f64>) -> Option<f64> {
        if !terms.iter().all(|t| self.is_positive(*t)) {
            return None;
        }
        terms.iter().find_map(|t| below(*t))
    }

    /// |x| ≤ √(Σ xᵢ²) for one of the xᵢ, where the sum is too large to have lost its square.
    fn below_root(&self, table: &Table, s: Vn, squares: Vn) -> Option<f64> {
        let members = squared_terms(table, squares)?;
        let large = self.bounds(squares).is_some_and(|b| b.0 >= SAFE_SQUARES);
        (large && members.contains(&table.bare(s))).then_some(1.0 + SLACK)
    }

    /// Values one of which equals `m` in magnitude.
    fn attained(&self, table: &Table, m: Vn) -> Option<Vec<Vn>> {
        match table.def(m) {
            Def::Unary(FloatUnary::Abs, x) => Some(vec![table.bare(*x)]),
            Def::Binary(FloatBinary::Max, a, b) => {
                let floor = |c: Vn, other: Vn| match table.def(c) {
                    Def::Constant(..) => Some(self.bounds(c)?.1 <= self.bounds(other)?.0),
                    _ => None,
                };
                if floor(*b, *a) == Some(true) {
                    return self.attained(table, *a);
                }
                if floor(*a, *b) == Some(true) {
                    return self.attained(table, *b);
                }
                let mut both = self.attained(table, *a)?;
                both.extend(self.attained(table, *b)?);
                Some(both)
            }
            _ => None,
        }
    }

    /// Bounds of a quotient that follow from how its operands were made.
    pub(super) fn quotient(&self, table: &Table, a: Vn, b: Vn) -> Option<(f64, f64)> {
        let positive = self.bounds(b).is_some_and(|bounds| bounds.0 > 0.0);
        let k = self.at_most(table, a, b, 12).filter(|_| positive)? * (1.0 + SLACK);
        let least = if self.is_positive(a) { 0.0 } else { -k };
        Some((least, k))
    }

    /// Bounds of a product that follow from how its factors were made: one of them brings the other to size.
    pub(super) fn product(&self, table: &Table, a: Vn, b: Vn) -> Option<(f64, f64)> {
        let sized = |x: Vn, factor: Vn| {
            let sized = size::brought_to_size(table, factor)?;
            let most = sized.largest(self.bounds(sized.number)?)?;
            let share = self.at_most(table, x, sized.number, 12)?;
            Some((x, share * most * (1.0 + SLACK)))
        };
        let (x, k) = sized(a, b).or_else(|| sized(b, a))?;
        let least = if self.is_positive(x) { 0.0 } else { -k };
        Some((least, k))
    }

    /// Bounds of a sum that follow from how its terms were made.
    pub(super) fn total(&self, table: &Table, terms: &[Vn]) -> Option<(f64, f64)> {
        let mut all = Vec::new();
        terms.iter().for_each(|t| addends(table, *t, &mut all));
        if let Some(members) = all
            .iter()
            .map(|t| magnitude_of(table, *t))
            .collect::<Option<Vec<_>>>()
        {
            return self.sum_of_magnitudes(table, &members);
        }
        if let Some(members) = terms
            .iter()
            .map(|t| square_of(table, *t))
            .collect::<Option<Vec<_>>>()
        {
            return self.sum_of_squares(table, &members);
        }
        let pairs: Option<Vec<(Vn, Vn)>> = terms.iter().map(|t| factors(table, *t)).collect();
        let (a, b): (Vec<Vn>, Vec<Vn>) = pairs?.into_iter().unzip();
        let product = |a: &[Vn], b: &[Vn]| Some(self.norm(table, a)? * self.norm(table, b)?);
        let most = product(&a, &b).or_else(|| {
            let (a, b) = sorted_sides(table, &a, &b)?;
            product(&a, &b)
        })? * (1.0 + SLACK);
        Some((-most, most))
    }

    /// The largest length that a vector of these components can have, for unit vectors.
    fn norm(&self, table: &Table, members: &[Vn]) -> Option<f64> {
        self.sum_of_squares(table, members)
            .filter(|b| b.1 < 2.0)
            .map(|b| b.1.sqrt())
    }

    fn sum_of_squares(&self, table: &Table, members: &[Vn]) -> Option<(f64, f64)> {
        let bare: Vec<Vn> = members.iter().map(|m| table.bare(*m)).collect();
        let holds = |unit: &Vec<Vn>| bare.iter().all(|m| unit.contains(m));
        if let Some(unit) = table.units.iter().find(|unit| holds(unit)) {
            let whole = unit.iter().all(|m| bare.contains(m));
            return Some((if whole { 1.0 - SLACK } else { 0.0 }, 1.0 + SLACK));
        }
        let (numerators, divisor) = quotients(table, &bare)?;
        if self.bounds(divisor).is_none_or(|b| b.0 <= 0.0) {
            return None;
        }
        self.scaled_squares(table, &numerators, divisor)
    }

    /// Σ |xᵢ/m| is at least 1 where m is the largest of the |xᵢ|.
    fn sum_of_magnitudes(&self, table: &Table, members: &[Vn]) -> Option<(f64, f64)> {
        let (numerators, divisor) = quotients(table, members)?;
        let positive = self.bounds(divisor).is_some_and(|b| b.0 > 0.0);
        let attained = self.attained(table, divisor).filter(|_| positive)?;
        let bounded = numerators
            .iter()
            .all(|n| self.at_most(table, *n, divisor, 12) == Some(1.0));
        let most = numerators.len() as f64 * (1.0 + SLACK);
        (bounded && attained.iter().all(|x| numerators.contains(x))).then_some((1.0 - SLACK, most))
    }

    /// Σ (xᵢ/m)²: by the length of x it is 1, by the largest component at least 1.
    fn scaled_squares(&self, table: &Table, numerators: &[Vn], divisor: Vn) -> Option<(f64, f64)> {
        if let Def::Unary(FloatUnary::Sqrt, squares) = table.def(divisor)
            && let Some(members) = squared_terms(table, *squares)
            && self.bounds(*squares)?.0 >= SAFE_SQUARES
            && numerators.iter().all(|n| members.contains(n))
        {
            let whole = members.iter().all(|m| numerators.contains(m));
            return Some((if whole { 1.0 - SLACK } else { 0.0 }, 1.0 + SLACK));
        }
        let attained = self.attained(table, divisor)?;
        let most = numerators.len() as f64 * (1.0 + SLACK);
        let bounded = numerators
            .iter()
            .all(|n| self.at_most(table, *n, divisor, 12) == Some(1.0));
        (bounded && attained.iter().all(|x| numerators.contains(x))).then_some((1.0 - SLACK, most))
    }
}

/// Numerators of quotients by one and the same value, without signs.
fn quotients(table: &Table, members: &[Vn]) -> Option<(Vec<Vn>, Vn)> {
    let mut divisor = None;
    let mut numerators = Vec::with_capacity(members.len());
    for member in members {
        let Def::Binary(FloatBinary::Divide, a, b) = table.def(*member) else {
            return None;
        };
        if *divisor.get_or_insert(*b) != *b {
            return None;
        }
        numerators.push(table.bare(*a));
    }
    Some((numerators, divisor?))
}

/// The terms of nested sums.
fn addends(table: &Table, vn: Vn, out: &mut Vec<Vn>) {
    match table.def(vn) {
        Def::Binary(FloatBinary::Add, a, b) => [a, b].into_iter().for_each(|t| addends(table, *t, out)),
        Def::Sum(terms) => terms.iter().for_each(|t| addends(table, *t, out)),
        _ => out.push(vn),
    }
}

/// What a magnitude is of.
fn magnitude_of(table: &Table, vn: Vn) -> Option<Vn> {
    match table.def(vn) {
        Def::Unary(FloatUnary::Abs, x) => Some(table.bare(*x)),
        _ => None,
    }
}

/// The base of a square.
fn square_of(table: &Table, vn: Vn) -> Option<Vn> {
    match table.def(vn) {
        Def::Unary(FloatUnary::Square, x) => Some(*x),
        Def::Binary(FloatBinary::Multiply, a, b) if table.bare(*a) == table.bare(*b) => Some(*a),
        _ => None,
    }
}

fn factors(table: &Table, vn: Vn) -> Option<(Vn, Vn)> {
    match table.def(vn) {
        Def::Unary(FloatUnary::Square, x) => Some((*x, *x)),
        Def::Binary(FloatBinary::Multiply, a, b) => Some((*a, *b)),
        _ => None,
    }
}

/// The bases of a sum of squares, without signs.
fn squared_terms(table: &Table, vn: Vn) -> Option<Vec<Vn>> {
    let terms = match table.def(vn) {
        Def::Sum(terms) => terms.clone(),
        Def::Binary(FloatBinary::Add, a, b) => {
            let mut list = Vec::new();
            for side in [*a, *b] {
                match squared_terms(table, side) {
                    Some(inner) => list.extend(inner),
                    None => list.push(table.bare(square_of(table, side)?)),
                }
            }
            return Some(list);
        }
        _ => return None,
    };
    terms
        .iter()
        .map(|t| square_of(table, *t).map(|x| table.bare(x)))
        .collect()
}

/// Factors put on the side of the vector they belong to: numbering has sorted them.
fn sorted_sides(table: &Table, a: &[Vn], b: &[Vn]) -> Option<(Vec<Vn>, Vec<Vn>)> {
    let family = |vn: Vn| -> Option<Vn> {
        let bare = table.bare(vn);
        if let Some(unit) = table.units.iter().find(|unit| unit.contains(&bare)) {
            return unit.first().copied();
        }
        match table.def(bare) {
            Def::Binary(FloatBinary::Divide, _, divisor) => Some(*divisor),
            _ => None,
        }
    };
    let first = family(*a.first()?)?;
    let (mut left, mut right) = (Vec::new(), Vec::new());
    for (&x, &y) in a.iter().zip(b) {
        if family(x)? == first {
            left.push(x);
            right.push(y);
        } else {
            left.push(y);
            right.push(x);
        }
    }
    Some((left, right))
}
