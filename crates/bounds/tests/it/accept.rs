//! The rules of the acceptance domain: soundness over many inputs, a control for every rule, and how wide the results are.

use crate::common::probe;
use bossage_bounds::{Accept, Bindings, F32, Interval, Limits, Range, Scalar, Width, run_probe_with};
use proptest::prelude::*;

/// Endpoints two times in three, random bits otherwise.
pub(crate) fn hard_float() -> impl Strategy<Value = f32> {
    let edges = vec![
        0.0,
        -0.0,
        1.0,
        -1.0,
        0.5,
        2.0,
        f32::MIN_POSITIVE,
        -f32::MIN_POSITIVE,
        f32::MIN_POSITIVE / 4.0,
        f32::MAX,
        -f32::MAX,
        1e-20,
        1.0 - f32::EPSILON / 2.0,
        1.0 + f32::EPSILON,
        3.0,
        0.1,
        1e20,
        16_777_216.0,
        -0.75,
        126.9,
    ];
    prop_oneof![2 => prop::sample::select(edges), 1 => any::<f32>().prop_filter("finite", |x| x.is_finite())]
}

/// Expressions in `x` and `y` with every rule of the table.
pub(crate) const EXPRESSIONS: &[&str] = &[
    "x + y",
    "x - y",
    "x * y",
    "x / y",
    "x % y",
    "x * x",
    "sqrt(x)",
    "inverseSqrt(x)",
    "floor(x)",
    "ceil(x)",
    "round(x)",
    "trunc(x)",
    "fract(x)",
    "abs(x)",
    "sign(x)",
    "saturate(x)",
    "min(x, y)",
    "max(x, y)",
    "clamp(x, y, 1.0)",
    "mix(x, y, 0.3)",
    "step(x, y)",
    "smoothstep(x, y, 0.5)",
    "fma(x, y, 0.7)",
    "exp(x)",
    "exp2(x)",
    "log(x)",
    "log2(x)",
    "pow(x, y)",
    "sin(x)",
    "cos(x)",
    "tan(x)",
    "asin(x)",
    "acos(x)",
    "atan(x)",
    "atan2(x, y)",
    "sinh(x)",
    "cosh(x)",
    "tanh(x)",
    "asinh(x)",
    "acosh(x)",
    "atanh(x)",
    "radians(x)",
    "degrees(x)",
    "quantizeToF16(x)",
    "dot(vec3f(x, y, 1.0), vec3f(y, x, 0.3))",
    "length(vec3f(x, y, 0.5))",
    "normalize(vec3f(x, y, 0.5)).x",
    "select(x, y, x < y)",
    "f32(i32(x))",
    "f32(u32(y))",
    "ldexp(x, 3)",
    "modf(x).fract",
    "frexp(x).fract",
    "unpack4x8unorm(pack4x8unorm(vec4f(x, y, x, y))).x",
    "unpack2x16float(pack2x16float(vec2f(x, y))).y",
    "bitcast<f32>(bitcast<u32>(x))",
    "f32(f16(x) * f16(y))",
    "faceForward(x * vec2f(1.0, 0.0), vec2f(y, 1.0), vec2f(x, 1.0)).x",
    "distance(vec2f(x, y), vec2f(0.5, 0.25))",
    "reflect(vec2f(x, y), vec2f(y, x)).x",
    "cross(vec3f(x, y, 1.0), vec3f(y, 1.0, x)).z",
];

/// All of them in one shader.
pub(crate) fn all_expressions() -> String {
    let n = EXPRESSIONS.len();
    let lines: String = EXPRESSIONS
        .iter()
        .enumerate()
        .map(|(k, e)| format!("o[{n}u * i + {k}u] = {e};\n"))
        .collect();
    format!(
        "enable f16;
         @group(0) @binding(0) var<storage, read> a: array<f32>;
         @group(0) @binding(1) var<storage, read_write> o: array<f32>;
         @compute @workgroup_size(64) fn main(@builtin(global_invocation_id) id: vec3u) {{
             let i = id.x;
             if (i >= arrayLength(&a) / 2u) {{ return; }}
             let x = a[2u * i]; let y = a[2u * i + 1u];
             {lines}
         }}"
    )
}

