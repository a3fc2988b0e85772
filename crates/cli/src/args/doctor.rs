//! Flags of `bossage doctor`.

pub(crate) const EXAMPLE: &str = "\
Example:
  bossage doctor";

/// `bossage doctor`.
#[derive(Debug, clap::Args)]
pub(crate) struct Doctor {
    /// Print JSON (schema 1) instead of text
    #[arg(long)]
    pub(crate) json: bool,
}
