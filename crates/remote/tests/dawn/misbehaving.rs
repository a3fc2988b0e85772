//! Programs that stand in for Dawn and misbehave: each is a clear error of the job, and never a hang.

use std::fs;
use std::os::unix::fs::PermissionsExt;
use std::time::{Duration, Instant};

use bossage_remote::{Kind, Limits, Remote};
use bossage_runner::Error;

use crate::compute::{DOUBLE, probe};
use crate::support::{compile, stand_in};

const LIMITS: Limits = Limits {
    time: Duration::from_secs(2),
    memory_bytes: 1 << 30,
    answer_bytes: 1 << 20,
};

/// A first word that is as it should be.
const HELLO: &str =
    "say '{\"features\":[],\"side\":8192,\"targets\":8,\"workgroups\":65535,\"bufferBytes\":1048576}'";

/// A shell script as the program; `say TEXT` sends a message without data.
fn open(script: &str) -> (tempfile::TempDir, Result<Remote, Error>) {
    let folder = tempfile::tempdir().unwrap();
    let program = folder.path().join("dawn");
    let say = r#"say() { printf "$(printf '\\%o' ${#1})\0\0\0\0\0\0\0"; printf '%s' "$1"; }"#;
    let text = format!("#!/bin/sh\n{say}\n{script}\n");
    fs::write(&program, text).unwrap();
    fs::set_permissions(&program, fs::Permissions::from_mode(0o755)).unwrap();
    let machine = Remote::open(Kind::Dawn, &program, &stand_in(), LIMITS);
    (folder, machine)
}

/// What opening such a program says.
fn refused(script: &str) -> String {
    let (_folder, machine) = open(script);
    let error = machine.unwrap_err();
    assert!(matches!(error, Error::GaveUp { .. }), "{error}");
    error.to_string()
}

#[test]
fn one_that_says_nothing_is_ended() {
    let start = Instant::now();
    let message = refused("sleep 100");
    assert!(
        message.contains("took longer than 2 s and was ended"),
        "{message}"
    );
    assert!(start.elapsed() < Duration::from_secs(30));
}

#[test]
fn one_that_ends_is_quoted() {
    let message = refused("echo why it ends >&2; exit 3");
    assert!(
        message.contains("exit status: 3") && message.contains("why it ends"),
        "{message}"
    );
}

#[test]
fn megabytes_of_errors_are_cut() {
    let message = refused("head -c 5000000 /dev/zero | tr '\\0' x >&2; echo the end >&2; exit 1");
    assert!(
        message.contains("the end") && message.len() < 3000,
        "{}",
        message.len()
    );
}

#[test]
fn an_answer_beyond_the_limit_is_not_read() {
    let message = refused("printf '\\377\\377\\377\\377\\0\\0\\0\\0'; sleep 100");
    assert!(message.contains("more than 1048576 bytes"), "{message}");
}

#[test]
fn what_is_no_answer_is_not_understood() {
    let message = refused("say nonsense; sleep 100");
    assert!(message.contains("its first word is not understood"), "{message}");
}

#[test]
fn a_program_that_is_not_there_is_said() {
    let error = Remote::open(Kind::Dawn, "/nowhere/dawn".as_ref(), &stand_in(), LIMITS).unwrap_err();
    assert!(error.to_string().contains("could not be started"), "{error}");
}

#[test]
fn a_crash_under_a_job_is_that_jobs_failure_and_the_next_one_gets_a_new_process() {
    let script = format!("{HELLO}\nhead -c 8 >/dev/null\nkill -s SEGV $$");
    let (_folder, machine) = open(&script);
    let machine = machine.unwrap();
    let double = compile(DOUBLE);
    for _ in 0..2 {
        let error = probe(double.wgsl("double"), &[1.0], None)
            .run(&machine)
            .unwrap_err();
        let Error::GaveUp { message, .. } = &error else {
            panic!("{error}")
        };
        assert!(message.contains("signal: 11"), "{message}");
    }
}

#[test]
fn answers_that_do_not_fit_the_job_are_refused() {
    let double = compile(DOUBLE);
    for (answer, problem) in [
        ("{\"lengths\":[]}", "0 buffers came back instead of 1"),
        ("{\"lengths\":[7]}", "parts do not fit"),
        ("[]", "not understood"),
    ] {
        let (_folder, machine) = open(&format!(
            "{HELLO}\nhead -c 8 >/dev/null\nsay '{answer}'\nsleep 100"
        ));
        let error = probe(double.wgsl("double"), &[1.0], None)
            .run(&machine.unwrap())
            .unwrap_err();
        assert!(error.to_string().contains(problem), "{error}");
    }
}
