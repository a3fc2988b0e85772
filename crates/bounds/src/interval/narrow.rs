//! What two floats are where a comparison of them is known to hold.
//!
//! **Soundness.** A comparison may take a subnormal operand for zero, each operand on its own, and what uses the value later may not; so a
//! bound among the subnormal numbers says no more than that the number is not beyond them on the other side, but for `x < 0`, which no
//! positive number satisfies however it is flushed. Elsewhere `a < b` bounds `a` by the greatest `b`, and leaves that out. A product is compared as it
//! was rounded, but may be used unrounded in a fused operation: its bound gives way by one step. Nothing is widened, and the members
//! that both sides of a condition keep are all members. Wider operands keep more.

use super::Interval;
use super::rules::flush;
use crate::domain::ops::Compare;
use crate::width::Width;

/// Both operands, narrowed. Operands that may be NaN stay as they are, and so does what would be empty.
pub(crate) fn both(
    op: Compare,
    w: Width,
    (a, b): (Interval, Interval),
    products: [bool; 2],
) -> (Interval, Interval) {
    if !(a.flags.is_none() && b.flags.is_none()) {
        return (a, b);
    }
    let a_side = Side {
        w,
        product: products[0],
    };
    let b_side = Side {
        w,
        product: products[1],
    };
    match op {
        Compare::Less => (a_side.below(a, b.hi, true), b_side.above(b, a.lo, true)),
        Compare::LessEqual => (a_side.below(a, b.hi, false), b_side.above(b, a.lo, false)),
        Compare::Greater => (a_side.above(a, b.lo, true), b_side.below(b, a.hi, true)),
        Compare::GreaterEqual => (a_side.above(a, b.lo, false), b_side.below(b, a.hi, false)),
        Compare::Equal => {
            let within =
                |side: &Side, x: Interval, y: Interval| side.below(side.above(x, y.lo, false), y.hi, false);
            (within(&a_side, a, b), within(&b_side, b, a))
        }
        Compare::NotEqual => (a, b),
    }
}

/// One operand: its format, and whether it may be a product.
struct Side {
    w: Width,
    product: bool,
}

impl Side {
    /// What of an interval is not below a bound, or above it.
    fn above(&self, x: Interval, bound: f64, strictly: bool) -> Interval {
        let lo = self.least(bound, strictly);
        if lo > x.lo && lo <= x.hi {
            // What may be flushed to zero was zero before, or will be where it is used: the cut keeps within what there was.
            let cut = flush(self.w, Interval { lo, ..x });
            Interval {
                lo: cut.lo.max(x.lo),
                hi: cut.hi.min(x.hi),
                ..cut
            }
        } else {
            x
        }
    }

    fn below(&self, x: Interval, bound: f64, strictly: bool) -> Interval {
        let negated = |x: Interval| Interval {
            lo: -x.hi,
            hi: -x.lo,
            ..x
        };
        negated(self.above(negated(x), -bound, strictly))
    }

