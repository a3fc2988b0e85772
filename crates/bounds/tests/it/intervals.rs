//! The rules of intervals: what comes out of whole intervals, end by end, and that more in is never less out.
//!
//! A row of [`ENDS`] is a rule and its own negative control: ends that lie further in lose results that a machine may return, ends
//! further out are wider than the rule. Containment of points is a property in `accept.rs`.

use crate::accept::{EXPRESSIONS, all_expressions, hard_float};
use crate::common::{probe_source, program};
use bossage_bounds::{
    Accept, Bindings, Domain, Flags, Interval, Limits, Program, Range, Scalar, Width, run_probe_with,
};
use proptest::prelude::*;

/// One output of a probe over intervals.
fn over<D: Domain<Float = Interval>>(
    program: &Program,
    inputs: &[Interval],
    outputs: usize,
) -> Vec<Interval> {
    let scalars = inputs.iter().map(|&x| Scalar::Float(x)).collect();
    let bindings = Bindings::<D>::new().scalars(0, 0, scalars);
    run_probe_with(program, bindings, outputs, 1, &Limits::default())
        .unwrap()
        .0
}

fn of<D: Domain<Float = Interval>>(expression: &str, x: (f64, f64), y: (f64, f64)) -> Interval {
    let body = format!("let x = a[0]; let y = a[1]; o[i] = {expression};");
    let inputs = [Interval::new(x.0, x.1), Interval::new(y.0, y.1)];
    over::<D>(&program(&probe_source(&body)), &inputs, 1)[0]
}

/// The ends of an interval.
type Ends = (f64, f64);

const NONE: Ends = (0.0, 0.0);
/// 2⁻¹¹, the error of a sine.
const SINE: f64 = 1.0 / 2048.0;

/// Expression, intervals of `x` and `y`, the ends of the result. Ends are numbers of the format, so nothing is rounded but where a
/// rule allows an error.
#[rustfmt::skip]
const ENDS: &[(&str, Ends, Ends, Ends)] = &[
    ("x + y", (1.0, 2.0), (3.0, 4.0), (4.0, 6.0)),
    ("x - y", (1.0, 2.0), (3.0, 4.0), (-3.0, -1.0)),
    ("-x", (-1.0, 3.0), NONE, (-3.0, 1.0)),
    ("x * y", (2.0, 3.0), (4.0, 5.0), (8.0, 15.0)),
    ("x * y", (-2.0, 3.0), (4.0, 5.0), (-10.0, 15.0)),
    ("x * y", (-2.0, 3.0), (-4.0, 5.0), (-12.0, 15.0)),
    ("x * y", (-3.0, -2.0), (-5.0, -4.0), (8.0, 15.0)),
    // A square has no negative values, although its factors have.
    ("x * x", (-3.0, 2.0), NONE, (0.0, 9.0)),
    ("abs(x)", (-3.0, 2.0), NONE, (0.0, 3.0)),
    ("abs(x)", (-3.0, -2.0), NONE, (2.0, 3.0)),
    ("min(x, y)", (1.0, 5.0), (2.0, 3.0), (1.0, 3.0)),
    ("max(x, y)", (1.0, 5.0), (2.0, 3.0), (2.0, 5.0)),
    ("clamp(x, 0.0, y)", (-1.0, 9.0), (2.0, 3.0), (0.0, 3.0)),
    ("saturate(x)", (-1.0, 0.5), NONE, (0.0, 0.5)),
    ("floor(x)", (0.5, 2.5), NONE, (0.0, 2.0)),
    ("ceil(x)", (0.5, 2.5), NONE, (1.0, 3.0)),
    ("round(x)", (0.5, 2.5), NONE, (0.0, 2.0)),
    ("trunc(x)", (-1.5, 2.5), NONE, (-1.0, 2.0)),
    ("fract(x)", (1.25, 1.75), NONE, (0.25, 0.75)),
    ("fract(x)", (1.25, 2.0), NONE, (0.0, 1.0)),
    ("sign(x)", (-1.0, 4.0), NONE, (-1.0, 1.0)),
    ("step(0.5, x)", (0.0, 1.0), NONE, (0.0, 1.0)),
    ("modf(x).fract", (1.25, 1.75), NONE, (0.25, 0.75)),
    ("ldexp(x, 2)", (-1.0, 3.0), NONE, (-4.0, 12.0)),
    ("select(x, y, x > y)", (1.0, 2.0), (3.0, 4.0), (1.0, 2.0)),
    ("select(x, y, x < 1.5)", (1.0, 2.0), (3.0, 4.0), (1.0, 4.0)),
    ("f32(i32(x))", (-1.5, 2.5), NONE, (-1.0, 2.0)),
    ("f32(u32(x))", (-1.5, 2.5), NONE, (0.0, 2.0)),
    ("sqrt(x)", (0.0, 0.0), NONE, (0.0, 0.0)),
    // Across a peak, a trough, both; the ends of the sine's own error.
    ("sin(x)", (0.0, 3.0), NONE, (-SINE, 1.0 + SINE)),
    ("sin(x)", (-3.0, 0.0), NONE, (-1.0 - SINE, SINE)),
    ("cos(x)", (-1.0, 0.5), NONE, (0.540_302_305_868 - SINE, 1.0 + SINE)),
    ("fma(x, y, 1.0)", (1.0, 2.0), (3.0, 4.0), (4.0, 9.0)),
    ("dot(vec2f(x, y), vec2f(1.0, 2.0))", (1.0, 2.0), (3.0, 4.0), (7.0, 10.0)),
    ("quantizeToF16(x)", (1.0, 2049.0), NONE, (1.0, 2050.0)),
];

