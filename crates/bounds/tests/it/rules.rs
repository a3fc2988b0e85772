//! The accuracy table of WGSL, rule by rule: results that a rule allows are accepted up to its end, results beyond are refused.
//!
//! Every row is a rule with arguments, its true result, and what the table allows there, worked out in this file and not by the
//! crate. A row is a positive test and its own negative control: an interval that is too narrow refuses the last result that is
//! allowed, one that is too wide accepts the next beyond. Where accuracy is inherited from a formula, what the errors of its
//! operations sum up to is derived beside the row: results within the lesser number are lawful, none beyond the greater is.

use crate::common::{probe, program};
use bossage_bounds::{Accept, Interval, Limits, Width, run_probe};
use std::f64::consts::{E, PI};

/// What a rule allows around the true result.
#[derive(Clone, Copy, Debug)]
enum Allowed {
    /// That number.
    Exact,
    /// One of the two numbers of the format around it, or itself.
    Rounded,
    /// So many units in the last place.
    Ulps(f64),
    /// An absolute error.
    Absolute(f64),
    /// Inherited: errors up to the first number are lawful, beyond the second nothing is.
    Inherited(f64, f64),
    /// Sums and products, each rounded either way: these results are lawful, and none further from the truth than the number.
    Chain(fn([f64; 2]) -> Vec<f64>, f64),
}

use Allowed::{Absolute, Chain, Exact, Inherited, Rounded, Ulps};

/// All results of a sum or a product of any of these numbers, rounded down or up.
fn each(a: &[f64], b: &[f64], op: fn(f64, f64) -> f64) -> Vec<f64> {
    let w = Width::F32;
    let pairs = a.iter().flat_map(|x| b.iter().map(move |y| op(*x, *y)));
    pairs
        .flat_map(|exact| [w.round_down(exact, 0.0), w.round_up(exact, 0.0)])
        .collect()
}

fn sums(a: &[f64], b: &[f64]) -> Vec<f64> {
    each(a, b, |x, y| x + y)
}

fn differences(a: &[f64], b: &[f64]) -> Vec<f64> {
    each(a, b, |x, y| x - y)
}

fn products(a: &[f64], b: &[f64]) -> Vec<f64> {
    each(a, b, |x, y| x * y)
}

/// A real constant, rounded either way.
fn constant(x: f64) -> [f64; 2] {
    [Width::F32.round_down(x, 0.0), Width::F32.round_up(x, 0.0)]
}

type Truth = fn([f64; 2]) -> f64;

/// A rule: its place in the table, an expression in `x` and `y`, arguments, the truth, what is allowed.
type Rule = (&'static str, &'static str, [f32; 2], Truth, Allowed);

const ABOUT: [f32; 2] = [1.7, 2.5];

