//! `bossage completions SHELL`: the script that makes a shell complete our flags.

use clap::CommandFactory;

use crate::Verdict;
use crate::args::{Cli, Completions};
use crate::console;
use crate::error::Result;

pub(crate) fn run(args: &Completions) -> Result<Verdict> {
    let mut script = Vec::new();
    clap_complete::generate(args.shell, &mut Cli::command(), "bossage", &mut script);
    console::print(&String::from_utf8_lossy(&script))?;
    Ok(Verdict::Fine)
}
