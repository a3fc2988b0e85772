//! Instructions of a walk.

use super::rule::{self, Rule};
use super::state::{State, Value, float_cell, meet};
use super::table::{Def, Pure, Vn};
use super::walk::{Alarm, Walk};
use crate::compile::code::{Count, Instr, Op, Place, RegionId, Root, Row};
use crate::domain::ops::{Compare, FloatBinary, FloatTernary, FloatUnary};
use crate::domain::{Domain, Truth};
use crate::interval::{Interval, Range, WideCell};
use crate::kind::{IntType, Kind};
use crate::texture::Bounds;
use crate::width::Width;

/// More elements than these are not looked at one by one.
const SPREAD: i128 = 256;

impl<'p> Walk<'p> {
    pub(super) fn value(&self, state: &State, row: Row) -> Value {
        state.get(row, self.code.kinds[row as usize])
    }

    fn values<const N: usize>(&self, state: &State, rows: [Row; N]) -> [Value; N] {
        rows.map(|row| self.value(state, row))
    }

    /// A value of which nothing is known.
    pub(super) fn unknown(&mut self, kind: Kind, state: &mut State) -> Value {
        let vn = self.table.opaque(kind, Vec::new());
        state.define(&self.table, vn, Range::undecided(kind))
    }

    pub(super) fn opaque(
        &mut self,
        kind: Kind,
        cell: WideCell,
        parents: Vec<Vn>,
        state: &mut State,
    ) -> Value {
        let vn = self.table.opaque(kind, parents);
        state.define(&self.table, vn, cell)
    }

    fn put(&mut self, state: &mut State, dst: Row, def: Def, cell: WideCell) {
        let vn = self.table.number(self.code.kinds[dst as usize], def);
        state.rows[dst as usize] = state.define(&self.table, vn, cell);
    }

    fn raise(&mut self, found: Option<Rule>, span: u32, operand: Vn, op_is_division: bool) {
        let Some(rule) = found else {
            return;
        };
        let rule = rule_at(rule, self.code.normalises.contains(&span), op_is_division);
        self.alarms.entry((span, rule)).or_insert(Alarm { operand });
    }

