//! The numeric lint: for each rule a shader in which it fires with a witness that really does it, and a guarded twin in which it stays
//! silent.

use crate::common::module;
use bossage_bounds::lint::{Finding, Options, Report, Rule, lint};
use bossage_bounds::ranges::{Declared, Inputs};
use bossage_bounds::{Bindings, F32, Limits, Program, run_compute};
use std::time::Duration;

/// Nothing depends on the clock: counts end the work long before the time does.
fn options() -> Options {
    Options {
        points: 2048,
        time: Duration::from_secs(600),
        ..Options::default()
    }
}

/// A compute shader of one invocation: inputs `a`, outputs `o`, functions before the body.
fn shader(functions: &str, body: &str) -> String {
    format!(
        "@group(0) @binding(0) var<storage, read> a: array<f32>;\n\
         @group(0) @binding(1) var<storage, read_write> o: array<f32>;\n\
         {functions}\n\
         @compute @workgroup_size(1) fn main() {{\n{body}\n}}"
    )
}

struct Linted {
    source: String,
    inputs: Inputs,
    report: Report,
}

fn linted(source: String, ranges: &str) -> Linted {
    let (module, info) = module(&source);
    let sidecar =
        format!("schema = 1\n[ranges]\na = {{ size = 8, lo = -10, hi = 10 }}\no = {{ size = 4 }}\n{ranges}");
    let declared = Declared::parse("test", &sidecar).unwrap_or_else(|e| panic!("{e}"));
    let inputs = Inputs::new(&module, &info, "main", Some(&declared)).unwrap_or_else(|e| panic!("{e}"));
    let program = Program::new(&module, &info, "main").unwrap_or_else(|e| panic!("{e}"));
    let report = lint(&program, &inputs, &options());
    Linted {
        source,
        inputs,
        report,
    }
}

impl Linted {
    fn find(&self, rule: Rule) -> Option<&Finding> {
        self.report.findings.iter().find(|f| f.rule == rule)
    }

    /// The text from where a finding points to the end of the line: of a call, naga's span holds the name alone.
    fn at(&self, finding: &Finding) -> &str {
        let rest = finding
            .span
            .to_range()
            .map_or("", |range| &self.source[range.start..]);
        rest.lines().next().unwrap_or("")
    }

    /// What the shader writes at a witness, run anew from the reported numbers alone.
    fn outputs(&self, finding: &Finding) -> Vec<f64> {
        let witness = finding.witness.as_ref().expect("a witness");
        let values: Vec<f32> = witness
            .inputs
            .iter()
            .flat_map(|(_, v)| v)
            .map(|x| *x as f32)
            .collect();
        assert_eq!(values.len(), self.inputs.scalars.len());
        let (module, info) = module(&self.source);
        let program = Program::new(&module, &info, "main").unwrap_or_else(|e| panic!("{e}"));
        let mut bindings = Bindings::<F32>::new()
            .floats(0, 0, &values)
            .floats(0, 1, &[0.0; 4]);
        run_compute(&program, &mut bindings, [1, 1, 1], &Limits::default()).unwrap_or_else(|e| panic!("{e}"));
        bindings.read_floats(0, 1).unwrap_or_default()
    }
}

/// The rule fires with a witness at the marked text, and the outputs there show it.
#[track_caller]
fn fires(rule: Rule, at: &str, source: &str, shows: impl Fn(&[f64]) -> bool) {
    let linted = linted(source.to_owned(), "");
    let finding = linted
        .find(rule)
        .unwrap_or_else(|| panic!("{} does not fire: {:?}", rule.id(), linted.report));
    assert!(
        linted.at(finding).starts_with(at),
        "{} {:?}",
        linted.at(finding),
        linted.report
    );
    let outputs = linted.outputs(finding);
    assert!(shows(&outputs), "{outputs:?} for {:?}", finding.witness);
}

/// Nothing at all is found, and the walk saw everything.
#[track_caller]
fn clean(source: &str) {
    let linted = linted(source.to_owned(), "");
    let found: Vec<(&str, &str)> = linted
        .report
        .findings
        .iter()
        .map(|f| (f.rule.id(), linted.at(f)))
        .collect();
    assert!(
        found.is_empty() && !linted.report.unfinished,
        "{:?}",
        linted.report
    );
}

fn not_finite(outputs: &[f64]) -> bool {
    outputs.iter().any(|x| !x.is_finite())
}

#[test]
fn division_by_zero() {
    fires(
        Rule::DivisionByZero,
        "1.0 / (a[0] - a[1])",
        &shader("", "o[0] = 1.0 / (a[0] - a[1]);"),
        not_finite,
    );
    clean(&shader(
        "",
        "let d = a[0] - a[1];\nif (abs(d) > 1e-6) { o[0] = 1.0 / d; }",
    ));
    clean(&shader("", "o[0] = 1.0 / max(abs(a[0]), 0.01);"));
    clean(&shader("", "o[0] = 1.0 / (a[0] * a[0] + 1.0);"));
}

