//! Flags of `bossage check`.

use std::path::PathBuf;

use super::emit::{Inputs, Versions};

pub(crate) const EXAMPLE: &str = "\
Examples:
  bossage check examples/*.toml
  bossage check water.wgsl --json > water.json
  bossage check water.wgsl --ranges water.ranges.toml --lint-time 10";

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
    /// What the inputs of the shaders may be, for the numeric lint [default: NAME.ranges.toml beside the input, else inferred]
    #[arg(long, value_name = "FILE")]
    pub(crate) ranges: Option<PathBuf>,
    /// Seconds that the numeric lint may take for each entry point; 0 leaves it out
    #[arg(long, value_name = "SECONDS", default_value_t = 2.0, value_parser = seconds)]
    pub(crate) lint_time: f64,
    #[command(flatten)]
    pub(crate) cache: CacheFolder,
}

/// A time that is finite and not negative.
fn seconds(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(seconds) if (0.0..=86400.0).contains(&seconds) => Ok(seconds),
        _ => Err("write seconds from 0 to 86400".to_owned()),
    }
}

/// Where the verdicts of external tools are remembered.
#[derive(Debug, clap::Args)]
pub(crate) struct CacheFolder {
    /// Where the external tools' verdicts are kept [default: bossage/ in the user's cache folder]
    #[arg(long, value_name = "DIR")]
    pub(crate) cache: Option<PathBuf>,
}
