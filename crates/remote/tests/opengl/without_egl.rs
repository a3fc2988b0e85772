//! A computer without EGL: said before any adapter is asked, and once more by whoever opens one all the same.

use std::fs;
use std::os::unix::fs::PermissionsExt;

use bossage_remote::{Kind, Limits, Remote, lacking};
use bossage_runner::Error;
use bossage_translate::external::find_program;

use crate::support::{skip, stand_in};

#[test]
fn it_is_said_that_egl_is_missing() {
    let Some(python) = find_program("python3") else {
        return skip("it_is_said_that_egl_is_missing", "python3 was not found");
    };
    let folder = tempfile::tempdir().unwrap();
    let program = folder.path().join("python");
    let text = format!(
        "#!/bin/sh\nPYTHONDONTWRITEBYTECODE=1 PYTHONPATH='{}' exec '{}' \"$@\"\n",
        concat!(env!("CARGO_MANIFEST_DIR"), "/tests/opengl/no_egl"),
        python.display()
    );
    fs::write(&program, text).unwrap();
    fs::set_permissions(&program, fs::Permissions::from_mode(0o755)).unwrap();

    let said = lacking(Kind::OpenGl, &program).unwrap();
    assert!(
        said.starts_with("EGL is not here (libEGL.so.1: cannot open"),
        "{said}"
    );
    let error = Remote::open(Kind::OpenGl, &program, &stand_in(), Limits::default()).unwrap_err();
    assert!(matches!(error, Error::Unsupported { .. }), "{error}");
    assert!(error.to_string().contains("EGL is not here"), "{error}");
}

#[test]
fn nothing_is_known_to_be_missing_for_dawn_and_a_program_that_is_not_there_is_said() {
    let nowhere = std::path::Path::new("/nowhere/python");
    assert_eq!(lacking(Kind::Dawn, nowhere), None);
    assert!(lacking(Kind::OpenGl, nowhere).is_some());
}
