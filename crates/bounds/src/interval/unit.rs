//! A component of a vector over the vector's length, `s / sqrt(dot(s, s))`, with the errors it shares with that length.
//!
//! Evaluated operation by operation, an error of `s` enters twice, as if numerator and length were independent. They are not: the
//! quotient `x / √(x² + r)` grows with `x` and falls with `r`, so its bounds are taken at the ends of `x` and of `r`, the squares of the
//! other components. Where every component was divided by one and the same value before (`v / max(|v|)`, which keeps squares in range),
//! that value's error cancels altogether, and the ends are those of the undivided components.
//!
//! **Soundness.** What a machine computes is, step by step, with every δ and ε bounded by the accuracy table at the magnitude it occurs at:
//!
//! - `sⱼ = (xⱼ / m)(1 + δⱼ)`, or `sⱼ = xⱼ` where nothing was divided; `m` has one value and one sign;
//! - `d = (Σ sⱼ²)(1 + ε)`: each square and each partial sum, of whichever order, errs by less than one unit; all are positive;
//! - `√d` inherited from `1 / inverseSqrt(d)`, and the quotient by it: 2, 2.5 and 2.5 ULP.
//!
//! So `s / √d = ±t · (1 + …)` with `t = y / √(y² + Σ yⱼ²)`, `yⱼ = xⱼ(1 + δⱼ)`, and `t` is monotone as said. A product that is squared may be
//! reassociated, (a·b)·(a·b) = a·(b·(a·b)), so that its two uses differ by some roundings: such components get room for them. What
//! underflows changes `d` by less than one part in 2⁶⁰ where `d ≥ 2⁻⁶⁰`, and the quotient by less than 2⁻⁹⁰; below that, in other formats than
//! `f32`, and where anything is open, the bounds stay as they were.
//!
//! The result is the intersection with the bounds evaluated as written: both contain what a machine returns.

use super::Interval;
use super::rules::{DIVIDE_ULPS, INVERSE_SQRT_ULPS, within_ulps};
use crate::domain::{Component, OverLength};
use crate::width::{Width, exp2i, exponent_of};

/// The least sum of squares that underflow cannot disturb.
const LEAST_SUM: f64 = 1.0 / (1u64 << 60) as f64;
/// Below this magnitude a quotient's error is not relative any more.
const TINY: f64 = 7.888_609_052_210_118e-31;
/// What underflow may add to a quotient by a length of at least 2⁻³⁰.
const UNDERFLOW: f64 = 8.077_935_669_463_161e-28;
/// Room for `f64` arithmetic of our own: some tens of operations at 2⁻⁵³.
const OURS: f64 = 1e-14;
/// Roundings by which two uses of one product may differ.
const REASSOCIATED: f64 = 8.0;

/// The accuracy entries that the derivation uses, so that a test can take one away.
#[derive(Clone, Copy)]
struct Entries {
    divide: f64,
    inverse_sqrt: f64,
    round: f64,
}

const TABLE: Entries = Entries {
    divide: DIVIDE_ULPS,
    inverse_sqrt: INVERSE_SQRT_ULPS,
    round: 1.0,
};

/// The bounds of a quotient that was evaluated as `written`.
pub(crate) fn over_length(w: Width, written: Interval, vector: &OverLength<Interval>) -> Interval {
    match correlated(w, vector, TABLE) {
        Some(found) if written.flags.is_none() => {
            let (lo, hi) = (written.lo.max(found.lo), written.hi.min(found.hi));
            debug_assert!(
                lo <= hi,
                "two sound bounds without a common member: {written:?}, {found:?}"
            );
            if lo <= hi {
                Interval { lo, hi, ..written }
            } else {
                written
            }
        }
        Some(_) | None => written,
    }
}

