//! What this computer lacks, asked before any adapter is opened.

use std::path::Path;
use std::time::Duration;

use bossage_translate::external;

use crate::kind::Kind;
use crate::process::Limits;
use crate::script::Script;

/// What this computer lacks so that the program could run jobs, whatever the adapter: libraries of the system. `None` where nothing is
/// known to be missing.
#[must_use]
pub fn lacking(kind: Kind, program: &Path) -> Option<String> {
    let script = match Script::write(kind) {
        Ok(script) => script,
        Err(error) => return Some(format!("its script could not be written: {error}")),
    };
    let arguments = kind.check_arguments(&script.main())?;
    let limits = external::Limits {
        time: Duration::from_secs(20),
        memory_bytes: Limits::default().memory_bytes,
        output_bytes: 4096,
    };
    match external::run(program, &arguments, &[], &limits) {
        Ok(outcome) if outcome.success => None,
        Ok(outcome) => Some(last_line(&outcome.output)),
        Err(problem) => Some(problem),
    }
}

/// A script that ends early says last why.
fn last_line(said: &str) -> String {
    let last = said.lines().rfind(|line| !line.trim().is_empty());
    last.map_or_else(
        || "its program ended without a word".to_owned(),
        |line| line.trim().to_owned(),
    )
}

#[cfg(test)]
mod tests {
    use super::last_line;

    #[test]
    fn the_reason_is_what_is_said_last() {
        let traceback = "Traceback (most recent call last):\n  File \"x\"\nModuleNotFoundError: No module named 'ctypes'\n\n";
        assert_eq!(
            last_line(traceback),
            "ModuleNotFoundError: No module named 'ctypes'"
        );
        assert_eq!(last_line("\n"), "its program ended without a word");
    }
}
