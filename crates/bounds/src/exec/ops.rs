//! Instructions over the active lanes.
//!
//! An expression's result row lies above its operands' rows, so the register file is split there and each instruction becomes a
//! loop over slices: over all lanes where all are active, over the list of active lanes otherwise.

use super::machine::Machine;
use crate::compile::chains::MAX_TERMS;
use crate::compile::code::{Chain, Instr, Op, Row, Unit};
use crate::domain::ops::{Compare, FloatBinary, FloatTernary, FloatUnary, IntBinary};
use crate::domain::{Component, Domain, OverLength};
use crate::error::Result;
use crate::kind::{IntType, Kind};
use crate::width::Width;

/// Runs a float instruction with the format as a constant where it is the usual one.
macro_rules! by_width {
    ($w:expr, |$k:ident| $body:expr) => {
        match $w {
            Width::F32 => {
                const $k: Width = Width::F32;
                $body
            }
            #[expect(non_snake_case, reason = "the name stands for a constant in the other arm")]
            $k @ (Width::F16 | Width::F64) => $body,
        }
    };
}

impl<'a, D: Domain> Machine<'a, D> {
    /// Not inlined: its frame would be paid for at every level of nested control flow.
    #[inline(never)]
    pub(crate) fn instruction(&mut self, instr: &'a Instr, active: &[u32]) -> Result<()> {
        self.count(instr, active.len() as u64);
        match &instr.op {
            Op::Copy { dst, src } => self.copy(*dst, *src, active),
            Op::FloatUnary { op, w, dst, a } => self.float_unary(*op, *w, *dst, *a, active),
            Op::FloatBinary { op, w, dst, a, b } => self.float_binary(*op, *w, (*dst, *a, *b), active),
            Op::FloatTernary { op, w, dst, a, b, c } => {
                self.float_ternary(*op, *w, *dst, [*a, *b, *c], active)
            }
            Op::Sum { w, dst, terms, n } => self.sum(*w, *dst, &terms[..*n as usize], active),
            Op::Chain(chain) => self.chain(chain, active),
            Op::Unit(unit) => self.unit(unit, active),
            Op::FloatCompare { op, w, dst, a, b } => self.float_compare(*op, *w, (*dst, *a, *b), active),
            Op::FrexpExponent { w, dst, a } => self.map1(*dst, *a, active, |x| D::frexp_exponent(*w, x)),
            Op::Ldexp { w, dst, a, b } => self.map2(*dst, *a, *b, active, |x, e| D::ldexp(*w, x, e)),
            Op::IsNan { dst, a } => self.map1(*dst, *a, active, |x| classify::<D>(x, f64::is_nan)),
            Op::IsInf { dst, a } => self.map1(*dst, *a, active, |x| classify::<D>(x, f64::is_infinite)),
            Op::IntUnary { op, t, dst, a } => self.map1(*dst, *a, active, |x| D::int_unary(*op, *t, x)),
            Op::IntBinary { op, t, dst, a, b } => self.int_binary(*op, *t, (*dst, *a, *b), active),
            Op::IntCompare { op, t, dst, a, b } => {
                self.map2(*dst, *a, *b, active, |x, y| D::int_compare(*op, *t, x, y))
            }
            Op::Not { dst, a } => self.map1(*dst, *a, active, D::not),
            Op::BoolBinary { op, dst, a, b } => {
                self.map2(*dst, *a, *b, active, |x, y| D::bool_binary(*op, x, y))
            }
            Op::Select {
                kind,
                dst,
                cond,
                accept,
                reject,
            } => self.select(*kind, *dst, [*cond, *accept, *reject], active),
            Op::Convert { from, to, dst, a } => self.map1(*dst, *a, active, |x| D::convert(*from, *to, x)),
            Op::ToBits { from, dst, a } => self.map1(*dst, *a, active, |x| D::to_bits(*from, x)),
            Op::FromBits { to, dst, a } => self.map1(*dst, *a, active, |x| D::from_bits(*to, x)),
            Op::Pick(pick) => self.pick(pick, active),
            Op::Load(load) => self.load(load, active),
            Op::Store(store) => self.store(store, active),
            Op::ArrayLength {
                dst,
                region,
                start,
                stride,
            } => self.array_length(*dst, *region, (*start, *stride), active),
            Op::Derivative {
                axis,
                control,
                w,
                dst,
                a,
            } => self.derivative(*axis, *control, *w, (*dst, *a), active),
            Op::Pack(pack) => self.pack(pack, active),
            Op::Unpack(pack) => self.unpack(pack, active),
            Op::Atomic(atomic) => self.atomic(atomic, active),
            Op::Sample(sample) => self.sample(sample, active)?,
            Op::ImageLoad(load) => self.image_load(load, active),
            Op::ImageStore(store) => self.image_store(store, active),
            Op::ImageQuery(query) => self.image_query(query, active),
            Op::Subgroup(subgroup) => self.subgroup(subgroup, active),
        }
        if self.is_exact(instr) {
            self.make_exact(instr, active);
        }
        if let Some(nudge) = self.context.limits.nudge {
            self.nudge(instr, active, (nudge.span, nudge.how));
        }
        if self.context.limits.watch {
            self.observe(instr, active);
        }
        if self.counters.operations + self.work > self.budget {
            return self.spend(0, instr.span);
        }
        Ok(())
    }