fn is_near(x: f64, wanted: f64) -> bool {
    // Rounded outward where the end is no number of the format.
    (x - wanted).abs()
        <= 2.0 * Width::F32.ulp(wanted.abs().max(0.25)) * f64::from(u8::from(wanted.fract() != 0.0))
}

#[test]
fn intervals_end_where_their_rules_say() {
    for (expression, x, y, (lo, hi)) in ENDS {
        for got in [of::<Accept>(expression, *x, *y), of::<Range>(expression, *x, *y)] {
            let right = is_near(got.lo, *lo) && is_near(got.hi, *hi) && got.flags.is_none();
            assert!(right, "{expression} of {x:?}, {y:?}: {got:?}, not [{lo}, {hi}]");
        }
    }
}

/// Control: an end that is off by a step, or by a unit in either direction, is not near.
#[test]
fn an_end_that_is_off_is_seen() {
    for wanted in [0.0, 1.0, -12.0, 0.25, 1.0 + SINE] {
        assert!(is_near(wanted, wanted));
        for off in [wanted + 1.0, wanted - 1.0, wanted + 1e-6, wanted - 1e-6] {
            assert!(!is_near(off, wanted), "{off} for {wanted}");
        }
    }
}

/// A quotient of intervals is that of their ends, 2.5 units wider, the greater ones above 1/8; a divisor that may be zero leaves it open.
#[test]
fn quotients_of_intervals() {
    let w = Width::F32;
    for x in [
        of::<Accept>("x / y", (1.0, 3.0), (4.0, 8.0)),
        of::<Range>("x / y", (1.0, 3.0), (4.0, 8.0)),
    ] {
        let (lo, hi) = (0.125 - 2.5 * 2.0 * w.ulp(0.125), 0.75 + 2.5 * w.ulp(0.75));
        // Rounded outward, and at most one step more for our own division.
        assert!(x.lo <= lo && x.lo >= w.next_down(lo), "{x:?}");
        assert!(x.hi >= hi && x.hi <= w.next_up(w.round_up(hi, 0.0)), "{x:?}");
    }
    let across = |y| {
        (
            of::<Accept>("x / y", (1.0, 3.0), y),
            of::<Range>("x / y", (1.0, 3.0), y),
        )
    };
    let (accept, range) = across((-1.0, 1.0));
    assert!(accept.is_indeterminate() && range.lo == f64::NEG_INFINITY && range.hi == f64::INFINITY);
    let (accept, range) = across((1e-30, 1.0));
    assert!(
        accept.flags.is_none() && range.flags.is_none(),
        "{accept:?} {range:?}"
    );
}

