//! Timing: the numbers hang together, and more work takes longer.

use std::time::Instant;

use bossage_runner::{BufferData, Clock, ComputeJob, Resources, TimedJob, TimingOptions, time};

use crate::support::{compile, device};

/// `rounds` dependent multiplications an item, which no compiler can shorten.
const WORK: &str = "
@group(0) @binding(0) var<uniform> rounds: u32;
@group(0) @binding(1) var<storage, read_write> outputs: array<f32>;
@compute @workgroup_size(64) fn work(@builtin(global_invocation_id) id: vec3u) {
    var value = f32(id.x);
    for (var i = 0u; i < rounds; i++) { value = value * 1.0001 + 0.5; }
    outputs[id.x] = value;
}";

#[test]
fn times_are_ordered_and_sixteenfold_work_takes_longer() {
    let Some(device) = device("times_are_ordered_and_sixteenfold_work_takes_longer") else {
        return;
    };
    let work = compile(WORK);
    let job = |rounds: f32| {
        let mut resources = Resources::default();
        resources.uniforms.insert("rounds".into(), vec![rounds]);
        resources
            .buffers
            .insert("outputs".into(), BufferData::Output(4096 * 4));
        ComputeJob {
            name: "work",
            shader: work.wgsl("work"),
            resources,
            workgroups: [64, 1, 1],
        }
    };
    let (little, much) = (job(64.0), job(1024.0));
    let options = TimingOptions {
        run_ms: 4.0,
        ..TimingOptions::default()
    };
    let start = Instant::now();
    let timings = time(
        device,
        &[TimedJob::Compute(&little), TimedJob::Compute(&much)],
        &options,
    )
    .unwrap();
    let wall_ms = start.elapsed().as_secs_f64() * 1e3;
    for timing in &timings {
        assert_eq!(timing.runs_ms.len(), 9);
        assert!(
            0.0 < timing.min_ms && timing.min_ms <= timing.median_ms && timing.median_ms <= timing.max_ms
        );
        assert_eq!(
            timing.clock,
            if device.has_timestamps() {
                Clock::Timestamps
            } else {
                Clock::Wall
            }
        );
        assert!(timing.spread >= 0.0);
    }
    // The device can't have worked longer than we waited.
    let worked =
        |timing: &bossage_runner::Timing| timing.runs_ms.iter().sum::<f64>() * f64::from(timing.repetitions);
    let worked_ms: f64 = timings.iter().map(worked).sum();
    assert!(worked_ms <= wall_ms, "{worked_ms} ms measured in {wall_ms} ms");
    // Sixteen times the loop: even if half of the shorter job were overhead, more than four times the time. The fastest runs
    // are compared, as noise only ever adds.
    assert!(timings[1].min_ms > 4.0 * timings[0].min_ms, "{timings:?}");
}
