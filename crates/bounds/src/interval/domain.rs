//! The interval domains as the evaluator sees them: cells in, cells out.

use super::integers::{self, Bounds};
use super::rules::{flush, outward};
use super::{Accept, Flags, Interval, Range, WideCell, arithmetic, bits, functions, narrow, orders, unit};
use crate::compile::chains::MAX_TERMS;
use crate::domain::ops::{BoolBinary, Compare, FloatBinary, FloatTernary, FloatUnary, IntBinary, IntUnary};
use crate::domain::point::{bits_type, frexp};
use crate::domain::{Component, Domain, OverLength, Truth, sealed};
use crate::kind::{IntType, Kind};
use crate::width::Width;

impl sealed::Sealed for Accept {}
impl sealed::Sealed for Range {}

#[inline(always)]
fn put_float(x: Interval) -> WideCell {
    WideCell::from_interval(x)
}

#[inline(always)]
fn get_int(t: IntType, c: WideCell) -> Bounds {
    if t.signed {
        (i128::from(c.lo as i64), i128::from(c.hi as i64))
    } else {
        (i128::from(c.lo), i128::from(c.hi))
    }
}

#[inline(always)]
fn put_int((lo, hi): Bounds, flags: Flags) -> WideCell {
    WideCell {
        lo: lo as u64,
        hi: hi as u64,
        flags,
    }
}

#[inline(always)]
fn put_truth(t: Truth, flags: Flags) -> WideCell {
    match t {
        Truth::False => WideCell { lo: 0, hi: 0, flags },
        Truth::True => WideCell { lo: 1, hi: 1, flags },
        Truth::Maybe => WideCell { lo: 0, hi: 1, flags },
    }
}

#[inline(always)]
fn get_truth(c: WideCell) -> Truth {
    if c.lo != 0 {
        Truth::True
    } else if c.hi == 0 {
        Truth::False
    } else {
        Truth::Maybe
    }
}

fn unknown(kind: Kind, flags: Flags) -> WideCell {
    match kind {
        Kind::Float(_) => put_float(Interval::unknown(flags)),
        Kind::Int(t) => put_int(integers::whole(t), flags),
        Kind::Bool => put_truth(Truth::Maybe, flags),
    }
}

/// Either of two cells, marked as such where they differ.
fn hull(kind: Kind, a: WideCell, b: WideCell) -> WideCell {
    let same = match kind {
        Kind::Float(_) => {
            let (a, b) = (a.interval(), b.interval());
            a.lo == b.lo && a.hi == b.hi
        }
        Kind::Int(_) | Kind::Bool => a.lo == b.lo && a.hi == b.hi,
    };
    let forked = if same { Flags::NONE } else { Flags::FORKED };
    let flags = a.flags.union(b.flags).union(forked);
    match kind {
        Kind::Float(_) => put_float(a.interval().hull(b.interval()).flagged(forked)),
        Kind::Int(t) => {
            let (x, y) = (get_int(t, a), get_int(t, b));
            put_int((x.0.min(y.0), x.1.max(y.1)), flags)
        }
        Kind::Bool => put_truth(get_truth(a).hull(get_truth(b)), flags),
    }
}

#[inline(always)]
fn binary<const A: bool>(op: FloatBinary, w: Width, a: Interval, b: Interval) -> Interval {
    match op {
        FloatBinary::Add => arithmetic::add::<A>(w, a, b),
        FloatBinary::Subtract => arithmetic::subtract::<A>(w, a, b),
        FloatBinary::Multiply => arithmetic::multiply::<A>(w, a, b),
        FloatBinary::Divide => arithmetic::divide::<A>(w, a, b),
        FloatBinary::Remainder => arithmetic::remainder::<A>(w, a, b),
        FloatBinary::Min => arithmetic::minimum::<A>(a, b),
        FloatBinary::Max => arithmetic::maximum::<A>(a, b),
        FloatBinary::Atan2 => functions::atan2::<A>(w, a, b),
        FloatBinary::Pow => functions::pow::<A>(w, a, b),
        FloatBinary::Step => step(a, b),
    }
}

