//! Built-in functions of floats over intervals: each the real function's bounds, widened by the accuracy table.
//!
//! A monotone function is evaluated at the ends; `sin` and `cos` also at the extrema between. Where the table says *inherited
//! from*, the formula it names is evaluated with the interval operations, so its error is inherited literally.

use super::arithmetic::{
    add, divide, enter, magnitude, maximum, minimum, multiply, negate, square, subtract, unbounded,
};
use super::rules::{
    DIVIDE_ULPS, INVERSE_SQRT_ULPS, LOG_ULPS, TANH_ERROR, acos_error, asin_error, atan_ulps, exp_ulps,
    finish, log_error, outward, sin_error, within_absolute, within_ulps, within_ulps_unrounded,
};
use super::{Flags, Interval};
use crate::domain::ops::FloatUnary;
use crate::domain::point::frexp;
use crate::width::{Width, exp2i};
use std::f64::consts::{FRAC_PI_2, PI};

/// A function of one argument.
#[inline(always)]
pub(crate) fn unary<const A: bool>(op: FloatUnary, w: Width, a: Interval) -> Interval {
    match op {
        FloatUnary::Negate => negate(a),
        FloatUnary::Abs => magnitude(a),
        FloatUnary::Floor => exact::<A>(a, f64::floor),
        FloatUnary::Square => square::<A>(w, a),
        FloatUnary::Sqrt => sqrt::<A>(w, a),
        FloatUnary::Fract => fract::<A>(w, a),
        FloatUnary::Sign
        | FloatUnary::Saturate
        | FloatUnary::Ceil
        | FloatUnary::Round
        | FloatUnary::Trunc
        | FloatUnary::InverseSqrt
        | FloatUnary::Sin
        | FloatUnary::Cos
        | FloatUnary::Tan
        | FloatUnary::Asin
        | FloatUnary::Acos
        | FloatUnary::Atan
        | FloatUnary::Sinh
        | FloatUnary::Cosh
        | FloatUnary::Tanh
        | FloatUnary::Asinh
        | FloatUnary::Acosh
        | FloatUnary::Atanh
        | FloatUnary::Exp
        | FloatUnary::Exp2
        | FloatUnary::Log
        | FloatUnary::Log2
        | FloatUnary::Radians
        | FloatUnary::Degrees
        | FloatUnary::QuantizeToF16
        | FloatUnary::ModfFract
        | FloatUnary::FrexpFract => rarer::<A>(op, w, a),
    }
}

#[inline(never)]
fn rarer<const A: bool>(op: FloatUnary, w: Width, a: Interval) -> Interval {
    match op {
        FloatUnary::Negate => negate(a),
        FloatUnary::Abs => magnitude(a),
        FloatUnary::Floor => exact::<A>(a, f64::floor),
        FloatUnary::Square => square::<A>(w, a),
        FloatUnary::Sqrt => sqrt::<A>(w, a),
        FloatUnary::Fract => fract::<A>(w, a),
        FloatUnary::Sign => exact::<A>(a, |x| if x == 0.0 { 0.0 } else { x.signum() }),
        FloatUnary::Saturate => maximum::<A>(minimum::<A>(a, Interval::point(1.0)), Interval::point(0.0)),
        FloatUnary::Ceil => exact::<A>(a, f64::ceil),
        FloatUnary::Round => exact::<A>(a, f64::round_ties_even),
        FloatUnary::Trunc => exact::<A>(a, f64::trunc),
        FloatUnary::InverseSqrt => inverse_sqrt::<A>(w, a),
        FloatUnary::Sin => periodic::<A>(w, a, f64::sin, FRAC_PI_2),
        FloatUnary::Cos => periodic::<A>(w, a, f64::cos, 0.0),
        FloatUnary::Tan => tan::<A>(w, a),
        FloatUnary::Asin => asin::<A>(w, a),
        FloatUnary::Acos => acos::<A>(w, a),
        FloatUnary::Atan => monotone::<A>(a, |lo, hi| {
            within_ulps::<A>(w, lo.atan(), hi.atan(), atan_ulps(w))
        }),
        FloatUnary::Sinh => sinh::<A>(w, a),
        FloatUnary::Cosh => cosh::<A>(w, a),
        FloatUnary::Tanh => tanh::<A>(w, a),
        FloatUnary::Asinh => asinh::<A>(w, a),
        FloatUnary::Acosh => acosh::<A>(w, a),
        FloatUnary::Atanh => atanh::<A>(w, a),
        FloatUnary::Exp => exponential::<A>(w, a, f64::exp),
        FloatUnary::Exp2 => exponential::<A>(w, a, f64::exp2),
        FloatUnary::Log => logarithm::<A>(w, a, f64::ln),
        FloatUnary::Log2 => logarithm::<A>(w, a, f64::log2),
        FloatUnary::Radians => multiply::<A>(w, a, constant(w, PI / 180.0)),
        FloatUnary::Degrees => multiply::<A>(w, a, constant(w, 180.0 / PI)),
        FloatUnary::QuantizeToF16 => round_to::<A>(Width::F16, a),
        FloatUnary::ModfFract => modf_fract::<A>(a),
        FloatUnary::FrexpFract => frexp_fract::<A>(w, a),
    }
}

