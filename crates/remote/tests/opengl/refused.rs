//! What OpenGL refuses is said, and the next job runs.

use bossage_remote::Remote;
use bossage_runner::{Code, Error, Shader};

use crate::compute::{DOUBLE, probe};
use crate::support::{compile, device};

fn doubles(machine: &Remote) {
    let double = compile(DOUBLE);
    let found = probe(double.wgsl("double"), &[1.5, 2.0], None).run(machine);
    assert_eq!(found.unwrap(), [3.0, 4.0]);
}

#[test]
fn text_that_the_driver_refuses_is_not_valid_with_line_and_reason() {
    let Some(machine) = device("text_that_the_driver_refuses_is_not_valid_with_line_and_reason") else {
        return;
    };
    let double = compile(DOUBLE);
    let Code::Glsl(text) = double.wgsl("double").code else {
        panic!("GLSL")
    };
    let wrong = text.replace("2.0 *", "nothing *");
    assert_ne!(wrong, text);
    let shader = Shader {
        code: Code::Glsl(&wrong),
        ..double.wgsl("double")
    };
    let error = probe(shader, &[1.0], None).run(machine).unwrap_err();
    let Error::Validation { message, .. } = &error else {
        panic!("{error}")
    };
    assert!(
        message.contains("refuses the GLSL: 0:") && message.contains("nothing"),
        "{message}"
    );
    doubles(machine);
}

#[test]
fn a_block_that_is_not_where_the_manifest_has_it_is_not_valid() {
    let Some(machine) = device("a_block_that_is_not_where_the_manifest_has_it_is_not_valid") else {
        return;
    };
    let double = compile(DOUBLE);
    let Code::Glsl(text) = double.wgsl("double").code else {
        panic!("GLSL")
    };
    let moved = text.replace("binding = 1", "binding = 5");
    assert_ne!(moved, text);
    let shader = Shader {
        code: Code::Glsl(&moved),
        ..double.wgsl("double")
    };
    let error = probe(shader, &[1.0], None).run(machine).unwrap_err();
    assert!(
        error.to_string().contains("is bound to 5, the manifest states 1"),
        "{error}"
    );
    doubles(machine);
}

#[test]
fn wgsl_is_refused() {
    let Some(machine) = device("wgsl_is_refused") else {
        return;
    };
    let double = compile(DOUBLE);
    let shader = Shader {
        code: Code::Wgsl(DOUBLE),
        ..double.wgsl("double")
    };
    let error = probe(shader, &[1.0], None).run(machine).unwrap_err();
    assert!(error.to_string().contains("OpenGL takes GLSL"), "{error}");
}
