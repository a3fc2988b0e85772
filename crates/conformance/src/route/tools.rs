//! The compilers of others that routes need: looked for once in a process.

use std::path::Path;
use std::sync::OnceLock;

use bossage_translate::external::{self, State, Validator};

/// Every tool that is known, there or not.
pub(crate) fn all() -> &'static [Validator] {
    static FOUND: OnceLock<Vec<Validator>> = OnceLock::new();
    FOUND.get_or_init(external::detect)
}

/// Why a tool cannot be used, and how to get it; `None` where it can.
pub(super) fn missing(tool: &str) -> Option<String> {
    let found = all().iter().find(|validator| validator.tool == tool);
    match found {
        Some(validator) if validator.state == State::Enabled => None,
        Some(validator) => validator.reason.clone(),
        None => Some(format!("no tool is called `{tool}`")),
    }
}

/// Where a tool is that can be used.
pub(super) fn path(tool: &str) -> Option<&'static Path> {
    let found = all().iter().find(|validator| validator.tool == tool)?;
    found.path.as_deref().filter(|_| found.state == State::Enabled)
}

/// Where what tools made is kept between runs.
pub(crate) fn cache() -> Option<&'static Path> {
    static FOLDER: OnceLock<Option<std::path::PathBuf>> = OnceLock::new();
    FOLDER.get_or_init(external::cache_folder).as_deref()
}