    /// Copies are moves of values between names, not operations.
    fn count(&mut self, instr: &Instr, lanes: u64) {
        let (operations, fetches) = match &instr.op {
            Op::Copy { .. } | Op::Unit(_) => (0, 0),
            Op::Sample(_) | Op::ImageLoad(_) => (lanes, lanes),
            Op::Sum { n, .. } => (lanes * (u64::from(*n) - 1), 0),
            _ => (lanes, 0),
        };
        self.counters.operations += operations;
        self.counters.fetches += fetches;
        if let Some(entry) = self.counters.by_span.get_mut(instr.span as usize) {
            entry[0] += operations;
            entry[1] += fetches;
        }
    }

    fn copy(&mut self, dst: Row, src: Row, active: &[u32]) {
        let (d, s) = (dst as usize * self.stride, src as usize * self.stride);
        if active.len() == self.lanes.width() {
            self.regs.copy_within(s..s + active.len(), d);
            return;
        }
        for &lane in active {
            self.regs[d + lane as usize] = self.regs[s + lane as usize];
        }
    }

    #[inline(always)]
    pub(crate) fn map1(&mut self, dst: Row, a: Row, active: &[u32], f: impl Fn(D::Cell) -> D::Cell) {
        let (n, stride) = (self.lanes.width(), self.stride);
        let (below, above) = self.regs.split_at_mut(dst as usize * stride);
        let (a, out) = (&below[a as usize * stride..][..n], &mut above[..n]);
        if active.len() == n {
            for (o, &x) in out.iter_mut().zip(a) {
                *o = f(x);
            }
        } else {
            for &lane in active {
                out[lane as usize] = f(a[lane as usize]);
            }
        }
    }

    #[inline(always)]
    pub(crate) fn map2(
        &mut self,
        dst: Row,
        a: Row,
        b: Row,
        active: &[u32],
        f: impl Fn(D::Cell, D::Cell) -> D::Cell,
    ) {
        let (n, stride) = (self.lanes.width(), self.stride);
        let (below, above) = self.regs.split_at_mut(dst as usize * stride);
        let (a, b) = (
            &below[a as usize * stride..][..n],
            &below[b as usize * stride..][..n],
        );
        let out = &mut above[..n];
        if active.len() == n {
            for ((o, &x), &y) in out.iter_mut().zip(a).zip(b) {
                *o = f(x, y);
            }
        } else {
            for &lane in active {
                let lane = lane as usize;
                out[lane] = f(a[lane], b[lane]);
            }
        }
    }