proptest! {
    #![proptest_config(crate::common::cases(64))]

    /// What a perfect machine returns lies in the acceptance interval, for every rule, on hard inputs.
    #[test]
    fn machine_results_are_accepted(values in prop::collection::vec(hard_float(), 256)) {
        let program = crate::common::program(&all_expressions());
        let n = EXPRESSIONS.len();
        let run = |values: &[f32]| bossage_bounds::run_probe::<F32>(&program, values, 128 * n, 128, &Limits::default()).unwrap().0;
        let accept = bossage_bounds::run_probe::<Accept>(&program, &values, 128 * n, 128, &Limits::default()).unwrap().0;
        let range = bossage_bounds::run_probe::<Range>(&program, &values, 128 * n, 128, &Limits::default()).unwrap().0;
        for (k, ((x, a), r)) in run(&values).into_iter().zip(accept).zip(range).enumerate() {
            let pair = &values[k / n * 2..][..2];
            prop_assert!(a.contains(x) || x == 0.0 && a.contains(-0.0), "{} of {pair:?}: {x} not in {a:?}", EXPRESSIONS[k % n]);
            prop_assert!(r.contains(x), "range: {} of {pair:?}: {x} not in {r:?}", EXPRESSIONS[k % n]);
        }
    }

    /// Interval inputs contain the results of every point inside.
    #[test]
    fn intervals_contain_their_points(lo in hard_float(), hi in hard_float(), y in hard_float(), t in 0.0f64..=1.0) {
        let (lo, hi) = (lo.min(hi), lo.max(hi));
        let program = crate::common::program(&all_expressions());
        let n = EXPRESSIONS.len();
        let input = vec![Scalar::Float(Interval::new(f64::from(lo), f64::from(hi))), Scalar::Float(Interval::point(f64::from(y)))];
        for x in [lo, hi, (f64::from(lo) * (1.0 - t) + f64::from(hi) * t) as f32] {
            let points = bossage_bounds::run_probe::<F32>(&program, &[x, y], n, 1, &Limits::default()).unwrap().0;
            let bindings = Bindings::<Range>::new().scalars(0, 0, input.iter().map(|s| s.float().map_or(Scalar::Int(0, 0), Scalar::Float)).collect());
            let wide = run_probe_with(&program, bindings, n, 1, &Limits::default()).unwrap().0;
            let bindings = Bindings::<Accept>::new().scalars(0, 0, input.clone());
            let accepted = run_probe_with(&program, bindings, n, 1, &Limits::default()).unwrap().0;
            for k in 0..n {
                prop_assert!(wide[k].contains(points[k]), "{} of [{lo}, {hi}] at {x}, {y}: {} not in {:?}", EXPRESSIONS[k], points[k], wide[k]);
                prop_assert!(accepted[k].contains(points[k]), "{} of [{lo}, {hi}] at {x}, {y}: {} not in {:?}", EXPRESSIONS[k], points[k], accepted[k]);
            }
        }
    }
}

fn one(expression: &str, inputs: &[f32]) -> Interval {
    probe::<Accept>(&format!("o[i] = {expression};"), inputs, 1)[0]
}