#[rustfmt::skip]
const F32_RULES: &[Rule] = &[
    ("x + y", "x + y", [1.7, 0.3], |[x, y]| x + y, Rounded),
    ("x - y", "x - y", [1.7, 0.3], |[x, y]| x - y, Rounded),
    ("x * y", "x * y", [1.7, 0.3], |[x, y]| x * y, Rounded),
    ("x / y", "x / y", [1.7, 0.3], |[x, y]| x / y, Ulps(2.5)),
    ("x / y", "x / y", [-1.0, 3.0], |[x, y]| x / y, Ulps(2.5)),
    ("x % y", "x % y", [7.3, 2.5], |[x, y]| x % y, Rounded),
    ("-x", "-x", ABOUT, |[x, _]| -x, Exact),
    ("==, <, …", "select(0.0, 1.0, x < y)", ABOUT, |_| 1.0, Exact),
    ("abs", "abs(x)", [-1.7, 0.0], |[x, _]| x.abs(), Exact),
    ("min", "min(x, y)", ABOUT, |[x, _]| x, Exact),
    ("max", "max(x, y)", ABOUT, |[_, y]| y, Exact),
    ("clamp", "clamp(x, y, 3.0)", ABOUT, |[_, y]| y, Exact),
    ("saturate", "saturate(x)", ABOUT, |_| 1.0, Exact),
    ("select", "select(x, y, x > y)", ABOUT, |[x, _]| x, Exact),
    ("sign", "sign(-x)", ABOUT, |_| -1.0, Exact),
    ("ceil", "ceil(x)", ABOUT, |_| 2.0, Exact),
    ("floor", "floor(x)", ABOUT, |_| 1.0, Exact),
    ("round", "round(y)", ABOUT, |_| 2.0, Exact),
    ("trunc", "trunc(-x)", ABOUT, |_| -1.0, Exact),
    ("step", "step(x, y)", ABOUT, |_| 1.0, Exact),
    ("modf", "modf(y).fract", ABOUT, |_| 0.5, Exact),
    ("frexp", "frexp(y).fract", ABOUT, |_| 0.625, Exact),
    ("ldexp", "ldexp(x, 3)", ABOUT, |[x, _]| 8.0 * x, Exact),
    ("bitcast", "bitcast<f32>(bitcast<u32>(x))", ABOUT, |[x, _]| x, Exact),
    ("conversions", "f32(i32(-x * 4.0))", [1.75, 0.0], |_| -7.0, Exact),
    ("conversions", "f32(u32(-x))", ABOUT, |_| 0.0, Exact),
    ("faceForward", "faceForward(vec2f(x, 0.0), vec2f(1.0, 0.0), vec2f(y, 0.0)).x", ABOUT, |[x, _]| -x, Exact),
    ("transpose", "transpose(mat2x2f(x, y, 1.0, 2.0))[1].x", ABOUT, |[_, y]| y, Exact),
    ("unpack2x16float", "unpack2x16float(pack2x16float(vec2f(y, 1.0))).x", ABOUT, |[_, y]| y, Exact),
    ("inverseSqrt", "inverseSqrt(x)", ABOUT, |[x, _]| 1.0 / x.sqrt(), Ulps(2.0)),
    ("exp", "exp(x)", [1.0, 0.0], |_| E, Ulps(5.0)),
    ("exp", "exp(x)", [-3.25, 0.0], |[x, _]| x.exp(), Ulps(9.5)),
    ("exp2", "exp2(x)", [1.7, 0.0], |[x, _]| x.exp2(), Ulps(3.0 + 2.0 * 1.7)),
    ("log", "log(y)", ABOUT, |[_, y]| y.ln(), Ulps(3.0)),
    ("log", "log(x)", [0.3, 0.0], |[x, _]| x.ln(), Ulps(3.0)),
    ("log", "log(x)", ABOUT, |[x, _]| x.ln(), Absolute(1.0 / 2_097_152.0)),
    ("log2", "log2(y)", ABOUT, |[_, y]| y.log2(), Ulps(3.0)),
    ("log2", "log2(x)", ABOUT, |[x, _]| x.log2(), Absolute(1.0 / 2_097_152.0)),
    ("sin", "sin(x)", ABOUT, |[x, _]| x.sin(), Absolute(1.0 / 2048.0)),
    ("cos", "cos(x)", ABOUT, |[x, _]| x.cos(), Absolute(1.0 / 2048.0)),
    ("atan", "atan(x)", ABOUT, |[x, _]| x.atan(), Ulps(4096.0)),
    ("atan2", "atan2(x, y)", ABOUT, |[x, y]| x.atan2(y), Ulps(4096.0)),
    ("atan2", "atan2(x, -y)", ABOUT, |[x, y]| x.atan2(-y), Ulps(4096.0)),
    // Where the inherited error is the smaller one.
    ("asin", "asin(x)", [1e-4, 0.0], |[x, _]| x.asin(), Absolute(6.81e-5)),
    ("acos", "acos(x)", [0.9999, 0.0], |[x, _]| x.acos(), Absolute(6.77e-5)),
    ("tanh", "tanh(x)", [1.2, 0.0], |[x, _]| x.tanh(), Absolute(1e-5)),
    // atan2(x, √(1 − x²)): 4096 units of 2⁻²⁴ are 2.44e-4, and the root adds less than 1e-6.
    ("asin", "asin(x)", [0.5, 0.0], |[x, _]| x.asin(), Inherited(2.4e-4, 2.5e-4)),
    // 4096 units of 2⁻²³ are 4.88e-4.
    ("acos", "acos(x)", [0.5, 0.0], |[x, _]| x.acos(), Inherited(4.8e-4, 5.0e-4)),
    // 1/r: 2 units of r and its rounding are 2.6 units of the root, then 2.5 of the quotient and a rounding.
    ("sqrt", "sqrt(x)", ABOUT, |[x, _]| x.sqrt(), Inherited(4.1 * 1.2e-7, 6.2 * 1.2e-7)),
    // (0.6442 + 2⁻¹¹) / (0.7648 − 2⁻¹¹) is 1.18e-3 above tan 0.7.
    ("tan", "tan(x)", [0.7, 0.0], |[x, _]| x.tan(), Inherited(1.16e-3, 1.2e-3)),
    // (e^x − e^−x)/2: 5.4 units of 3.32 and of 0.30, a rounding of the difference.
    ("sinh", "sinh(x)", [1.2, 0.0], |[x, _]| x.sinh(), Inherited(7.2e-7, 1.1e-6)),
    ("cosh", "cosh(x)", [1.2, 0.0], |[x, _]| x.cosh(), Inherited(7.2e-7, 1.1e-6)),
    // ln(x + √(x² + 1)): the root's 5 units of 1.56, two roundings of 2.76, then 3 units of 1.016.
    ("asinh", "asinh(x)", [1.2, 0.0], |[x, _]| x.asinh(), Inherited(5.5e-7, 9e-7)),
    ("acosh", "acosh(y)", ABOUT, |[_, y]| y.acosh(), Inherited(5.5e-7, 9e-7)),
    // ½ ln(1.5 / 0.5): 2.5 units of 3, 3 units of 1.0986, halved.
    ("atanh", "atanh(x)", [0.5, 0.0], |[x, _]| x.atanh(), Inherited(2.6e-7, 3.7e-7)),
    // exp2(y · log2 x): the exponent is off by 2.5 · 2⁻²¹ and a rounding, which the exponential takes times 3.77 ln 2, and adds
    // 3 + 2 · 1.91 units of 2⁻²².
    ("pow", "pow(x, y)", ABOUT, |[x, y]| x.powf(y), Inherited(19.0 * 2.4e-7, 24.0 * 2.4e-7)),
    // A factor that is rounded either way, and the product.
    ("radians", "radians(x)", [70.0, 0.0], |[x, _]| x.to_radians(), Chain(|[x, _]| products(&[x], &constant(PI / 180.0)), 3.6e-7)),
    ("degrees", "degrees(x)", [1.2, 0.0], |[x, _]| x.to_degrees(), Chain(|[x, _]| products(&[x], &constant(180.0 / PI)), 1.7e-5)),
    // Two products near 4.25 and their sum near 8.5, each rounded.
    ("dot", "dot(vec2f(x, y), vec2f(y, x))", ABOUT, |[x, y]| 2.0 * x * y, Chain(|[x, y]| sums(&products(&[x], &[y]), &products(&[y], &[x])), 2.4e-6)),
    // 2.89 is rounded, 6.25 exact, the difference rounded.
    ("cross", "cross(vec3f(x, y, 1.0), vec3f(y, x, 1.0)).z", ABOUT, |[x, y]| x * x - y * y, Chain(|[x, y]| differences(&products(&[x], &[x]), &products(&[y], &[y])), 7.3e-7)),
    // The root's 4.2 to 5.5 units of 3.02, and the squares' share of 2e-7.
    ("length", "length(vec2f(x, y))", ABOUT, |[x, y]| x.hypot(y), Inherited(1.0e-6, 1.7e-6)),
    ("distance", "distance(vec2f(x, y), vec2f(0.5, 0.25))", ABOUT, |[x, y]| (x - 0.5).hypot(y - 0.25), Inherited(1.0e-6, 1.8e-6)),
    // y over the length: the length's relative 5e-7, 2.5 units of the quotient.
    ("normalize", "normalize(vec2f(x, y)).y", ABOUT, |[x, y]| y / x.hypot(y), Inherited(4e-7, 7e-7)),
    ("mix", "mix(x, y, 0.25)", ABOUT, |[x, y]| 0.75 * x + 0.25 * y, Chain(|[x, y]| sums(&products(&[x], &[0.75]), &products(&[y], &[0.25])), 6e-7)),
    ("fract", "fract(-x)", ABOUT, |[x, _]| -x - (-x).floor(), Rounded),
    // Fused or not: a rounding near 4.25 and one near 4.95.
    ("fma", "fma(x, y, 0.75)", ABOUT, |[x, y]| x * y + 0.75, Chain(|[x, y]| [sums(&products(&[x], &[y]), &[0.75]), constant(x * y + 0.75).to_vec()].concat(), 1.5e-6)),
    // t is off by 2.2e-7, which its three places in the polynomial take times 3.22 at most, and five roundings.
    ("smoothstep", "smoothstep(0.25, 0.75, x)", [0.6, 0.0], |[x, _]| { let t = (x - 0.25) / 0.5; t * t * (3.0 - 2.0 * t) },
        Inherited(2.5e-7, 1.2e-6)),
    ("reflect", "reflect(vec2f(x, y), vec2f(0.5, 0.75)).x", ABOUT, |[x, y]| x - 2.0 * (0.5 * x + 0.75 * y) * 0.5, Chain(|[x, y]| {
        let dot = sums(&products(&[x], &[0.5]), &products(&[y], &[0.75]));
        differences(&[x], &products(&products(&[2.0], &dot), &[0.5]))
    }, 1.6e-6)),
    // −½·¾ − (−½·¾ + √k) with k = 1 − ¼(1 − 9/16): the root's 5 units of 0.94 and two roundings.
    ("refract", "refract(vec2f(0.6, -x), vec2f(0.0, 1.0), 0.5).y", [0.75, 0.0], |[x, _]| -(1.0 - 0.25 * (1.0 - x * x)).sqrt(),
        Inherited(2.2e-7, 8e-7)),
    ("determinant", "determinant(mat2x2f(x, y, 0.5, x))", ABOUT, |[x, y]| x * x - 0.5 * y, Chain(|[x, y]| differences(&products(&[x], &[x]), &products(&[0.5], &[y])), 6.1e-7)),
    ("matrix · vector", "(mat2x2f(x, 0.0, 0.25, 0.0) * vec2f(y, x)).x", ABOUT, |[x, y]| x * y + 0.25 * x, Chain(|[x, y]| sums(&products(&[x], &[y]), &products(&[0.25], &[x])), 1.5e-6)),
    ("unpack4x8unorm", "unpack4x8unorm(79u).x", ABOUT, |_| 79.0 / 255.0, Ulps(3.0)),
    ("unpack4x8snorm", "unpack4x8snorm(79u).x", ABOUT, |_| 79.0 / 127.0, Ulps(3.0)),
    ("unpack2x16unorm", "unpack2x16unorm(7900u).x", ABOUT, |_| 7900.0 / 65535.0, Ulps(3.0)),
    ("unpack2x16snorm", "unpack2x16snorm(7900u).x", ABOUT, |_| 7900.0 / 32767.0, Ulps(3.0)),
    // The code is decided: 79.05 and 39.37 are far from a half.
    ("pack4x8unorm", "f32(pack4x8unorm(vec4f(x, 0.0, 0.0, 0.0)))", [0.31, 0.0], |_| 79.0, Exact),
    ("pack4x8snorm", "f32(pack4x8snorm(vec4f(x, 0.0, 0.0, 0.0)))", [0.31, 0.0], |_| 39.0, Exact),
    ("pack2x16unorm", "f32(pack2x16unorm(vec2f(x, 0.0)))", [0.25, 0.0], |_| 16384.0, Exact),
    ("pack2x16snorm", "f32(pack2x16snorm(vec2f(x, 0.0)))", [0.25, 0.0], |_| 8192.0, Exact),
    ("quantizeToF16", "quantizeToF16(y)", ABOUT, |[_, y]| y, Exact),
    // 1.7 lies between 1.69921875 and 1.7001953125.
    ("quantizeToF16", "quantizeToF16(x)", ABOUT, |_| (1.699_218_75 + 1.700_195_312_5) / 2.0, Inherited(0.000_488, 0.000_489)),
];