#[test]
fn a_guard_in_another_function_or_variable_counts() {
    let functions =
        "fn inverse(x: f32) -> f32 { var y = x; if (!(y > 0.5)) { return 0.0; } return 1.0 / y; }";
    clean(&shader(functions, "o[0] = inverse(a[0]);"));
    let functions = "fn safe(x: f32) -> bool { return x >= 0.5 && x < 4.0; }";
    clean(&shader(functions, "if (safe(a[0])) { o[0] = log(a[0]) / a[0]; }"));
}

#[test]
fn a_guard_that_guards_something_else_does_not_count() {
    let source = shader("", "if (a[1] > 0.5) { o[0] = 1.0 / a[0]; }");
    fires(Rule::DivisionByZero, "1.0 / a[0]", &source, not_finite);
    let source = shader(
        "",
        "var y = a[0]; if (y > 0.5) { y -= 0.5 + a[1] * 0.0; y -= a[2]; o[0] = 1.0 / y; }",
    );
    fires(Rule::DivisionByZero, "1.0 / y", &source, not_finite);
}

#[test]
fn normalise_zero() {
    let source = shader("", "let v = vec3f(a[0], a[1], a[2]);\no[0] = normalize(v).x;");
    fires(Rule::NormaliseZero, "normalize(v)", &source, not_finite);
    clean(&shader(
        "",
        "let v = vec3f(a[0], a[1], a[2]);\nif (dot(v, v) > 1e-20) { o[0] = normalize(v).x; }",
    ));
    clean(&shader(
        "",
        "let v = vec3f(a[0], a[1], a[2]);\nif (length(v) > 1e-8) { o[0] = normalize(v).x; }",
    ));
    clean(&shader("", "o[0] = normalize(vec3f(a[0], a[1], 1.0)).x;"));
}

#[test]
fn root_domain() {
    fires(
        Rule::RootDomain,
        "sqrt(1.0 - a[0] * a[0])",
        &shader("", "o[0] = sqrt(1.0 - a[0] * a[0]);"),
        not_finite,
    );
    fires(
        Rule::RootDomain,
        "inverseSqrt(abs(a[0]))",
        &shader("", "o[0] = inverseSqrt(abs(a[0]));"),
        not_finite,
    );
    clean(&shader("", "o[0] = sqrt(max(1.0 - a[0] * a[0], 0.0));"));
    clean(&shader("", "o[0] = inverseSqrt(abs(a[0]) + 1e-6);"));
}

#[test]
fn logarithm_domain() {
    fires(
        Rule::LogarithmDomain,
        "log2(abs(a[0]))",
        &shader("", "o[0] = log2(abs(a[0]));"),
        not_finite,
    );
    clean(&shader("", "o[0] = log2(abs(a[0]) + 1.0);"));
}

#[test]
fn power_domain() {
    // The language leaves the power of zero open, whatever a perfect machine says: the base is the evidence.
    fires(
        Rule::PowerDomain,
        "pow(x, 2.0)",
        &shader("", "let x = max(a[0], 0.0); o[1] = x; o[0] = pow(x, 2.0);"),
        |o| o[1] == 0.0,
    );
    clean(&shader("", "if (a[0] > 1e-6) { o[0] = pow(a[0], 2.0); }"));
}

#[test]
fn arc_domain() {
    fires(
        Rule::ArcDomain,
        "acos(a[0])",
        &shader("", "o[0] = acos(a[0]);"),
        not_finite,
    );
    fires(
        Rule::ArcDomain,
        "atan2(a[0], a[1])",
        &shader("", "o[1] = a[0]; o[2] = a[1]; o[0] = atan2(a[0], a[1]);"),
        |o| o[1].abs() < 1.2e-38 && o[2].abs() < 1.2e-38,
    );
    clean(&shader("", "o[0] = acos(clamp(a[0], -1.0, 1.0));"));
}

#[test]
fn overflow() {
    fires(
        Rule::Overflow,
        "exp(a[0] * 10.0)",
        &shader("", "o[0] = exp(a[0] * 10.0);"),
        not_finite,
    );
    clean(&shader("", "o[0] = exp(a[0]);"));
}

#[test]
fn nan_output() {
    let source = shader("", "let x = a[0] / a[1];\no[0] = x * 2.0;");
    fires(Rule::NanOutput, "a[0] / a[1]", &source, |o| o[0].is_nan());
    // The quotient may be NaN and no output is.
    let linted = linted(
        shader("", "let x = a[0] / a[1];\nif (x > 1.0) { o[0] = 1.0; }"),
        "",
    );
    assert!(linted.find(Rule::NanOutput).is_none() && linted.find(Rule::DivisionByZero).is_some());
}

