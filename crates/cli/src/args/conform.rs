//! Flags of `bossage conform`.

use std::path::PathBuf;

pub(crate) const EXAMPLE: &str = "\
Examples:
  bossage conform
  bossage conform parallax_offset --route wgsl,spirv --adapter llvmpipe --html conform.html";

/// `bossage conform`.
#[derive(Debug, clap::Args)]
pub(crate) struct Conform {
    /// Only cases whose id contains this
    pub(crate) filter: Option<String>,
    /// Also draw these scenes and compare every pixel
    #[arg(long, value_name = "SCENE")]
    pub(crate) scene: Vec<PathBuf>,
    /// Only these routes from emitted code to numbers [default: all]
    #[arg(long, value_name = "ROUTES", value_delimiter = ',')]
    pub(crate) route: Vec<String>,
    /// Only adapters whose name contains one of these; each must be there [default: all found]
    #[arg(long, value_name = "ADAPTERS")]
    pub(crate) adapter: Vec<String>,
    /// Only the I-th of N parts of the cases, counted from 1
    #[arg(long, value_name = "I/N")]
    pub(crate) shard: Option<String>,
    /// Many more inputs a case
    #[arg(long)]
    pub(crate) full: bool,
    /// Name the cases that would run, and run none
    #[arg(long)]
    pub(crate) list: bool,
    /// Write the report as JSON (schema 1); - is standard output
    #[arg(long, value_name = "FILE")]
    pub(crate) json: Option<PathBuf>,
    /// Write the report as JUnit XML
    #[arg(long, value_name = "FILE")]
    pub(crate) junit: Option<PathBuf>,
    /// Write the report as a web page
    #[arg(long, value_name = "FILE")]
    pub(crate) html: Option<PathBuf>,
}
