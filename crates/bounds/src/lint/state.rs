//! The state of one path: what every variable holds, and what is known of every value on this path.

use super::table::{Def, Table, Vn};
use crate::domain::ops::{BoolBinary, Compare, FloatBinary, FloatUnary};
use crate::domain::{Domain, Truth};
use crate::interval::{Interval, Range, WideCell};
use crate::kind::Kind;
use crate::width::Width;

/// What a scalar holds: bounds, and which value it is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Value {
    pub(super) cell: WideCell,
    pub(super) vn: Vn,
}

/// One path.
#[derive(Clone)]
pub(super) struct State {
    pub(super) rows: Vec<Value>,
    pub(super) memory: Vec<Vec<Value>>,
    /// The tightest bounds of each value on this path.
    known: Vec<Option<WideCell>>,
    /// Values of which the first is no smaller than the second on this path.
    orders: Vec<(Vn, Vn)>,
    /// Open conditions that led here: what is decided by them depends on them.
    pub(super) guards: Vec<Vn>,
}

/// More open conditions on a path than this are not told apart.
const GUARDS: usize = 64;

impl State {
    pub(super) fn new(rows: usize, memory: Vec<Vec<Value>>) -> Self {
        let nothing = Value {
            cell: WideCell::default(),
            vn: 0,
        };
        Self {
            rows: vec![nothing; rows],
            memory,
            known: Vec::new(),
            orders: Vec::new(),
            guards: Vec::new(),
        }
    }

    pub(super) fn known(&self, vn: Vn) -> Option<WideCell> {
        self.known.get(vn as usize).copied().flatten()
    }

    /// Bounds of a float value that is certainly a number.
    pub(super) fn known_float(&self, vn: Vn) -> Option<(f64, f64)> {
        let (lo, hi) = Range::float_bounds(self.known(vn)?);
        (!lo.is_nan()).then_some((lo, hi))
    }

    fn remember(&mut self, vn: Vn, cell: WideCell) {
        let at = vn as usize;
        if self.known.len() <= at {
            self.known.resize(at + 1, None);
        }
        self.known[at] = Some(cell);
    }

    /// A value that was computed: its bounds are those, and those known before on this path.
    pub(super) fn define(&mut self, table: &Table, vn: Vn, cell: WideCell) -> Value {
        let kind = table.kinds[vn as usize];
        let cell = match self.known(vn) {
            Some(before) => meet(kind, before, cell).unwrap_or(cell),
            None => cell,
        };
        self.remember(vn, cell);
        Value { cell, vn }
    }

    /// What a row holds, with all that is known of it.
    pub(super) fn get(&self, row: u32, kind: Kind) -> Value {
        let value = self.rows[row as usize];
        let known = self.known(value.vn).filter(|_| value.vn != 0);
        let cell = known.and_then(|known| meet(kind, value.cell, known));
        Value {
            cell: cell.unwrap_or(value.cell),
            vn: value.vn,
        }
    }

    /// Notes an open condition that this path depends on.
    pub(super) fn guard(&mut self, condition: Vn) {
        if self.guards.len() < GUARDS && !self.guards.contains(&condition) {
            self.guards.push(condition);
        }
    }

    /// Values known to be no larger than one, directly or through others.
    pub(super) fn smaller_than(&self, big: Vn) -> Vec<Vn> {
        let mut found = vec![big];
        let mut at = 0;
        while at < found.len() {
            let here = found[at];
            for &(_, small) in self.orders.iter().filter(|o| o.0 == here) {
                if !found.contains(&small) {
                    found.push(small);
                }
            }
            at += 1;
        }
        found.swap_remove(0);
        found
    }

    /// Two paths that come together: whatever both say. `condition` is what they differ in: true here, false there.
    pub(super) fn join(
        mut self,
        other: &Self,
        condition: Option<Vn>,
        table: &mut Table,
        kinds: &[Kind],
    ) -> Self {
        other.guards.iter().for_each(|guard| self.guard(*guard));
        self.orders.retain(|order| other.orders.contains(order));
        let guards = self.guards.clone();
        self.known.truncate(other.known.len());
        for (at, (mine, theirs)) in self.known.iter_mut().zip(&other.known).enumerate() {
            *mine = match (*mine, theirs) {
                (Some(a), Some(b)) if a == *b => Some(a),
                (Some(a), Some(b)) => Some(Range::hull(table.kinds[at], a, *b)),
                (Some(_) | None, _) => None,
            };
        }
        let mut joined = Vec::new();
        for (k, (mine, theirs)) in self.rows.iter_mut().zip(&other.rows).enumerate() {
            if mine != theirs {
                *mine = join_values(*mine, *theirs, kinds[k], (condition, &guards), table);
                joined.push(*mine);
            }
        }
        for (mine, theirs) in self.memory.iter_mut().zip(&other.memory) {
            for (a, b) in mine.iter_mut().zip(theirs) {
                if a != b {
                    let kind = table.kinds[a.vn as usize];
                    *a = join_values(*a, *b, kind, (condition, &guards), table);
                    joined.push(*a);
                }
            }
        }
        for value in joined {
            if self.known(value.vn).is_none() && value.vn != 0 {
                self.remember(value.vn, value.cell);
            }
        }
        self
    }

