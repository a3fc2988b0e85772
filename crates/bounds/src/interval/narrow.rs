//! What two floats are where a comparison of them is known to hold.
//!
//! The comparison may have flushed subnormal operands, and so may what uses them later: a bound among the subnormal numbers says no more
//! than that the number is not beyond them on the other side, and an interval that begins among them contains zero.

use super::Interval;
use super::rules::flush;
use crate::domain::ops::Compare;
use crate::width::Width;

/// Both operands, narrowed. Operands that may be NaN stay as they are, and so does what would be empty.
pub(crate) fn both(op: Compare, w: Width, a: Interval, b: Interval) -> (Interval, Interval) {
    if !(a.flags.is_none() && b.flags.is_none()) {
        return (a, b);
    }
    match op {
        Compare::Less => (below(w, a, b.hi, true), above(w, b, a.lo, true)),
        Compare::LessEqual => (below(w, a, b.hi, false), above(w, b, a.lo, false)),
        Compare::Greater => (above(w, a, b.lo, true), below(w, b, a.hi, true)),
        Compare::GreaterEqual => (above(w, a, b.lo, false), below(w, b, a.hi, false)),
        Compare::Equal => {
            let within = |x: Interval, y: Interval| below(w, above(w, x, y.lo, false), y.hi, false);
            (within(a, b), within(b, a))
        }
        Compare::NotEqual => (a, b),
    }
}

/// What of an interval is not below a bound, or above it.
fn above(w: Width, x: Interval, bound: f64, strictly: bool) -> Interval {
    let lo = if bound.abs() < w.min_normal() {
        w.next_up(-w.min_normal())
    } else if strictly {
        w.next_up(bound)
    } else {
        bound
    };
    if lo > x.lo && lo <= x.hi {
        flush(w, Interval { lo, ..x })
    } else {
        x
    }
}

fn below(w: Width, x: Interval, bound: f64, strictly: bool) -> Interval {
    let negated = |x: Interval| Interval {
        lo: -x.hi,
        hi: -x.lo,
        ..x
    };
    negated(above(w, negated(x), -bound, strictly))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::domain::Truth;
    use crate::interval::{Flags, integers};

    const W: Width = Width::F32;

    fn left(op: Compare, a: (f64, f64), b: (f64, f64)) -> (f64, f64) {
        let (a, _) = both(op, W, Interval::new(a.0, a.1), Interval::new(b.0, b.1));
        (a.lo, a.hi)
    }

    #[test]
    fn each_comparison_cuts_at_its_bound() {
        let (up, down) = (W.next_up(0.5), W.next_down(0.5));
        assert_eq!(left(Compare::Less, (0.0, 1.0), (0.25, 0.5)), (0.0, down));
        assert_eq!(left(Compare::LessEqual, (0.0, 1.0), (0.25, 0.5)), (0.0, 0.5));
        assert_eq!(left(Compare::Greater, (0.0, 1.0), (0.5, 0.75)), (up, 1.0));
        assert_eq!(left(Compare::GreaterEqual, (0.0, 1.0), (0.5, 0.75)), (0.5, 1.0));
        assert_eq!(left(Compare::Equal, (0.0, 1.0), (0.5, 2.0)), (0.5, 1.0));
        assert_eq!(left(Compare::NotEqual, (0.0, 1.0), (0.5, 0.5)), (0.0, 1.0));
    }

    #[test]
    fn no_bound_is_drawn_among_what_may_be_flushed() {
        let least = W.min_normal();
        // x > 0 may be a subnormal number, which a later operation takes for 0.
        assert_eq!(left(Compare::Greater, (0.0, 1.0), (0.0, 0.0)), (0.0, 1.0));
        // x >= 0 holds for a negative subnormal number that the comparison flushed.
        assert_eq!(
            left(Compare::GreaterEqual, (-1.0, 1.0), (0.0, 0.0)),
            (W.next_up(-least), 1.0)
        );
        assert_eq!(
            left(Compare::GreaterEqual, (0.0, 1.0), (least, least)),
            (least, 1.0)
        );
    }

    #[test]
    fn what_may_be_a_nan_stays_as_it_is() {
        let open = Interval::new(0.0, 1.0).flagged(Flags::INDETERMINATE);
        let (a, b) = both(Compare::Less, W, open, Interval::point(0.5));
        assert_eq!((a, b), (open, Interval::point(0.5)));
    }

    /// The definition: members that satisfy the comparison stay, as they are.
    #[test]
    fn nothing_that_satisfies_the_comparison_is_lost() {
        let ends = [-1.0, -1e-40, 0.0, 1e-40, W.min_normal(), 0.5, 1.0];
        let ops = [
            Compare::Equal,
            Compare::NotEqual,
            Compare::Less,
            Compare::LessEqual,
            Compare::Greater,
            Compare::GreaterEqual,
        ];
        let members: Vec<f64> = ends.iter().map(|x| W.round(*x)).collect();
        for op in ops {
            for (&x, &y) in members.iter().flat_map(|x| members.iter().map(move |y| (x, y))) {
                let (a, b) = both(op, W, Interval::new(-1.0, 1.0), Interval::new(-1.0, 1.0));
                if integers::compare(op, (x, x), (y, y)) == Truth::True {
                    assert!(a.contains(x) && b.contains(y), "{x} {op:?} {y}: {a:?} {b:?}");
                }
                let (a, _) = both(op, W, Interval::new(-1.0, 1.0), Interval::point(y));
                if integers::compare(op, (x, x), (y, y)) == Truth::True {
                    assert!(a.contains(x), "{x} {op:?} {y}: {a:?}");
                }
            }
        }
    }
}
