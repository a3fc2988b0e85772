//! Attribution: the line that dominates an error bound is named, and no other.

use crate::common::module as module_of;
use bossage_bounds::{Accept, Attribution, Limits, Program, attribution, run_probe};

/// Of `cos(t) * 2`, added to a value of the other line: the sine family has an absolute error of 2^-11, a product one rounding.
fn shader(first: &str, second: &str) -> String {
    format!(
        "@group(0) @binding(0) var<storage, read> inputs: array<f32>;
@group(0) @binding(1) var<storage, read_write> outputs: array<f32>;
@compute @workgroup_size(1) fn main() {{
    let x = inputs[0];
    let a = {first};
    let b = {second};
    outputs[0] = a + b;
}}"
    )
}

fn attribute(text: &str, x: f32) -> Option<Attribution> {
    let (module, info) = module_of(text);
    let program = Program::new(&module, &info, "main").unwrap();
    attribution(&program, text, &Limits::default(), |limits| {
        run_probe::<Accept>(&program, &[x], 1, 1, limits).map(|(outputs, _)| outputs[0])
    })
    .unwrap()
}

fn share(attribution: &Attribution, line: usize) -> f64 {
    let found = attribution.lines.iter().find(|one| one.line == line);
    found.map_or(0.0, |one| one.share)
}

#[test]
fn the_line_that_dominates_is_named() {
    let one = attribute(&shader("cos(x)", "x * 1.1"), 0.7).unwrap();
    assert!(share(&one, 5) > 0.99, "{one:?}");
    assert!(share(&one, 6) < 0.01, "{one:?}");
    let other = attribute(&shader("x * 1.1", "cos(x)"), 0.7).unwrap();
    assert!(share(&other, 6) > 0.99 && share(&other, 5) < 0.01, "{other:?}");
}

#[test]
fn equal_lines_have_equal_shares() {
    let even = attribute(&shader("cos(x)", "cos(x) * 1.0"), 0.7).unwrap();
    for line in [5, 6] {
        assert!((share(&even, line) - 0.5).abs() < 0.01, "{even:?}");
    }
}

/// The difference magnifies what came before it: it is exact itself, and the error belongs to the lines of its operands.
#[test]
fn cancellation_is_charged_to_what_was_rounded_before() {
    let text = shader("x * x", "-(x * 0.7)");
    let found = attribute(&text, 0.7).unwrap();
    assert!(share(&found, 5) > 0.2 && share(&found, 6) > 0.2, "{found:?}");
    assert!(share(&found, 7) < 0.01, "{found:?}");
}

#[test]
fn what_is_exact_or_open_has_nothing_to_attribute() {
    assert_eq!(attribute(&shader("abs(x)", "0.0"), 0.5), None);
    assert_eq!(attribute(&shader("1.0 / (x - x)", "0.0"), 0.5), None);
}
