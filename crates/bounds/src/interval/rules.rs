//! The accuracy table of WGSL, as data and as the two ways to apply an entry: units in the last place, or an absolute error.
//!
//! Source: WGSL, *Accuracy of Concrete Floating Point Expressions*. The table has columns for `f32` and `f16`; for `f64`, which
//! WGSL does not have, the `f32` entries are used in units of `f64` (the SPIR-V environment promises double precision at least
//! the accuracy of single).
//!
//! Three readings of ours, documented in the crate's front page: an exactly zero quotient or root is zero, without the
//! subnormal error that "2.5 ULP of 0" would allow; an error in units does not change the sign of a result, which it could do below
//! the normal numbers alone; and `atan2(y, x)` for `y = 0`, which the table leaves out, is bounded by its
//! neighbours where the function is continuous (`x > 0`).

use super::{Flags, Interval};
use crate::width::{Width, exp2i, exponent_of};

/// Division.
pub(crate) const DIVIDE_ULPS: f64 = 2.5;
/// `inverseSqrt`.
pub(crate) const INVERSE_SQRT_ULPS: f64 = 2.0;
/// `log` and `log2` outside of [0.5, 2].
pub(crate) const LOG_ULPS: f64 = 3.0;
/// `unpack4x8unorm` and its relatives.
pub(crate) const UNPACK_ULPS: f64 = 3.0;

/// `exp` and `exp2`: this many units in the last place at `x`.
pub(crate) fn exp_ulps(w: Width, x: f64) -> f64 {
    let base = if w == Width::F16 { 1.0 } else { 3.0 };
    base + 2.0 * x.abs()
}

/// `atan` and `atan2`.
pub(crate) fn atan_ulps(w: Width) -> f64 {
    if w == Width::F16 { 5.0 } else { 4096.0 }
}

/// `sin` and `cos` on [−π, π].
pub(crate) fn sin_error(w: Width) -> f64 {
    exp2i(if w == Width::F16 { -7 } else { -11 })
}

/// `log` and `log2` on [0.5, 2].
pub(crate) fn log_error(w: Width) -> f64 {
    exp2i(if w == Width::F16 { -7 } else { -21 })
}

/// `asin`, where the inherited error is smaller.
pub(crate) fn asin_error(w: Width) -> f64 {
    if w == Width::F16 { 3.91e-3 } else { 6.81e-5 }
}

/// `acos`, where the inherited error is smaller.
pub(crate) fn acos_error(w: Width) -> f64 {
    if w == Width::F16 { 3.91e-3 } else { 6.77e-5 }
}

/// `tanh`, where the inherited error is smaller.
pub(crate) const TANH_ERROR: f64 = 1.0e-5;

/// What our own `f64` evaluation of a function may be off by: the platform's library promises less than one unit, two are taken.
#[inline(always)]
fn slop(x: f64) -> f64 {
    if x == 0.0 || !x.is_finite() {
        0.0
    } else {
        x.abs() * (4.0 * f64::EPSILON) + f64::MIN_POSITIVE * f64::EPSILON
    }
}

/// All values within `ulps` units in the last place of a real number in `[lo, hi]`, rounded outward.
pub(crate) fn within_ulps<const ABSORB: bool>(w: Width, lo: f64, hi: f64, ulps: f64) -> Interval {
    let (below, above) = within_ulps_unrounded(w, lo, hi, ulps);
    outward::<ABSORB>(w, below, above)
}

/// As [`within_ulps`], as real numbers.
#[inline(always)]
pub(crate) fn within_ulps_unrounded(w: Width, lo: f64, hi: f64, ulps: f64) -> (f64, f64) {
    let (below, above) = (lower_by_ulps(w, lo, hi, ulps), -lower_by_ulps(w, -hi, -lo, ulps));
    (below - slop(below), above + slop(above))
}

/// As [`within_ulps`], of one number that is known exactly.
pub(crate) fn within_ulps_of<const ABSORB: bool>(w: Width, x: f64, ulps: f64) -> Interval {
    outward::<ABSORB>(w, lower_by_ulps(w, x, x, ulps), -lower_by_ulps(w, -x, -x, ulps))
}

/// The least of `v − ulps·ulp(v)` over `v` in `[lo, hi]`.
///
/// The unit doubles above every power of two, which itself has the lesser one: for positive numbers the minimum may lie just above
/// the next power, or just above `lo` where that is one.
fn lower_by_ulps(w: Width, lo: f64, hi: f64, ulps: f64) -> f64 {
    if lo == 0.0 {
        return 0.0;
    }
    let at_lo = lo - ulps * w.ulp(lo);
    if lo < 0.0 || !lo.is_finite() {
        return at_lo;
    }
    let own = exp2i(exponent_of(lo));
    let power = if lo == own { own } else { 2.0 * own };
    let least = if power >= hi {
        at_lo
    } else {
        at_lo.min(power - ulps * 2.0 * w.ulp(power))
    };
    least.max(0.0)
}

/// All values within an absolute error of a real number in `[lo, hi]`, rounded outward.
pub(crate) fn within_absolute<const ABSORB: bool>(w: Width, lo: f64, hi: f64, error: f64) -> Interval {
    outward::<ABSORB>(w, lo - error - slop(lo), hi + error + slop(hi))
}

/// Rounds real bounds outward to the format.
#[inline(always)]
pub(crate) fn outward<const ABSORB: bool>(w: Width, lo: f64, hi: f64) -> Interval {
    finish::<ABSORB>(w, w.round_down(lo, 0.0), w.round_up(hi, 0.0))
}

/// The end of every operation: bounds of the format become a result. Subnormals may be flushed; in `Accept`, what may leave the
/// finite numbers is indeterminate.
#[inline(always)]
pub(crate) fn finish<const ABSORB: bool>(w: Width, lo: f64, hi: f64) -> Interval {
    if ABSORB {
        let max = w.max_finite();
        // Written so that NaN fails it.
        if !(lo >= -max && hi <= max) {
            return Interval::unknown(Flags::INDETERMINATE);
        }
    } else if lo.is_nan() || hi.is_nan() {
        return Interval::unknown(Flags::NAN);
    }
    flush(w, Interval::new(lo, hi))
}

/// Adds zero where a subnormal member may be flushed to it.
#[inline(always)]
pub(crate) fn flush(w: Width, mut x: Interval) -> Interval {
    let least = w.min_normal();
    if x.lo > 0.0 && x.lo < least {
        x.lo = 0.0;
    }
    if x.hi < 0.0 && x.hi > -least {
        x.hi = 0.0;
    }
    x
}
