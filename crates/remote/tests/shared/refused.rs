//! What a machine refuses is said, and the next job runs.

use bossage_remote::{Limits, Remote};
use bossage_runner::{Code, Error};

use crate::compute::{DOUBLE, probe};
use crate::machine::{TESTED, program};
use crate::support::{compile, device, stand_in};
use crate::tested::Refused;

pub(crate) fn doubles(machine: &Remote) {
    let double = compile(DOUBLE);
    let found = probe(double.wgsl("double"), &[1.5, 2.0], None).run(machine);
    assert_eq!(found.unwrap(), [3.0, 4.0]);
}

/// What is said of the doubling shader with a change, after which the machine goes on.
fn said_of(machine: &Remote, change: &Refused) -> String {
    let double = compile(DOUBLE);
    let text = double.text("double");
    let changed = text.replace(change.from, change.to);
    assert_ne!(changed, text);
    let error = probe(double.with("double", &changed), &[1.0], None)
        .run(machine)
        .unwrap_err();
    doubles(machine);
    let Error::Validation { message, .. } = error else {
        panic!("{error}")
    };
    message
}

fn assert_said(said: &str, words: &[&str]) {
    for word in words {
        assert!(said.contains(word), "no `{word}` in: {said}");
    }
}

#[test]
fn text_that_the_compiler_refuses_is_not_valid_with_line_and_reason() {
    if let Some(machine) = device("text_that_the_compiler_refuses_is_not_valid_with_line_and_reason") {
        assert_said(&said_of(machine, &TESTED.text), TESTED.text.said);
    }
}

#[test]
fn a_binding_where_the_manifest_has_none_is_not_valid() {
    if let Some(machine) = device("a_binding_where_the_manifest_has_none_is_not_valid") {
        assert_said(&said_of(machine, &TESTED.binding), TESTED.binding.said);
    }
}

#[test]
fn another_language_is_refused() {
    let Some(machine) = device("another_language_is_refused") else {
        return;
    };
    let double = compile(DOUBLE);
    let mut shader = double.wgsl("double");
    shader.code = Code::Spirv(&[3, 2, 35, 7]);
    let error = probe(shader, &[1.0], None).run(machine).unwrap_err();
    assert_said(&error.to_string(), &[TESTED.takes]);
}

#[test]
fn an_adapter_that_is_not_there_is_unsupported_with_what_is() {
    let Some(machine) = device("an_adapter_that_is_not_there_is_unsupported_with_what_is") else {
        return;
    };
    let error = Remote::open(TESTED.kind, &program().unwrap(), &stand_in(), Limits::default()).unwrap_err();
    assert!(matches!(error, Error::Unsupported { .. }), "{error}");
    assert_said(
        &error.to_string(),
        &[&bossage_runner::Machine::info(machine).name],
    );
}

#[test]
fn what_takes_too_much_memory_fails_by_itself() {
    let limits = Limits {
        memory_bytes: TESTED.too_few_bytes,
        ..Limits::default()
    };
    let Some(machine) = device("what_takes_too_much_memory_fails_by_itself") else {
        return;
    };
    let info = bossage_runner::Machine::info(machine);
    let error = Remote::open(TESTED.kind, &program().unwrap(), info, limits).unwrap_err();
    assert!(matches!(error, Error::GaveUp { .. }), "{error}");
}