    #[inline(always)]
    fn map3(
        &mut self,
        dst: Row,
        [a, b, c]: [Row; 3],
        active: &[u32],
        f: impl Fn(D::Cell, D::Cell, D::Cell) -> D::Cell,
    ) {
        let (n, stride) = (self.lanes.width(), self.stride);
        let (below, above) = self.regs.split_at_mut(dst as usize * stride);
        let at = |row: Row| &below[row as usize * stride..][..n];
        let (a, b, c, out) = (at(a), at(b), at(c), &mut above[..n]);
        if active.len() == n {
            for k in 0..n {
                out[k] = f(a[k], b[k], c[k]);
            }
        } else {
            for &lane in active {
                let k = lane as usize;
                out[k] = f(a[k], b[k], c[k]);
            }
        }
    }

    fn float_unary(&mut self, op: FloatUnary, w: Width, dst: Row, a: Row, active: &[u32]) {
        by_width!(w, |W| match op {
            FloatUnary::Negate => self.map1(dst, a, active, |x| D::unary(FloatUnary::Negate, W, x)),
            FloatUnary::Abs => self.map1(dst, a, active, |x| D::unary(FloatUnary::Abs, W, x)),
            FloatUnary::Square => self.map1(dst, a, active, |x| D::unary(FloatUnary::Square, W, x)),
            FloatUnary::Floor => self.map1(dst, a, active, |x| D::unary(FloatUnary::Floor, W, x)),
            FloatUnary::Fract => self.map1(dst, a, active, |x| D::unary(FloatUnary::Fract, W, x)),
            FloatUnary::Sqrt => self.map1(dst, a, active, |x| D::unary(FloatUnary::Sqrt, W, x)),
            _ => self.map1(dst, a, active, |x| D::unary(op, W, x)),
        });
    }

    fn float_binary(&mut self, op: FloatBinary, w: Width, (dst, a, b): (Row, Row, Row), active: &[u32]) {
        by_width!(w, |W| match op {
            FloatBinary::Add => self.map2(dst, a, b, active, |x, y| D::binary(FloatBinary::Add, W, x, y)),
            FloatBinary::Subtract => self.map2(dst, a, b, active, |x, y| D::binary(
                FloatBinary::Subtract,
                W,
                x,
                y
            )),
            FloatBinary::Multiply => self.map2(dst, a, b, active, |x, y| D::binary(
                FloatBinary::Multiply,
                W,
                x,
                y
            )),
            FloatBinary::Divide =>
                self.map2(dst, a, b, active, |x, y| D::binary(FloatBinary::Divide, W, x, y)),
            FloatBinary::Min => self.map2(dst, a, b, active, |x, y| D::binary(FloatBinary::Min, W, x, y)),
            FloatBinary::Max => self.map2(dst, a, b, active, |x, y| D::binary(FloatBinary::Max, W, x, y)),
            FloatBinary::Remainder | FloatBinary::Atan2 | FloatBinary::Pow | FloatBinary::Step => {
                self.map2(dst, a, b, active, |x, y| D::binary(op, W, x, y));
            }
        });
    }

    fn float_ternary(&mut self, op: FloatTernary, w: Width, dst: Row, rows: [Row; 3], active: &[u32]) {
        by_width!(w, |W| match op {
            FloatTernary::Fma => self.map3(dst, rows, active, |x, y, z| D::ternary(
                FloatTernary::Fma,
                W,
                x,
                y,
                z
            )),
            FloatTernary::Clamp => self.map3(dst, rows, active, |x, y, z| D::ternary(
                FloatTernary::Clamp,
                W,
                x,
                y,
                z
            )),
            FloatTernary::Mix | FloatTernary::SmoothStep => {
                self.map3(dst, rows, active, |x, y, z| D::ternary(op, W, x, y, z));
            }
        });
    }

    fn sum(&mut self, w: Width, dst: Row, terms: &[Row], active: &[u32]) {
        by_width!(w, |W| match *terms {
            [a, b] => self.map2(dst, a, b, active, |x, y| D::sum(W, &[x, y])),
            [a, b, c] => self.map3(dst, [a, b, c], active, |x, y, z| D::sum(W, &[x, y, z])),
            _ => self.sum_list(W, dst, terms, active),
        });
    }

