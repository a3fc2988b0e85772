//! What makes acceptance intervals narrower than operation by operation: conditions, and errors that are shared. Each narrowing is held
//! to the two laws of the domain over whole programs: what a machine returns is inside, and wider inputs give wider outputs.

use crate::common::{probe_source, program};
use bossage_bounds::{
    Accept, Bindings, F32, Interval, Limits, Program, Scalar, Width, run_probe, run_probe_with,
};
use proptest::prelude::*;

/// Functions that the programs below call.
const FUNCTIONS: &str = "
    const TINY = 1.17549435e-38;
    fn largest(v: vec3f) -> f32 { return max(max(abs(v.x), abs(v.y)), abs(v.z)); }
    fn unit(v: vec3f) -> vec3f {
        let m = largest(v);
        if (m < TINY) { return vec3f(0.0); }
        let s = v / m;
        return s / sqrt(dot(s, s));
    }
    fn root_or_zero(x: f32) -> f32 {
        if (x < TINY) { return 0.0; }
        return sqrt(x);
    }
    fn power(x: f32, p: f32) -> f32 {
        let base = saturate(x);
        if (base < TINY) { return 0.0; }
        return pow(base, p);
    }
    fn three_ways(x: f32, y: f32) -> f32 {
        if (x < y) { return y - x; } else if (x > y + 1.0) { return x - y; }
        return x * y;
    }
";

/// Programs of three inputs with conditions and lengths of every shape.
const PROGRAMS: &[&str] = &[
    "o[i] = unit(vec3f(a[0], a[1], a[2])).y;",
    "o[i] = unit(vec3f(a[0] * a[1], a[1] - a[2], a[2])).x;",
    "o[i] = normalize(vec3f(a[0] * a[1], a[1] * a[2], a[0])).z;",
    "let v = vec2f(a[0], a[1]) - a[2]; o[i] = (v / length(v)).x;",
    "let x = a[0]; let y = a[1]; o[i] = x / sqrt(x * x + y * y);",
    "o[i] = root_or_zero(a[0] * a[1] - a[2]);",
    "o[i] = power(a[0] - a[1], abs(a[2]));",
    "o[i] = three_ways(a[0] + a[2], a[1]);",
    "let p = a[0] * a[1]; if (p <= a[2]) { o[i] = p + 0.5; } else { o[i] = a[2] - p; }",
    "let x = a[0] - a[1]; var y = 0.0; if (x > 0.0) { y = x; } o[i] = y + x * a[2];",
    "let x = a[0]; if (!(x >= a[1] | x < a[2])) { o[i] = x; } else { o[i] = x - 1.0; }",
    "var s = 0.0; for (var k = 0; k < 4; k++) { let t = a[0] - f32(k) * a[1]; if (t < a[2]) { break; } s += t; } o[i] = s;",
    "let x = a[0]; var k = 0.0; loop { let t = x + k; if (t > 2.0) { break; } if (t < a[1]) { k += 1.5; continue; } k += 1.0; } o[i] = x + k;",
    "let x = a[0]; switch i32(a[1]) { case 0: { if (x > a[2]) { o[i] = x; return; } o[i] = -x; } default: { o[i] = x * 2.0; } }",
];

fn compiled(body: &str) -> Program {
    program(&format!("{FUNCTIONS}{}", probe_source(body)))
}

/// The interval at a box of inputs; `None` where a limit ends the evaluation.
fn over(program: &Program, inputs: &[Interval; 3]) -> Option<Interval> {
    let list = inputs.iter().map(|&x| Scalar::Float(x)).collect();
    let bindings = Bindings::<Accept>::new().scalars(0, 0, list);
    let (out, _) = run_probe_with(program, bindings, 1, 1, &Limits::default()).ok()?;
    Some(out[0])
}

/// Inputs at which a·b − c may be a little below zero or a little above.
const NEAR: [Interval; 3] = [
    Interval::new(0.25, 0.250_000_12),
    Interval::point(0.5),
    Interval::point(0.125_000_06),
];

fn near(body: &str) -> Interval {
    over(&compiled(body), &NEAR).unwrap()
}

/// A box, a wider one around it, and a point inside.
fn boxes() -> impl Strategy<Value = ([Interval; 3], [Interval; 3], [f32; 3])> {
    let value = prop_oneof![
        -2.0f32..2.0,
        Just(0.0f32),
        Just(1.0f32),
        Just(-1.0f32),
        -1e-3f32..1e-3
    ];
    let width = prop_oneof![Just(0.0f32), 0.0f32..1e-6, 0.0f32..1e-2, 0.0f32..1.0];
    let one = (value, width.clone(), width, 0.0f32..=1.0).prop_map(|(x, narrow, more, t)| {
        let hi = x + narrow;
        let point = (x + (hi - x) * t).clamp(x, hi);
        let interval = |lo: f32, hi: f32| Interval::new(f64::from(lo), f64::from(hi));
        (interval(x, hi), interval(x - more, hi + more), point)
    });
    prop::array::uniform3(one).prop_map(|all| (all.map(|x| x.0), all.map(|x| x.1), all.map(|x| x.2)))
}