/// The unit doubles just above a power of two: an interval from one on takes the greater unit, the power alone the lesser.
#[test]
fn units_double_just_above_a_power_of_two() {
    let w = Width::F32;
    let alone = of::<Accept>("exp2(x)", (1.0, 1.0), NONE);
    let above = of::<Accept>("exp2(x)", (1.0, 1.000_001), NONE);
    // One step more for our own evaluation of the exponential.
    assert!(
        (2.0 - 6.0 * w.ulp(2.0)..=2.0 - 5.0 * w.ulp(2.0)).contains(&alone.lo),
        "{alone:?}"
    );
    assert!(
        above.lo <= 2.0 - 5.0 * 2.0 * w.ulp(2.0) && above.lo > 2.0 - 7.0 * 2.0 * w.ulp(2.0),
        "{above:?}"
    );
}

/// A choice that an interval leaves open marks its result; one that it decides does not.
#[test]
fn steps_across_which_an_interval_lies_are_marked() {
    for (expression, open, decided) in [
        ("floor(x)", (0.5, 1.5), (0.5, 0.75)),
        ("ceil(x)", (0.5, 1.5), (0.5, 0.75)),
        ("round(x)", (0.25, 0.75), (0.75, 1.25)),
        ("trunc(x)", (0.5, 1.5), (-0.5, 0.5)),
        ("fract(x)", (0.5, 1.5), (0.5, 0.75)),
        ("sign(x)", (-1.0, 1.0), (0.5, 1.5)),
        ("step(1.0, x)", (0.5, 1.5), (1.0, 1.5)),
        ("select(2.0, 3.0, x < 1.0)", (0.5, 1.5), (1.0, 1.5)),
        ("f32(i32(x))", (0.5, 1.5), (-0.5, 0.5)),
    ] {
        assert!(
            of::<Accept>(expression, open, NONE).is_forked(),
            "{expression} of {open:?}"
        );
        assert!(
            !of::<Accept>(expression, decided, NONE).is_forked(),
            "{expression} of {decided:?}"
        );
    }
}

/// Beyond the finite numbers `Accept` gives up and `Range` goes on and says what may happen.
#[test]
fn overflow_and_nan_are_told_apart() {
    let big = (1e38, 3e38);
    assert!(of::<Accept>("x + y", big, big).is_indeterminate());
    let range = of::<Range>("x + y", big, big);
    assert!(
        range.hi == f64::INFINITY && range.lo < f64::INFINITY && !range.flags.has(Flags::NAN),
        "{range:?}"
    );
    let range = of::<Range>("x - y", (0.0, f64::INFINITY), (0.0, f64::INFINITY));
    assert!(range.flags.has(Flags::NAN), "{range:?}");
    let range = of::<Range>("x * y", (0.0, 1.0), (0.0, f64::INFINITY));
    assert!(range.flags.has(Flags::NAN), "{range:?}");
    let range = of::<Range>("sqrt(x)", (-1.0, 4.0), NONE);
    assert!(range.flags.has(Flags::NAN) && range.contains(2.0), "{range:?}");
    // Control: with numbers that stay finite nothing is flagged.
    assert!(of::<Range>("x - y", (0.0, 1.0), (0.0, 1.0)).flags.is_none());
}

