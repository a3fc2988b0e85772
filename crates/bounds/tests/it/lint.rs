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

/// What cancels is named where it cancels, however far the quotient or the direction is that fails for it.
#[test]
fn vanishing_sum() {
    let functions = "fn direction(v: vec2f) -> vec2f { return normalize(v); }";
    let source = shader(
        functions,
        "let sum = vec2f(a[0], a[1]) + vec2f(a[2], a[3]);\no[0] = direction(sum).x;",
    );
    fires(Rule::VanishingSum, "vec2f(a[0], a[1]) +", &source, not_finite);
    // The sum may be zero, and nothing is worse for it.
    clean(&shader(
        "",
        "let sum = a[0] + a[1];\no[0] = 1.0 / (sum * sum + 1.0);",
    ));
    clean(&shader(
        "",
        "let d = a[0] - a[1];\nif (abs(d) > 1e-6) { o[0] = 1.0 / d; }",
    ));
}

/// Another sum that is zero at the same input is not blamed.
#[test]
fn a_sum_that_causes_nothing_is_not_named() {
    let source = shader("", "let other = a[1] - a[2];\no[0] = 1.0 / a[0] + other;");
    let linted = linted(source, "");
    assert!(linted.find(Rule::DivisionByZero).is_some(), "{:?}", linted.report);
    assert!(linted.find(Rule::VanishingSum).is_none(), "{:?}", linted.report);
}

/// A loop over an index list, whose terms cancel only together.
#[test]
fn terms_that_are_gathered_cancel_too() {
    let source = shader(
        "",
        "var sum = vec2f(0.0);\nfor (var i = 0u; i < 4u; i++) { sum += vec2f(a[2u * i], a[2u * i + 1u]); }\no[0] = normalize(sum).x;",
    );
    fires(Rule::VanishingSum, "sum += vec2f(a[2u * i]", &source, not_finite);
}

#[test]
fn underflow() {
    let small = "\"a[0]\" = { lo = 1e-30, hi = 1e-25 }";
    let source = shader(
        "",
        "let v = vec2f(a[0], 0.0);\no[0] = v.x / sqrt(v.x * v.x + v.y * v.y);",
    );
    let found = linted(source.clone(), small);
    let finding = found
        .find(Rule::Underflow)
        .unwrap_or_else(|| panic!("{:?}", found.report));
    assert!(
        found.at(finding).starts_with("v.x * v.x"),
        "{}",
        found.at(finding)
    );
    assert!(not_finite(&found.outputs(finding)), "{:?}", finding.witness);
    let large = "\"a[0]\" = { lo = 1e-15, hi = 1 }";
    assert!(linted(source, large).find(Rule::Underflow).is_none());
}

/// Digits that are lost to inputs' own rounding are no fault of the formula, unless what is left is divided by without a look at it.
#[test]
fn a_difference_of_rounded_products_that_is_divided_by() {
    let body = "let area = a[0] * a[3] - a[1] * a[2];\n";
    let wide = "\"a[0..2]\" = { lo = -8, hi = 8 }\n\"a[2..4]\" = { lo = -8, hi = 8 }";
    let found = linted(shader("", &format!("{body}o[0] = a[4] / area;")), wide);
    let finding = found
        .find(Rule::Cancellation)
        .unwrap_or_else(|| panic!("{:?}", found.report));
    assert!(
        found.at(finding).starts_with("a[0] * a[3] - a[1] * a[2]"),
        "{}",
        found.at(finding)
    );
    let guard = "if (abs(area) <= max(1e-6 * (abs(a[0] * a[3]) + abs(a[1] * a[2])), 1e-30)) { return; }\n";
    let guarded = linted(shader("", &format!("{body}{guard}o[0] = a[4] / area;")), wide);
    assert!(guarded.report.findings.is_empty(), "{:?}", guarded.report);
    let harmless = linted(shader("", &format!("{body}o[0] = area;")), wide);
    assert!(harmless.report.findings.is_empty(), "{:?}", harmless.report);
}

/// One vector's own components: no normal close by has such a tangent.
#[test]
fn a_vector_that_cancels_against_itself() {
    let unit = "\"a[0..3]\" = { unit = true }";
    let body = |across: &str| {
        shader(
            "",
            &format!(
                "let n = vec3f(a[0], a[1], a[2]);\nlet t = cross(n, {across});\nlet l = dot(t, t);\n\
                 if (l > 1e-30) {{ let d = t * inverseSqrt(l); o[0] = d.x; o[1] = d.y; o[2] = d.z; }}"
            ),
        )
    };
    let found = linted(body("vec3f(n.y, -n.z, n.x)"), unit);
    let finding = found
        .find(Rule::Cancellation)
        .unwrap_or_else(|| panic!("{:?}", found.report));
    assert!(found.at(finding).starts_with("cross(n"), "{}", found.at(finding));
}

/// No operation errs in 1 + n.z, but near −1 only the last digits of n.z are left in it.
#[test]
fn an_input_near_a_constant() {
    let unit = "\"a[0..3]\" = { unit = true }";
    let source = shader(
        "",
        "let n = vec3f(a[0], a[1], a[2]);\nif (n.z > -0.99999994) { o[0] = n.x * n.y / (1.0 + n.z); }",
    );
    let found = linted(source, unit);
    let finding = found
        .find(Rule::Cancellation)
        .unwrap_or_else(|| panic!("{:?}", found.report));
    assert!(
        found.at(finding).starts_with("1.0 + n.z"),
        "{}",
        found.at(finding)
    );
    let away = shader(
        "",
        "let n = vec3f(a[0], a[1], a[2]);\nif (n.z >= 0.0) { o[0] = n.x * n.y / (1.0 + n.z); }",
    );
    assert!(linted(away, unit).report.findings.is_empty());
    let harmless = shader("", "o[0] = 1.0 + a[2];");
    assert!(linted(harmless, unit).report.findings.is_empty());
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