/// A non-decreasing step function, whose results need no rounding; across a step it forks.
#[inline(always)]
fn exact<const A: bool>(a: Interval, f: impl Fn(f64) -> f64) -> Interval {
    match enter::<A>(a.flags) {
        Ok(flags) => {
            let (lo, hi) = (f(a.lo), f(a.hi));
            let forked = if lo == hi { Flags::NONE } else { Flags::FORKED };
            Interval {
                lo,
                hi,
                flags: flags.union(forked),
            }
        }
        Err(unknown) => unknown,
    }
}

/// A function whose bounds come from both ends.
#[inline(always)]
fn monotone<const A: bool>(a: Interval, f: impl Fn(f64, f64) -> Interval) -> Interval {
    match enter::<A>(a.flags) {
        Ok(flags) => f(a.lo, a.hi).flagged(flags),
        Err(unknown) => unknown,
    }
}

/// A real constant, which a shader compiler rounds in either direction.
fn constant(w: Width, x: f64) -> Interval {
    Interval::new(w.round_down(x, -1.0), w.round_up(x, 1.0))
}

/// Rounds members to a format in either direction.
pub(crate) fn round_to<const A: bool>(w: Width, a: Interval) -> Interval {
    monotone::<A>(a, |lo, hi| outward::<A>(w, lo, hi))
}

/// `x - floor(x)`; within one unit step the argument's spread is kept, across a step the result is anything in [0, 1].
fn fract<const A: bool>(w: Width, a: Interval) -> Interval {
    monotone::<A>(a, |lo, hi| {
        let step = lo.floor();
        if step == hi.floor() && lo.is_finite() {
            outward_difference::<A>(w, lo, hi, step)
        } else if lo.is_finite() && hi.is_finite() {
            Interval::new(0.0, 1.0).flagged(Flags::FORKED)
        } else {
            Interval::new(0.0, 1.0).flagged(Flags::NAN)
        }
    })
}

fn outward_difference<const A: bool>(w: Width, lo: f64, hi: f64, step: f64) -> Interval {
    subtract::<A>(w, Interval::new(lo, hi), Interval::point(step))
}

fn modf_fract<const A: bool>(a: Interval) -> Interval {
    monotone::<A>(a, |lo, hi| {
        let step = lo.trunc();
        // Both ends on one side of zero and in one unit step: the subtraction is exact.
        if step == hi.trunc() && lo.is_finite() {
            Interval::new(lo - step, hi - step)
        } else {
            Interval::new(
                if lo < 0.0 { -1.0 } else { 0.0 },
                if hi > 0.0 { 1.0 } else { 0.0 },
            )
        }
    })
}

fn frexp_fract<const A: bool>(w: Width, a: Interval) -> Interval {
    let subnormal = a.lo < w.min_normal() && a.hi > -w.min_normal() && !(a.lo == 0.0 && a.hi == 0.0);
    if subnormal {
        return unbounded::<A>(Flags::NONE);
    }
    monotone::<A>(a, |lo, hi| {
        let ((f, e), (g, h)) = (frexp(w, lo), frexp(w, hi));
        if e == h {
            Interval::new(f, g)
        } else if lo > 0.0 {
            Interval::new(0.5, 1.0)
        } else {
            Interval::new(-1.0, -0.5)
        }
    })
}