    /// Takes a condition for true or false; `false` when that cannot be on this path.
    pub(super) fn assume(&mut self, table: &Table, condition: Vn, holds: bool) -> bool {
        if !self.narrow(table, condition, Range::bool(holds), 8) {
            return false;
        }
        match (table.def(condition).clone(), holds) {
            (Def::Not(inner), _) => self.assume(table, inner, !holds),
            (Def::Bool(BoolBinary::And, a, b), true) | (Def::Bool(BoolBinary::Or, a, b), false) => {
                self.assume(table, a, holds) && self.assume(table, b, holds)
            }
            (Def::Compare(op, a, b), _) => self.assume_order(table, op, a, b, holds),
            _ => true,
        }
    }

    fn assume_order(&mut self, table: &Table, op: Compare, a: Vn, b: Vn, holds: bool) -> bool {
        let (op, nan_possible) = match (op, holds) {
            (op, true) => (op, op == Compare::NotEqual),
            (Compare::Less, false) => (Compare::GreaterEqual, true),
            (Compare::LessEqual, false) => (Compare::Greater, true),
            (Compare::Greater, false) => (Compare::LessEqual, true),
            (Compare::GreaterEqual, false) => (Compare::Less, true),
            (Compare::Equal, false) => (Compare::NotEqual, true),
            (Compare::NotEqual, false) => (Compare::Equal, false),
        };
        let (Some(x), Some(y)) = (self.known(a), self.known(b)) else {
            return true;
        };
        match table.kinds[a as usize] {
            Kind::Float(w) => {
                let (x, y) = (Range::to_float(x), Range::to_float(y));
                let (p, q) = ordered(op, w, (x.lo, x.hi), (y.lo, y.hi));
                let open = nan_possible && !(x.flags.is_none() && y.flags.is_none());
                if open {
                    // A NaN makes the comparison false whatever the other side is: bounds say nothing then.
                    return true;
                }
                self.narrow(table, a, float_cell(p), 8)
                    && self.narrow(table, b, float_cell(q), 8)
                    && self.order(table, op, a, b)
            }
            Kind::Int(t) => {
                let (p, q) = ordered_whole(op, Range::int_bounds(t, x), Range::int_bounds(t, y));
                let cell = |(lo, hi): (i128, i128)| {
                    let (lo, hi) = (lo.max(t.min()), hi.min(t.max()));
                    (lo <= hi).then(|| Range::int_range(t, lo, hi))
                };
                match (cell(p), cell(q)) {
                    (Some(p), Some(q)) => self.narrow(table, a, p, 8) && self.narrow(table, b, q, 8),
                    (Some(_) | None, _) => false,
                }
            }
            Kind::Bool => true,
        }
    }

    /// Remembers an order, and what it says about maxima: the largest of the candidates is the maximum.
    fn order(&mut self, table: &Table, op: Compare, a: Vn, b: Vn) -> bool {
        match op {
            Compare::Greater | Compare::GreaterEqual => self.orders.push((a, b)),
            Compare::Less | Compare::LessEqual => self.orders.push((b, a)),
            Compare::Equal => self.orders.extend([(a, b), (b, a)]),
            Compare::NotEqual => return true,
        }
        let maxima: Vec<Vn> = table
            .maxima()
            .filter(|m| self.known_float(*m).is_some())
            .collect();
        for maximum in maxima {
            let (candidates, Some((lo, _))) = (table.candidates(maximum), self.known_float(maximum)) else {
                continue;
            };
            let largest = |c: &&Vn| {
                candidates
                    .iter()
                    .all(|other| other == *c || self.smaller_than(**c).contains(other))
            };
            if let Some(&c) = candidates.iter().find(largest)
                && !self.narrow(table, c, float_cell((lo, f64::INFINITY)), 4)
            {
                return false;
            }
        }
        true
    }