/// `1` where `edge <= x`.
fn step(edge: Interval, x: Interval) -> Interval {
    let flags = edge.flags.union(x.flags);
    match integers::compare(Compare::LessEqual, (edge.lo, edge.hi), (x.lo, x.hi)) {
        Truth::True if flags.is_none() => Interval::point(1.0).flagged(flags),
        Truth::False if flags.is_none() => Interval::point(0.0).flagged(flags),
        Truth::True | Truth::False | Truth::Maybe => Interval {
            lo: 0.0,
            hi: 1.0,
            flags: flags.union(Flags::FORKED),
        },
    }
}

#[inline(always)]
fn ternary<const A: bool>(op: FloatTernary, w: Width, a: Interval, b: Interval, c: Interval) -> Interval {
    match op {
        FloatTernary::Fma => arithmetic::fma::<A>(w, a, b, c),
        FloatTernary::Clamp => arithmetic::clamp::<A>(a, b, c),
        FloatTernary::Mix => arithmetic::mix::<A>(w, a, b, c),
        FloatTernary::SmoothStep => arithmetic::smooth_step::<A>(w, a, b, c),
    }
}

/// A flagged operand may be NaN, for which every comparison but `!=` is false.
#[inline(always)]
fn compare(op: Compare, a: Interval, b: Interval) -> WideCell {
    let flags = a.flags.union(b.flags);
    if flags.is_none() {
        put_truth(integers::compare(op, (a.lo, a.hi), (b.lo, b.hi)), flags)
    } else {
        put_truth(Truth::Maybe, flags)
    }
}

#[inline(always)]
fn int_binary(op: IntBinary, t: IntType, a: WideCell, b: WideCell) -> WideCell {
    let shift = matches!(op, IntBinary::ShiftLeft | IntBinary::ShiftRight);
    let other = if shift {
        IntType {
            signed: false,
            bits: 32,
        }
    } else {
        t
    };
    put_int(
        integers::binary(op, t, get_int(t, a), get_int(other, b)),
        a.flags.union(b.flags),
    )
}

fn bool_binary(op: BoolBinary, a: WideCell, b: WideCell) -> WideCell {
    let (x, y) = (get_truth(a), get_truth(b));
    let flags = a.flags.union(b.flags);
    let result = match op {
        BoolBinary::And if x == Truth::False || y == Truth::False => {
            return put_truth(Truth::False, Flags::NONE);
        }
        BoolBinary::Or if x == Truth::True || y == Truth::True => return put_truth(Truth::True, Flags::NONE),
        BoolBinary::And | BoolBinary::Or => x.hull(y),
        BoolBinary::Equal if x == Truth::Maybe || y == Truth::Maybe => Truth::Maybe,
        BoolBinary::Equal => Truth::from_bool(x == y),
        BoolBinary::NotEqual if x == Truth::Maybe || y == Truth::Maybe => Truth::Maybe,
        BoolBinary::NotEqual => Truth::from_bool(x != y),
    };
    put_truth(result, flags)
}

fn convert<const A: bool>(from: Kind, to: Kind, a: WideCell) -> WideCell {
    match (from, to) {
        (Kind::Float(v), Kind::Float(w)) => put_float(bits::float_to_float::<A>(v, w, a.interval())),
        (Kind::Float(w), Kind::Int(t)) => {
            let (bounds, flags) = bits::float_to_integer(w, t, a.interval());
            put_int(bounds, flags)
        }
        (Kind::Float(_), Kind::Bool) => compare(Compare::NotEqual, a.interval(), Interval::point(0.0)),
        (Kind::Int(t), Kind::Float(w)) => put_float(bits::integer_to_float::<A>(w, get_int(t, a), a.flags)),
        (Kind::Int(t), Kind::Int(u)) => put_int(resize(u, get_int(t, a)), a.flags),
        (Kind::Int(t), Kind::Bool) => put_truth(
            integers::compare(Compare::NotEqual, get_int(t, a), (0, 0)),
            a.flags,
        ),
        (Kind::Bool, Kind::Float(_)) => put_float(Interval {
            lo: a.lo as f64,
            hi: a.hi as f64,
            flags: a.flags,
        }),
        (Kind::Bool, Kind::Int(_) | Kind::Bool) => a,
    }
}

fn resize(t: IntType, (lo, hi): Bounds) -> Bounds {
    let (a, b) = (t.wrap(lo), t.wrap(hi));
    if a <= b && b - a == hi - lo {
        (a, b)
    } else {
        integers::whole(t)
    }
}