/// 2 ULP on positive numbers.
pub(crate) fn inverse_sqrt<const A: bool>(w: Width, a: Interval) -> Interval {
    if a.lo < w.min_normal() {
        return unbounded::<A>(if a.lo < 0.0 { Flags::NAN } else { Flags::NONE }).flagged(a.flags);
    }
    monotone::<A>(a, |lo, hi| {
        within_ulps::<A>(w, 1.0 / hi.sqrt(), 1.0 / lo.sqrt(), INVERSE_SQRT_ULPS)
    })
}

/// Inherited from `1 / inverseSqrt(x)`; the root of zero is zero. The roots below the least normal number may be flushed.
pub(crate) fn sqrt<const A: bool>(w: Width, a: Interval) -> Interval {
    let flags = match enter::<A>(a.flags) {
        Ok(flags) => flags,
        Err(unknown) => return unknown,
    };
    if a.lo < 0.0 {
        return unbounded::<A>(Flags::NAN).flagged(flags);
    }
    if a.hi == 0.0 {
        return Interval::point(0.0).flagged(flags);
    }
    let least = w.min_normal();
    if a.hi < least {
        return outward::<A>(w, 0.0, least.sqrt())
            .flagged(flags)
            .hull(Interval::point(0.0));
    }
    let normal = Interval::new(a.lo.max(least), a.hi);
    let root = if normal.hi == f64::INFINITY {
        Interval::new(0.0, f64::INFINITY)
    } else {
        root::<A>(w, normal)
    };
    if a.lo < least {
        root.hull(Interval::point(0.0)).flagged(flags)
    } else {
        root.flagged(flags)
    }
}

/// Of positive normal numbers. The reciprocal root on the way is bounded as a real number: nothing asks for it in the format.
fn root<const A: bool>(w: Width, a: Interval) -> Interval {
    // In f16 the reciprocal of a large root leaves division's stated range only below 2^-14: never for normal arguments.
    let inverse = within_ulps_unrounded(w, 1.0 / a.hi.sqrt(), 1.0 / a.lo.sqrt(), INVERSE_SQRT_ULPS);
    within_ulps::<A>(w, 1.0 / inverse.1, 1.0 / inverse.0, DIVIDE_ULPS)
}

/// `sin` and `cos`: absolute error on [−π, π], nothing stated outside. `peak` is where the function is 1.
fn periodic<const A: bool>(w: Width, a: Interval, f: fn(f64) -> f64, peak: f64) -> Interval {
    let flags = match enter::<A>(a.flags) {
        Ok(flags) => flags,
        Err(unknown) => return unknown,
    };
    // π rounded up to the format is what a shader writes for π.
    let limit = w.round_up(PI, 0.0);
    if A && (a.lo < -limit || a.hi > limit) {
        return Interval::unknown(Flags::INDETERMINATE);
    }
    let (lo, hi) = extrema(a, f, peak);
    let nan = if a.lo.is_finite() && a.hi.is_finite() {
        Flags::NONE
    } else {
        Flags::NAN
    };
    within_absolute::<A>(w, lo, hi, sin_error(w)).flagged(flags.union(nan))
}

fn extrema(a: Interval, f: fn(f64) -> f64, peak: f64) -> (f64, f64) {
    // Beyond 2^40 the phase in f64 is no longer good to the error the table allows.
    if !(a.lo.is_finite() && a.hi.is_finite())
        || a.hi - a.lo >= 2.0 * PI
        || a.hi.abs().max(a.lo.abs()) > exp2i(40)
    {
        return (-1.0, 1.0);
    }
    let passes = |at: f64| ((a.lo - at) / (2.0 * PI)).ceil() * (2.0 * PI) + at <= a.hi;
    let (x, y) = (f(a.lo), f(a.hi));
    let lo = if passes(peak + PI) { -1.0 } else { x.min(y) };
    let hi = if passes(peak) { 1.0 } else { x.max(y) };
    (lo, hi)
}

