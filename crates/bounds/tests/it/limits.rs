//! Bad calls, counters, the range domain.

use crate::common::{module, probe_source, program};
use bossage_bounds::{
    Accept, Bindings, Error, F32, Flags, Interval, Limits, Program, Range, Scalar, StageInputs, TexelFormat,
    Texture, range_scalar, run_compute, run_fragment, run_probe, run_probe_with,
};

fn error_of(source: &str, bindings: Bindings<F32>) -> Error {
    run_compute(&program(source), &mut { bindings }, [1, 1, 1], &Limits::default()).unwrap_err()
}

#[test]
fn bad_bindings_are_named() {
    let source = probe_source("o[i] = a[i];");
    let e = error_of(&source, Bindings::new());
    assert!(
        matches!(
            e,
            Error::MissingBinding {
                group: 0,
                binding: 0,
                ..
            }
        ),
        "{e}"
    );
    let uniform = "@group(0) @binding(3) var<uniform> u: vec4f; @group(0) @binding(1) var<storage, read_write> o: array<f32>;
        @compute @workgroup_size(1) fn main() { o[0] = u.x; }";
    let e = error_of(
        uniform,
        Bindings::new().bytes(0, 3, vec![0; 8]).floats(0, 1, &[0.0]),
    );
    assert!(
        e.to_string().contains("8 bytes are bound, the variable needs 16"),
        "{e}"
    );
    let e = error_of(
        &source,
        Bindings::new()
            .scalars(0, 0, vec![Scalar::Int(1, 1)])
            .floats(0, 1, &[0.0]),
    );
    assert!(matches!(e, Error::Buffer { .. }), "{e}");
}

#[test]
fn bad_entry_points_and_stages() {
    let (m, info) = module(&probe_source("o[i] = 1.0;"));
    let e = Program::new(&m, &info, "mian").unwrap_err();
    assert!(
        e.to_string().contains("`mian`") && e.to_string().contains("main"),
        "{e}"
    );
    let p = program(&probe_source("o[i] = 1.0;"));
    let e = run_fragment(
        &p,
        &mut Bindings::<F32>::new(),
        &StageInputs::new(4),
        &Limits::default(),
    )
    .unwrap_err();
    assert!(matches!(e, Error::WrongStage { .. }), "{e}");
}

#[test]
fn bad_ranges_and_textures() {
    assert!(matches!(
        range_scalar::<Range>(1.0, 0.0),
        Err(Error::EmptyRange { .. })
    ));
    assert!(matches!(
        range_scalar::<Range>(f64::NAN, 0.0),
        Err(Error::EmptyRange { .. })
    ));
    assert!(matches!(
        Texture::d2(TexelFormat::Rgba8Unorm, 2, 2, vec![0; 15]),
        Err(Error::Texture { .. })
    ));
    assert!(matches!(
        Texture::d2(TexelFormat::Rgba8Unorm, 0, 2, vec![]),
        Err(Error::Texture { .. })
    ));
}

#[test]
fn deep_calls_are_refused_without_a_crash() {
    let mut source = String::from("fn g0(x: f32) -> f32 { return x; }\n");
    for k in 1..400 {
        source += &format!("fn g{k}(x: f32) -> f32 {{ return g{}(x) + 1.0; }}\n", k - 1);
    }
    source += &probe_source("o[i] = g399(a[i]);");
    let (m, info) = module(&source);
    assert!(matches!(
        Program::new(&m, &info, "main"),
        Err(Error::Depth { .. })
    ));
}

/// Deep but lawful nesting fits the stack of a worker thread, which is smaller than the main thread's.
#[test]
fn deep_nesting_within_the_limit_runs() {
    let mut source = String::from("fn g0(x: f32) -> f32 { return x; }\n");
    for k in 1..100 {
        source += &format!(
            "fn g{k}(x: f32) -> f32 {{ var r = x; for (var i = 0; i < 1; i++) {{ if (x > -1.0) {{ r = g{}(x) + 1.0; }} }} return r; }}\n",
            k - 1
        );
    }
    let p = program(&(source + &probe_source("o[i] = g99(a[i]);")));
    assert_eq!(
        run_probe::<F32>(&p, &[0.5], 1, 1, &Limits::default()).unwrap().0,
        [99.5]
    );
    assert!(
        run_probe::<Accept>(&p, &[0.5], 1, 1, &Limits::default())
            .unwrap()
            .0[0]
            .contains(99.5)
    );
}

