//! Programs that do not end, crash, or say too much: each is the error of its job, and the next one runs.

use std::time::{Duration, Instant};

use bossage_metal::Metal;
use bossage_runner::{Error, run_probe};
use bossage_translate::external;

use crate::support::{compile, device, tools};

fn kernel(body: &str) -> String {
    format!(
        "@group(0) @binding(0) var<storage, read> inputs: array<f32>;
         @group(0) @binding(1) var<storage, read_write> outputs: array<f32>;
         @compute @workgroup_size(1) fn main(@builtin(global_invocation_id) id: vec3u) {{ {body} }}"
    )
}

fn run(machine: &Metal, body: &str) -> Result<Vec<f32>, Error> {
    let compiled = compile(&kernel(body));
    let shader = compiled.msl("main");
    run_probe(machine, shader.code, shader.entry, &[1.0, 2.0], 1, 2)
}

const FINE: &str = "outputs[id.x] = 2.0 * inputs[id.x];";

#[test]
fn an_endless_loop_is_ended_and_the_next_job_runs() {
    let Some(_) = device("endless loop") else { return };
    let cache = external::cache_folder();
    let machine = Metal::new(tools(), cache.as_deref())
        .unwrap()
        .with_time_limit(Duration::from_secs(1));
    let start = Instant::now();
    // Nothing happens in it, and it ends for no input that is given.
    let problem = run(
        &machine,
        "loop { if inputs[0] == 7.0 { break; } } outputs[id.x] = 1.0;",
    )
    .unwrap_err();
    assert!(matches!(problem, Error::GaveUp { .. }), "{problem:?}");
    assert!(problem.to_string().contains("took longer than 1 s"), "{problem}");
    assert!(start.elapsed() < Duration::from_secs(60));
    assert_eq!(run(&machine, FINE).unwrap(), [2.0, 4.0]);
}

#[test]
fn a_crash_is_told_and_the_next_job_runs() {
    let Some(machine) = device("crash") else { return };
    let problem = run(machine, "outputs[u32(inputs[0]) * 1000000000u] = 1.0;").unwrap_err();
    assert!(matches!(problem, Error::GaveUp { .. }), "{problem:?}");
    assert!(problem.to_string().contains("signal"), "{problem}");
    assert_eq!(run(machine, FINE).unwrap(), [2.0, 4.0]);
}

#[test]
fn a_barrier_that_not_all_meet_is_told() {
    let Some(machine) = device("barrier") else { return };
    let compiled = compile(
        "@group(0) @binding(1) var<storage, read_write> outputs: array<f32>;
         var<workgroup> shared_sum: array<f32, 4>;
         @compute @workgroup_size(4) fn main(@builtin(local_invocation_index) i: u32) {
            shared_sum[i] = f32(i);
            workgroupBarrier();
            outputs[i] = shared_sum[3u - i];
         }",
    );
    let good = compiled.msl("main");
    let turned = run_probe(machine, good.code, good.entry, &[], 1, 4).unwrap();
    assert_eq!(turned, [3.0, 2.0, 1.0, 0.0]);
    // The language refuses such a shader; text that was damaged may have it.
    let entry = compiled.manifest.entry("main").unwrap();
    let text = compiled.msl["main"].replacen(
        "metal::threadgroup_barrier",
        "if (i > 1u) metal::threadgroup_barrier",
        1,
    );
    let problem = run_probe(machine, bossage_runner::Code::Msl(&text), entry, &[], 1, 4).unwrap_err();
    assert!(
        problem
            .to_string()
            .contains("a barrier was not met by all invocations"),
        "{problem}"
    );
}

#[test]
fn text_that_does_not_compile_is_refused_with_the_compilers_words() {
    let Some(machine) = device("compile") else { return };
    let compiled = compile(&kernel(FINE));
    let text = compiled.msl["main"].replace("outputs[", "outputz[");
    let entry = compiled.manifest.entry("main").unwrap();
    let problem = run_probe(machine, bossage_runner::Code::Msl(&text), entry, &[1.0], 1, 1).unwrap_err();
    assert!(matches!(problem, Error::Validation { .. }), "{problem:?}");
    assert!(problem.to_string().contains("outputz"), "{problem}");
}