#[rustfmt::skip]
const F16_RULES: &[Rule] = &[
    ("x + y", "x + y", [1.7, 0.3], |[x, y]| x + y, Rounded),
    ("x * y", "x * y", [1.7, 0.3], |[x, y]| x * y, Rounded),
    ("x / y", "x / y", [1.7, 0.3], |[x, y]| x / y, Ulps(2.5)),
    ("inverseSqrt", "inverseSqrt(x)", ABOUT, |[x, _]| 1.0 / x.sqrt(), Ulps(2.0)),
    ("exp", "exp(x)", [1.0, 0.0], |_| E, Ulps(3.0)),
    ("exp2", "exp2(x)", [1.5, 0.0], |[x, _]| x.exp2(), Ulps(4.0)),
    ("log", "log(y)", ABOUT, |[_, y]| y.ln(), Ulps(3.0)),
    ("log", "log(x)", ABOUT, |[x, _]| x.ln(), Absolute(1.0 / 128.0)),
    ("log2", "log2(x)", ABOUT, |[x, _]| x.log2(), Absolute(1.0 / 128.0)),
    ("sin", "sin(x)", ABOUT, |[x, _]| x.sin(), Absolute(1.0 / 128.0)),
    ("cos", "cos(x)", ABOUT, |[x, _]| x.cos(), Absolute(1.0 / 128.0)),
    ("atan", "atan(x)", ABOUT, |[x, _]| x.atan(), Ulps(5.0)),
    ("atan2", "atan2(x, y)", ABOUT, |[x, y]| x.atan2(y), Ulps(5.0)),
    ("asin", "asin(x)", [0.01, 0.0], |[x, _]| x.asin(), Absolute(3.91e-3)),
];

