//! Sum, difference, product, quotient, remainder and what is built from comparisons: the operations of which most shaders consist.
//!
//! Sums and products are correctly rounded in either direction, which is exactly `[round_down, round_up]` of the exact bounds. A
//! fused multiply-add rounds once, which lies between the twice-rounded bounds, so fusion needs no case of its own.

use super::rules::{DIVIDE_ULPS, finish, within_ulps, within_ulps_of};
use super::{Flags, Interval};
use crate::width::{Width, exp2i, two_sum};

/// Flags of a result whose arguments carry flags; `Err` when nothing is left to compute.
#[inline(always)]
pub(crate) fn enter<const ABSORB: bool>(flags: Flags) -> Result<Flags, Interval> {
    if ABSORB && !flags.is_none() {
        Err(Interval::unknown(flags))
    } else {
        Ok(flags)
    }
}

#[inline(always)]
pub(crate) fn add<const ABSORB: bool>(w: Width, a: Interval, b: Interval) -> Interval {
    let mut flags = match enter::<ABSORB>(a.flags.union(b.flags)) {
        Ok(flags) => flags,
        Err(unknown) => return unknown,
    };
    if !ABSORB && opposite_infinities(a, b) {
        flags = flags.union(Flags::NAN);
    }
    let (lo, below) = two_sum(a.lo, b.lo);
    let (hi, above) = two_sum(a.hi, b.hi);
    let (lo, hi) = if ABSORB {
        (lo, hi)
    } else {
        (or(lo, f64::NEG_INFINITY), or(hi, f64::INFINITY))
    };
    finish::<ABSORB>(w, w.round_down(lo, below), w.round_up(hi, above)).flagged(flags)
}

fn opposite_infinities(a: Interval, b: Interval) -> bool {
    (a.hi == f64::INFINITY && b.lo == f64::NEG_INFINITY)
        || (a.lo == f64::NEG_INFINITY && b.hi == f64::INFINITY)
}

#[inline(always)]
fn or(x: f64, instead: f64) -> f64 {
    if x.is_nan() { instead } else { x }
}

#[inline(always)]
pub(crate) fn negate(a: Interval) -> Interval {
    Interval {
        lo: -a.hi,
        hi: -a.lo,
        flags: a.flags,
    }
}

#[inline(always)]
pub(crate) fn subtract<const ABSORB: bool>(w: Width, a: Interval, b: Interval) -> Interval {
    add::<ABSORB>(w, a, negate(b))
}

#[inline(always)]
pub(crate) fn multiply<const ABSORB: bool>(w: Width, a: Interval, b: Interval) -> Interval {
    let mut flags = match enter::<ABSORB>(a.flags.union(b.flags)) {
        Ok(flags) => flags,
        Err(unknown) => return unknown,
    };
    if !ABSORB && zero_times_infinity(a, b) {
        flags = flags.union(Flags::NAN);
    }
    let (lo, hi) = if w == Width::F64 {
        product_bounds_f64(a, b)
    } else {
        product_bounds(w, a, b)
    };
    finish::<ABSORB>(w, lo, hi).flagged(flags)
}

fn zero_times_infinity(a: Interval, b: Interval) -> bool {
    let infinite = |x: Interval| x.lo == f64::NEG_INFINITY || x.hi == f64::INFINITY;
    (a.contains_zero() && infinite(b)) || (b.contains_zero() && infinite(a))
}

/// Products of two `f32` or `f16` values are exact in `f64`.
#[inline(always)]
fn product_bounds(w: Width, a: Interval, b: Interval) -> (f64, f64) {
    if a.lo >= 0.0 && b.lo >= 0.0 && a.hi < f64::INFINITY && b.hi < f64::INFINITY {
        return (w.round_down(a.lo * b.lo, 0.0), w.round_up(a.hi * b.hi, 0.0));
    }
    let p = [a.lo * b.lo, a.lo * b.hi, a.hi * b.lo, a.hi * b.hi].map(|x| or(x, 0.0));
    let lo = p[0].min(p[1]).min(p[2].min(p[3]));
    let hi = p[0].max(p[1]).max(p[2].max(p[3]));
    (w.round_down(lo, 0.0), w.round_up(hi, 0.0))
}