    pub(super) fn instruction(&mut self, instr: &'p Instr, state: &mut State) {
        let span = instr.span;
        match &instr.op {
            Op::Copy { dst, src } => state.rows[*dst as usize] = self.value(state, *src),
            Op::Unit(unit) => state.rows[unit.dst as usize] = self.value(state, unit.quotient),
            Op::FloatUnary { op, w, dst, a } => self.float_unary((*op, *w), (*dst, *a), span, state),
            Op::FloatBinary { op, w, dst, a, b } => self.float_binary((*op, *w), (*dst, *a, *b), span, state),
            // As written: which order a compiler takes is not this shader's fault.
            Op::Chain(chain) => {
                let rows = (chain.dst, chain.a, chain.b);
                self.float_binary((chain.op, chain.w), rows, span, state);
            }
            Op::FloatTernary { op, w, dst, a, b, c } => {
                self.float_ternary((*op, *w), *dst, [*a, *b, *c], span, state)
            }
            Op::Sum { w, dst, terms, n } => self.sum(*w, *dst, &terms[..*n as usize], span, state),
            Op::FloatCompare { op, w, dst, a, b } => {
                let [x, y] = self.values(state, [*a, *b]);
                let cell = compared(*op, x, y).unwrap_or_else(|| Range::compare(*op, *w, x.cell, y.cell));
                self.put(state, *dst, Def::Compare(*op, x.vn, y.vn), cell);
            }
            Op::IntCompare { op, t, dst, a, b } => {
                let [x, y] = self.values(state, [*a, *b]);
                let cell = Range::int_compare(*op, *t, x.cell, y.cell);
                self.put(state, *dst, Def::Compare(*op, x.vn, y.vn), cell);
            }
            Op::FrexpExponent { w, dst, a } => {
                let w = *w;
                self.pure(Pure::FrexpExponent, *dst, &[*a], state, |c| {
                    Range::frexp_exponent(w, c[0])
                });
            }
            Op::Ldexp { w, dst, a, b } => {
                let w = *w;
                self.pure(Pure::Ldexp, *dst, &[*a, *b], state, |c| {
                    Range::ldexp(w, c[0], c[1])
                });
            }
            Op::IsNan { dst, a } => self.pure(Pure::IsNan, *dst, &[*a], state, |c| {
                let open = !Range::to_float(c[0]).flags.is_none();
                if open {
                    Range::undecided(Kind::Bool)
                } else {
                    Range::bool(false)
                }
            }),
            Op::IsInf { dst, a } => self.pure(Pure::IsInf, *dst, &[*a], state, |c| {
                let (lo, hi) = Range::float_bounds(c[0]);
                let finite = lo.is_finite() && hi.is_finite();
                if finite {
                    Range::bool(false)
                } else {
                    Range::undecided(Kind::Bool)
                }
            }),
            Op::IntUnary { op, t, dst, a } => {
                let (op, t) = (*op, *t);
                self.pure(Pure::IntUnary(op, t), *dst, &[*a], state, |c| {
                    Range::int_unary(op, t, c[0])
                });
            }
            Op::IntBinary { op, t, dst, a, b } => {
                let (op, t) = (*op, *t);
                self.pure(Pure::IntBinary(op, t), *dst, &[*a, *b], state, |c| {
                    Range::int_binary(op, t, c[0], c[1])
                });
            }
            Op::Not { dst, a } => {
                let [x] = self.values(state, [*a]);
                self.put(state, *dst, Def::Not(x.vn), Range::not(x.cell));
            }
            Op::BoolBinary { op, dst, a, b } => {
                let [x, y] = self.values(state, [*a, *b]);
                self.put(
                    state,
                    *dst,
                    Def::Bool(*op, x.vn, y.vn),
                    Range::bool_binary(*op, x.cell, y.cell),
                );
            }
            Op::Select {
                kind,
                dst,
                cond,
                accept,
                reject,
            } => self.select(*kind, *dst, [*cond, *accept, *reject], state),
            Op::Convert { from, to, dst, a } => {
                let (from, to) = (*from, *to);
                self.pure(Pure::Convert(from, to), *dst, &[*a], state, |c| {
                    Range::convert(from, to, c[0])
                });
            }
            Op::ToBits { from, dst, a } => {
                let from = *from;
                self.pure(Pure::ToBits(from), *dst, &[*a], state, |c| {
                    Range::to_bits(from, c[0])
                });
            }
            Op::FromBits { to, dst, a } => {
                let to = *to;
                self.pure(Pure::FromBits(to), *dst, &[*a], state, |c| {
                    Range::from_bits(to, c[0])
                });
            }
            Op::Pick(pick) => {
                let index = self.value(state, pick.index);
                let (lo, hi) = Range::int_bounds(pick.int, index.cell);
                let last = pick.groups.len() as i128 - 1;
                let range = lo.clamp(0, last) as usize..=hi.clamp(0, last) as usize;
                for (k, dst) in (0..pick.kinds.len()).zip(pick.dst..) {
                    let rows: Vec<Row> = pick.groups[range.clone()].iter().map(|g| g[k]).collect();
                    let values: Vec<Value> = rows.iter().map(|&row| self.value(state, row)).collect();
                    state.rows[dst as usize] = self.any_of(pick.kinds[k], &values, index.vn, state);
                }
            }
            Op::Load(load) => self.load(load.dst, &load.kinds, &load.place, state),
            Op::Store(store) => self.store(&store.place, &store.kinds, &store.values, state),
            Op::ArrayLength {
                dst,
                region,
                start,
                stride,
            } => {
                let n =
                    (state.memory[*region as usize].len() as u32).saturating_sub(*start) / (*stride).max(1);
                let def = Def::Constant(Kind::Int(IntType::U32), u64::from(n));
                self.put(state, *dst, def, Range::int(IntType::U32, i128::from(n)));
            }
            Op::Derivative { dst, a, w, .. } => {
                let x = self.value(state, *a);
                let (lo, hi) = Range::float_bounds(x.cell);
                let cell = if lo.is_nan() {
                    Range::undecided(Kind::Float(*w))
                } else {
                    float_cell((lo - hi, hi - lo))
                };
                state.rows[*dst as usize] = self.opaque(Kind::Float(*w), cell, vec![x.vn], state);
            }
            Op::Pack(pack) => {
                let kind = self.code.kinds[pack.word as usize];
                let parents = pack.parts.iter().map(|&row| self.value(state, row).vn).collect();
                let cell = whole(kind);
                state.rows[pack.word as usize] = self.opaque(kind, cell, parents, state);
            }
            Op::Unpack(pack) => self.unpack(pack, state),
            Op::Atomic(atomic) => {
                if let crate::compile::code::AtomicTarget::Place(place) = &atomic.target
                    && let Root::Memory(region) = place.root
                {
                    self.forget_region(region, state);
                }
                for dst in atomic.result.iter().chain(&atomic.exchanged) {
                    let kind = self.code.kinds[*dst as usize];
                    state.rows[*dst as usize] = self.opaque(kind, whole(kind), Vec::new(), state);
                }
            }
            Op::Sample(sample) => self.sample(sample, state),
            Op::ImageLoad(load) => self.image_load(load, state),
            Op::ImageStore(_) => {}
            Op::ImageQuery(query) => self.image_query(query, state),
            Op::Subgroup(subgroup) => {
                let n = match subgroup.op {
                    crate::compile::code::SubgroupOp::Ballot => 4,
                    _ => 1,
                };
                for dst in subgroup.dst..subgroup.dst + n {
                    let kind = self.code.kinds[dst as usize];
                    state.rows[dst as usize] = self.unknown(kind, state);
                }
            }
        }
    }

