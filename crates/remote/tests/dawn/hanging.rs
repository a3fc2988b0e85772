//! A job that never ends. OpenGL has none: Mesa ends loops.

use bossage_remote::Limits;
use bossage_runner::Error;

use crate::compute::probe;
use crate::refused::doubles;
use crate::support::{compile, device, open};

/// Never ends, and no compiler can know that.
const ENDLESS: &str = "
@group(0) @binding(0) var<storage, read> inputs: array<f32>;
@group(0) @binding(1) var<storage, read_write> outputs: array<f32>;
@compute @workgroup_size(1) fn double() {
    loop {
        outputs[0] = inputs[0] + outputs[0];
        if outputs[0] > 10.0 { break; }
    }
}";

#[test]
fn a_shader_that_hangs_is_ended_and_the_next_job_runs() {
    let limits = Limits {
        time: std::time::Duration::from_secs(6),
        ..Limits::default()
    };
    if device("a_shader_that_hangs_is_ended_and_the_next_job_runs").is_none() {
        return;
    }
    let machine = open(limits).unwrap();
    let endless = compile(ENDLESS);
    let error = probe(endless.wgsl("double"), &[0.0], None)
        .run(&machine)
        .unwrap_err();
    let Error::GaveUp { message, .. } = &error else {
        panic!("{error}")
    };
    assert!(message.contains("longer than 6 s and was ended"), "{message}");
    doubles(&machine);
}