/// A rule is neither missing nor wider than the table: the interval's ends are exactly where the table puts them.
#[test]
fn the_ends_are_those_of_the_table() {
    let w = Width::F32;
    let third = 1.0 / 3.0;
    // Correct rounding either way: the two neighbours.
    let x = one("a[0] + a[1]", &[1.0, 1e-10]);
    assert_eq!((x.lo, x.hi), (1.0, w.next_up(1.0)));
    let x = one("a[0] * a[1]", &[1.0 + f32::EPSILON, 1.0 + f32::EPSILON]);
    assert_eq!(
        (x.lo, x.hi),
        (
            f64::from(1.0 + 2.0 * f32::EPSILON),
            f64::from(1.0 + 3.0 * f32::EPSILON)
        )
    );
    // 2.5 ULP of a quotient: 1/3 is not representable, so each end is rounded outward.
    let x = one("a[0] / a[1]", &[1.0, 3.0]);
    let half = 2.5 * w.ulp(third);
    assert_eq!(
        (x.lo, x.hi),
        (w.round_down(third - half, 0.0), w.round_up(third + half, 0.0))
    );
    // exp(1): 5 ULP.
    let x = one("exp(a[0])", &[1.0]);
    let half = 5.0 * w.ulp(std::f64::consts::E);
    assert!(
        (x.lo - (std::f64::consts::E - half)).abs() <= w.ulp(2.0)
            && (x.hi - (std::f64::consts::E + half)).abs() <= w.ulp(3.0)
    );
    // sin: 2^-11.
    let x = one("sin(a[0])", &[0.0]);
    assert_eq!((x.lo, x.hi), (-2f64.powi(-11), 2f64.powi(-11)));
    // log(1): 2^-21; log(8): 3 ULP.
    let x = one("log2(a[0])", &[1.0]);
    assert_eq!((x.lo, x.hi), (-2f64.powi(-21), 2f64.powi(-21)));
    // Three units each way, and at most one more for our own evaluation of the logarithm.
    let width = one("log2(a[0])", &[8.0]).width_ulps(w).unwrap();
    assert!((6.0..=8.0).contains(&width), "{width}");
    // inverseSqrt(4): 2 ULP of 1/2, a power of two, whose unit is the lesser one.
    let x = one("inverseSqrt(a[0])", &[4.0]);
    assert!(x.lo >= 0.5 - 2.0 * w.ulp(0.5) - w.ulp(0.4) && x.hi <= 0.5 + 2.0 * w.ulp(0.5) + w.ulp(0.6));
}

/// Deliberately wrong results that each rule must reject.
#[test]
fn wrong_results_are_rejected() {
    let controls: [(&str, f64); 12] = [
        ("a[0] + a[1]", 4.200001),
        ("a[0] * a[1]", 3.6),
        ("a[0] / a[1]", 1.7 / 2.5 + 4.0 * Width::F32.ulp(0.68)),
        ("sqrt(a[0])", 1.7f64.sqrt() + 10.0 * Width::F32.ulp(1.3)),
        (
            "inverseSqrt(a[0])",
            1.0 / 1.7f64.sqrt() + 4.0 * Width::F32.ulp(0.76),
        ),
        ("sin(a[0])", 1.7f64.sin() - 1.0 / 1024.0),
        ("exp(a[0])", 1.7f64.exp() + 9.0 * Width::F32.ulp(5.4)),
        ("log(a[1])", 2.5f64.ln() + 5.0 * Width::F32.ulp(0.9)),
        ("atan(a[0])", 1.7f64.atan() + 5000.0 * Width::F32.ulp(1.03)),
        ("dot(vec2f(a[0], a[1]), vec2f(a[1], a[0]))", 8.5001),
        (
            "length(vec2f(a[0], a[1]))",
            (1.7f64 * 1.7 + 2.5 * 2.5).sqrt() + 1e-5,
        ),
        ("floor(a[0])", 2.0),
    ];
    for (expression, wrong) in controls {
        let x = one(expression, &[1.7, 2.5]);
        assert!(!x.contains(wrong), "{expression}: {wrong} accepted by {x:?}");
        assert!(x.flags.is_none());
    }
}