    fn pure(
        &mut self,
        op: Pure,
        dst: Row,
        args: &[Row],
        state: &mut State,
        run: impl FnOnce(&[WideCell]) -> WideCell,
    ) {
        let values: Vec<Value> = args.iter().map(|&row| self.value(state, row)).collect();
        let cells: Vec<WideCell> = values.iter().map(|v| v.cell).collect();
        let def = Def::Pure(op, values.iter().map(|v| v.vn).collect());
        self.put(state, dst, def, run(&cells));
    }

    fn float_unary(
        &mut self,
        (op, w): (FloatUnary, Width),
        (dst, a): (Row, Row),
        span: u32,
        state: &mut State,
    ) {
        let [x] = self.values(state, [a]);
        let cell = Range::unary(op, w, x.cell);
        let found = rule::unary(op, w, Range::float_bounds(x.cell), bounds(cell));
        self.raise(found, span, x.vn, false);
        self.put(state, dst, Def::Unary(op, x.vn), cell);
    }

    fn float_binary(
        &mut self,
        (op, w): (FloatBinary, Width),
        (dst, a, b): (Row, Row, Row),
        span: u32,
        state: &mut State,
    ) {
        let [x, y] = self.values(state, [a, b]);
        // Equal values need not be in one row.
        if op == FloatBinary::Multiply && x.vn == y.vn {
            return self.float_unary((FloatUnary::Square, w), (dst, a), span, state);
        }
        let mut cell = Range::binary(op, w, x.cell, y.cell);
        let mut divisor = Range::float_bounds(y.cell);
        let straddles = divisor.0 < 0.0 && divisor.1 > 0.0;
        if matches!(op, FloatBinary::Divide | FloatBinary::Remainder)
            && straddles
            && let Some(least) = state.magnitude_at_least(&self.table, y.vn)
        {
            // Either side of zero on its own.
            divisor = (least, divisor.1.max(-divisor.0));
            let above = Range::binary(op, w, x.cell, float_cell(divisor));
            let below = Range::binary(op, w, x.cell, float_cell((-divisor.1, -divisor.0)));
            cell = Range::hull(Kind::Float(w), above, below);
        }
        let related = match op {
            FloatBinary::Divide => state.quotient(&self.table, x.vn, y.vn),
            FloatBinary::Add => state.total(&self.table, &[x.vn, y.vn]),
            FloatBinary::Subtract if x.vn == y.vn && clean(x.cell) => Some((0.0, 0.0)),
            FloatBinary::Multiply => state.product(&self.table, x.vn, y.vn),
            FloatBinary::Subtract
            | FloatBinary::Remainder
            | FloatBinary::Min
            | FloatBinary::Max
            | FloatBinary::Atan2
            | FloatBinary::Pow
            | FloatBinary::Step => None,
        };
        cell = tightened(
            w,
            cell,
            related.filter(|_| relates(w) && clean(x.cell) && clean(y.cell)),
        );
        let found = rule::binary(op, w, Range::float_bounds(x.cell), divisor, bounds(cell));
        let blamed = if found == Some(Rule::PowerDomain) {
            x.vn
        } else {
            y.vn
        };
        self.raise(found, span, blamed, op == FloatBinary::Divide);
        self.put(state, dst, Def::Binary(op, x.vn, y.vn), cell);
    }

    fn float_ternary(
        &mut self,
        (op, w): (FloatTernary, Width),
        dst: Row,
        rows: [Row; 3],
        span: u32,
        state: &mut State,
    ) {
        let [x, y, z] = self.values(state, rows);
        let cell = Range::ternary(op, w, x.cell, y.cell, z.cell);
        let args = [x, y, z].map(|v| Range::float_bounds(v.cell));
        self.raise(rule::ternary(op, w, args, bounds(cell)), span, y.vn, false);
        self.put(state, dst, Def::Ternary(op, [x.vn, y.vn, z.vn]), cell);
    }

