//! Flags of `bossage check`.

use std::path::PathBuf;

use super::emit::{Inputs, Versions};

pub(crate) const EXAMPLE: &str = "\
Examples:
  bossage check examples/*.toml
  bossage check water.wgsl --json > water.json";

/// `bossage check`.
#[derive(Debug, clap::Args)]
pub(crate) struct Check {
    #[command(flatten)]
    pub(crate) inputs: Inputs,
    #[command(flatten)]
    pub(crate) versions: Versions,
    /// Print JSON (schema 1) instead of text
    #[arg(long)]
    pub(crate) json: bool,
    #[command(flatten)]
    pub(crate) cache: CacheFolder,
}

/// Where the verdicts of external tools are remembered.
#[derive(Debug, clap::Args)]
pub(crate) struct CacheFolder {
    /// Where the external tools' verdicts are kept [default: bossage/ in the user's cache folder]
    #[arg(long, value_name = "DIR")]
    pub(crate) cache: Option<PathBuf>,
}
