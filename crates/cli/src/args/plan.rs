//! Flags of `bossage plan`.

use std::path::PathBuf;

pub(crate) const EXAMPLE: &str = "\
Example:
  bossage plan examples/brick_wall.toml";

/// `bossage plan`.
#[derive(Debug, clap::Args)]
pub(crate) struct Plan {
    /// The scene file
    pub(crate) scene: PathBuf,
    /// Print JSON (schema 1) instead of text
    #[arg(long)]
    pub(crate) json: bool,
}
