//! Conversions and bit patterns of intervals.

use super::functions::round_to;
use super::integers::{Bounds, whole};
use super::rules::{finish, flush};
use super::{Flags, Interval};
use crate::domain::point::{float_from_bits, float_to_bits, float_to_int, int_to_f64};
use crate::kind::IntType;
use crate::width::Width;

/// Float to float: rounded in either direction where the new format is shorter.
pub(crate) fn float_to_float<const A: bool>(from: Width, to: Width, x: Interval) -> Interval {
    if to >= from { x } else { round_to::<A>(to, x) }
}

/// Float to integer: truncated and clamped, monotone; across a step it forks.
pub(crate) fn float_to_integer(w: Width, t: IntType, x: Interval) -> (Bounds, Flags) {
    if x.flags.is_none() {
        let bounds = (float_to_int(w, t, x.lo), float_to_int(w, t, x.hi));
        let forked = if bounds.0 == bounds.1 {
            Flags::NONE
        } else {
            Flags::FORKED
        };
        (bounds, x.flags.union(forked))
    } else {
        (whole(t), x.flags)
    }
}

/// Integer to float: rounded in either direction.
pub(crate) fn integer_to_float<const A: bool>(w: Width, (lo, hi): Bounds, flags: Flags) -> Interval {
    finish::<A>(w, below(w, lo), above(w, hi)).flagged(flags)
}

fn below(w: Width, x: i128) -> f64 {
    let y = int_to_f64(x);
    w.round_down(y, residual(x, y))
}

fn above(w: Width, x: i128) -> f64 {
    let y = int_to_f64(x);
    w.round_up(y, residual(x, y))
}

fn residual(x: i128, y: f64) -> f64 {
    (x - y as i128) as f64
}

/// The bit pattern of a float. On one side of zero the pattern is monotone in the magnitude.
pub(crate) fn bits_of(w: Width, x: Interval) -> (Bounds, Flags) {
    let all = (0, (1i128 << (crate::kind::Kind::Float(w).bytes() * 8)) - 1);
    if !x.flags.is_none() {
        return (all, x.flags);
    }
    let (a, b) = (
        i128::from(float_to_bits(w, x.lo)),
        i128::from(float_to_bits(w, x.hi)),
    );
    let crosses_zero = x.lo != x.hi && x.contains_zero() && !(x.lo == 0.0 && x.lo.is_sign_positive());
    if crosses_zero {
        (all, x.flags)
    } else {
        ((a.min(b), a.max(b)), x.flags)
    }
}

/// The float with a bit pattern: exact for one pattern, bounded where all patterns are finite and of one sign.
pub(crate) fn float_of<const A: bool>(w: Width, (lo, hi): Bounds, flags: Flags) -> Interval {
    let sign = 1i128 << (crate::kind::Kind::Float(w).bytes() * 8 - 1);
    let (x, y) = (float_from_bits(w, lo as u64), float_from_bits(w, hi as u64));
    let open = !flags.is_none() || (lo < sign) != (hi < sign) || !x.is_finite() || !y.is_finite();
    if open {
        return open_pattern::<A>(x, y, lo == hi).flagged(flags);
    }
    flush(w, Interval::new(x.min(y), x.max(y))).flagged(flags)
}

fn open_pattern<const A: bool>(x: f64, y: f64, point: bool) -> Interval {
    if A {
        Interval::unknown(Flags::INDETERMINATE)
    } else if point && !x.is_nan() {
        Interval::new(x, y)
    } else {
        Interval::unknown(Flags::NAN)
    }
}