    fn sum(&mut self, w: Width, dst: Row, terms: &[Row], span: u32, state: &mut State) {
        let values: Vec<Value> = terms.iter().map(|&row| self.value(state, row)).collect();
        let cells: Vec<WideCell> = values.iter().map(|v| v.cell).collect();
        let numbers: Vec<Vn> = values.iter().map(|v| v.vn).collect();
        let all_clean = relates(w) && cells.iter().all(|c| clean(*c));
        let related = state.total(&self.table, &numbers).filter(|_| all_clean);
        let cell = tightened(w, Range::sum(w, &cells), related);
        let found = rule::sum(w, cells.iter().map(|c| Range::float_bounds(*c)), bounds(cell));
        self.raise(found, span, numbers[0], false);
        self.put(state, dst, Def::Sum(numbers), cell);
    }

    fn select(&mut self, kind: Kind, dst: Row, rows: [Row; 3], state: &mut State) {
        let [c, x, y] = self.values(state, rows);
        let chosen = match Range::truth(c.cell) {
            Truth::True => x,
            Truth::False => y,
            Truth::Maybe if x.vn == y.vn => x,
            Truth::Maybe => match self.decide(dst, c.vn, state) {
                Some(true) => self.value(state, rows[1]),
                Some(false) => self.value(state, rows[2]),
                None => {
                    let cell = self.selected(kind, c.vn, x, y, state);
                    self.put(state, dst, Def::Pure(Pure::Select, vec![c.vn, x.vn, y.vn]), cell);
                    let entry = self.selections.entry(dst).or_insert((0, 0));
                    *entry = (state.rows[dst as usize].vn, entry.1 + 1);
                    return;
                }
            },
        };
        state.rows[dst as usize] = chosen;
    }

    /// Each side as it is where it is chosen.
    fn selected(&self, kind: Kind, condition: Vn, x: Value, y: Value, state: &State) -> WideCell {
        let under = |holds: bool, value: Value| {
            let mut side = state.clone();
            if !side.assume(&self.table, condition, holds) {
                return None;
            }
            Some(side.known(value.vn).unwrap_or(value.cell))
        };
        match (under(true, x), under(false, y)) {
            (Some(a), Some(b)) => Range::hull(kind, a, b),
            (Some(one), None) | (None, Some(one)) => one,
            (None, None) => Range::hull(kind, x.cell, y.cell),
        }
    }

    /// One of several values.
    fn any_of(&mut self, kind: Kind, values: &[Value], index: Vn, state: &mut State) -> Value {
        let Some((first, rest)) = values.split_first() else {
            return self.unknown(kind, state);
        };
        if rest.iter().all(|v| v.vn == first.vn) {
            return *first;
        }
        let cell = rest.iter().fold(first.cell, |c, v| Range::hull(kind, c, v.cell));
        let mut parents: Vec<Vn> = values.iter().map(|v| v.vn).collect();
        parents.push(index);
        self.opaque(kind, cell, parents, state)
    }

    /// Every offset that a place may point to, and the values of its indices; `None` for too many.
    fn offsets(&self, place: &Place, state: &State) -> (Option<Vec<u32>>, Vec<Vn>) {
        let (mut offsets, mut indices) = (vec![place.offset], Vec::new());
        for dim in &place.dims {
            let index = self.value(state, dim.index);
            indices.push(index.vn);
            let (lo, hi) = Range::int_bounds(dim.int, index.cell);
            let count = match (dim.count, place.root) {
                (Count::Fixed(n), _) => n,
                (Count::Runtime { start }, Root::Memory(region)) => {
                    (state.memory[region as usize].len() as u32).saturating_sub(start) / dim.stride.max(1)
                }
                (Count::Runtime { .. }, Root::Rows { .. }) => 0,
            };
            let last = i128::from(count) - 1;
            // Out of bounds means the last element here; a run counts it, and it is no numeric matter.
            let (lo, hi) = (lo.clamp(0, last.max(0)), hi.clamp(0, last.max(0)));
            if last < 0 || (hi - lo + 1) * offsets.len() as i128 > SPREAD {
                return (None, indices);
            }
            offsets = (lo..=hi)
                .flat_map(|i| offsets.iter().map(move |o| o + i as u32 * dim.stride))
                .collect();
        }
        (Some(offsets), indices)
    }

    fn peek(&self, root: Root, at: u32, kind: Kind, state: &State) -> Option<Value> {
        match root {
            Root::Rows { base, .. } => Some(state.get(base + at, kind)),
            Root::Memory(region) => {
                let value = *state.memory[region as usize].get(at as usize)?;
                let known = state
                    .known(value.vn)
                    .and_then(|known| meet(kind, value.cell, known));
                Some(Value {
                    cell: known.unwrap_or(value.cell),
                    vn: value.vn,
                })
            }
        }
    }

