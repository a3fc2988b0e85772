//! Control flow that an interval cannot decide.

use crate::common::{dispatch, probe, program};
use bossage_bounds::{
    Accept, Bindings, Error, F32, Interval, Limits, Range, Scalar, StageInputs, range_scalar, run_compute,
    run_probe,
};

/// 0.1 + 0.2 lies strictly between 0.3 as an f32 and the number below it: rounding decides, so the interval cannot.
const SUM: &str = "let s = a[0] + a[1];";

#[test]
fn an_undecided_condition_gives_the_hull_of_both_sides() {
    let body =
        format!("{SUM} var r = 5.0; if (s >= a[2]) {{ r = 1.0; }} else {{ r = 2.0; }} o[i] = r * 10.0;");
    let x = probe::<Accept>(&body, &[0.1, 0.2, 0.3], 1)[0];
    assert_eq!((x.lo, x.hi), (10.0, 20.0));
    // Negative control: a decided condition takes one side only.
    let y = probe::<Accept>(&body, &[0.1, 0.2, 0.4], 1)[0];
    assert_eq!(y, Interval::point(20.0));
}

#[test]
fn an_undecided_early_return_merges_at_the_call() {
    let source = "
        @group(0) @binding(0) var<storage, read> a: array<f32>;
        @group(0) @binding(1) var<storage, read_write> o: array<f32>;
        fn f(s: f32) -> f32 { if (s >= a[2]) { return 1.0; } return 4.0; }
        @compute @workgroup_size(1) fn main() {
            if (a[0] + a[1] >= a[2]) { o[0] = 7.0; return; }
            o[0] = f(a[0] + a[1]) + 1.0;
            o[1] = 3.0;
        }";
    let b = Bindings::<Accept>::new()
        .floats(0, 0, &[0.1, 0.2, 0.3])
        .floats(0, 1, &[9.0, 9.0]);
    let got = dispatch(source, b).0.read_floats(0, 1).unwrap();
    // Both paths write o[0], so its old value is gone; only one writes o[1].
    assert_eq!((got[0].lo, got[0].hi), (2.0, 7.0));
    assert_eq!((got[1].lo, got[1].hi), (3.0, 9.0));
}

#[test]
fn an_undecided_loop_exit_keeps_both_exits_apart() {
    // Leaves at k = 3 or at k = 4: never at another.
    let body = "var k = 0; loop { if (f32(k) * a[0] >= a[1]) { break; } k++; if (k > 20) { break; } } o[i] = f32(k);";
    let x = probe::<Accept>(body, &[0.1, 0.3], 1)[0];
    assert_eq!((x.lo, x.hi), (3.0, 4.0));
    assert!(x.flags.is_none());
}

#[test]
fn a_loop_that_cannot_be_decided_is_given_up() {
    let body = "var x = a[0]; var k = 0; var keep = 1.0; loop { if (x * x > a[1]) { break; } x = x + a[2] - a[2]; k++; if (k > 100000) { break; } } o[i] = x; o[i + 1u] = keep;";
    let source = crate::common::probe_source(body);
    let (out, outcome) =
        run_probe::<Accept>(&program(&source), &[0.1, 0.01, 1.0], 2, 1, &Limits::default()).unwrap();
    assert!(out[0].is_undecided(), "{out:?}");
    assert_eq!(
        out[1],
        Interval::point(1.0),
        "what the loop does not write stays known"
    );
    // Once for each of the two invocations that outputs of two scalars make.
    assert_eq!(outcome.counters.abandoned_loops, 2);
    assert!(outcome.counters.forks > 0);
}

