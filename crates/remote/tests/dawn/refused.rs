//! What Dawn refuses is said, and the next job runs.

use bossage_remote::{Kind, Limits, Remote};
use bossage_runner::{Code, Error, Shader};

use crate::compute::{DOUBLE, probe};
use crate::support::{compile, device, own, stand_in};

fn doubles(machine: &Remote) {
    let double = compile(DOUBLE);
    let found = probe(double.wgsl("double"), &[1.5, 2.0], None).run(machine);
    assert_eq!(found.unwrap(), [3.0, 4.0]);
}

#[test]
fn text_that_tint_refuses_is_not_valid_with_line_and_reason() {
    let Some(machine) = device("text_that_tint_refuses_is_not_valid_with_line_and_reason") else {
        return;
    };
    let double = compile(DOUBLE);
    let wrong = DOUBLE.replace("2.0 *", "2u *");
    let shader = Shader {
        code: Code::Wgsl(&wrong),
        ..double.wgsl("double")
    };
    let error = probe(shader, &[1.0], None).run(machine).unwrap_err();
    let Error::Validation { message, .. } = &error else {
        panic!("{error}")
    };
    assert!(
        message.contains("Tint refuses the WGSL: 5:") && message.contains("u32"),
        "{message}"
    );
    doubles(machine);
}

#[test]
fn a_binding_where_the_manifest_has_none_is_not_valid() {
    let Some(machine) = device("a_binding_where_the_manifest_has_none_is_not_valid") else {
        return;
    };
    let double = compile(DOUBLE);
    let moved = DOUBLE.replace("@binding(1)", "@binding(4)");
    let shader = Shader {
        code: Code::Wgsl(&moved),
        ..double.wgsl("double")
    };
    let error = probe(shader, &[1.0], None).run(machine).unwrap_err();
    assert!(matches!(error, Error::Validation { .. }), "{error}");
    doubles(machine);
}

#[test]
fn spirv_is_refused() {
    let Some(machine) = device("spirv_is_refused") else {
        return;
    };
    let double = compile(DOUBLE);
    let shader = Shader {
        code: Code::Spirv(&[3, 2, 35, 7]),
        ..double.wgsl("double")
    };
    let error = probe(shader, &[1.0], None).run(machine).unwrap_err();
    assert!(error.to_string().contains("Dawn takes WGSL"), "{error}");
}

#[test]
fn an_adapter_that_is_not_there_is_unsupported_with_those_that_are() {
    let Some(_) = device("an_adapter_that_is_not_there_is_unsupported_with_those_that_are") else {
        return;
    };
    let program = crate::support::program().unwrap();
    let error = Remote::open(Kind::Dawn, &program, &stand_in(), Limits::default()).unwrap_err();
    assert!(matches!(error, Error::Unsupported { .. }), "{error}");
    assert!(error.to_string().contains("SwiftShader"), "{error}");
}

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
    let Some(machine) = own("a_shader_that_hangs_is_ended_and_the_next_job_runs", limits) else {
        return;
    };
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

#[test]
fn what_takes_too_much_memory_fails_by_itself() {
    let limits = Limits {
        memory_bytes: 64 << 20,
        ..Limits::default()
    };
    let Some(_) = device("what_takes_too_much_memory_fails_by_itself") else {
        return;
    };
    let program = crate::support::program().unwrap();
    let error = Remote::open(Kind::Dawn, &program, &stand_in(), limits).unwrap_err();
    assert!(matches!(error, Error::GaveUp { .. }), "{error}");
}