/// Inherited from `sin(x) / cos(x)`.
fn tan<const A: bool>(w: Width, a: Interval) -> Interval {
    divide::<A>(
        w,
        periodic::<A>(w, a, f64::sin, FRAC_PI_2),
        periodic::<A>(w, a, f64::cos, 0.0),
    )
}

/// 4096 ULP for a normal divisor; see `rules.rs` for `y = 0`.
pub(crate) fn atan2<const A: bool>(w: Width, y: Interval, x: Interval) -> Interval {
    let flags = match enter::<A>(y.flags.union(x.flags)) {
        Ok(flags) => flags,
        Err(unknown) => return unknown,
    };
    let least = w.min_normal();
    let near_zero = |v: Interval| v.lo < least && v.hi > -least;
    if near_zero(x) || magnitude(x).hi > exp2i(w.quotient_exponent()) || (near_zero(y) && x.lo < 0.0) {
        return if A {
            Interval::unknown(Flags::INDETERMINATE)
        } else {
            within_ulps::<A>(w, -PI, PI, atan_ulps(w)).flagged(flags)
        };
    }
    let corners = [(y.lo, x.lo), (y.lo, x.hi), (y.hi, x.lo), (y.hi, x.hi)].map(|(y, x)| y.atan2(x));
    let lo = corners.into_iter().fold(f64::INFINITY, f64::min);
    let hi = corners.into_iter().fold(f64::NEG_INFINITY, f64::max);
    within_ulps::<A>(w, lo, hi, atan_ulps(w)).flagged(flags)
}

/// The worse of an absolute error and `atan2(x, sqrt(1 - x * x))`.
fn asin<const A: bool>(w: Width, a: Interval) -> Interval {
    inverse_of::<A>(
        a,
        |lo, hi| within_absolute::<A>(w, lo.asin(), hi.asin(), asin_error(w)),
        |a| atan2::<A>(w, a, co_side::<A>(w, a)),
    )
}

/// The worse of an absolute error and `atan2(sqrt(1 - x * x), x)`.
fn acos<const A: bool>(w: Width, a: Interval) -> Interval {
    inverse_of::<A>(
        a,
        |lo, hi| within_absolute::<A>(w, hi.acos(), lo.acos(), acos_error(w)),
        |a| atan2::<A>(w, co_side::<A>(w, a), a),
    )
}

fn co_side<const A: bool>(w: Width, a: Interval) -> Interval {
    sqrt::<A>(w, subtract::<A>(w, Interval::point(1.0), square::<A>(w, a)))
}

fn inverse_of<const A: bool>(
    a: Interval,
    absolute: impl Fn(f64, f64) -> Interval,
    inherited: impl Fn(Interval) -> Interval,
) -> Interval {
    if a.lo < -1.0 || a.hi > 1.0 {
        return unbounded::<A>(Flags::NAN).flagged(a.flags);
    }
    monotone::<A>(a, |lo, hi| {
        absolute(lo, hi).hull(inherited(Interval::new(lo, hi)))
    })
}

/// Inherited from `(exp(x) - exp(-x)) * 0.5`.
fn sinh<const A: bool>(w: Width, a: Interval) -> Interval {
    let (up, down) = (
        exponential::<A>(w, a, f64::exp),
        exponential::<A>(w, negate(a), f64::exp),
    );
    multiply::<A>(w, subtract::<A>(w, up, down), Interval::point(0.5))
}

/// Inherited from `(exp(x) + exp(-x)) * 0.5`.
fn cosh<const A: bool>(w: Width, a: Interval) -> Interval {
    let (up, down) = (
        exponential::<A>(w, a, f64::exp),
        exponential::<A>(w, negate(a), f64::exp),
    );
    multiply::<A>(w, add::<A>(w, up, down), Interval::point(0.5))
}

/// The worse of an absolute error and `sinh(x) / cosh(x)`.
fn tanh<const A: bool>(w: Width, a: Interval) -> Interval {
    let inherited = divide::<A>(w, sinh::<A>(w, a), cosh::<A>(w, a));
    monotone::<A>(a, |lo, hi| {
        within_absolute::<A>(w, lo.tanh(), hi.tanh(), TANH_ERROR)
    })
    .hull(inherited)
}