fn over_length(w: Width, quotient: WideCell, vector: &OverLength<'_, WideCell>) -> WideCell {
    let mut components = [Component {
        scaled: Interval::point(0.0),
        whole: Interval::point(0.0),
        product: false,
    }; 4];
    for (to, from) in components.iter_mut().zip(vector.components) {
        *to = Component {
            scaled: from.scaled.interval(),
            whole: from.whole.interval(),
            product: from.product,
        };
    }
    let vector = OverLength {
        sum: vector.sum.interval(),
        components: &components[..vector.components.len().min(4)],
        divisor: vector.divisor.map(WideCell::interval),
        at: vector.at,
    };
    put_float(unit::over_length(w, quotient.interval(), &vector))
}

macro_rules! interval_domain {
    ($name:ident, $label:literal, $absorb:literal) => {
        impl Domain for $name {
            type Cell = WideCell;
            type Float = Interval;
            const UNCERTAIN: bool = true;
            const REORDERS: bool = $absorb;
            const NAME: &'static str = $label;

            #[inline(always)]
            fn float(w: Width, x: f64) -> WideCell {
                put_float(super::rules::finish::<$absorb>(w, x, x))
            }
            fn int(_t: IntType, x: i128) -> WideCell {
                put_int((x, x), Flags::NONE)
            }
            fn bool(b: bool) -> WideCell {
                put_truth(Truth::from_bool(b), Flags::NONE)
            }
            fn to_float(c: WideCell) -> Interval {
                c.interval()
            }
            fn from_float(w: Width, x: Interval) -> WideCell {
                let bounds = Interval::new(w.round_down(x.lo, 0.0), w.round_up(x.hi, 0.0));
                put_float(if x.flags.is_none() {
                    flush(w, bounds)
                } else {
                    x
                })
            }
            #[inline(always)]
            fn float_bounds(c: WideCell) -> (f64, f64) {
                let x = c.interval();
                if x.flags.is_none() {
                    (x.lo, x.hi)
                } else {
                    (f64::NAN, f64::NAN)
                }
            }
            #[inline(always)]
            fn int_bounds(t: IntType, c: WideCell) -> Bounds {
                get_int(t, c)
            }
            #[inline(always)]
            fn truth(c: WideCell) -> Truth {
                get_truth(c)
            }
            fn int_range(_t: IntType, lo: i128, hi: i128) -> WideCell {
                put_int((lo, hi), Flags::NONE)
            }
            fn real(w: Width, lo: f64, hi: f64) -> WideCell {
                put_float(outward::<$absorb>(w, lo, hi))
            }
            fn indeterminate(kind: Kind) -> WideCell {
                unknown(kind, Flags::INDETERMINATE)
            }
            fn undecided(kind: Kind) -> WideCell {
                unknown(kind, Flags::UNDECIDED)
            }
            fn hull(kind: Kind, a: WideCell, b: WideCell) -> WideCell {
                hull(kind, a, b)
            }
            fn narrow(
                op: Compare,
                w: Width,
                a: WideCell,
                b: WideCell,
                products: [bool; 2],
            ) -> (WideCell, WideCell) {
                let (a, b) = narrow::both(op, w, (a.interval(), b.interval()), products);
                (put_float(a), put_float(b))
            }
            fn unite(a: WideCell, b: WideCell) -> WideCell {
                put_float(a.interval().hull(b.interval()))
            }
            #[inline(always)]
            fn unary(op: FloatUnary, w: Width, a: WideCell) -> WideCell {
                put_float(functions::unary::<$absorb>(op, w, a.interval()))
            }
            #[inline(always)]
            fn binary(op: FloatBinary, w: Width, a: WideCell, b: WideCell) -> WideCell {
                put_float(binary::<$absorb>(op, w, a.interval(), b.interval()))
            }
            #[inline(always)]
            fn ternary(op: FloatTernary, w: Width, a: WideCell, b: WideCell, c: WideCell) -> WideCell {
                put_float(ternary::<$absorb>(
                    op,
                    w,
                    a.interval(),
                    b.interval(),
                    c.interval(),
                ))
            }
            fn sum(w: Width, terms: &[WideCell]) -> WideCell {
                let mut list = [Interval::point(0.0); 4];
                let n = terms.len().min(4);
                for (to, from) in list.iter_mut().zip(terms) {
                    *to = from.interval();
                }
                put_float(orders::of_four::<$absorb>(w, &list[..n]))
            }
            fn reordered(op: FloatBinary, w: Width, written: WideCell, terms: &[WideCell]) -> WideCell {
                let mut list = [Interval::point(0.0); MAX_TERMS];
                for (to, from) in list.iter_mut().zip(terms) {
                    *to = from.interval();
                }
                let terms = &list[..terms.len()];
                put_float(if op == FloatBinary::Multiply {
                    orders::product::<$absorb>(w, written.interval(), terms)
                } else {
                    orders::sum::<$absorb>(w, written.interval(), terms)
                })
            }
            fn over_length(w: Width, quotient: WideCell, vector: &OverLength<'_, WideCell>) -> WideCell {
                over_length(w, quotient, vector)
            }
            #[inline(always)]
            fn compare(op: Compare, _w: Width, a: WideCell, b: WideCell) -> WideCell {
                compare(op, a.interval(), b.interval())
            }
            fn frexp_exponent(w: Width, a: WideCell) -> WideCell {
                let x = a.interval();
                let zero = x.lo == 0.0 && x.hi == 0.0;
                let subnormal = x.lo < w.min_normal() && x.hi > -w.min_normal() && !zero;
                if !x.flags.is_none() || subnormal {
                    return unknown(Kind::Int(IntType::I32), x.flags.union(Flags::INDETERMINATE));
                }
                let (e, f) = (i128::from(frexp(w, x.lo).1), i128::from(frexp(w, x.hi).1));
                put_int((e.min(f), e.max(f)), x.flags)
            }
            fn ldexp(w: Width, x: WideCell, e: WideCell) -> WideCell {
                let (lo, hi) = get_int(IntType::I32, e);
                put_float(functions::ldexp::<$absorb>(
                    w,
                    x.interval().flagged(e.flags),
                    (lo as i32, hi as i32),
                ))
            }
            fn int_unary(op: IntUnary, t: IntType, a: WideCell) -> WideCell {
                put_int(integers::unary(op, t, get_int(t, a)), a.flags)
            }
            fn int_binary(op: IntBinary, t: IntType, a: WideCell, b: WideCell) -> WideCell {
                int_binary(op, t, a, b)
            }
            fn int_compare(op: Compare, t: IntType, a: WideCell, b: WideCell) -> WideCell {
                put_truth(
                    integers::compare(op, get_int(t, a), get_int(t, b)),
                    a.flags.union(b.flags),
                )
            }
            fn not(a: WideCell) -> WideCell {
                put_truth(integers::negate(get_truth(a)), a.flags)
            }
            fn bool_binary(op: BoolBinary, a: WideCell, b: WideCell) -> WideCell {
                bool_binary(op, a, b)
            }
            fn select(kind: Kind, condition: WideCell, accept: WideCell, reject: WideCell) -> WideCell {
                match get_truth(condition) {
                    Truth::True => accept,
                    Truth::False => reject,
                    Truth::Maybe => hull(kind, accept, reject),
                }
            }
            fn convert(from: Kind, to: Kind, a: WideCell) -> WideCell {
                convert::<$absorb>(from, to, a)
            }
            fn to_bits(from: Kind, a: WideCell) -> WideCell {
                match from {
                    Kind::Float(w) => {
                        let (bounds, flags) = bits::bits_of(w, a.interval());
                        put_int(bounds, flags)
                    }
                    Kind::Int(t) => put_int(resize(bits_type(from), get_int(t, a)), a.flags),
                    Kind::Bool => a,
                }
            }
            fn from_bits(to: Kind, a: WideCell) -> WideCell {
                let bounds = get_int(bits_type(to), a);
                match to {
                    Kind::Float(w) => put_float(bits::float_of::<$absorb>(w, bounds, a.flags)),
                    Kind::Int(t) => put_int(resize(t, bounds), a.flags),
                    Kind::Bool => put_truth(
                        integers::compare(Compare::NotEqual, bounds, (0, 0)),
                        a.flags,
                    ),
                }
            }
        }
    };
}

interval_domain!(Accept, "accept", true);
interval_domain!(Range, "range", false);