    /// Adds that a value lies in a cell, and what follows for what it was made of; `false` when nothing is left.
    pub(super) fn narrow(&mut self, table: &Table, vn: Vn, to: WideCell, depth: u32) -> bool {
        let kind = table.kinds[vn as usize];
        let before = self.known(vn);
        let cell = match before.map(|before| meet(kind, before, to)) {
            Some(Some(cell)) => cell,
            Some(None) => return false,
            None => to,
        };
        self.remember(vn, cell);
        if depth == 0 || before == Some(cell) {
            return true;
        }
        let Kind::Float(w) = kind else {
            return true;
        };
        let x = Range::to_float(cell);
        if !x.flags.is_none() {
            return true;
        }
        self.backward(table, vn, w, (x.lo, x.hi), depth - 1)
    }

    fn backward(&mut self, table: &Table, vn: Vn, w: Width, (lo, hi): (f64, f64), depth: u32) -> bool {
        let sign = |state: &Self, x: Vn| state.known_float(x);
        match *table.def(vn) {
            Def::Unary(FloatUnary::Negate, x) => self.narrow(table, x, float_cell((-hi, -lo)), depth),
            Def::Unary(FloatUnary::Abs, x) => {
                let range = magnitude_back(sign(self, x), lo.max(0.0), hi);
                self.narrow(table, x, float_cell(range), depth)
            }
            Def::Unary(FloatUnary::Square, x) => {
                // Squares below the normal numbers may have been flushed, so they say nothing about a lower end.
                let least = if lo >= w.min_normal() {
                    lo.sqrt() * (1.0 - 1e-6)
                } else {
                    0.0
                };
                let most = (hi.max(w.min_normal()) * 2.0).sqrt();
                let range = magnitude_back(sign(self, x), least, most);
                self.narrow(table, x, float_cell(range), depth)
            }
            Def::Unary(FloatUnary::Sqrt, x) => {
                let least = if lo > 1e-18 { lo * lo * (1.0 - 1e-5) } else { 0.0 };
                self.narrow(
                    table,
                    x,
                    float_cell((least, hi * hi * (1.0 + 1e-5) + w.min_normal())),
                    depth,
                )
            }
            Def::Binary(FloatBinary::Max, a, b) => {
                self.backward_extreme(table, (a, b), (lo, hi), depth, true)
            }
            Def::Binary(FloatBinary::Min, a, b) => {
                self.backward_extreme(table, (a, b), (lo, hi), depth, false)
            }
            Def::Binary(FloatBinary::Add, a, b) => self.backward_sum(table, w, (a, b), (lo, hi), depth, 1.0),
            Def::Binary(FloatBinary::Subtract, a, b) => {
                self.backward_sum(table, w, (a, b), (lo, hi), depth, -1.0)
            }
            _ => true,
        }
    }

    fn backward_extreme(
        &mut self,
        table: &Table,
        (a, b): (Vn, Vn),
        (lo, hi): (f64, f64),
        depth: u32,
        is_max: bool,
    ) -> bool {
        for (one, other) in [(a, b), (b, a)] {
            let rest = self.known_float(other);
            let range = match (is_max, rest) {
                (true, Some(rest)) if rest.1 < lo => (lo, hi),
                (true, _) => (f64::NEG_INFINITY, hi),
                (false, Some(rest)) if rest.0 > hi => (lo, hi),
                (false, _) => (lo, f64::INFINITY),
            };
            if self.known_float(one).is_some() && !self.narrow(table, one, float_cell(range), depth) {
                return false;
            }
        }
        true
    }

    /// a + side·b within bounds, up to rounding.
    fn backward_sum(
        &mut self,
        table: &Table,
        w: Width,
        (a, b): (Vn, Vn),
        (lo, hi): (f64, f64),
        depth: u32,
        side: f64,
    ) -> bool {
        let (Some(x), Some(y)) = (self.known_float(a), self.known_float(b)) else {
            return true;
        };
        let slack = 2.0 * w.ulp(lo.abs().max(hi.abs()).min(w.max_finite())) + w.min_normal();
        let (lo, hi) = (lo - slack, hi + slack);
        let of_a = if side > 0.0 {
            (lo - y.1, hi - y.0)
        } else {
            (lo + y.0, hi + y.1)
        };
        let of_b = if side > 0.0 {
            (lo - x.1, hi - x.0)
        } else {
            (x.0 - hi, x.1 - lo)
        };
        let usable = |r: (f64, f64)| !r.0.is_nan() && !r.1.is_nan();
        (!usable(of_a) || self.narrow(table, a, float_cell(of_a), depth))
            && (!usable(of_b) || self.narrow(table, b, float_cell(of_b), depth))
    }
}

/// Bounds of x, given those of |x| and what is known of x.
fn magnitude_back(known: Option<(f64, f64)>, lo: f64, hi: f64) -> (f64, f64) {
    match known {
        Some((least, _)) if least >= 0.0 => (lo, hi),
        Some((_, most)) if most <= 0.0 => (-hi, -lo),
        Some((least, _)) if least > -lo => (lo, hi),
        Some((_, most)) if most < lo => (-hi, -lo),
        Some(_) | None => (-hi, hi),
    }
}

