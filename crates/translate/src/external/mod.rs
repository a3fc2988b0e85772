//! Compilers of others that check what we emit.
//!
//! A tool is looked up once ([`detect`]), says its version, and is then run on emitted files ([`check`]). Results are kept
//! in a directory, keyed by tool, version, arguments and content. A tool runs in a process of its own with [`LIMITS`] on its time,
//! its memory and on what it may say: whatever it does is a verdict on the file and nothing else.
//!
//! Three of the tools are compilers as well: [`to_spirv`] takes what they make of HLSL and GLSL, [`compile_native`] what one makes of
//! MSL, so that the emitted text can be run.
//!
//! One file a tool: a tool is a constant of `Tool`. To add one, write its file and list it in `TOOLS`.

use std::io::Write;
use std::path::{Path, PathBuf};
use std::time::Duration;

use serde::{Deserialize, Serialize};

use crate::emit::{Emitted, EmittedFile};
use crate::options::EmitOptions;
use crate::target::Target;

mod cache;
mod clang;
mod compile;
mod dawn;
mod dxc;
mod folders;
mod formats;
mod glslang;
mod metal;
mod native;
mod parameters;
mod push;
mod relocate;
mod run;
mod spirv_val;

pub use compile::{Compiled, to_spirv};
pub use folders::{cache_folder, find_program, tool_folders};
pub use native::{Native, compile_native};
pub use run::{Limits, Outcome, Raw, end, run, run_raw, start};

/// What a tool may take for one file. Every tool answers within milliseconds and a hundred megabytes: this ends a hang.
pub const LIMITS: Limits = Limits {
    time: Duration::from_secs(20),
    memory_bytes: 2 << 30,
    output_bytes: 16 * 1024,
};

/// Every tool that we know how to run.
const TOOLS: [&Tool; 5] = [
    &spirv_val::TOOL,
    &glslang::TOOL,
    &dxc::TOOL,
    &dawn::TOOL,
    &clang::TOOL,
];

/// What is known about a tool.
struct Tool {
    /// Its name, which is also that of its program.
    name: &'static str,
    /// How to get it.
    how_to_get: &'static str,
    /// The arguments that make it say its version.
    version_arguments: &'static [&'static str],
    /// Finds the version in what it said.
    version: fn(&str) -> Option<String>,
    /// The target it checks.
    target: Target,
    /// How it gets the file.
    input: Input,
    /// The arguments for a file, but for its path; or why it cannot check it.
    arguments: fn(&EmittedFile, &EmitOptions) -> Result<Vec<String>, String>,
    /// Arguments that only make it quicker, for this program of this version.
    ready: fn(&Path, &str) -> Vec<String>,
}

/// How a tool gets a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Input {
    /// Through a pipe.
    Pipe,
    /// By a path, which is the last argument.
    Path,
}

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

/// Looks for every tool that we know how to run, in [`tool_folders`].
#[must_use]
pub fn detect() -> Vec<Validator> {
    detect_in(&tool_folders())
}

/// Looks for every tool in these folders only, the first hit wins.
#[must_use]
pub fn detect_in(folders: &[PathBuf]) -> Vec<Validator> {
    TOOLS.iter().map(|tool| detect_tool(tool, folders)).collect()
}

fn detect_tool(tool: &Tool, folders: &[PathBuf]) -> Validator {
    let program = format!("{}{}", tool.name, std::env::consts::EXE_SUFFIX);
    let found = folders
        .iter()
        .map(|folder| folder.join(&program))
        .find(|path| path.is_file());
    let Some(path) = found else {
        return disabled(
            tool,
            None,
            format!("`{program}` was not found; {}", tool.how_to_get),
        );
    };
    let arguments: Vec<String> = tool.version_arguments.iter().map(|&a| a.to_owned()).collect();
    let said = match run(&path, &arguments, &[], &LIMITS) {
        Ok(outcome) => outcome.output,
        Err(problem) => return disabled(tool, Some(path), problem),
    };
    match (tool.version)(&said) {
        Some(version) => Validator {
            tool: tool.name.to_owned(),
            version: Some(version),
            path: Some(path),
            state: State::Enabled,
            reason: None,
        },
        None => disabled(
            tool,
            Some(path),
            format!("`{program}` does not say its version; {}", tool.how_to_get),
        ),
    }
}