#[test]
fn an_undecided_switch_enters_every_case_it_may() {
    let source = "
        @group(0) @binding(0) var<storage, read> a: array<f32>;
        @group(0) @binding(1) var<storage, read_write> o: array<f32>;
        @compute @workgroup_size(1) fn main() {
            var r = 0.0;
            switch i32(a[0]) { case 1: { r = 10.0; } case 2: { r = 20.0; } case 7: { r = 70.0; } default: { r = 30.0; } }
            o[0] = r;
        }";
    let run = |lo: f64, hi: f64| {
        let b = Bindings::<Accept>::new()
            .scalars(0, 0, vec![Scalar::Float(Interval::new(lo, hi))])
            .floats(0, 1, &[0.0]);
        let x = dispatch(source, b).0.read_floats(0, 1).unwrap()[0];
        (x.lo, x.hi)
    };
    assert_eq!(run(1.0, 1.5), (10.0, 10.0));
    assert_eq!(run(1.0, 2.5), (10.0, 20.0));
    assert_eq!(run(2.0, 3.0), (20.0, 30.0));
    assert_eq!(run(1.0, 7.0), (10.0, 70.0));
}

#[test]
fn uncertain_indices_read_and_write_every_element_they_may() {
    let source = "
        @group(0) @binding(0) var<storage, read> a: array<f32>;
        @group(0) @binding(1) var<storage, read_write> o: array<f32>;
        @compute @workgroup_size(1) fn main() {
            var t = array<vec2f, 4>(vec2f(1.0, -1.0), vec2f(2.0, -2.0), vec2f(4.0, -4.0), vec2f(8.0, -8.0));
            let k = i32(a[0]);
            o[0] = t[k].x;
            t[k].y = 5.0;
            o[1] = t[1].y; o[2] = t[3].y; o[3] = t[1].x;
            o[4 + k] = 9.0;
        }";
    let b = Bindings::<Accept>::new()
        .scalars(0, 0, vec![Scalar::Float(Interval::new(1.0, 2.0))])
        .floats(0, 1, &[0.0; 8]);
    let got = dispatch(source, b).0.read_floats(0, 1).unwrap();
    let pairs: Vec<_> = got.iter().map(|x| (x.lo, x.hi)).collect();
    assert_eq!(
        pairs,
        [
            (2.0, 4.0),
            (-2.0, 5.0),
            (-8.0, -8.0),
            (2.0, 2.0),
            (0.0, 0.0),
            (0.0, 9.0),
            (0.0, 9.0),
            (0.0, 0.0)
        ]
    );
}

#[test]
fn out_of_bounds_accesses_follow_the_rules() {
    let source = "
        @group(0) @binding(0) var<storage, read> a: array<f32>;
        @group(0) @binding(1) var<storage, read_write> o: array<f32>;
        @compute @workgroup_size(1) fn main() {
            var t = array<f32, 2>(1.0, 2.0);
            let k = i32(a[0]);
            t[k] = 50.0;
            o[k] = 60.0;
            o[0] = t[k] + t[0];
            o[1] = a[k];
        }";
    let run = || {
        Bindings::<F32>::new()
            .floats(0, 0, &[9.0])
            .floats(0, 1, &[0.0; 2])
    };
    let (b, outcome) = dispatch(source, run());
    // Reads are clamped to the last element, writes dropped.
    assert_eq!(b.read_floats(0, 1).unwrap(), [3.0, 9.0]);
    assert_eq!(outcome.counters.out_of_bounds, 4);
    let b = Bindings::<Accept>::new()
        .floats(0, 0, &[-1.0])
        .floats(0, 1, &[0.0; 2]);
    assert!(dispatch(source, b).0.read_floats(0, 1).unwrap()[0].is_indeterminate());
}

