//! Small random programs: every domain evaluates them without a panic, and the acceptance interval contains the machine's result.

use crate::common::module;
use bossage_bounds::{Accept, Bindings, Error, F32, F64, Limits, Program, Range, run_probe, run_probe_with};
use proptest::prelude::*;
use proptest::strategy::ValueTree;

fn float_expression() -> impl Strategy<Value = String> {
    let leaf = prop_oneof![
        Just("x".to_string()),
        Just("y".to_string()),
        Just("v.z".to_string()),
        Just("f32(n)".to_string()),
        (-40i32..40).prop_map(|k| format!("{:?}", f64::from(k) / 8.0)),
        Just("t[u32(n) & 3u]".to_string()),
    ];
    leaf.prop_recursive(4, 24, 3, |inner| {
        prop_oneof![
            (
                inner.clone(),
                prop::sample::select(vec!["+", "-", "*", "/", "%"]),
                inner.clone()
            )
                .prop_map(|(a, o, b)| format!("({a} {o} {b})")),
            (
                prop::sample::select(vec![
                    "sin", "sqrt", "exp", "abs", "floor", "fract", "log2", "sign", "atan"
                ]),
                inner.clone()
            )
                .prop_map(|(f, a)| format!("{f}({a})")),
            (
                prop::sample::select(vec!["min", "max", "pow", "step", "atan2"]),
                inner.clone(),
                inner.clone()
            )
                .prop_map(|(f, a, b)| format!("{f}({a}, {b})")),
            (inner.clone(), inner.clone(), inner.clone())
                .prop_map(|(a, b, c)| format!("select({a}, {b}, {c} > 0.25)")),
            (inner.clone(), inner.clone(), inner.clone()).prop_map(|(a, b, c)| format!("mix({a}, {b}, {c})")),
            (inner.clone(), inner).prop_map(|(a, b)| format!("dot(vec2f({a}, y), vec2f(x, {b}))")),
        ]
    })
}

fn statement() -> impl Strategy<Value = String> {
    let leaf = prop_oneof![
        float_expression().prop_map(|e| format!("x = {e};")),
        float_expression().prop_map(|e| format!("v.y = {e}; y = length(v);")),
        float_expression().prop_map(|e| format!("t[u32(n) % 4u] = {e};")),
        float_expression().prop_map(|e| format!("n = i32({e}) ^ n;")),
        float_expression().prop_map(|e| format!("o[i] = {e};")),
        Just("n = n * 3 - (n >> 2u);".to_string()),
    ];
    leaf.prop_recursive(3, 12, 3, |inner| {
        let block = prop::collection::vec(inner, 1..3).prop_map(|list| list.join(" "));
        prop_oneof![
            (float_expression(), block.clone(), block.clone())
                .prop_map(|(c, a, b)| format!("if ({c} > x) {{ {a} }} else {{ {b} }}")),
            (1u32..6, block.clone(), float_expression()).prop_map(|(k, b, c)| format!(
                "for (var k = 0u; k < {k}u; k++) {{ {b} if ({c} > 3.0) {{ break; }} }}"
            )),
            (block.clone(), block.clone())
                .prop_map(|(a, b)| format!("switch n {{ case 0, 3: {{ {a} }} default: {{ {b} }} }}")),
            (float_expression(), block).prop_map(|(c, a)| format!("if ({c} < 0.0) {{ {a} return; }}")),
        ]
    })
}

pub(crate) fn shader() -> impl Strategy<Value = String> {
    prop::collection::vec(statement(), 1..6).prop_map(|list| {
        crate::common::probe_source(&format!(
            "var x = a[0]; var y = a[1]; var n = i32(a[2]); var v = vec3f(x, y, 0.5); var t = array<f32, 4>(1.0, 2.0, x, y);
             {}
             o[i] = x + y + v.y + t[1] + f32(n);",
            list.join("\n")
        ))
    })
}

proptest! {
    #![proptest_config(crate::common::cases(300))]

    #[test]
    fn random_programs_evaluate_everywhere(source in shader(), inputs in prop::array::uniform3(-4.0f32..4.0)) {
        let Ok(parsed) = naga::front::wgsl::parse_str(&source) else { return Ok(()) };
        let mut validator = naga::valid::Validator::new(naga::valid::ValidationFlags::all(), naga::valid::Capabilities::all());
        let Ok(info) = validator.validate(&parsed) else { return Ok(()) };
        let program = Program::new(&parsed, &info, "main").unwrap();
        let limits = Limits::default();
        let point = run_probe::<F32>(&program, &inputs, 1, 1, &limits).unwrap().0[0];
        run_probe::<F64>(&program, &inputs, 1, 1, &limits).unwrap();
        let accept = run_probe::<Accept>(&program, &inputs, 1, 1, &limits).unwrap().0[0];
        prop_assert!(accept.contains(point), "{point} not in {accept:?}\n{source}");
        let range = run_probe_with(&program, Bindings::<Range>::new().floats(0, 0, &inputs), 1, 1, &limits).unwrap().0[0];
        prop_assert!(range.contains(point), "{point} not in {range:?}\n{source}");
    }
}

#[test]
fn the_generator_makes_programs_that_mean_something() {
    // Negative control: most generated texts must be valid, or the test above tests nothing.
    let mut runner = proptest::test_runner::TestRunner::deterministic();
    let valid = (0..50).filter(|_| {
        let source = shader().new_tree(&mut runner).unwrap().current();
        naga::front::wgsl::parse_str(&source).is_ok()
    });
    assert!(valid.count() >= 40);
    let (m, info) = module(&crate::common::probe_source("o[i] = 1.0;"));
    assert!(!matches!(
        Program::new(&m, &info, "main"),
        Err(Error::Unsupported { .. })
    ));
}
