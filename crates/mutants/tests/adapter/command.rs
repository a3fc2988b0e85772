//! The command: calls that are wrong.

use std::path::Path;
use std::process::{Command, Output};

fn run(arguments: &[&str]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_bossage-mutants"));
    command.args(arguments).output().expect("the command starts")
}

fn told(output: &Output) -> String {
    let parts = [&output.stdout, &output.stderr].map(|bytes| String::from_utf8_lossy(bytes).into_owned());
    parts.concat()
}

#[test]
fn wrong_calls_are_refused() {
    let output = run(&["no/such.wesl", "--list"]);
    assert_eq!(output.status.code(), Some(2));
    assert!(
        told(&output).contains("no mutant's id contains `no/such.wesl`"),
        "{}",
        told(&output)
    );
    let output = run(&["--shard", "3/2"]);
    assert_eq!(output.status.code(), Some(2));
    assert!(told(&output).contains("write it as I/N"), "{}", told(&output));
    let output = run(&["--shader-dir", "no/such/folder"]);
    assert_eq!(output.status.code(), Some(2));
    assert!(
        told(&output).contains("cannot read no/such/folder"),
        "{}",
        told(&output)
    );
}

#[test]
fn a_stale_or_broken_list_is_refused() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let stale = "[[mutant]]\nfile = 'lib/gone.wesl'\nitem = 'gone'\noperator = 'drop_bias'\nwas = 'a'\nis = 'b'\nreason = 'c'";
    for (text, message) in [
        (stale, "fits no mutant"),
        ("[[mutant]]\nfile = 1", "invalid type"),
    ] {
        let path = folder.path().join("list.toml");
        std::fs::write(&path, text).expect("the list can be written");
        let output = run(&[
            "--list",
            "--equivalent",
            path.to_str().expect("a path in Unicode"),
        ]);
        assert_eq!(output.status.code(), Some(2), "{text}");
        assert!(told(&output).contains(message), "{}", told(&output));
    }
    let output = run(&[
        "--list",
        "--equivalent",
        Path::new("no/such/list").to_str().expect("Unicode"),
    ]);
    assert_eq!(output.status.code(), Some(2));
}