/// The bounds of the derivation above, where it holds.
fn correlated(w: Width, vector: &OverLength<Interval>, entries: Entries) -> Option<Interval> {
    let parts = vector.components;
    let decided = |x: &Interval| x.flags.is_none();
    let known = parts
        .iter()
        .all(|part| decided(&part.scaled) && decided(&part.whole));
    if w != Width::F32 || !known || !decided(&vector.sum) || vector.sum.lo < LEAST_SUM {
        return None;
    }
    let falls = match vector.divisor {
        Some(m) if !decided(&m) || m.contains_zero() => return None,
        Some(m) => m.hi < 0.0,
        None => false,
    };
    let divided = vector.divisor.is_some();
    let (mut least, mut most) = (0.0, 0.0);
    for (_, part) in parts.iter().enumerate().filter(|(k, _)| *k != vector.at) {
        let (low, high) = square(part, room(w, part, divided, entries));
        (least, most) = (least + low, most + high);
    }
    let own = parts.get(vector.at)?;
    let y = stretched(own.whole, room(w, own, divided, entries));
    let t = Interval::new(
        ratio(y.lo, if y.lo < 0.0 { least } else { most }),
        ratio(y.hi, if y.hi < 0.0 { most } else { least }),
    );
    let t = if falls { super::arithmetic::negate(t) } else { t };
    let (below, above) = factors(w, vector, entries);
    let underflow = if smallest(own.scaled) < TINY {
        UNDERFLOW
    } else {
        0.0
    };
    let (at_lo, at_hi) = (
        if t.lo < 0.0 { above } else { below },
        if t.hi < 0.0 { below } else { above },
    );
    let (lo, hi) = (t.lo * at_lo - underflow, t.hi * at_hi + underflow);
    Some(within_ulps::<true>(w, lo, hi, entries.divide))
}

/// By how much a component may differ from the number it stands for, relatively.
fn room(w: Width, part: &Component<Interval>, divided: bool, entries: Entries) -> f64 {
    let quotient = if divided {
        relative(
            w,
            smallest(part.scaled).max(TINY),
            largest(part.scaled),
            entries.divide,
        )
    } else {
        0.0
    };
    let product = if part.product { REASSOCIATED * unit(w) } else { 0.0 };
    quotient + product + OURS
}

/// The bounds of a component's square.
fn square(part: &Component<Interval>, room: f64) -> (f64, f64) {
    let (low, high) = (smallest(part.whole), largest(part.whole));
    // What may underflow, itself or squared, may be nothing.
    let low = if smallest(part.scaled) < TINY.sqrt() {
        0.0
    } else {
        low * (1.0 - room)
    };
    let high = high * (1.0 + room);
    (low * low, high * high)
}

/// An interval with relative room at both ends.
fn stretched(x: Interval, room: f64) -> Interval {
    Interval::new(x.lo - x.lo.abs() * room, x.hi + x.hi.abs() * room)
}

fn ratio(x: f64, rest: f64) -> f64 {
    if x == 0.0 { 0.0 } else { x / (x * x + rest).sqrt() }
}

/// The least and the greatest factor by which the errors of the length change the quotient.
fn factors(w: Width, vector: &OverLength<Interval>, entries: Entries) -> (f64, f64) {
    let d = vector.sum;
    let steps: f64 = vector
        .components
        .iter()
        .map(|part| step(w, largest(part.scaled).powi(2)))
        .sum();
    let sums = (vector.components.len() as f64 - 1.0) * step(w, d.hi);
    let sum = entries.round * (steps + sums) / d.lo + LEAST_SUM;
    let product = if vector.components.iter().any(|part| part.product) {
        REASSOCIATED * unit(w)
    } else {
        0.0
    };
    let root = (d.lo.sqrt() * (1.0 - 1e-6), d.hi.sqrt() * (1.0 + 1e-6));
    let inverse = relative(w, 1.0 / root.1, 1.0 / root.0, entries.inverse_sqrt);
    let divided = relative(w, root.0, root.1, entries.divide);
    let other = product + OURS;
    (
        (1.0 - inverse) / ((1.0 + divided) * (1.0 + sum).sqrt()) * (1.0 - other),
        (1.0 + inverse) / ((1.0 - divided) * (1.0 - sum).sqrt()) * (1.0 + other),
    )
}

/// The largest relative error of a result of a magnitude in `[lo, hi]` that errs by so many ULPs.
fn relative(w: Width, lo: f64, hi: f64, ulps: f64) -> f64 {
    let next_power = exp2i(exponent_of(lo) + 1);
    let share = if next_power <= hi {
        unit(w)
    } else {
        step(w, lo) / lo
    };
    ulps * share
}

/// The distance of neighbours above `x`.
fn step(w: Width, x: f64) -> f64 {
    exp2i(exponent_of(x.max(w.min_normal())) - w.precision() + 1)
}

/// The distance of neighbours above 1.
fn unit(w: Width) -> f64 {
    exp2i(1 - w.precision())
}

fn smallest(x: Interval) -> f64 {
    super::arithmetic::magnitude(x).lo
}

fn largest(x: Interval) -> f64 {
    super::arithmetic::magnitude(x).hi
}

#[cfg(test)]
mod tests;
