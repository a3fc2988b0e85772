//! The command line of Bossage: args → plan → run.
//!
//! `args` says what can be typed and holds no logic; `run` has one file a command, which turns flags into calls of the
//! other crates; [`output`] writes files all-or-nothing; `console` prints. Results go to standard output, progress to
//! standard error. Exit codes: 0 fine, 1 a check failed, 2 the input or the call is wrong, 3 the environment lacks what
//! was demanded.
//!
//! Nothing is computed here: a number in a report comes from the crate that owns it.
//!
//! ```
//! use std::process::ExitCode;
//!
//! let code = bossage_cli::run(["bossage", "emit", "no_such_scene.toml", "-o", "out"]);
//! assert_eq!(code, ExitCode::from(2));
//! assert!(!std::path::Path::new("out").exists());
//! ```

mod args;
mod bundle;
mod console;
mod cube_files;
mod depfile;
mod drawing;
pub mod drivers;
pub mod error;
mod inputs;
mod machine;
mod nearest;
mod numeric;
mod options;
pub mod output;
mod picture;
mod run;
mod stamp;
mod technique;
mod translation;

use std::ffi::OsString;
use std::process::ExitCode;

use clap::Parser;

use args::{Cli, Command};
use console::Console;
use error::Result;

/// How a command that ran to its end went.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[must_use]
pub enum Verdict {
    /// Exit code 0.
    Fine,
    /// A check failed: exit code 1.
    Failed,
}

/// Runs one command line, the program's name first, and returns the exit code of the process.
pub fn run<I, T>(line: I) -> ExitCode
where
    I: IntoIterator<Item = T>,
    T: Into<OsString> + Clone,
{
    let cli = match Cli::try_parse_from(line) {
        Ok(cli) => cli,
        Err(answer) => return print_answer(&answer),
    };
    match dispatch(cli) {
        Ok(Verdict::Fine) => ExitCode::SUCCESS,
        Ok(Verdict::Failed) => ExitCode::from(1),
        Err(error) => {
            report(&error);
            ExitCode::from(error.exit_code())
        }
    }
}

/// Shows an error; those that bring their own heading (a picture of a line with a caret) are shown as they are.
fn report(error: &error::Error) {
    let text = error::chain(error);
    if text.starts_with("error") {
        console::warn(text);
    } else {
        console::warn(format_args!("{} {text}", console::bad("error:")));
    }
}

/// Help, version, or what is wrong with the call.
fn print_answer(answer: &clap::Error) -> ExitCode {
    // A reader that went away has seen enough.
    let _ = answer.print();
    if answer.use_stderr() {
        ExitCode::from(2)
    } else {
        ExitCode::SUCCESS
    }
}

fn dispatch(cli: Cli) -> Result<Verdict> {
    let console = Console::new(cli.global.quiet);
    match cli.command {
        Command::Completions(args) => run::completions::run(&args),
        Command::Plan(args) => run::plan::run(&args, &cli.global),
        Command::Emit(args) => run::emit::run(&args, &cli.global, console),
        Command::Check(args) => run::check::run(&args, &cli.global, console),
        Command::Bake(args) => run::bake::run(&args, &cli.global, console),
        Command::Render(args) => run::render::run(&args, &cli.global, console),
        Command::Doctor(args) => run::doctor::run(&args),
        Command::Conform(args) => run::conform::run(&args, &cli.global, console),
        Command::Study(args) => run::study::run(&args, &cli.global, console),
        Command::Demo(args) => run::demo::run(&args, &cli.global, console),
    }
}