/// What the language leaves open is said to be open, and nothing else is.
#[test]
fn indeterminate_results() {
    for (expression, inputs) in [
        ("a[0] / a[1]", [1.0, 0.0]),
        ("a[0] / a[1]", [1.0, 1e-40]),
        ("a[0] / a[1]", [1.0, f32::MAX]),
        ("a[0] * a[1]", [f32::MAX, 2.0]),
        ("sqrt(a[0])", [-1.0, 0.0]),
        ("inverseSqrt(a[1])", [1.0, 0.0]),
        ("log(a[1])", [1.0, 0.0]),
        ("pow(a[1], a[0])", [1.0, 0.0]),
        ("sin(a[0])", [4.0, 0.0]),
        ("acos(a[0])", [1.5, 0.0]),
        ("normalize(vec2f(a[1], a[1])).x", [1.0, 0.0]),
        ("atan2(a[1], a[0])", [-1.0, 0.0]),
    ] {
        let x = probe::<Accept>(&format!("o[i] = {expression};"), &inputs, 1)[0];
        assert!(
            x.is_indeterminate() && !x.is_undecided(),
            "{expression} of {inputs:?}: {x:?}"
        );
        assert!(x.contains(f64::NAN));
    }
    // Subnormal numbers may be flushed: both are accepted, and nothing more.
    let x = one("a[0] * 0.5", &[f32::MIN_POSITIVE]);
    assert!(
        x.contains(0.0)
            && x.contains(f64::from(f32::MIN_POSITIVE) / 2.0)
            && !x.contains(f64::from(f32::MIN_POSITIVE))
    );
    assert_eq!(one("sqrt(a[0])", &[0.0]), Interval::point(0.0));
    assert!(!one("select(a[0] / a[1], 0.0, a[1] == 0.0)", &[1.0, 0.0]).is_indeterminate());
}

/// Every order of the additions of a dot product is accepted.
#[test]
fn a_dot_product_may_add_in_any_order() {
    let v = [1e8f32, 1.0, -1e8, 0.5];
    let x = probe::<Accept>("o[i] = dot(vec4f(a[0], a[1], a[2], a[3]), vec4f(1.0));", &v, 1)[0];
    for order in [
        [0, 1, 2, 3],
        [0, 2, 1, 3],
        [1, 3, 0, 2],
        [3, 2, 1, 0],
        [1, 0, 3, 2],
    ] {
        let sum = order.iter().fold(0.0f32, |s, &k| s + v[k]);
        assert!(x.contains(f64::from(sum)), "{order:?}: {sum} not in {x:?}");
    }
}

/// Half precision has its own column.
#[test]
fn half_precision_rules() {
    let source = "enable f16;
        @group(0) @binding(0) var<storage, read> a: array<f32>;
        @group(0) @binding(1) var<storage, read_write> o: array<f32>;
        @compute @workgroup_size(1) fn main() {
            let x = f16(a[0]); let y = f16(a[1]);
            o[0] = f32(x + y); o[1] = f32(sin(x)); o[2] = f32(x / y); o[3] = f32(x * 60000.0h);
        }";
    let p = crate::common::program(source);
    let got = bossage_bounds::run_probe::<Accept>(&p, &[1.5, 0.001], 4, 1, &Limits::default())
        .unwrap()
        .0;
    let w = Width::F16;
    // 0.001 is just above one unit of 1.5 in f16.
    assert_eq!(
        (got[0].lo, got[0].hi),
        (w.next_up(1.5), w.next_up(w.next_up(1.5)))
    );
    assert!((got[1].hi - got[1].lo - 2.0 * 2f64.powi(-7)).abs() < w.ulp(0.9) + w.ulp(1.5));
    assert!(got[2].contains(1.5 / 0.001) && got[3].is_indeterminate());
}

/// Where a choice is undecided, the hull of both results says so, and everything computed from it; where it is decided, or both
/// results are equal, nothing is marked.
#[test]
fn undecided_choices_are_marked_and_still_bounded() {
    // 1/3 - a third of 1 is zero within its error.
    let open = "let zero = a[0] / 3.0 - a[1];";
    let inputs = [1.0, 1.0 / 3.0];
    for (body, lo, hi) in [
        ("o[i] = select(-1.0, 1.0, zero < 0.0) * 2.0;", -2.0, 2.0),
        ("var y = 3.0; if (zero > 0.0) { y = 5.0; } o[i] = y;", 3.0, 5.0),
        ("o[i] = floor(zero + 4.0);", 3.0, 4.0),
        ("o[i] = f32(i32(zero + 4.0));", 3.0, 4.0),
        ("o[i] = sign(zero);", -1.0, 1.0),
        ("o[i] = step(0.0, zero);", 0.0, 1.0),
    ] {
        let x = probe::<Accept>(&format!("{open} {body}"), &inputs, 1)[0];
        assert!(x.is_forked() && x.flags.is_none(), "{body}: {x:?}");
        assert_eq!((x.lo, x.hi), (lo, hi), "{body}");
    }
    for body in [
        "o[i] = select(2.0, 2.0, zero < 0.0);",
        "o[i] = max(zero, 0.0);",
        "o[i] = floor(a[0]);",
        "o[i] = select(-1.0, 1.0, a[0] < 2.0);",
    ] {
        let x = probe::<Accept>(&format!("{open} {body}"), &inputs, 1)[0];
        assert!(!x.is_forked(), "{body}: {x:?}");
    }
}

