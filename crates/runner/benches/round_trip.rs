//! How long small jobs take there and back: probes of one, ten thousand and a million items.
//!
//! `cargo bench --profile dev -p bossage-runner`.

#![allow(clippy::print_stdout, reason = "a benchmark prints")]

use std::time::Instant;

use bossage_runner::{AdapterSelector, Code, Device, run_probe};
use bossage_translate::{EmitOptions, Shader, Source, Target, emit, manifest};

const PROBE: &str = "
@group(0) @binding(0) var<storage, read> inputs: array<f32>;
@group(0) @binding(1) var<storage, read_write> outputs: array<f32>;
@compute @workgroup_size(64) fn lengths(@builtin(global_invocation_id) id: vec3u) {
    if id.x >= arrayLength(&outputs) { return; }
    let at = 3u * id.x;
    outputs[id.x] = length(vec3f(inputs[at], inputs[at + 1u], inputs[at + 2u]));
}";

const ROUNDS: usize = 100;

fn main() {
    let device = match Device::open(&AdapterSelector::Any) {
        Ok(device) => device,
        Err(error) => return println!("SKIP: {error}"),
    };
    let shader = Shader::parse("probe", &Source::Wgsl(PROBE.to_owned())).expect("valid WGSL");
    let options = EmitOptions::default();
    let emitted = emit(&shader, Target::Spirv, &options).expect("SPIR-V");
    let manifest = manifest(&shader, &options, std::slice::from_ref(&emitted));
    let entry = &manifest.entries[0];
    let spirv = emitted.files[0].contents.bytes();
    println!("{}", device.info());
    for items in [1, 10_000, 1_000_000] {
        let inputs: Vec<f32> = (0..3 * items).map(|index| index as f32).collect();
        for code in [Code::Wgsl(PROBE), Code::Spirv(spirv)] {
            let start = Instant::now();
            run_probe(&device, code, entry, &inputs, 1, items).expect("a run");
            let first_ms = start.elapsed().as_secs_f64() * 1e3;
            let start = Instant::now();
            for _ in 0..ROUNDS {
                run_probe(&device, code, entry, &inputs, 1, items).expect("a run");
            }
            let warm_ms = start.elapsed().as_secs_f64() * 1e3 / ROUNDS as f64;
            println!(
                "{:>5} {items:>8} items: first {first_ms:.2} ms, then {warm_ms:.3} ms each",
                code.route()
            );
        }
    }
}