fn accepted(w: Width, expression: &str, inputs: [f32; 2]) -> Interval {
    if w == Width::F16 {
        let body = format!(
            "let x = f16(a[0]); let y = f16(a[1]); o[i] = f32({});",
            expression.replace("vec2f", "vec2h")
        );
        let source = format!("enable f16;\n{}", crate::common::probe_source(&body));
        let p = program(&source);
        return run_probe::<Accept>(&p, &inputs, 1, 1, &Limits::default())
            .unwrap()
            .0[0];
    }
    probe::<Accept>(
        &format!("let x = a[0]; let y = a[1]; o[i] = {expression};"),
        &inputs,
        1,
    )[0]
}

/// The last result that must be accepted and one that must be refused: below and above the truth.
fn ends(w: Width, inputs: [f64; 2], truth: f64, allowed: Allowed) -> [(f64, f64); 2] {
    // One step more than the rule: outward rounding of an end that the format does not have.
    let beyond = |error: f64| error + 2.0 * w.ulp(truth.abs() + error);
    match allowed {
        Exact => [(truth, w.next_down(truth)), (truth, w.next_up(truth))],
        Rounded => {
            let (down, up) = (w.round_down(truth, 0.0), w.round_up(truth, 0.0));
            [(down, w.next_down(down)), (up, w.next_up(up))]
        }
        Ulps(count) => {
            let error = count * w.ulp(truth);
            [
                (truth - error, truth - beyond(error)),
                (truth + error, truth + beyond(error)),
            ]
        }
        Absolute(error) => [
            (truth - error, truth - beyond(error)),
            (truth + error, truth + beyond(error)),
        ],
        Inherited(inside, outside) => [
            (truth - inside, truth - outside),
            (truth + inside, truth + outside),
        ],
        Chain(results, outside) => {
            let results = results(inputs);
            let least = results.iter().copied().fold(f64::INFINITY, f64::min);
            let most = results.iter().copied().fold(f64::NEG_INFINITY, f64::max);
            [(least, truth - outside), (most, truth + outside)]
        }
    }
}