/// Subnormal results may be flushed: zero is among them, but not for results that are larger.
#[test]
fn subnormal_ends_reach_zero() {
    let least = f64::from(f32::MIN_POSITIVE);
    assert_eq!(of::<Accept>("x * 0.5", (least, least), NONE).lo, 0.0);
    assert_eq!(of::<Accept>("x * 0.5", (-least, -least), NONE).hi, 0.0);
    assert_eq!(
        of::<Accept>("x * 0.5", (2.0 * least, 4.0 * least), NONE).lo,
        least
    );
}

/// One interval within another: endpoints two times in three, anything between otherwise.
fn nested() -> impl Strategy<Value = (Interval, Interval)> {
    (hard_float(), hard_float(), 0.0f64..=1.0, 0.0f64..=1.0, 0..3u8).prop_map(|(a, b, s, t, kind)| {
        // One zero only: the bits of the two differ, and with them what `bitcast` makes of an interval.
        let (lo, hi) = (f64::from(a.min(b)) + 0.0, f64::from(a.max(b)) + 0.0);
        let at = |t: f64| f64::from((lo + (hi - lo) * t) as f32).clamp(lo, hi);
        let (p, q) = match kind {
            0 => (lo, at(t)),
            1 => (at(s), hi),
            _ => (at(s.min(t)), at(s.max(t))),
        };
        (Interval::new(lo, hi), Interval::new(p, q))
    })
}

/// Whether everything that the inner interval admits is admitted by the outer one.
fn includes(outer: &Interval, inner: &Interval) -> bool {
    let open = |x: &Interval| x.is_indeterminate() || x.is_undecided();
    open(outer)
        || (!open(inner)
            && outer.lo <= inner.lo
            && inner.hi <= outer.hi
            && (!inner.flags.has(Flags::NAN) || outer.flags.has(Flags::NAN)))
}

proptest! {
    #![proptest_config(crate::common::cases(128))]

    /// Monotonicity: a machine that knows less about its inputs never knows more about its results, for every expression.
    #[test]
    fn more_in_is_never_less_out((wide_x, x) in nested(), (wide_y, y) in nested()) {
        let program = program(&all_expressions());
        let n = EXPRESSIONS.len();
        let accept = (over::<Accept>(&program, &[wide_x, wide_y], n), over::<Accept>(&program, &[x, y], n));
        let range = (over::<Range>(&program, &[wide_x, wide_y], n), over::<Range>(&program, &[x, y], n));
        for (k, expression) in EXPRESSIONS.iter().enumerate() {
            let of = format!("{expression} of {wide_x:?}, {wide_y:?} and of {x:?}, {y:?}");
            prop_assert!(includes(&accept.0[k], &accept.1[k]), "{of}: {:?}, {:?}", accept.0[k], accept.1[k]);
            prop_assert!(includes(&range.0[k], &range.1[k]), "range: {of}: {:?}, {:?}", range.0[k], range.1[k]);
        }
    }

    /// A hull contains both, and is no wider than it must be.
    #[test]
    fn a_hull_is_the_least_that_contains_both((a, _) in nested(), (b, _) in nested()) {
        let hull = a.hull(b);
        prop_assert!(includes(&hull, &a) && includes(&hull, &b));
        prop_assert!(hull.lo == a.lo || hull.lo == b.lo);
        prop_assert!(hull.hi == a.hi || hull.hi == b.hi);
    }
}

/// Control of the property: an interval that lost an end, or its flag, does not include what it was.
#[test]
fn an_interval_that_lost_something_is_seen() {
    let whole = Interval::new(-1.0, 2.0);
    assert!(includes(&whole, &whole));
    for less in [Interval::new(-0.5, 2.0), Interval::new(-1.0, 1.5)] {
        assert!(!includes(&less, &whole) && includes(&whole, &less));
    }
    let open = Interval::unknown(Flags::INDETERMINATE);
    assert!(includes(&open, &whole) && !includes(&whole, &open));
    let mut nan = whole;
    nan.flags = Flags::NAN;
    assert!(includes(&nan, &whole) && !includes(&whole, &nan));
}