/// Inherited from `log(x + sqrt(x * x + 1))`.
fn asinh<const A: bool>(w: Width, a: Interval) -> Interval {
    let root = sqrt::<A>(w, add::<A>(w, square::<A>(w, a), Interval::point(1.0)));
    logarithm::<A>(w, add::<A>(w, a, root), f64::ln)
}

/// Inherited from `log(x + sqrt(x * x - 1))`.
fn acosh<const A: bool>(w: Width, a: Interval) -> Interval {
    let root = sqrt::<A>(w, subtract::<A>(w, square::<A>(w, a), Interval::point(1.0)));
    logarithm::<A>(w, add::<A>(w, a, root), f64::ln)
}

/// Inherited from `log((1 + x) / (1 - x)) * 0.5`.
fn atanh<const A: bool>(w: Width, a: Interval) -> Interval {
    let one = Interval::point(1.0);
    let q = divide::<A>(w, add::<A>(w, one, a), subtract::<A>(w, one, a));
    multiply::<A>(w, logarithm::<A>(w, q, f64::ln), Interval::point(0.5))
}

/// `3 + 2 |x|` ULP, with the larger `|x|` of the two ends.
pub(crate) fn exponential<const A: bool>(w: Width, a: Interval, f: fn(f64) -> f64) -> Interval {
    monotone::<A>(a, |lo, hi| {
        let ulps = exp_ulps(w, magnitude(Interval::new(lo, hi)).hi.min(2000.0));
        let bounds = within_ulps::<A>(w, f(lo), f(hi), ulps);
        // An exponential is not negative, however wide its error.
        Interval {
            lo: bounds.lo.max(if bounds.flags.is_none() {
                0.0
            } else {
                f64::NEG_INFINITY
            }),
            ..bounds
        }
    })
}

/// Absolute error on [0.5, 2], ULP elsewhere; nothing at or below zero.
pub(crate) fn logarithm<const A: bool>(w: Width, a: Interval, f: fn(f64) -> f64) -> Interval {
    if a.lo < w.min_normal() {
        return unbounded::<A>(if a.lo < 0.0 { Flags::NAN } else { Flags::NONE }).flagged(a.flags);
    }
    monotone::<A>(a, |lo, hi| {
        let mut bounds: Option<Interval> = None;
        let mut include = |x: Interval| bounds = Some(bounds.map_or(x, |b| b.hull(x)));
        if lo < 0.5 {
            include(within_ulps::<A>(w, f(lo), f(hi.min(0.5)), LOG_ULPS));
        }
        if hi > 2.0 {
            include(within_ulps::<A>(w, f(lo.max(2.0)), f(hi), LOG_ULPS));
        }
        if hi >= 0.5 && lo <= 2.0 {
            include(within_absolute::<A>(
                w,
                f(lo.max(0.5)),
                f(hi.min(2.0)),
                log_error(w),
            ));
        }
        bounds.unwrap_or(Interval::unknown(Flags::INDETERMINATE))
    })
}

/// Inherited from `exp2(y * log2(x))`.
pub(crate) fn pow<const A: bool>(w: Width, x: Interval, y: Interval) -> Interval {
    let exponent = multiply::<A>(w, y, logarithm::<A>(w, x, f64::log2));
    exponential::<A>(w, exponent, f64::exp2)
}

/// `x * 2^e`, correctly rounded.
pub(crate) fn ldexp<const A: bool>(w: Width, x: Interval, (lo, hi): (i32, i32)) -> Interval {
    monotone::<A>(x, |a, b| {
        let scaled = |x: f64, e: i32| crate::domain::point::scale(x, e);
        let bounds = [scaled(a, lo), scaled(a, hi), scaled(b, lo), scaled(b, hi)];
        let least = bounds.into_iter().fold(f64::INFINITY, f64::min);
        let most = bounds.into_iter().fold(f64::NEG_INFINITY, f64::max);
        finish::<A>(w, w.round_down(least, 0.0), w.round_up(most, 0.0))
    })
}
