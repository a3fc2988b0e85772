//! What every command says of itself, as named snapshots in the repository's `snapshots/` folder.
//!
//! Help is part of the interface: a changed flag shows up as a changed snapshot and is reviewed as text.

mod tool;

use tool::bossage;

/// The commands, and the empty one.
const COMMANDS: &[&str] = &[
    "",
    "demo",
    "plan",
    "emit",
    "check",
    "conform",
    "study",
    "render",
    "bake",
    "doctor",
    "completions",
];

#[test]
fn help_of_every_command() {
    for command in COMMANDS {
        let arguments: Vec<&str> = [*command, "--help"]
            .into_iter()
            .filter(|word| !word.is_empty())
            .collect();
        let run = bossage(&arguments);
        assert_eq!(run.code, 0);
        assert_eq!(run.stderr, "", "help is a result: it goes to standard output");
        let mut settings = insta::Settings::clone_current();
        settings.set_snapshot_path(concat!(env!("CARGO_MANIFEST_DIR"), "/../../snapshots"));
        settings.set_prepend_module_to_snapshot(false);
        settings.set_omit_expression(true);
        settings.set_snapshot_suffix(if command.is_empty() { "bossage" } else { command });
        settings.bind(|| insta::assert_snapshot!("help", run.stdout));
    }
}

/// A command that is missing here has no snapshot.
#[test]
fn no_command_is_left_out() {
    let help = bossage(&["--help"]).stdout;
    let commands = help
        .split("Commands:")
        .nth(1)
        .and_then(|rest| rest.split("Options:").next())
        .unwrap();
    let listed: Vec<&str> = commands
        .lines()
        .filter(|line| line.starts_with("  ") && !line.starts_with("   "))
        .filter_map(|line| line.split_whitespace().next())
        .filter(|word| *word != "help")
        .collect();
    assert_eq!(listed, COMMANDS[1..]);
}

#[test]
fn version_is_the_packages() {
    assert_eq!(
        bossage(&["--version"]).stdout,
        format!("bossage {}\n", env!("CARGO_PKG_VERSION"))
    );
}
