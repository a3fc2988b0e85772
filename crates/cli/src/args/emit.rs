//! Flags of `bossage emit`, and those that `bossage check` shares with it.

use std::path::PathBuf;

use clap::ValueEnum;

pub(crate) const EXAMPLE: &str = "\
Examples:
  bossage emit examples/brick_wall.toml -o out/brick_wall
  bossage emit water.wgsl sky.frag -t hlsl,msl --hlsl 5_1 -o out/shaders --depfile out/shaders.d";

/// `bossage emit`.
#[derive(Debug, clap::Args)]
pub(crate) struct Emit {
    #[command(flatten)]
    pub(crate) inputs: Inputs,
    /// The languages to write
    #[arg(
        short,
        long,
        value_name = "LANGUAGES",
        value_delimiter = ',',
        default_value = "spirv,hlsl,msl,glsl,wgsl"
    )]
    pub(crate) target: Vec<TargetName>,
    /// Where the files and manifest.json go
    #[arg(short, long, value_name = "DIR")]
    pub(crate) output: PathBuf,
    #[command(flatten)]
    pub(crate) versions: Versions,
    /// Also write the list of files that were read, as a Makefile rule
    #[arg(long, value_name = "FILE")]
    pub(crate) depfile: Option<PathBuf>,
}

/// What goes in: scenes and shaders.
#[derive(Debug, clap::Args)]
pub(crate) struct Inputs {
    /// Scenes (.toml) and shaders (.wgsl, .wesl, .spv, .vert, .frag, .comp, .glsl)
    #[arg(value_name = "INPUT", required = true)]
    pub(crate) inputs: Vec<PathBuf>,
    /// The stage of GLSL files whose extension does not tell it
    #[arg(long, value_name = "STAGE")]
    pub(crate) stage: Option<StageName>,
}

/// Which version of each language to write.
#[derive(Debug, clap::Args)]
pub(crate) struct Versions {
    /// HLSL shader model
    #[arg(long, value_name = "MODEL", default_value = "5_1")]
    pub(crate) hlsl: HlslVersion,
    /// MSL version
    #[arg(long, value_name = "VERSION", default_value = "2.0")]
    pub(crate) msl: MslVersion,
    /// GLSL version
    #[arg(long, value_name = "VERSION", default_value = "450")]
    pub(crate) glsl: GlslVersion,
}

/// The five target languages.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, ValueEnum)]
pub(crate) enum TargetName {
    Spirv,
    Hlsl,
    Msl,
    Glsl,
    Wgsl,
}

/// A stage of a GLSL file.
#[derive(Clone, Copy, Debug, ValueEnum)]
pub(crate) enum StageName {
    #[value(alias = "vert")]
    Vertex,
    #[value(alias = "frag")]
    Fragment,
    #[value(alias = "comp")]
    Compute,
}

/// HLSL shader models.
#[derive(Clone, Copy, Debug, ValueEnum)]
pub(crate) enum HlslVersion {
    #[value(name = "5_0", alias = "5.0")]
    V5_0,
    #[value(name = "5_1", alias = "5.1")]
    V5_1,
    #[value(name = "6_0", alias = "6.0")]
    V6_0,
}

/// GLSL dialects.
#[derive(Clone, Copy, Debug, ValueEnum)]
pub(crate) enum GlslVersion {
    #[value(name = "330")]
    Core330,
    #[value(name = "450")]
    Core450,
    #[value(name = "es300")]
    Es300,
    #[value(name = "es310")]
    Es310,
}

/// MSL versions, from 2.0 up.
#[derive(Clone, Copy, Debug, ValueEnum)]
pub(crate) enum MslVersion {
    #[value(name = "2.0")]
    V2_0,
    #[value(name = "2.1")]
    V2_1,
    #[value(name = "2.2")]
    V2_2,
    #[value(name = "2.3")]
    V2_3,
    #[value(name = "2.4")]
    V2_4,
    #[value(name = "3.0")]
    V3_0,
    #[value(name = "3.1")]
    V3_1,
    #[value(name = "3.2")]
    V3_2,
}