fn product_bounds_f64(a: Interval, b: Interval) -> (f64, f64) {
    let (mut lo, mut hi) = (f64::INFINITY, f64::NEG_INFINITY);
    for (x, y) in [(a.lo, b.lo), (a.lo, b.hi), (a.hi, b.lo), (a.hi, b.hi)] {
        let p = or(x * y, 0.0);
        let tiny = p != 0.0 && p.abs() < 1e-290;
        let residual = or(x.mul_add(y, -p), 0.0);
        // Near the bottom of the format the residual itself may underflow: step either way.
        let (below, above) = if tiny || (p == 0.0 && x != 0.0 && y != 0.0) {
            (-1.0, 1.0)
        } else {
            (residual, residual)
        };
        lo = lo.min(Width::F64.round_down(p, below));
        hi = hi.max(Width::F64.round_up(p, above));
    }
    (lo, hi)
}

/// `x * x` of one and the same value.
#[inline(always)]
pub(crate) fn square<const ABSORB: bool>(w: Width, a: Interval) -> Interval {
    multiply::<ABSORB>(w, magnitude(a), magnitude(a))
}

/// `|x|`.
#[inline(always)]
pub(crate) fn magnitude(a: Interval) -> Interval {
    let (p, q) = (a.lo.abs(), a.hi.abs());
    let lo = if a.contains_zero() { 0.0 } else { p.min(q) };
    Interval {
        lo,
        hi: p.max(q),
        flags: a.flags,
    }
}

/// 2.5 ULP for a divisor in the stated range; a divisor that may be zero or outside of it leaves the quotient open.
pub(crate) fn divide<const ABSORB: bool>(w: Width, a: Interval, b: Interval) -> Interval {
    let flags = match enter::<ABSORB>(a.flags.union(b.flags)) {
        Ok(flags) => flags,
        Err(unknown) => return unknown,
    };
    if b.lo < w.min_normal() && b.hi > -w.min_normal() {
        let nan = if a.contains_zero() || !ABSORB {
            Flags::NAN
        } else {
            Flags::NONE
        };
        return unbounded::<ABSORB>(nan).flagged(flags);
    }
    let stated = exp2i(w.quotient_exponent());
    let outside = magnitude(b).hi > stated;
    if ABSORB && outside {
        return Interval::unknown(Flags::INDETERMINATE);
    }
    let q = [a.lo / b.lo, a.lo / b.hi, a.hi / b.lo, a.hi / b.hi];
    if q.iter().any(|x| x.is_nan()) {
        return unbounded::<ABSORB>(Flags::NAN).flagged(flags);
    }
    let lo = q[0].min(q[1]).min(q[2].min(q[3]));
    let hi = q[0].max(q[1]).max(q[2].max(q[3]));
    let exact = lo == hi && lo.mul_add(-b.lo, a.lo) == 0.0;
    let result = if exact {
        within_ulps_of::<ABSORB>(w, lo, DIVIDE_ULPS)
    } else {
        within_ulps::<ABSORB>(w, lo, hi, DIVIDE_ULPS)
    };
    let result = result.flagged(flags);
    // A large divisor may be handled through its reciprocal, which may flush to zero.
    if outside {
        result.hull(Interval::point(0.0))
    } else {
        result
    }
}

/// No bound at all: indeterminate in `Accept`, everything with the given flags in `Range`.
#[inline(always)]
pub(crate) fn unbounded<const ABSORB: bool>(flags: Flags) -> Interval {
    Interval::unknown(if ABSORB { Flags::INDETERMINATE } else { flags })
}