/// What is wrong with an interval by a rule.
fn mistakes(w: Width, inputs: [f64; 2], truth: f64, allowed: Allowed, x: Interval) -> Vec<String> {
    let mut wrong = Vec::new();
    if !x.flags.is_none() {
        wrong.push(format!("is open: {x:?}"));
    }
    for (inside, outside) in ends(w, inputs, truth, allowed) {
        if !x.contains(inside) {
            wrong.push(format!("refuses {inside:e}, which the rule allows: {x:?}"));
        }
        if x.contains(outside) {
            wrong.push(format!("accepts {outside:e}, which no rule allows: {x:?}"));
        }
    }
    wrong
}

/// Arguments as the format has them.
fn arguments(w: Width, inputs: [f32; 2]) -> [f64; 2] {
    inputs.map(|x| {
        if w == Width::F16 {
            w.round(f64::from(x))
        } else {
            f64::from(x)
        }
    })
}

#[test]
fn every_rule_ends_where_the_table_says() {
    let all = F32_RULES.iter().map(|rule| (Width::F32, rule));
    let all = all.chain(F16_RULES.iter().map(|rule| (Width::F16, rule)));
    let mut wrong = Vec::new();
    for (w, (_, expression, inputs, truth, allowed)) in all {
        // Arguments of f16 are rounded either way; those that the format has are not.
        let inputs = if w == Width::F16 {
            inputs.map(|x| w.round(f64::from(x)) as f32)
        } else {
            *inputs
        };
        let x = accepted(w, expression, inputs);
        let found = mistakes(w, arguments(w, inputs), truth(arguments(w, inputs)), *allowed, x);
        wrong.extend(
            found
                .into_iter()
                .map(|what| format!("{w:?} {expression} of {inputs:?} {what}")),
        );
    }
    assert!(wrong.is_empty(), "{wrong:#?}");
}

