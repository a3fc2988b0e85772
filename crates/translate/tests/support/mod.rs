//! Shared by the tests of this crate: fixtures and the tools that check them.
#![allow(dead_code, reason = "each test file uses its own part")]
#![allow(clippy::print_stderr, reason = "a skip must be seen")]

use std::path::PathBuf;
use std::sync::OnceLock;

use bossage_translate::external::{State, Validator};
use bossage_translate::{Shader, Source, external};

/// The folder of fixtures.
pub(crate) fn fixtures() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("tests/fixtures")
}

/// Names and texts of all good fixtures, sorted.
pub(crate) fn good() -> Vec<(String, String)> {
    let mut all: Vec<(String, String)> = std::fs::read_dir(fixtures().join("good"))
        .expect("the fixtures are there")
        .map(|entry| entry.expect("a readable entry").path())
        .map(|path| {
            let name = path.file_name().expect("a file").to_string_lossy().into_owned();
            (name, std::fs::read_to_string(&path).expect("readable text"))
        })
        .collect();
    all.sort();
    assert!(all.len() >= 8, "fixtures are missing");
    all
}

/// A good fixture, parsed.
pub(crate) fn shader(name: &str) -> Shader {
    let text = std::fs::read_to_string(fixtures().join("good").join(name)).expect("a fixture");
    wgsl(name, &text)
}

/// A WGSL text that must parse.
pub(crate) fn wgsl(name: &str, text: &str) -> Shader {
    Shader::parse(name, &Source::Wgsl(text.to_owned())).unwrap_or_else(|error| panic!("{error}"))
}

/// Whether `BOSSAGE_REQUIRE` (`lavapipe,spirv-val,glslang`, say) lists a tool, by the start of its name.
fn required(tool: &str) -> bool {
    let list = std::env::var("BOSSAGE_REQUIRE").unwrap_or_default();
    list.split(',')
        .map(str::trim)
        .any(|item| !item.is_empty() && tool.starts_with(item))
}

/// A tool that the tests need. A missing one fails where `BOSSAGE_REQUIRE` lists it, as CI does; elsewhere the skip is
/// printed and `None` comes back.
pub(crate) fn tool(name: &str) -> Option<Vec<Validator>> {
    static FOUND: OnceLock<Vec<Validator>> = OnceLock::new();
    let found = FOUND.get_or_init(external::detect);
    let tool = found.iter().find(|v| v.tool == name).expect("a known tool");
    if tool.state == State::Enabled {
        return Some(found.clone());
    }
    let reason = tool.reason.clone().unwrap_or_default();
    assert!(!required(name), "{name} is required: {reason}");
    eprintln!("SKIP 1 test: {name} is DISABLED: {reason}");
    None
}