    fn sum_list(&mut self, w: Width, dst: Row, terms: &[Row], active: &[u32]) {
        for &lane in active {
            let mut list = [D::Cell::default(); 4];
            for (to, &row) in list.iter_mut().zip(terms) {
                *to = self.get(row, lane);
            }
            self.set(dst, lane, D::sum(w, &list[..terms.len()]));
        }
    }

    /// As written; in a domain of what machines may do, in any order of its terms too.
    fn chain(&mut self, chain: &Chain, active: &[u32]) {
        self.float_binary(chain.op, chain.w, (chain.dst, chain.a, chain.b), active);
        if !D::REORDERS {
            return;
        }
        let mut cells = [D::Cell::default(); MAX_TERMS];
        for &lane in active {
            for (to, term) in cells.iter_mut().zip(&chain.terms) {
                let cell = self.get(term.row, lane);
                *to = if term.negative {
                    D::unary(FloatUnary::Negate, chain.w, cell)
                } else {
                    cell
                };
            }
            let written = self.get(chain.dst, lane);
            let any = D::reordered(chain.op, chain.w, written, &cells[..chain.terms.len()]);
            self.set(chain.dst, lane, any);
        }
    }

    /// The quotient; in a domain of what machines may do, without counting twice the errors that it shares with the length.
    fn unit(&mut self, unit: &Unit, active: &[u32]) {
        self.copy(unit.dst, unit.quotient, active);
        if !D::REORDERS {
            return;
        }
        let products = &self.context.program.code.products;
        let mut components = [Component {
            scaled: D::Cell::default(),
            whole: D::Cell::default(),
            product: false,
        }; 4];
        for &lane in active {
            for (to, part) in components.iter_mut().zip(&unit.parts) {
                *to = Component {
                    scaled: self.get(part.scaled, lane),
                    whole: self.get(part.whole, lane),
                    product: products[part.scaled as usize],
                };
            }
            let vector = OverLength {
                sum: self.get(unit.sum, lane),
                components: &components[..unit.parts.len()],
                divisor: unit.divisor.map(|row| self.get(row, lane)),
                at: unit.at,
            };
            let cell = D::over_length(unit.w, self.get(unit.quotient, lane), &vector);
            self.set(unit.dst, lane, cell);
        }
    }

    fn float_compare(&mut self, op: Compare, w: Width, (dst, a, b): (Row, Row, Row), active: &[u32]) {
        self.map2(dst, a, b, active, |x, y| D::compare(op, w, x, y));
    }

    fn int_binary(&mut self, op: IntBinary, t: IntType, (dst, a, b): (Row, Row, Row), active: &[u32]) {
        if t == IntType::U32 || t == IntType::I32 {
            let t = if t.signed { IntType::I32 } else { IntType::U32 };
            match op {
                IntBinary::Add => {
                    return self.map2(dst, a, b, active, |x, y| D::int_binary(IntBinary::Add, t, x, y));
                }
                IntBinary::Multiply => {
                    return self.map2(dst, a, b, active, |x, y| {
                        D::int_binary(IntBinary::Multiply, t, x, y)
                    });
                }
                IntBinary::Xor => {
                    return self.map2(dst, a, b, active, |x, y| D::int_binary(IntBinary::Xor, t, x, y));
                }
                IntBinary::Subtract
                | IntBinary::Divide
                | IntBinary::Remainder
                | IntBinary::And
                | IntBinary::Or
                | IntBinary::ShiftLeft
                | IntBinary::ShiftRight
                | IntBinary::Min
                | IntBinary::Max => {}
            }
        }
        self.map2(dst, a, b, active, |x, y| D::int_binary(op, t, x, y));
    }

    fn select(&mut self, kind: Kind, dst: Row, rows: [Row; 3], active: &[u32]) {
        self.map3(dst, rows, active, |c, x, y| D::select(kind, c, x, y));
    }
}

/// Whether a float is of a class; open where its bounds do not decide it.
fn classify<D: Domain>(x: D::Cell, is: fn(f64) -> bool) -> D::Cell {
    let (lo, hi) = D::float_bounds(x);
    if D::UNCERTAIN && (lo.is_nan() || is(lo) != is(hi)) {
        return D::undecided(Kind::Bool);
    }
    D::bool(is(lo))
}