pub(super) fn float_cell((lo, hi): (f64, f64)) -> WideCell {
    WideCell::from_interval(Interval::new(lo, hi))
}

/// Both cells at once; `None` where they exclude each other.
pub(super) fn meet(kind: Kind, a: WideCell, b: WideCell) -> Option<WideCell> {
    match kind {
        Kind::Float(_) => {
            let (x, y) = (a.interval(), b.interval());
            let flags = x.flags.intersection(y.flags);
            let both = Interval {
                lo: x.lo.max(y.lo),
                hi: x.hi.min(y.hi),
                flags,
            };
            if both.lo <= both.hi {
                return Some(WideCell::from_interval(both));
            }
            // Only a NaN is left, if that is possible on both sides.
            (!flags.is_none()).then(|| WideCell::from_interval(Interval::unknown(flags)))
        }
        Kind::Int(t) => {
            let (x, y) = (Range::int_bounds(t, a), Range::int_bounds(t, b));
            let (lo, hi) = (x.0.max(y.0), x.1.min(y.1));
            (lo <= hi).then(|| Range::int_range(t, lo, hi))
        }
        Kind::Bool => match (Range::truth(a), Range::truth(b)) {
            (Truth::Maybe, _) => Some(b),
            (_, Truth::Maybe) => Some(a),
            (x, y) => (x == y).then_some(a),
        },
    }
}

/// One value or the other. Of truth values that a short-circuit operator made, the operator is seen.
fn join_values(
    a: Value,
    b: Value,
    kind: Kind,
    (condition, guards): (Option<Vn>, &[Vn]),
    table: &mut Table,
) -> Value {
    let constant = |value: Value, truth: Truth| {
        value.vn != 0 && matches!(table.def(value.vn), Def::Constant(..)) && Range::truth(value.cell) == truth
    };
    let vn = match (kind, condition) {
        _ if a.vn == b.vn => a.vn,
        (Kind::Bool, Some(condition)) if constant(b, Truth::False) => {
            table.number(kind, Def::Bool(BoolBinary::And, condition, a.vn))
        }
        (Kind::Bool, Some(condition)) if constant(a, Truth::True) => {
            table.number(kind, Def::Bool(BoolBinary::Or, condition, b.vn))
        }
        _ => {
            let mut parents = vec![a.vn, b.vn];
            parents.extend(guards);
            table.opaque(kind, parents)
        }
    };
    Value {
        cell: Range::hull(kind, a.cell, b.cell),
        vn,
    }
}

type Pair = ((f64, f64), (f64, f64));

/// What an order says about both sides.
fn ordered(op: Compare, w: Width, a: (f64, f64), b: (f64, f64)) -> Pair {
    let all = (f64::NEG_INFINITY, f64::INFINITY);
    match op {
        Compare::Less => ((all.0, w.next_down(b.1)), (w.next_up(a.0), all.1)),
        Compare::LessEqual => ((all.0, b.1), (a.0, all.1)),
        Compare::Greater => ((w.next_up(b.0), all.1), (all.0, w.next_down(a.1))),
        Compare::GreaterEqual => ((b.0, all.1), (all.0, a.1)),
        Compare::Equal => (b, a),
        Compare::NotEqual => {
            let away = |x: (f64, f64), y: (f64, f64)| match (y.0 == y.1, x) {
                (true, (lo, _)) if lo == y.0 => (w.next_up(lo), all.1),
                (true, (_, hi)) if hi == y.0 => (all.0, w.next_down(hi)),
                (true | false, _) => all,
            };
            (away(a, b), away(b, a))
        }
    }
}

type WholePair = ((i128, i128), (i128, i128));

fn ordered_whole(op: Compare, a: (i128, i128), b: (i128, i128)) -> WholePair {
    let all = (i128::MIN, i128::MAX);
    match op {
        Compare::Less => ((all.0, b.1 - 1), (a.0 + 1, all.1)),
        Compare::LessEqual => ((all.0, b.1), (a.0, all.1)),
        Compare::Greater => ((b.0 + 1, all.1), (all.0, a.1 - 1)),
        Compare::GreaterEqual => ((b.0, all.1), (all.0, a.1)),
        Compare::Equal => (b, a),
        Compare::NotEqual => {
            let away = |x: (i128, i128), y: (i128, i128)| match (y.0 == y.1, x) {
                (true, (lo, _)) if lo == y.0 => (lo + 1, all.1),
                (true, (_, hi)) if hi == y.0 => (all.0, hi - 1),
                (true | false, _) => all,
            };
            (away(a, b), away(b, a))
        }
    }
}