#[test]
fn counters_count_what_runs() {
    let p = program(&probe_source(
        "var s = 0.0; for (var k = 0u; k < 10u; k++) { s += a[i] * 2.0; } o[i] = s;",
    ));
    let limits = Limits {
        count: true,
        ..Limits::default()
    };
    let (_, outcome) = run_probe::<F32>(&p, &[1.0], 1, 1, &limits).unwrap();
    let (_, twice) = run_probe::<F32>(&p, &[1.0, 1.0], 2, 2, &limits).unwrap();
    let spans: u64 = outcome.spans.iter().map(|s| s.operations).sum();
    // The sum and the product of ten rounds are among them; loops add one for each round on top of the spans.
    assert!(spans >= 20 && outcome.counters.operations >= spans);
    assert!(outcome.spans.iter().any(|s| s.operations == 10));
    assert!(twice.counters.operations > outcome.counters.operations);
    // Negative control: nothing is counted by span unless asked for.
    let (_, quiet) = run_probe::<F32>(&p, &[1.0], 1, 1, &Limits::default()).unwrap();
    assert!(quiet.spans.is_empty());
}

fn over(body: &str, ranges: &[(f64, f64)]) -> Interval {
    let list = ranges
        .iter()
        .map(|&(lo, hi)| range_scalar::<Range>(lo, hi).unwrap())
        .collect();
    run_probe_with(
        &program(&probe_source(body)),
        Bindings::new().scalars(0, 0, list),
        1,
        1,
        &Limits::default(),
    )
    .unwrap()
    .0[0]
}

#[test]
fn ranges_follow_the_formula() {
    let x = over("o[i] = a[0] * a[1] + 1.0;", &[(0.0, 2.0), (-1.0, 3.0)]);
    assert_eq!((x.lo, x.hi), (-1.0, 7.0));
    let x = over("o[i] = 1.0 / a[0];", &[(-1.0, 1.0)]);
    assert!(x.lo == f64::NEG_INFINITY && x.hi == f64::INFINITY);
    let x = over("o[i] = sqrt(a[0]);", &[(-1.0, 4.0)]);
    assert!(x.flags.has(Flags::NAN));
    let x = over("o[i] = sqrt(max(a[0], 0.0));", &[(-1.0, 4.0)]);
    assert!(x.flags.is_none() && x.contains(0.0) && x.contains(2.0) && !x.contains(2.1));
    let x = over("let d = a[0] * a[0]; o[i] = sqrt(d);", &[(-3.0, 2.0)]);
    assert!(
        x.flags.is_none() && x.lo == 0.0,
        "a square is not negative: {x:?}"
    );
    let x = over("o[i] = select(1.0 / a[0], 0.0, a[0] < 1.0);", &[(1.0, 4.0)]);
    assert!(x.flags.is_none() && x.contains(0.25) && !x.contains(0.0));
}

#[test]
fn memory_limits_are_errors() {
    let p = program(&probe_source(
        "var t: array<f32, 4096>; t[u32(a[0])] = 1.0; o[i] = t[1];",
    ));
    let limits = Limits {
        memory: 1 << 20,
        ..Limits::default()
    };
    let e = run_probe::<Accept>(&p, &[1.0], 1, 1, &limits).unwrap_err();
    assert!(matches!(e, Error::Memory { .. }), "{e}");
}

/// The lesser of a NaN and a number is the number on many machines, so a range that may be NaN lets the other argument through.
#[test]
fn a_possible_nan_lets_the_other_argument_through() {
    let ranges = [(-1.0, 4.0), (7.0, 8.0)];
    let x = over("o[i] = min(sqrt(a[0]), a[1]);", &ranges);
    assert!(x.contains(8.0) && x.contains(0.0), "{x:?}");
    let x = over("o[i] = max(a[1] - 9.0, sqrt(a[0]));", &ranges);
    assert!(x.contains(-2.0) && x.contains(2.0), "{x:?}");
    // Negative control: without the NaN nothing of the sort.
    let x = over("o[i] = min(sqrt(abs(a[0])), a[1]);", &ranges);
    assert!(!x.contains(8.0), "{x:?}");
}
