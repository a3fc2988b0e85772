//! Shaders that ask too much: endless, nested too deeply, too long, with indices out of bounds. Each is answered, none ends the program.

mod tool;

use std::fs;
use std::time::{Duration, Instant};

use tool::{Run, command, text};

/// Longer than any of these takes, even on a busy machine.
const PATIENCE: Duration = Duration::from_secs(120);

/// Checks a shader with a second for its numbers.
fn check(source: &str) -> Run {
    let folder = tempfile::tempdir().unwrap();
    let (shader, cache) = (folder.path().join("a.wgsl"), folder.path().join("cache"));
    fs::write(&shader, source).unwrap();
    let arguments = [
        "check",
        text(&shader),
        "--lint-time",
        "1",
        "--cache",
        text(&cache),
    ];
    let start = Instant::now();
    // A program that was ended by a signal has no exit code, which `Run` does not take.
    let run: Run = command(&arguments).output().expect("the binary starts").into();
    assert!(start.elapsed() < PATIENCE, "{:?}", start.elapsed());
    assert!(!run.stderr.contains("panicked"), "{}", run.stderr);
    run
}

const FRAGMENT: &str = "@fragment fn main(@location(0) x: f32) -> @location(0) vec4f {";

#[test]
fn an_endless_loop_is_named_with_the_budget() {
    let run = check(
        "@group(0) @binding(0) var<storage, read_write> o: array<f32>;
@compute @workgroup_size(1) fn main() {
    var k = 0u;
    loop { k = k + 1u; if (k == 0u) { k = 5u; } o[0] = f32(k); if (o[0] < 0.0) { break; } }
}",
    );
    assert!(run.stdout.contains("unbounded_loop"), "{}", run.stdout);
    assert!(
        run.stdout.contains("more than 1048576 operations"),
        "{}",
        run.stdout
    );
}

#[test]
fn indices_out_of_bounds_follow_the_language() {
    check(
        "@group(0) @binding(0) var<storage, read_write> o: array<f32>;
@group(0) @binding(1) var<storage, read> a: array<i32, 4>;
var<private> t: array<f32, 3> = array<f32, 3>(1.0, 2.0, 3.0);
@compute @workgroup_size(1) fn main() {
    let i = a[0];
    t[i + 100] = 4.0;
    o[u32(i) * 40000u] = t[i - 50] + f32(a[i]);
    var v = vec3f(1.0);
    v[i + 7] = 2.0;
    o[0] = v[i * 1000] + v.x;
}",
    )
    .exits(0);
}

#[test]
fn recursion_is_refused_with_a_caret() {
    let run = check(&format!(
        "fn f(x: f32) -> f32 {{ return g(x); }}\nfn g(x: f32) -> f32 {{ return f(x); }}\n{FRAGMENT} return vec4f(f(x)); }}"
    ));
    assert!(
        run.stdout.contains("cyclic") && run.stdout.contains("2:4"),
        "{}",
        run.stdout
    );
    run.exits(2);
}

#[test]
fn a_long_chain_of_calls_is_checked_or_refused() {
    let mut source = String::from("fn g0(x: f32) -> f32 { return x; }\n");
    for k in 1..2000 {
        source += &format!("fn g{k}(x: f32) -> f32 {{ return g{}(x) + 1.0; }}\n", k - 1);
    }
    check(&format!("{source}{FRAGMENT} return vec4f(g1999(x)); }}"));
}

#[test]
fn a_sum_of_thousands_of_terms_does_not_end_the_program() {
    let sum = "x + ".repeat(20_000);
    check(&format!("{FRAGMENT} return vec4f({sum}x); }}"));
}

#[test]
fn nesting_that_is_too_deep_is_refused() {
    let parentheses = format!(
        "{FRAGMENT} return vec4f({}x{}); }}",
        "(".repeat(20_000),
        ")".repeat(20_000)
    );
    let run = check(&parentheses).exits(2);
    assert!(run.stdout.contains("limit"), "{}", run.stdout);
    let blocks = format!(
        "{FRAGMENT} var y = x; {}{} return vec4f(y); }}",
        "if (y > 0.0) { y -= 1.0; ".repeat(3000),
        "}".repeat(3000)
    );
    let run = check(&blocks).exits(2);
    assert!(run.stdout.contains("nesting limit"), "{}", run.stdout);
}

#[test]
fn an_array_that_no_machine_has_room_for_is_refused() {
    let run = check(&format!(
        "var<private> t: array<array<f32, 60000>, 60000>;\n{FRAGMENT} t[3][4] = x; return vec4f(t[u32(x)][2]); }}"
    ));
    assert!(run.stdout.contains("exceeds limit"), "{}", run.stdout);
    run.exits(2);
}