fn disabled(tool: &Tool, path: Option<PathBuf>, reason: String) -> Validator {
    Validator {
        tool: tool.name.to_owned(),
        version: None,
        path,
        state: State::Disabled,
        reason: Some(reason),
    }
}

/// Runs every given tool that knows the target on every file. `cache` is a directory that is made when it is missing;
/// without one, nothing is kept. A cache that cannot be written is no error: results are then not kept.
#[must_use]
pub fn check(
    emitted: &Emitted,
    options: &EmitOptions,
    validators: &[Validator],
    cache: Option<&Path>,
) -> Vec<Check> {
    let fitting = TOOLS.iter().filter(|tool| tool.target == emitted.target);
    fitting
        .flat_map(|tool| {
            let validator = validators.iter().find(|v| v.tool == tool.name);
            emitted
                .files
                .iter()
                .map(move |file| check_file(tool, validator, file, options, cache))
        })
        .collect()
}

fn check_file(
    tool: &Tool,
    validator: Option<&Validator>,
    file: &EmittedFile,
    options: &EmitOptions,
    cache: Option<&Path>,
) -> Check {
    let (state, message) = verdict(tool, validator, file, options, cache);
    Check {
        tool: tool.name.to_owned(),
        file: file.file_name.clone(),
        state,
        message,
    }
}

fn verdict(
    tool: &Tool,
    validator: Option<&Validator>,
    file: &EmittedFile,
    options: &EmitOptions,
    cache: Option<&Path>,
) -> (CheckState, String) {
    let skip = |reason: String| (CheckState::Skip, reason);
    let Some(validator) = validator else {
        return skip("the tool was not looked for".to_owned());
    };
    let (Some(path), Some(version)) = (&validator.path, &validator.version) else {
        return skip(validator.reason.clone().unwrap_or_default());
    };
    let arguments = match (tool.arguments)(file, options) {
        Ok(arguments) => arguments,
        Err(reason) => return skip(reason),
    };
    let content = file.contents.bytes();
    let key = cache::key(tool.name, version, &arguments, content);
    if let Some(known) = cache.and_then(|dir| cache::read(dir, &key)) {
        return known;
    }
    let arguments = [(tool.ready)(path, version), arguments].concat();
    match run_on(tool, path, arguments, content) {
        Ok(outcome) => {
            let state = if outcome.success {
                CheckState::Pass
            } else {
                CheckState::Fail
            };
            let message = outcome.output.trim().to_owned();
            if let (Some(dir), false) = (cache, outcome.crashed) {
                cache::write(dir, &key, state, &message);
            }
            (state, message)
        }
        Err(problem) => (CheckState::Fail, problem),
    }
}

/// Of a tool that nothing makes quicker.
fn as_it_is(_: &Path, _: &str) -> Vec<String> {
    Vec::new()
}

/// Runs a tool on a content.
fn run_on(tool: &Tool, path: &Path, mut arguments: Vec<String>, content: &[u8]) -> Result<Outcome, String> {
    if tool.input == Input::Pipe {
        return run(path, &arguments, content, &LIMITS);
    }
    let file = written(content)?;
    arguments.push(file.path().to_string_lossy().into_owned());
    run(path, &arguments, &[], &LIMITS)
}

/// A file with this content that goes when it is dropped.
fn written(content: &[u8]) -> Result<tempfile::NamedTempFile, String> {
    let make = || {
        let mut file = tempfile::NamedTempFile::new()?;
        file.write_all(content)?;
        Ok(file)
    };
    make().map_err(|error: std::io::Error| format!("a file for the tool could not be written: {error}"))
}