#[test]
fn unbounded_loop() {
    let endless = shader(
        "",
        "var x = 0.0;\nwhile (x < 1.0) { x += max(a[0], 0.0); }\no[0] = x;",
    );
    let linted = linted(endless, "");
    let finding = linted.find(Rule::UnboundedLoop).expect("it can run for ever");
    assert!(finding.witness.is_some(), "{:?}", linted.report);
    clean(&shader(
        "",
        "var x = 0.0;\nfor (var i = 0; i < 64; i++) { if (x >= 1.0) { break; } x += max(a[0], 0.0); }\no[0] = 1.0;",
    ));
}

#[test]
fn a_loop_whose_end_cannot_be_shown_says_that_no_witness_was_found() {
    let source = shader(
        "",
        "var x = 1.0;\nwhile (x < 1000.0) { x += abs(a[0]) * 0.1 + 0.25; }\no[0] = x;",
    );
    let linted = linted(source, "");
    let finding = linted
        .find(Rule::UnboundedLoop)
        .unwrap_or_else(|| panic!("{:?}", linted.report));
    assert!(finding.witness.is_none() && linted.report.unfinished);
}

#[test]
fn cancellation() {
    let source = shader(
        "",
        "let x = a[0] * 1000.0;\nlet s = sqrt(x * x + 1.0);\no[0] = 1.0 / (s - abs(x));",
    );
    let linted = linted(source, "\"a[0]\" = { lo = 1, hi = 10 }");
    let finding = linted
        .find(Rule::Cancellation)
        .unwrap_or_else(|| panic!("{:?}", linted.report));
    assert!(
        linted.at(finding).starts_with("s - abs(x)"),
        "{}",
        linted.at(finding)
    );
    assert!(finding.witness.is_some());
}

#[test]
fn the_same_without_cancellation_is_clean() {
    let source = shader(
        "",
        "let x = a[0] * 1000.0;\nlet s = sqrt(x * x + 1.0);\no[0] = s + abs(x);",
    );
    let linted = linted(source, "\"a[0]\" = { lo = 1, hi = 10 }");
    assert!(linted.report.findings.is_empty(), "{:?}", linted.report);
}

#[test]
fn unit_vectors_stay_unit_vectors() {
    let unit = "\"a[0..3]\" = { unit = true }\n\"a[3..6]\" = { unit = true }";
    let source = shader(
        "",
        "let n = vec3f(a[0], a[1], a[2]); let l = vec3f(a[3], a[4], a[5]);\no[0] = 1.0 / (dot(n, l) + 1.001);\no[1] = normalize(n).x;",
    );
    let linted_unit = linted(source.clone(), unit);
    assert!(linted_unit.report.findings.is_empty(), "{:?}", linted_unit.report);
    assert!(
        !linted(source, "").report.findings.is_empty(),
        "negative control: any vectors"
    );
}

#[test]
fn equal_seeds_find_equal_witnesses() {
    let source = shader("", "o[0] = normalize(vec2f(a[0], a[1])).x + log(a[2]);");
    assert_eq!(linted(source.clone(), "").report, linted(source, "").report);
}

#[test]
fn fragments_and_vertices_are_linted_at_their_inputs() {
    let source = "@group(0) @binding(0) var t: texture_2d<f32>;\n@group(0) @binding(1) var s: sampler;\n\
        @fragment fn main(@location(0) uv: vec2f, @location(1) light: vec3f) -> @location(0) vec4f {\n\
        let n = textureSample(t, s, uv).xyz * 2.0 - 1.0;\nreturn vec4f(dot(normalize(n), normalize(light)));\n}";
    let (module, info) = module(source);
    let inputs = Inputs::new(&module, &info, "main", None).unwrap_or_else(|e| panic!("{e}"));
    let program = Program::new(&module, &info, "main").unwrap_or_else(|e| panic!("{e}"));
    let report = lint(&program, &inputs, &options());
    let texts: Vec<&str> = report
        .findings
        .iter()
        .filter(|f| f.rule == Rule::NormaliseZero && f.witness.is_some())
        .filter_map(|f| f.span.to_range().map(|r| &source[r.start..r.start + 12]))
        .collect();
    assert_eq!(texts, ["normalize(n)", "normalize(li"], "{report:?}");
}

#[test]
fn what_later_rounds_of_a_loop_do_is_seen() {
    let source = shader(
        "",
        "var x = 4.0;\nfor (var i = 0; i < 4; i++) { o[0] = 1.0 / x; x -= 1.5 - a[0] * 0.0; }\no[1] = 1.0 / (x + 2.0 + a[1]);",
    );
    let linted = linted(source, "");
    let finding = linted
        .find(Rule::DivisionByZero)
        .unwrap_or_else(|| panic!("{:?}", linted.report));
    assert!(
        linted.at(finding).starts_with("1.0 / (x + 2.0"),
        "{:?}",
        linted.report
    );
    let source = shader(
        "",
        "var x = 3.0;\nfor (var i = 0; i < 4; i++) { o[0] = 1.0 / (x + a[0] * 0.01); x -= 1.0; }",
    );
    fires(Rule::DivisionByZero, "1.0 / (x +", &source, |o| {
        o.iter().all(|x| !x.is_nan())
    });
}