/// Whether everything that the first admits is admitted by the second.
fn within(narrow: Interval, wide: Interval) -> bool {
    !wide.flags.is_none() || narrow.flags.is_none() && wide.lo <= narrow.lo && narrow.hi <= wide.hi
}

proptest! {
    #![proptest_config(crate::common::cases(400))]

    #[test]
    fn narrowed_intervals_keep_what_a_machine_returns((inputs, _, point) in boxes()) {
        for body in PROGRAMS {
            let program = compiled(body);
            let Ok((got, _)) = run_probe::<F32>(&program, &point, 1, 1, &Limits::default()) else { continue };
            if let Some(accept) = over(&program, &inputs) {
                prop_assert!(accept.contains(got[0]), "{body}\n{point:?} in {inputs:?}: {} not in {accept:?}", got[0]);
            }
        }
    }

    #[test]
    fn wider_inputs_give_wider_outputs((inputs, wide, _) in boxes()) {
        for body in PROGRAMS {
            let program = compiled(body);
            if let (Some(a), Some(b)) = (over(&program, &inputs), over(&program, &wide)) {
                prop_assert!(within(a, b), "{body}\n{inputs:?} in {wide:?}: {a:?} not within {b:?}");
            }
        }
    }

    #[test]
    fn random_programs_are_monotone(source in crate::generated::shader(), (inputs, wide, _) in boxes()) {
        let Ok(parsed) = naga::front::wgsl::parse_str(&source) else { return Ok(()) };
        let mut validator = naga::valid::Validator::new(naga::valid::ValidationFlags::all(), naga::valid::Capabilities::all());
        let Ok(info) = validator.validate(&parsed) else { return Ok(()) };
        let program = Program::new(&parsed, &info, "main").unwrap();
        if let (Some(a), Some(b)) = (over(&program, &inputs), over(&program, &wide)) {
            prop_assert!(within(a, b), "{inputs:?} in {wide:?}: {a:?} not within {b:?}\n{source}");
        }
    }
}

/// The control of the two laws: a box that is not wider, and a result that is not inside.
#[test]
fn the_laws_can_fail() {
    let (narrow, wide) = (Interval::new(0.0, 1.0), Interval::new(0.5, 2.0));
    assert!(!within(narrow, wide) && within(Interval::new(0.6, 1.0), wide));
    assert!(!within(
        Interval::unknown(bossage_bounds::Flags::INDETERMINATE),
        wide
    ));
}

#[test]
fn a_guard_keeps_the_domain_of_what_stands_behind_it() {
    let guarded = near("o[i] = root_or_zero(a[0] * a[1] - a[2]);");
    assert!(
        guarded.flags.is_none() && guarded.is_forked() && guarded.lo == 0.0,
        "{guarded:?}"
    );
    let bare = near("o[i] = sqrt(a[0] * a[1] - a[2]);");
    assert!(
        bare.is_indeterminate(),
        "without the guard the root of a negative number is possible: {bare:?}"
    );
    let turned =
        "let x = a[0] * a[1] - a[2]; if (x > 1.17549435e-38) { o[i] = 1.0; return; } o[i] = sqrt(x);";
    assert!(
        near(turned).is_indeterminate(),
        "the wrong side of the guard helps nothing"
    );
}

#[test]
fn behind_the_condition_a_value_is_whole_again_and_no_choice() {
    let whole = near("o[i] = a[0] * a[1] - a[2];");
    let joined =
        "let x = a[0] * a[1] - a[2]; var y = 1.0; if (x < 0.0) { y = 2.0; } o[i] = select(x, 0.0, y < 0.5);";
    assert_eq!(near(joined), whole);
    let parameter = "o[i] = through(a[0] * a[1] - a[2]);";
    let source = format!(
        "fn through(x: f32) -> f32 {{ var y = 1.0; if (x < 0.0) {{ y = 2.0; }} return x; }}{}",
        probe_source(parameter)
    );
    assert_eq!(over(&program(&source), &NEAR), Some(whole));
}

#[test]
fn a_unit_vector_counts_shared_errors_once() {
    let inputs = [0.6f32, 0.5, 0.3].map(|x| Interval::point(f64::from(x)));
    let width = |body: &str| {
        over(&compiled(body), &inputs)
            .unwrap()
            .width_ulps(Width::F32)
            .unwrap()
    };
    let shared = width("o[i] = unit(vec3f(a[0] * 1.7, a[1] + 0.1, a[2])).x;");
    // The same with the length of another, equal, vector: no relation is seen.
    let apart = width(
        "let v = vec3f(a[0] * 1.7, a[1] + 0.1, a[2]); let m = largest(v); let s = v / m; let r = v / m;
         o[i] = s.x / sqrt(dot(r, r));",
    );
    assert!(shared < 0.8 * apart, "{shared} against {apart}");
    let wide = over(
        &compiled("o[i] = unit(vec3f(a[0], a[1], a[2])).x;"),
        &[
            Interval::new(-1.0, 1.0),
            Interval::point(1.0),
            Interval::point(0.5),
        ],
    )
    .unwrap();
    assert!(
        wide.lo > -0.67 && wide.hi < 0.67,
        "1/√(1 + 1 + ¼) and no more: {wide:?}"
    );
}
