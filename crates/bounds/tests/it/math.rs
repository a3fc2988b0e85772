//! Float built-ins: the `f32` domain against Rust's `f64` functions rounded once, the acceptance interval against the same.

use crate::common::probe;
use bossage_bounds::{Accept, F32, F64, Width};

/// A built-in of `x = a[0]`, `y = a[1]`, `z = a[2]`, and what it is.
type Case = (&'static str, fn([f64; 3]) -> f64);

/// Functions that are one operation: a perfect machine gives the real result rounded once.
const SINGLE: &[Case] = &[
    ("sin(x)", |[x, ..]| x.sin()),
    ("cos(x)", |[x, ..]| x.cos()),
    ("tan(x)", |[x, ..]| x.tan()),
    ("asin(x / 2.0)", |[x, ..]| (x / 2.0).asin()),
    ("acos(x / 2.0)", |[x, ..]| (x / 2.0).acos()),
    ("atan(x)", |[x, ..]| x.atan()),
    ("atan2(y, x)", |[x, y, _]| y.atan2(x)),
    ("sinh(x)", |[x, ..]| x.sinh()),
    ("cosh(x)", |[x, ..]| x.cosh()),
    ("tanh(x)", |[x, ..]| x.tanh()),
    ("asinh(x)", |[x, ..]| x.asinh()),
    ("acosh(y)", |[_, y, _]| y.acosh()),
    ("atanh(x / 2.0)", |[x, ..]| (x / 2.0).atanh()),
    ("exp(x)", |[x, ..]| x.exp()),
    ("exp2(x)", |[x, ..]| x.exp2()),
    ("log(y)", |[_, y, _]| y.ln()),
    ("log2(y)", |[_, y, _]| y.log2()),
    ("pow(y, x)", |[x, y, _]| y.powf(x)),
    ("sqrt(y)", |[_, y, _]| y.sqrt()),
    ("inverseSqrt(y)", |[_, y, _]| 1.0 / y.sqrt()),
    ("abs(z)", |[.., z]| z.abs()),
    ("sign(z)", |[.., z]| z.signum()),
    ("floor(z)", |[.., z]| z.floor()),
    ("ceil(z)", |[.., z]| z.ceil()),
    ("round(z)", |[.., z]| z.round_ties_even()),
    ("trunc(z)", |[.., z]| z.trunc()),
    ("fract(z)", |[.., z]| z - z.floor()),
    ("saturate(z)", |[.., z]| z.clamp(0.0, 1.0)),
    ("degrees(x)", |[x, ..]| x.to_degrees()),
    ("radians(x)", |[x, ..]| x.to_radians()),
    ("min(x, y)", |[x, y, _]| x.min(y)),
    ("max(x, y)", |[x, y, _]| x.max(y)),
    ("clamp(z, x, y)", |[x, y, z]| z.clamp(x, y)),
    ("step(x, y)", |[x, y, _]| if x <= y { 1.0 } else { 0.0 }),
    ("fma(x, y, z)", |[x, y, z]| x.mul_add(y, z)),
    ("modf(z).fract", |[.., z]| z.fract()),
    ("modf(z).whole", |[.., z]| z.trunc()),
    ("frexp(z).fract", |[.., z]| z / 4.0),
    ("f32(frexp(z).exp)", |_| 2.0),
    ("ldexp(x, 5)", |[x, ..]| x * 32.0),
    ("quantizeToF16(x)", |[x, ..]| Width::F16.round(x)),
    ("-x", |[x, ..]| -x),
    ("z % x", |[x, _, z]| z % x),
];

/// Functions of several operations: the perfect machine rounds each.
const COMPOSED: &[Case] = &[
    ("mix(x, y, 0.25)", |[x, y, _]| x * 0.75 + y * 0.25),
    ("smoothstep(x, y, 1.0)", |[x, y, _]| {
        let t: f64 = (1.0 - x) / (y - x);
        t * t * (3.0 - 2.0 * t)
    }),
    ("dot(vec3f(x, y, z), vec3f(y, z, x))", |[x, y, z]| {
        x * y + y * z + z * x
    }),
    ("length(vec2f(x, y))", |[x, y, _]| x.hypot(y)),
    ("length(z)", |[.., z]| z.abs()),
    ("distance(vec2f(x, y), vec2f(z, x))", |[x, y, z]| {
        (x - z).hypot(y - x)
    }),
    ("normalize(vec3f(x, y, z)).y", |[x, y, z]| {
        y / (x * x + y * y + z * z).sqrt()
    }),
    ("cross(vec3f(x, y, z), vec3f(y, z, x)).z", |[x, y, z]| {
        x * z - y * y
    }),
    ("reflect(vec2f(x, y), vec2f(0.6, 0.8)).x", |[x, y, _]| {
        x - 2.0 * (x * 0.6 + y * 0.8) * 0.6
    }),
    (
        "faceForward(vec2f(x, y), vec2f(1.0, 0.0), vec2f(z, 0.0)).x",
        |[x, ..]| x,
    ),
    ("refract(vec2f(0.6, -0.8), vec2f(0.0, 1.0), 0.5).x", |_| 0.3),
    ("determinant(mat2x2f(x, y, z, x))", |[x, y, z]| x * x - y * z),
    (
        "determinant(mat3x3f(x, 0.0, 1.0, 0.0, y, 0.0, 1.0, 0.0, z))",
        |[x, y, z]| x * y * z - y,
    ),
    (
        "determinant(mat4x4f(x, 0.0, 0.0, 1.0, 0.0, y, 0.0, 0.0, 0.0, 0.0, 2.0, 0.0, 1.0, 0.0, 0.0, z))",
        |[x, y, z]| 2.0 * y * (x * z - 1.0),
    ),
];

const XYZ: [f32; 3] = [0.7, 1.9, -2.3];

fn wide() -> [f64; 3] {
    XYZ.map(f64::from)
}

fn body(expression: &str) -> String {
    format!("let x = a[0]; let y = a[1]; let z = a[2]; o[i] = {expression};")
}

/// The bodies of all probes here.
pub(crate) fn bodies() -> Vec<String> {
    let all = SINGLE.iter().chain(COMPOSED);
    all.map(|(expression, _)| body(expression)).collect()
}

#[test]
fn a_perfect_machine_rounds_single_operations_once() {
    for (expression, f) in SINGLE {
        let want = f(wide()) as f32;
        let got = probe::<F32>(&body(expression), &XYZ, 1)[0] as f32;
        // Rust's f64 function and ours are the same; arguments such as x / 2.0 are exact.
        assert_eq!(got.to_bits(), want.to_bits(), "{expression}: {got}, want {want}");
    }
}

#[test]
fn composed_functions_stay_within_their_roundings() {
    for (expression, f) in COMPOSED {
        let want = f(wide());
        let got = probe::<F32>(&body(expression), &XYZ, 1)[0];
        // At most 16 roundings of half a unit, on intermediate values below 16: 16 * 0.5 * 16 * 2^-24 * 2.
        assert!(
            (got - want).abs() <= 16.0 * 16.0 * 2f64.powi(-24),
            "{expression}: {got}, want {want}"
        );
        // The f64 domain has the same formula with roundings of 2^-53.
        let got = probe::<F64>(&body(expression), &XYZ, 1)[0];
        let inputs = if expression.contains("0.6") {
            2f64.powi(-22)
        } else {
            0.0
        };
        assert!(
            (got - want).abs() <= 16.0 * 16.0 * 2f64.powi(-53) + inputs,
            "{expression}: {got}, want {want}"
        );
    }
}

#[test]
fn acceptance_intervals_contain_truth_and_machine() {
    for (expression, f) in SINGLE.iter().chain(COMPOSED) {
        let interval = probe::<Accept>(&body(expression), &XYZ, 1)[0];
        let machine = probe::<F32>(&body(expression), &XYZ, 1)[0];
        assert!(!interval.is_indeterminate(), "{expression}: {interval:?}");
        assert!(
            interval.contains(machine),
            "{expression}: {machine} not in {interval:?}"
        );
        assert!(
            interval.contains(f(wide()) as f32 as f64) || expression.contains("0.6"),
            "{expression}: {interval:?}"
        );
    }
}

#[test]
fn inverse_matrices() {
    // No WGSL built-in inverts a matrix; the IR has one for other front ends, and M⁻¹ M = I checks the adjugate.
    let body = "let m = mat3x3f(2.0, 0.0, 1.0, 0.0, 3.0, 0.0, 1.0, 0.0, 1.0); o[i] = determinant(m);";
    assert_eq!(probe::<F32>(body, &[0.0], 1), [3.0]);
}