/// A compiler may reassociate what is written as a sum or a product; what it may not do stays outside.
#[test]
fn sums_and_products_may_be_taken_in_another_order() {
    let (big, third) = (1e8f32, 1.0f32 / 3.0);
    // Written so that the small term is lost first, or kept to the end.
    for (body, inputs, orders) in [
        (
            "o[i] = a[0] + a[1] + a[2];",
            [big, third, -big],
            [(big + third) - big, (big - big) + third],
        ),
        (
            "o[i] = a[0] - (a[1] - a[2]);",
            [big, big, third],
            [big - (big - third), (big - big) + third],
        ),
        (
            "let s = a[0] + a[1]; o[i] = -s + a[0];",
            [big, third, 0.0],
            [-(big + third) + big, -third],
        ),
        (
            "var s = a[0]; s += a[1]; s += a[2]; o[i] = s;",
            [big, third, -big],
            [(big + third) - big, third],
        ),
        (
            "o[i] = dot(a_xy, vec2f(1.0)) + a[2];",
            [big, third, -big],
            [(big + third) - big, (big - big) + third],
        ),
        (
            "o[i] = a[0] * a[1] * a[2];",
            [third, 0.7, 0.9],
            [(third * 0.7) * 0.9, third * (0.7 * 0.9)],
        ),
    ] {
        let body = format!("let a_xy = vec2f(a[0], a[1]); {body}");
        let x = probe::<Accept>(&body, &inputs, 1)[0];
        for order in orders {
            assert!(x.contains(f64::from(order)), "{body}: {order} not in {x:?}");
        }
        // The wide sums span what is lost; nothing beyond.
        assert!(
            !x.contains(f64::from(orders[0]) + 40.0) && !x.contains(-40.0),
            "{body}: {x:?}"
        );
        // Negative control: a perfect machine does as written, and input ranges are followed as written.
        assert_eq!(probe::<F32>(&body, &inputs, 1)[0], f64::from(orders[0]), "{body}");
        let range = probe::<Range>(&body, &inputs, 1)[0];
        assert!(range.hi - range.lo < 40.0, "{body}: {range:?}");
    }
}

/// More than four terms are bounded as a whole.
#[test]
fn a_long_sum_contains_every_order() {
    let body = "o[i] = a[0] + a[1] + a[2] + a[3] + a[4] + a[5] + a[6];";
    let values = [1e8f32, 1.0, -1e8, 0.5, 3e7, -0.3, 1e-3];
    let x = probe::<Accept>(body, &values, 1)[0];
    for shift in 0..7 {
        for step in 1..7 {
            let sum = (0..7).fold(0.0f32, |s, k| s + values[(shift + step * k) % 7]);
            assert!(x.contains(f64::from(sum)), "{shift} {step}: {sum} not in {x:?}");
        }
    }
    let exact: f64 = values.iter().copied().map(f64::from).sum();
    // Six additions, each off by at most one unit of less than 2^29.
    assert!(x.contains(exact) && !x.contains(exact + 400.0) && !x.contains(exact - 400.0));
}

/// A number beyond `f16` leaves the whole packed word open, the half of its neighbour too.
#[test]
fn a_packed_half_out_of_range_opens_the_whole_word() {
    let both = "unpack2x16float(pack2x16float(vec2f(a[0], a[1])))";
    let x = one(&format!("{both}.y"), &[-5.643971e33, 3.0]);
    assert!(x.contains(3.001953125), "{x:?}");
    // Negative control: within the format the other half is what was packed, and nothing else.
    let x = one(&format!("{both}.y"), &[60000.0, 3.0]);
    assert_eq!((x.lo, x.hi), (3.0, 3.0));
}