/// Inherited from `x - y * trunc(x / y)`.
pub(crate) fn remainder<const ABSORB: bool>(w: Width, a: Interval, b: Interval) -> Interval {
    let q = divide::<ABSORB>(w, a, b);
    if ABSORB && !q.flags.is_none() {
        return q;
    }
    let whole = Interval {
        lo: q.lo.trunc(),
        hi: q.hi.trunc(),
        flags: q.flags,
    };
    subtract::<ABSORB>(w, a, multiply::<ABSORB>(w, b, whole))
}

#[inline(always)]
pub(crate) fn minimum<const ABSORB: bool>(a: Interval, b: Interval) -> Interval {
    match enter::<ABSORB>(a.flags.union(b.flags)) {
        Ok(flags) => {
            let usual = Interval {
                lo: a.lo.min(b.lo),
                hi: a.hi.min(b.hi),
                flags,
            };
            or_the_other(usual, a, b)
        }
        Err(unknown) => unknown,
    }
}

#[inline(always)]
pub(crate) fn maximum<const ABSORB: bool>(a: Interval, b: Interval) -> Interval {
    match enter::<ABSORB>(a.flags.union(b.flags)) {
        Ok(flags) => {
            let usual = Interval {
                lo: a.lo.max(b.lo),
                hi: a.hi.max(b.hi),
                flags,
            };
            or_the_other(usual, a, b)
        }
        Err(unknown) => unknown,
    }
}

/// The lesser or the greater of a NaN and a number is the number on many machines: where either may be NaN, the other is a result.
#[inline(always)]
fn or_the_other(usual: Interval, a: Interval, b: Interval) -> Interval {
    let mut out = usual;
    if a.flags.has(Flags::NAN) {
        out = out.hull(b);
    }
    if b.flags.has(Flags::NAN) {
        out = out.hull(a);
    }
    out
}

/// `min(max(x, low), high)` or the median of the three, which differ where `low > high`.
pub(crate) fn clamp<const ABSORB: bool>(x: Interval, low: Interval, high: Interval) -> Interval {
    let usual = minimum::<ABSORB>(maximum::<ABSORB>(x, low), high);
    if low.hi <= high.lo || !usual.flags.is_none() {
        return usual;
    }
    usual.hull(Interval::new(
        median(x.lo, low.lo, high.lo),
        median(x.hi, low.hi, high.hi),
    ))
}

fn median(a: f64, b: f64, c: f64) -> f64 {
    a.min(b).max(a.max(b).min(c))
}

/// `x * y + z`, fused or not.
pub(crate) fn fma<const ABSORB: bool>(w: Width, x: Interval, y: Interval, z: Interval) -> Interval {
    add::<ABSORB>(w, multiply::<ABSORB>(w, x, y), z)
}

/// Inherited from `x * (1 - z) + y * z`; the form `x + (y - x) * z`, which machines use as well, is admitted too.
pub(crate) fn mix<const ABSORB: bool>(w: Width, x: Interval, y: Interval, z: Interval) -> Interval {
    let rest = subtract::<ABSORB>(w, Interval::point(1.0), z);
    let weighted = add::<ABSORB>(w, multiply::<ABSORB>(w, x, rest), multiply::<ABSORB>(w, y, z));
    let stepped = add::<ABSORB>(w, x, multiply::<ABSORB>(w, subtract::<ABSORB>(w, y, x), z));
    weighted.hull(stepped)
}

/// Inherited from `t * t * (3 - 2 * t)` with `t = clamp((x - edge0) / (edge1 - edge0), 0, 1)`.
pub(crate) fn smooth_step<const ABSORB: bool>(
    w: Width,
    edge0: Interval,
    edge1: Interval,
    x: Interval,
) -> Interval {
    let span = subtract::<ABSORB>(w, edge1, edge0);
    let raw = divide::<ABSORB>(w, subtract::<ABSORB>(w, x, edge0), span);
    let t = clamp::<ABSORB>(raw, Interval::point(0.0), Interval::point(1.0));
    let falling = subtract::<ABSORB>(
        w,
        Interval::point(3.0),
        multiply::<ABSORB>(w, Interval::point(2.0), t),
    );
    multiply::<ABSORB>(w, square::<ABSORB>(w, t), falling)
}