#[test]
fn workgroup_memory_under_an_undecided_condition_is_weak() {
    let source = "
        @group(0) @binding(0) var<storage, read> a: array<f32>;
        @group(0) @binding(1) var<storage, read_write> o: array<f32>;
        var<workgroup> w: array<f32, 4>;
        @compute @workgroup_size(4) fn main(@builtin(local_invocation_index) l: u32) {
            w[l] = 1.0;
            workgroupBarrier();
            if (a[0] + a[1] >= a[2]) { w[l] = 5.0; }
            workgroupBarrier();
            o[l] = w[3u - l];
        }";
    let b = Bindings::<Accept>::new()
        .floats(0, 0, &[0.1, 0.2, 0.3])
        .floats(0, 1, &[0.0; 4]);
    for x in dispatch(source, b).0.read_floats(0, 1).unwrap() {
        assert_eq!((x.lo, x.hi), (1.0, 5.0));
    }
}

#[test]
fn results_do_not_depend_on_the_batch() {
    let body = "var s = 0.0; for (var k = 0; k < 40; k++) { if (f32(k) * 0.1 > a[i]) { break; } s += a[i] * 0.3; } o[i] = s;";
    let inputs: Vec<f32> = (0..200).map(|k| k as f32 * 0.0171).collect();
    let all = probe::<Accept>(body, &inputs, 200);
    for k in [0, 63, 64, 150] {
        let alone = probe::<Accept>(body, &inputs[k..], 1);
        assert_eq!(alone[0], all[k]);
    }
    let points = probe::<F32>(body, &inputs, 200);
    assert!(all.iter().zip(points).all(|(x, p)| x.contains(p)));
}

#[test]
fn one_invocation_budget_is_an_error_that_names_it() {
    let p = program(&crate::common::probe_source(
        "var x = 0.0; loop { x += 1.0; if (x < 0.0) { break; } } o[i] = x;",
    ));
    let limits = Limits {
        operations: 10_000,
        ..Limits::default()
    };
    let mut b = Bindings::<F32>::new().floats(0, 0, &[0.0]).floats(0, 1, &[0.0]);
    let error = run_compute(&p, &mut b, [1, 1, 1], &limits).unwrap_err();
    assert!(error.to_string().contains("10000 operations"), "{error}");
    assert!(error.span().is_some());
}

/// Loads of a vector and of its first component are different loads, in either order.
#[test]
fn a_vector_and_its_first_component_are_loaded_apart() {
    let source = "struct S { v: vec4f, m: mat2x2f, w: vec3f }
        @group(0) @binding(0) var<uniform> u: S;
        @group(0) @binding(1) var<storage, read_write> o: array<f32>;
        @compute @workgroup_size(1) fn main() {
            let x = u.v.x; let zw = u.v.zw;
            let w = u.w; let wx = u.w.x;
            let column = u.m[0]; let corner = u.m[0].x;
            let both = vec4f(u.v.x, wx, corner, 0.5) + vec4f(u.w, u.w.x);
            o[0] = x + 10.0 * zw.x + 100.0 * zw.y;
            o[1] = w.z + 10.0 * wx;
            o[2] = column.y + 10.0 * corner;
            o[3] = both.x; o[4] = both.y; o[5] = both.z; o[6] = both.w;
        }";
    let b = Bindings::<F32>::new()
        .floats(
            0,
            0,
            &[1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0, 10.0, 11.0, 0.0],
        )
        .floats(0, 1, &[0.0; 7]);
    let (b, _) = dispatch(source, b);
    assert_eq!(
        b.read_floats(0, 1).unwrap(),
        [431.0, 101.0, 56.0, 10.0, 19.0, 16.0, 9.5]
    );
}

