//! Flags of `bossage demo`.

use std::path::PathBuf;

pub(crate) const EXAMPLE: &str = "\
Example:
  bossage demo -o out/demo";

/// `bossage demo`.
#[derive(Debug, clap::Args)]
pub(crate) struct Demo {
    /// Where the emitted code, the pictures and the report page go
    #[arg(short, long, value_name = "DIR", default_value = "out/demo")]
    pub(crate) output: PathBuf,
}