    fn load(&mut self, dst: Row, kinds: &[Kind], place: &Place, state: &mut State) {
        let (offsets, indices) = self.offsets(place, state);
        for (k, (&kind, dst)) in (0u32..).zip(kinds.iter().zip(dst..)) {
            let found: Option<Vec<Value>> = offsets.as_ref().and_then(|list| {
                list.iter()
                    .map(|at| self.peek(place.root, at + k, kind, state))
                    .collect()
            });
            state.rows[dst as usize] = match found {
                Some(values) => {
                    let index = indices.first().copied().unwrap_or(0);
                    self.any_of(kind, &values, index, state)
                }
                None => self.unknown(kind, state),
            };
        }
    }

    fn store(&mut self, place: &Place, kinds: &[Kind], values: &[Row], state: &mut State) {
        let (offsets, _) = self.offsets(place, state);
        let Some(offsets) = offsets else {
            return self.store_anywhere(place, state);
        };
        let weak = offsets.len() > 1;
        for at in offsets {
            for (k, (&row, &kind)) in (0u32..).zip(values.iter().zip(kinds)) {
                let mut value = self.value(state, row);
                if weak && let Some(old) = self.peek(place.root, at + k, kind, state) {
                    let cell = Range::hull(kind, old.cell, value.cell);
                    value = self.opaque(kind, cell, vec![old.vn, value.vn], state);
                }
                match place.root {
                    Root::Rows { base, .. } => state.rows[(base + at + k) as usize] = value,
                    Root::Memory(region) => {
                        if let Some(to) = state.memory[region as usize].get_mut((at + k) as usize) {
                            *to = value;
                        }
                    }
                }
            }
        }
    }

    fn store_anywhere(&mut self, place: &Place, state: &mut State) {
        match place.root {
            Root::Rows { base, len } => {
                for row in base..base + len {
                    let kind = self.code.kinds[row as usize];
                    state.rows[row as usize] = self.unknown(kind, state);
                }
            }
            Root::Memory(region) => self.forget_region(region, state),
        }
    }

    pub(super) fn forget_region(&mut self, region: RegionId, state: &mut State) {
        for at in 0..state.memory[region as usize].len() {
            let kind = self.table.kinds[state.memory[region as usize][at].vn as usize];
            state.memory[region as usize][at] = self.unknown(kind, state);
        }
    }
}

/// A rule at a place: `normalize` divides by a length.
pub(crate) fn rule_at(rule: Rule, is_normalize: bool, is_division: bool) -> Rule {
    if rule == Rule::DivisionByZero && is_normalize && is_division {
        Rule::NormaliseZero
    } else {
        rule
    }
}

/// Bounds, infinite ends included; a value that may be NaN has none.
fn bounds(cell: WideCell) -> Bounds {
    Range::float_bounds(cell)
}

/// Relations leave room for the rounding of these formats.
fn relates(w: Width) -> bool {
    match w {
        Width::F32 | Width::F64 => true,
        Width::F16 => false,
    }
}

fn clean(cell: WideCell) -> bool {
    Range::to_float(cell).flags.is_none()
}

/// One value compared with itself.
fn compared(op: Compare, x: Value, y: Value) -> Option<WideCell> {
    let same = x.vn == y.vn && clean(x.cell);
    same.then(|| match op {
        Compare::Equal | Compare::LessEqual | Compare::GreaterEqual => Range::bool(true),
        Compare::NotEqual | Compare::Less | Compare::Greater => Range::bool(false),
    })
}

/// What operations give and what relations say, at once.
fn tightened(w: Width, cell: WideCell, related: Option<(f64, f64)>) -> WideCell {
    let Some((lo, hi)) = related else {
        return cell;
    };
    // A relation knows the value is a number, so it stands alone where the operation knows nothing.
    let outward = Interval::new(w.round_down(lo, 0.0), w.round_up(hi, 0.0));
    let by_relation = WideCell::from_interval(outward);
    if !clean(cell) {
        return by_relation;
    }
    meet(Kind::Float(w), cell, by_relation).unwrap_or(cell)
}

/// Everything that a machine may hold in the kind, and of floats every finite number.
pub(super) fn whole(kind: Kind) -> WideCell {
    match kind {
        Kind::Float(w) => float_cell((-w.max_finite(), w.max_finite())),
        Kind::Int(t) => Range::int_range(t, t.min(), t.max()),
        Kind::Bool => Range::undecided(Kind::Bool),
    }
}