/// What forks cost is paid from the budget too: loops of undecided length in each other end, or say that they do not.
#[test]
fn forks_are_paid_for() {
    let p = program(&crate::common::probe_source(
        "var t: array<f32, 256>;
         for (var k = 0u; k < 200u; k++) { for (var j = 0u; j < 200u; j++) { if (a[0] < t[j]) { t[k] += a[0]; } } }
         o[i] = t[7];",
    ));
    let ranges = vec![range_scalar::<Range>(-1.0, 1.0).unwrap()];
    let limits = Limits {
        operations: 300_000,
        ..Limits::default()
    };
    let b = || {
        Bindings::<Range>::new()
            .scalars(0, 0, ranges.clone())
            .floats(0, 1, &[0.0])
    };
    let error = run_compute(&p, &mut b(), [1, 1, 1], &limits).unwrap_err();
    assert!(matches!(error, Error::Budget { .. }), "{error}");
    // Negative control: without forks the same loops fit.
    let mut point = Bindings::<F32>::new().floats(0, 0, &[0.5]).floats(0, 1, &[0.0]);
    assert!(
        run_compute(
            &p,
            &mut point,
            [1, 1, 1],
            &Limits {
                operations: 1_000_000,
                ..limits
            }
        )
        .is_ok()
    );
}

/// Behind a guard that returns early, and in both ways of a condition, a float is what the condition says.
#[test]
fn conditions_narrow_what_they_compare() {
    let of = |body: &str, lo: f32, hi: f32| {
        let shader = format!(
            "@fragment fn main(@location(0) x: f32) -> @location(0) vec4f {{ return vec4f(f(x), x, 0.0, 0.0); }}
             fn f(x: f32) -> f32 {{ {body} }}"
        );
        let range = Interval::new(f64::from(lo), f64::from(hi));
        let input = StageInputs::<Accept>::new(1).location(0, 1, &[range]);
        let (outputs, _) = bossage_bounds::run_fragment(
            &program(&shader),
            &mut Bindings::new(),
            &input,
            &Limits::default(),
        )
        .unwrap();
        let all = outputs.location(0, 0).unwrap();
        // Where the ways have met again it is what it was, and not forked.
        assert_eq!(all[1], range);
        all[0]
    };
    let guarded = of("if (x < 0.25) { return 4.0; } return 1.0 / x;", 0.0, 1.0);
    assert!(
        guarded.flags.is_none() && guarded.hi <= 4.0 + 1e-5 && guarded.lo > 0.99,
        "{guarded:?}"
    );
    assert!(guarded.is_forked());
    let either = of(
        "if (!(x > 0.25)) { return 4.0 + 0.0 * x; } else { return 1.0 / x; }",
        0.0,
        1.0,
    );
    assert!(either.flags.is_none() && either.hi <= 4.0 + 1e-5, "{either:?}");
    // Without the guard, or with the guard after the division, nothing is known.
    assert!(of("return 1.0 / x;", 0.0, 1.0).is_indeterminate());
    assert!(
        of(
            "let y = 1.0 / x; if (x < 0.25) { return 4.0; } return y;",
            0.0,
            1.0
        )
        .is_indeterminate()
    );
    // Zero is not among what is at least the smallest normal number, but it is among what is above zero.
    assert!(
        of(
            "if (x < 1.17549435e-38) { return 0.0; } return log2(x);",
            0.0,
            1.0
        )
        .flags
        .is_none()
    );
    assert!(of("if (x <= 0.0) { return 0.0; } return log2(x);", 0.0, 1.0).is_indeterminate());
}

/// What one way of a loop knows is not known any more where all ways meet.
#[test]
fn what_was_narrowed_is_widened_where_ways_meet() {
    let shader = "@fragment fn main(@location(0) x: f32) -> @location(0) vec4f {
        var sum = 0.0;
        for (var i = 0; i < 3; i++) {
            if (x < 0.5) { continue; }
            sum += x;
        }
        return vec4f(x, sum, 0.0, 0.0);
    }";
    let range = Interval::new(0.0, 1.0);
    let input = StageInputs::<Accept>::new(1).location(0, 1, &[range]);
    let (outputs, _) =
        bossage_bounds::run_fragment(&program(shader), &mut Bindings::new(), &input, &Limits::default())
            .unwrap();
    let all = outputs.location(0, 0).unwrap();
    assert_eq!(all[0], range);
    assert!(all[1].contains(0.0) && all[1].contains(3.0), "{:?}", all[1]);
}
