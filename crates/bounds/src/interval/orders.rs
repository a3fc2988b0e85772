//! Sums and products of several terms in every order that an implementation may choose.
//!
//! Up to four terms the orders are tried one by one. A longer sum is bounded as a whole: whatever the order, each of its n − 1
//! additions errs by at most one unit of the largest partial sum, which is no more than the sum of magnitudes.

use super::rules::finish;
use super::{Interval, arithmetic};
use crate::width::Width;

/// A sum that came out as `written`, in every order.
pub(crate) fn sum<const ABSORB: bool>(w: Width, written: Interval, terms: &[Interval]) -> Interval {
    let any = if terms.len() <= 4 {
        of_four::<ABSORB>(w, terms)
    } else {
        of_many::<ABSORB>(w, terms)
    };
    written.hull(any)
}

/// A product that came out as `written`, in every order. Rounding keeps signs, so the sign of what was written holds in every order.
pub(crate) fn product<const ABSORB: bool>(w: Width, written: Interval, terms: &[Interval]) -> Interval {
    let multiply = |a, b| arithmetic::multiply::<ABSORB>(w, a, b);
    let mut any = match *terms {
        [a, b, c] => three(&multiply, a, b, c),
        [a, b, c, d] => four(&multiply, a, b, c, d),
        _ => written,
    };
    if any.flags.is_none() && written.flags.is_none() {
        if written.lo >= 0.0 {
            any.lo = any.lo.max(0.0);
        }
        if written.hi <= 0.0 {
            any.hi = any.hi.min(0.0);
        }
    }
    written.hull(any)
}

/// The sum of more than four terms.
fn of_many<const ABSORB: bool>(w: Width, terms: &[Interval]) -> Interval {
    let flags = terms.iter().fold(super::Flags::NONE, |f, t| f.union(t.flags));
    let flags = match arithmetic::enter::<ABSORB>(flags) {
        Ok(flags) => flags,
        Err(unknown) => return unknown,
    };
    let n = terms.len() as f64;
    let (lo, hi) = terms
        .iter()
        .fold((0.0, 0.0), |(lo, hi), t| (lo + t.lo, hi + t.hi));
    // Partial sums grow by their own errors, by far less than a quarter for any number of terms that is followed.
    let largest = 1.25 * terms.iter().map(|t| t.lo.abs().max(t.hi.abs())).sum::<f64>();
    let ours = n * f64::EPSILON * largest;
    let error = (n - 1.0) * (w.ulp(largest).max(w.ulp(w.next_up(largest))) + w.min_normal()) + ours;
    finish::<ABSORB>(w, w.round_down(lo - error, -1.0), w.round_up(hi + error, 1.0)).flagged(flags)
}

/// The sum of up to four terms, in every order of additions.
pub(crate) fn of_four<const ABSORB: bool>(w: Width, t: &[Interval]) -> Interval {
    let add = |a, b| arithmetic::add::<ABSORB>(w, a, b);
    match *t {
        [] => Interval::point(0.0),
        [a] => a,
        [a, b] => add(a, b),
        [a, b, c] => three(&add, a, b, c),
        [a, b, c, d, ..] => four(&add, a, b, c, d),
    }
}

fn three(add: &impl Fn(Interval, Interval) -> Interval, a: Interval, b: Interval, c: Interval) -> Interval {
    add(add(a, b), c).hull(add(add(a, c), b)).hull(add(add(b, c), a))
}

fn four(
    add: &impl Fn(Interval, Interval) -> Interval,
    a: Interval,
    b: Interval,
    c: Interval,
    d: Interval,
) -> Interval {
    let chains = add(three(add, b, c, d), a)
        .hull(add(three(add, a, c, d), b))
        .hull(add(three(add, a, b, d), c))
        .hull(add(three(add, a, b, c), d));
    let pairs = add(add(a, b), add(c, d))
        .hull(add(add(a, c), add(b, d)))
        .hull(add(add(a, d), add(b, c)));
    chains.hull(pairs)
}
