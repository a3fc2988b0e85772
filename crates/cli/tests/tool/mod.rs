//! Runs the built binary the way a user does, with nothing inherited that changes what it prints.

#![allow(
    dead_code,
    reason = "each test file is a program of its own and uses its part"
)]

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use serde_json::Value;

/// What a run left.
#[derive(Debug)]
pub(crate) struct Run {
    pub(crate) code: i32,
    pub(crate) stdout: String,
    pub(crate) stderr: String,
}

impl From<Output> for Run {
    fn from(output: Output) -> Self {
        Self {
            code: output.status.code().expect("it was not killed by a signal"),
            stdout: String::from_utf8(output.stdout).expect("it prints UTF-8"),
            stderr: String::from_utf8(output.stderr).expect("it prints UTF-8"),
        }
    }
}

impl Run {
    /// Asserts the exit code, showing what was printed when it is another.
    #[track_caller]
    pub(crate) fn exits(self, code: i32) -> Self {
        assert_eq!(
            self.code, code,
            "stdout:\n{}\nstderr:\n{}",
            self.stdout, self.stderr
        );
        self
    }

    /// Asserts that standard error holds all of these.
    #[track_caller]
    pub(crate) fn says(self, words: &[&str]) -> Self {
        for word in words {
            assert!(self.stderr.contains(word), "{word:?} is not in:\n{}", self.stderr);
        }
        self
    }
}

/// The command, ready for more settings.
pub(crate) fn command(arguments: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_bossage"));
    command
        .args(arguments)
        .env("NO_COLOR", "1")
        .env_remove("COLUMNS")
        .env_remove("CLICOLOR_FORCE");
    command
}

/// Runs the binary.
pub(crate) fn bossage(arguments: &[&str]) -> Run {
    command(arguments).output().expect("the binary starts").into()
}

/// Runs the binary where no driver can be found.
pub(crate) fn bossage_without_adapter(arguments: &[&str]) -> Run {
    let missing = "/nonexistent/icd.json";
    let mut command = command(arguments);
    command
        .env("VK_ICD_FILENAMES", missing)
        .env("VK_DRIVER_FILES", missing);
    command.output().expect("the binary starts").into()
}

/// A file of the repository.
pub(crate) fn repository(path: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..").join(path)
}

/// A path as an argument.
pub(crate) fn text(path: &Path) -> &str {
    path.to_str().expect("test paths are UTF-8")
}

/// Names of everything in a folder, sorted; hidden files too.
pub(crate) fn entries(folder: &Path) -> Vec<String> {
    let mut names: Vec<String> = std::fs::read_dir(folder)
        .expect("the folder is there")
        .map(|entry| {
            entry
                .expect("it can be listed")
                .file_name()
                .into_string()
                .expect("names are UTF-8")
        })
        .collect();
    names.sort();
    names
}

/// Copies a folder with all that is in it.
pub(crate) fn copy(from: &Path, to: &Path) {
    std::fs::create_dir_all(to).expect("the copy can be made");
    for name in entries(from) {
        let (from, to) = (from.join(&name), to.join(&name));
        if from.is_dir() {
            copy(&from, &to);
        } else {
            std::fs::copy(&from, &to).expect("the copy can be made");
        }
    }
}

/// Text as JSON.
pub(crate) fn parsed(text: &str) -> Value {
    serde_json::from_str(text).unwrap_or_else(|error| panic!("{error} in:\n{text}"))
}

/// Says why a test is skipped.
#[expect(clippy::print_stderr, reason = "a skipped test says why")]
fn say(line: &str) {
    eprintln!("{line}");
}

/// Whether this machine has a driver's adapter. Where a run must have one, `BOSSAGE_REQUIRE` names it, and going without fails.
pub(crate) fn has_adapter() -> bool {
    let report = parsed(&bossage(&["doctor", "--json"]).exits(0).stdout);
    let adapters = report["adapters"].as_array().unwrap();
    let found = adapters.iter().any(|adapter| adapter["name"] != "embedded");
    let required = std::env::var("BOSSAGE_REQUIRE").unwrap_or_default();
    assert!(
        found || !required.contains("lavapipe"),
        "BOSSAGE_REQUIRE names an adapter, and none is here"
    );
    if !found {
        say(&format!("SKIP: no driver; {}", report["how_to_get_an_adapter"]));
    }
    found
}