/// Control of the controls: an interval that is off by a little more than the rule is noticed, on either side, for every kind of
/// rule.
#[test]
fn a_rule_that_is_too_wide_or_too_narrow_is_seen() {
    let w = Width::F32;
    for allowed in [Exact, Rounded, Ulps(2.5), Absolute(1e-4), Inherited(1e-6, 2e-6)] {
        let truth = if matches!(allowed, Exact) { 1.75 } else { 1.7 };
        let [(low, below), (high, above)] = ends(w, [0.0; 2], truth, allowed);
        let just_right = Interval::new(w.round_down(low, 0.0), w.round_up(high, 0.0));
        assert_eq!(
            mistakes(w, [0.0; 2], truth, allowed, just_right),
            [""; 0],
            "{allowed:?}"
        );
        for wrong in [
            Interval::new(below, just_right.hi),
            Interval::new(just_right.lo, above),
            Interval::new(w.next_up(low), just_right.hi),
            Interval::new(just_right.lo, w.next_down(high)),
            Interval::unknown(bossage_bounds::Flags::INDETERMINATE),
        ] {
            assert!(
                !mistakes(w, [0.0; 2], truth, allowed, wrong).is_empty(),
                "{allowed:?}: {wrong:?}"
            );
        }
    }
}

/// Outside of what the table states, everything is open; just inside of it nothing is.
#[test]
fn rules_are_open_beyond_their_domain_and_only_there() {
    let least = f32::MIN_POSITIVE;
    let pi = std::f32::consts::PI;
    for (expression, inside, outside) in [
        ("x / y", [1.0, least], [1.0, least.next_down()]),
        ("x / y", [1.0, 2f32.powi(126)], [1.0, 2f32.powi(126).next_up()]),
        (
            "x * y",
            [2f32.powi(64), 2f32.powi(63)],
            [2f32.powi(64), 2f32.powi(64)],
        ),
        ("x + y", [f32::MAX, 0.0], [f32::MAX, 1e35]),
        ("x - y", [-f32::MAX, 0.0], [-f32::MAX, 1e35]),
        ("sqrt(x)", [0.0, 0.0], [-least, 0.0]),
        ("inverseSqrt(x)", [least, 0.0], [0.0, 0.0]),
        ("log(x)", [least, 0.0], [0.0, 0.0]),
        ("log2(x)", [least, 0.0], [-1.0, 0.0]),
        ("exp(x)", [88.7, 0.0], [88.8, 0.0]),
        ("exp2(x)", [127.9, 0.0], [128.0, 0.0]),
        ("pow(x, y)", [least, 0.5], [0.0, 0.5]),
        ("sin(x)", [pi, 0.0], [pi.next_up(), 0.0]),
        ("cos(x)", [-pi, 0.0], [(-pi).next_down(), 0.0]),
        ("tan(x)", [1.57, 0.0], [std::f32::consts::FRAC_PI_2, 0.0]),
        ("asin(x)", [0.999, 0.0], [1.0f32.next_up(), 0.0]),
        ("acos(x)", [-0.99, 0.0], [(-1.0f32).next_down(), 0.0]),
        ("acosh(x)", [1.01, 0.0], [0.99, 0.0]),
        ("atanh(x)", [0.99, 0.0], [1.0, 0.0]),
        ("sinh(x)", [88.0, 0.0], [89.0, 0.0]),
        ("cosh(x)", [88.0, 0.0], [-89.0, 0.0]),
        ("atan2(x, y)", [1.0, least], [1.0, 0.0]),
        ("x % y", [1.0, 3.0], [1.0, 0.0]),
        ("normalize(vec2f(x, y)).x", [1e-15, 1e-15], [0.0, 0.0]),
        ("length(vec2f(x, y))", [1e19, 1e18], [2e19, 2e19]),
        ("smoothstep(x, y, 0.5)", [0.0, 1.0], [1.0, 1.0]),
        ("quantizeToF16(x)", [65504.0, 0.0], [66000.0, 0.0]),
        ("ldexp(x, 100)", [1e7, 0.0], [1e10, 0.0]),
    ] {
        let x = accepted(Width::F32, expression, inside);
        assert!(x.flags.is_none(), "{expression} of {inside:?}: {x:?}");
        let x = accepted(Width::F32, expression, outside);
        assert!(
            x.is_indeterminate() && !x.is_undecided(),
            "{expression} of {outside:?}: {x:?}"
        );
    }
}

/// Every built-in function of floats that naga has stands in the table above.
#[test]
fn no_function_goes_without_a_rule() {
    let expressions: String = F32_RULES.iter().map(|rule| format!("{} ", rule.1)).collect();
    for name in [
        "abs",
        "acos",
        "acosh",
        "asin",
        "asinh",
        "atan",
        "atan2",
        "atanh",
        "ceil",
        "clamp",
        "cos",
        "cosh",
        "cross",
        "degrees",
        "determinant",
        "distance",
        "dot",
        "exp",
        "exp2",
        "faceForward",
        "floor",
        "fma",
        "fract",
        "frexp",
        "inverseSqrt",
        "ldexp",
        "length",
        "log",
        "log2",
        "max",
        "min",
        "mix",
        "modf",
        "normalize",
        "pow",
        "quantizeToF16",
        "radians",
        "reflect",
        "refract",
        "round",
        "saturate",
        "select",
        "sign",
        "sin",
        "sinh",
        "smoothstep",
        "sqrt",
        "step",
        "tan",
        "tanh",
        "transpose",
        "trunc",
    ] {
        assert!(expressions.contains(&format!("{name}(")), "{name}");
    }
}