    /// The least number that may have compared above a bound.
    fn least(&self, bound: f64, strictly: bool) -> f64 {
        let w = self.w;
        let lo = if bound.abs() >= w.min_normal() {
            if strictly { w.next_up(bound) } else { bound }
        } else if strictly && bound >= 0.0 {
            0.0
        } else {
            w.next_up(-w.min_normal())
        };
        if self.product { w.next_down(lo) } else { lo }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::domain::Truth;
    use crate::interval::{Flags, integers};
    use proptest::prelude::*;

    const W: Width = Width::F32;
    const LEAST: f64 = f32::MIN_POSITIVE as f64;

    const ALL: [Compare; 6] = [
        Compare::Equal,
        Compare::NotEqual,
        Compare::Less,
        Compare::LessEqual,
        Compare::Greater,
        Compare::GreaterEqual,
    ];

    fn narrowed(op: Compare, a: Interval, b: Interval) -> (Interval, Interval) {
        both(op, W, (a, b), [false; 2])
    }

    fn left(op: Compare, a: (f64, f64), b: (f64, f64)) -> (f64, f64) {
        let (a, _) = narrowed(op, Interval::new(a.0, a.1), Interval::new(b.0, b.1));
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
        // x > 0 may be a subnormal number, which a later operation takes for 0.
        assert_eq!(left(Compare::Greater, (-1.0, 1.0), (0.0, 0.0)), (0.0, 1.0));
        // x >= 0 holds for a negative subnormal number that the comparison flushed.
        assert_eq!(
            left(Compare::GreaterEqual, (-1.0, 1.0), (0.0, 0.0)),
            (W.next_up(-LEAST), 1.0)
        );
        assert_eq!(
            left(Compare::GreaterEqual, (0.0, 1.0), (LEAST, LEAST)),
            (LEAST, 1.0)
        );
    }

    #[test]
    fn a_cut_among_subnormals_does_not_reach_back_to_zero() {
        let most = W.next_down(LEAST);
        let (_, b) = narrowed(
            Compare::Greater,
            Interval::new(0.0, LEAST),
            Interval::new(most, 0.5),
        );
        assert_eq!((b.lo, b.hi), (most, most));
    }

    #[test]
    fn what_may_be_a_nan_stays_as_it_is() {
        let open = Interval::new(0.0, 1.0).flagged(Flags::INDETERMINATE);
        let (a, b) = narrowed(Compare::Less, open, Interval::point(0.5));
        assert_eq!((a, b), (open, Interval::point(0.5)));
    }

    #[test]
    fn a_product_gives_way_by_one_step() {
        let operands = (Interval::new(0.0, 1.0), Interval::point(0.5));
        let (a, _) = both(Compare::LessEqual, W, operands, [true, false]);
        assert_eq!(a.hi, W.next_up(0.5));
    }

    /// Numbers of every kind, among them subnormal ones, neighbours of the least normal number, and zero.
    fn number() -> impl Strategy<Value = f64> {
        prop_oneof![
            Just(0.0f32),
            Just(f32::MIN_POSITIVE),
            Just(-f32::MIN_POSITIVE),
            Just(f32::MIN_POSITIVE.next_down()),
            Just(1.0f32),
            Just(1.0f32.next_up()),
            -2.0f32..2.0,
            -1e-38f32..1e-38,
        ]
        .prop_map(f64::from)
    }

    /// As every operation leaves it: with zero where a member may be flushed to it.
    fn interval() -> impl Strategy<Value = Interval> {
        (number(), number()).prop_map(|(a, b)| flush(W, Interval::new(a.min(b), a.max(b))))
    }

    fn member(x: Interval, at: f64) -> f64 {
        W.round(x.lo + (x.hi - x.lo) * at).clamp(x.lo, x.hi)
    }

    /// Whether a machine may see the comparison hold: each subnormal operand as it is, or as zero.
    fn may_hold(op: Compare, x: f64, y: f64) -> bool {
        let seen = |x: f64| if W.is_subnormal(x) { vec![x, 0.0] } else { vec![x] };
        let holds = |x: f64, y: f64| integers::compare(op, (x, x), (y, y)) == Truth::True;
        seen(x).iter().any(|&x| seen(y).iter().any(|&y| holds(x, y)))
    }

    proptest! {
        #[test]
        fn no_machine_that_takes_a_side_loses_its_operand(
            op in prop::sample::select(&ALL[..]), a in interval(), b in interval(), p in 0.0..=1.0f64, q in 0.0..=1.0f64,
        ) {
            let (x, y) = (member(a, p), member(b, q));
            let (left, right) = narrowed(op, a, b);
            prop_assert!(!may_hold(op, x, y) || left.contains(x) && right.contains(y), "{x} {op:?} {y}: {left:?} {right:?}");
        }

        #[test]
        fn wider_operands_keep_more(
            op in prop::sample::select(&ALL[..]), a in interval(), b in interval(), c in interval(), d in interval(),
        ) {
            prop_assume!(integers::compare(op, (a.lo, a.hi), (b.lo, b.hi)) == Truth::Maybe);
            let (less, more) = (narrowed(op, a, b), narrowed(op, a.hull(c), b.hull(d)));
            for (less, more) in [(less.0, more.0), (less.1, more.1)] {
                prop_assert!(more.lo <= less.lo && less.hi <= more.hi, "{less:?} is not within {more:?}");
            }
        }
    }

    #[test]
    fn a_bound_that_ignores_flushing_loses_a_member() {
        // The control of the first property: −1e−40 may be seen as zero, and a bound at zero would drop it.
        assert!(may_hold(Compare::GreaterEqual, -1e-40, 0.0));
        assert!(
            narrowed(
                Compare::GreaterEqual,
                Interval::new(-1.0, 1.0),
                Interval::point(0.0)
            )
            .0
            .contains(-1e-40)
        );
        assert!(!Interval::new(0.0, 1.0).contains(-1e-40));
    }
}
