//! Parsing and running WGSL in tests.

use bossage_bounds::{Bindings, Domain, Limits, Outcome, Program, run_compute};
use naga::valid::{Capabilities, ModuleInfo, ValidationFlags, Validator};

/// The corpus files in WGSL; each is evaluated in `corpus.rs`, `textures.rs` or `further.rs`.
pub(crate) const FILES: [&str; 13] = [
    "values",
    "flow",
    "integers",
    "shared",
    "wide",
    "fragment",
    "vertex",
    "textures",
    "subgroups",
    "built_ins",
    "clipped",
    "narrow",
    "arrays",
];

/// Parses and validates a module; panics with the compiler's message otherwise.
pub(crate) fn module(source: &str) -> (naga::Module, ModuleInfo) {
    let module =
        naga::front::wgsl::parse_str(source).unwrap_or_else(|e| panic!("{}", e.emit_to_string(source)));
    let info = Validator::new(ValidationFlags::all(), Capabilities::all())
        .validate(&module)
        .unwrap_or_else(|e| panic!("{}", e.emit_to_string(source)));
    (module, info)
}

/// Compiles the entry point `main`.
pub(crate) fn program(source: &str) -> Program {
    let (module, info) = module(source);
    Program::new(&module, &info, "main").unwrap_or_else(|e| panic!("{e}"))
}

/// A compute shader with the given body for one invocation `i`; inputs `a: array<f32>`, outputs `o: array<f32>`.
pub(crate) fn probe_source(body: &str) -> String {
    format!(
        "@group(0) @binding(0) var<storage, read> a: array<f32>;
         @group(0) @binding(1) var<storage, read_write> o: array<f32>;
         @compute @workgroup_size(64) fn main(@builtin(global_invocation_id) id: vec3u) {{
             let i = id.x;
             if (i >= arrayLength(&o)) {{ return; }}
             {body}
         }}"
    )
}

/// Runs such a probe, one output for each invocation.
pub(crate) fn probe<D: Domain>(body: &str, inputs: &[f32], outputs: usize) -> Vec<D::Float> {
    let program = program(&probe_source(body));
    bossage_bounds::run_probe::<D>(&program, inputs, outputs, outputs, &Limits::default())
        .unwrap_or_else(|e| panic!("{e}"))
        .0
}

/// Dispatches one workgroup.
pub(crate) fn dispatch<D: Domain>(source: &str, bindings: Bindings<D>) -> (Bindings<D>, Outcome) {
    dispatch_many(source, bindings, [1, 1, 1])
}

/// Dispatches workgroups.
pub(crate) fn dispatch_many<D: Domain>(
    source: &str,
    mut bindings: Bindings<D>,
    groups: [u32; 3],
) -> (Bindings<D>, Outcome) {
    let program = program(source);
    let outcome =
        run_compute(&program, &mut bindings, groups, &Limits::default()).unwrap_or_else(|e| panic!("{e}"));
    (bindings, outcome)
}

/// Parses and validates a compute shader in GLSL.
pub(crate) fn glsl(source: &str) -> (naga::Module, ModuleInfo) {
    let options = naga::front::glsl::Options::from(naga::ShaderStage::Compute);
    let module = naga::front::glsl::Frontend::default()
        .parse(&options, source)
        .unwrap_or_else(|e| panic!("{}", e.emit_to_string(source)));
    let info = Validator::new(ValidationFlags::all(), Capabilities::all())
        .validate(&module)
        .unwrap_or_else(|e| panic!("{}", e.emit_to_string(source)));
    (module, info)
}

/// The text of a corpus file.
pub(crate) fn source(name: &str) -> String {
    let extension = if name == "glsl" { "comp" } else { "wgsl" };
    let path = format!("{}/tests/corpus/{name}.{extension}", env!("CARGO_MANIFEST_DIR"));
    std::fs::read_to_string(&path).unwrap_or_else(|e| panic!("{path}: {e}"))
}

/// How many cases a property is tried on; `BOSSAGE_BOUNDS_CASES` multiplies it, for long runs.
pub(crate) fn cases(n: u32) -> proptest::test_runner::Config {
    let factor = std::env::var("BOSSAGE_BOUNDS_CASES")
        .ok()
        .and_then(|f| f.parse().ok())
        .unwrap_or(1);
    proptest::test_runner::Config {
        cases: n.saturating_mul(factor),
        ..Default::default()
    }
}
