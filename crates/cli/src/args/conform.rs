//! Flags of `bossage conform`.

use std::path::PathBuf;

use super::emit::StageName;

pub(crate) const EXAMPLE: &str = "\
Examples:
  bossage conform
  bossage conform parallax_offset --route wgsl,spirv --adapter llvmpipe --html conform.html
  bossage conform --shader examples/shaders/tone_map.wgsl --inputs 256 --seed 7
  bossage conform --hunt codec_octahedral --time 30";

/// `bossage conform`.
#[derive(Debug, clap::Args)]
pub(crate) struct Conform {
    /// Only cases whose id contains this
    pub(crate) filter: Option<String>,
    /// Also draw these scenes and compare every pixel
    #[arg(long, value_name = "SCENE", conflicts_with = "shader")]
    pub(crate) scene: Vec<PathBuf>,
    /// Only these routes from emitted code to numbers [default: all]
    #[arg(long, value_name = "ROUTES", value_delimiter = ',')]
    pub(crate) route: Vec<String>,
    /// Only adapters whose name contains one of these; each must be there [default: all found]
    #[arg(long, value_name = "ADAPTERS")]
    pub(crate) adapter: Vec<String>,
    /// Only the I-th of N parts of the cases, counted from 1
    #[arg(long, value_name = "I/N", conflicts_with = "shader")]
    pub(crate) shard: Option<String>,
    /// Many more inputs a case
    #[arg(long, conflicts_with = "shader")]
    pub(crate) full: bool,
    /// Name the cases that would run, and run none
    #[arg(long, conflicts_with = "shader")]
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
    /// Say in the JSON and HTML reports which source lines the error bound of this output comes from: a number (of the library's
    /// functions) or a name (of a shader of your own, where it is the widest otherwise)
    #[arg(long, value_name = "OUTPUT")]
    pub(crate) attribute: Option<String>,
    #[command(flatten, next_help_heading = "Hard inputs")]
    pub(crate) hunt: Hunt,
    #[command(flatten, next_help_heading = "A shader of your own")]
    pub(crate) user: UserShader,
    /// Run one request of another process: it comes in on standard input, answers go to standard output
    #[arg(long, hide = true)]
    pub(crate) serve: bool,
}

/// The search for hard inputs.
#[derive(Debug, clap::Args)]
pub(crate) struct Hunt {
    /// Search for inputs at which the library's functions, or a shader of your own, err most or are known least
    #[arg(long, conflicts_with_all = ["scene", "shard", "full", "list", "junit", "html", "attribute"])]
    pub(crate) hunt: bool,
    /// Seconds that the search takes, for all functions together [default: 60, or no limit with --evaluations]
    #[arg(long, value_name = "SECONDS", requires = "hunt", value_parser = seconds)]
    pub(crate) time: Option<f64>,
    /// Inputs that are evaluated at most for each function or entry point, a fifth of them to make finds plain; without --time the same
    /// seed then finds the same on every machine
    #[arg(long, value_name = "N", requires = "hunt", value_parser = clap::value_parser!(u64).range(1..))]
    pub(crate) evaluations: Option<u64>,
    /// Only errors and widths of so many ULPs count as found
    #[arg(long, value_name = "ULPS", default_value_t = 64.0, requires = "hunt", value_parser = ulps)]
    pub(crate) threshold: f64,
    /// Where hard inputs are kept: of the library a file a function [default: crates/conformance/corpus, where that is], of a shader of
    /// your own NAME.corpus.toml, which later runs of it replay [default: beside it]
    #[arg(long, value_name = "DIR")]
    pub(crate) corpus: Option<PathBuf>,
}

/// A number of ULPs.
fn ulps(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(ulps) if ulps.is_finite() && ulps >= 0.0 => Ok(ulps),
        _ => Err("write a number of ULPs, 0 or more".to_owned()),
    }
}

/// A shader that is not the library's.
#[derive(Debug, clap::Args)]
pub(crate) struct UserShader {
    /// Run this shader (.wgsl, .wesl, .spv, GLSL) instead of the library, on inputs from their ranges, and judge it by the
    /// accuracy rules and by comparing the routes
    #[arg(long, value_name = "FILE")]
    pub(crate) shader: Option<PathBuf>,
    /// What its inputs may be [default: NAME.ranges.toml beside it, else inferred from names and types]
    #[arg(long, value_name = "FILE", requires = "shader")]
    pub(crate) ranges: Option<PathBuf>,
    /// The stage of a shader whose file name does not tell it
    #[arg(long, value_enum, requires = "shader")]
    pub(crate) stage: Option<StageName>,
    /// Only this entry point [default: all]
    #[arg(long, value_name = "NAME", requires = "shader")]
    pub(crate) entry: Option<String>,
    /// How many inputs an entry point gets, chosen from its ranges
    #[arg(long, value_name = "N", default_value_t = 64, requires = "shader", value_parser = clap::value_parser!(u32).range(1..=1_000_000))]
    pub(crate) inputs: u32,
    /// The seed of the inputs, and of the search for hard ones
    #[arg(long, value_name = "SEED", default_value_t = 1)]
    pub(crate) seed: u64,
    /// Workgroups of a dispatch along x, y and z [default: what the ranges say, else one invocation an element of the longest array]
    #[arg(long, value_name = "X,Y,Z", requires = "shader")]
    pub(crate) workgroups: Option<String>,
    /// Operations that an invocation may take on average before the shader counts as one that does not end
    #[arg(long, value_name = "N", default_value_t = 1 << 20, requires = "shader", value_parser = clap::value_parser!(u64).range(1..))]
    pub(crate) operations: u64,
    /// Seconds that one input may take before its process is ended
    #[arg(long, value_name = "SECONDS", default_value_t = 20.0, requires = "shader", value_parser = seconds)]
    pub(crate) time_limit: f64,
}

/// A time that is finite and more than nothing.
fn seconds(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(seconds) if seconds > 0.0 && seconds <= 86400.0 => Ok(seconds),
        _ => Err("write seconds, more than 0 and at most 86400".to_owned()),
    }
}
