//! Flags of `bossage bake`.

use std::path::PathBuf;

use clap::ValueEnum;

pub(crate) const EXAMPLE: &str = "\
Example:
  bossage bake examples/textures/brick_height.png -o out/brick --normal central --edge wrap --scale 0.04";

/// `bossage bake`.
#[derive(Debug, clap::Args)]
pub(crate) struct Bake {
    /// The height image (PNG, JPEG, TGA, BMP, TIFF, OpenEXR, HDR); 1 is highest
    pub(crate) height: PathBuf,
    /// Where the maps go
    #[arg(short, long, value_name = "DIR")]
    pub(crate) output: PathBuf,
    /// How slopes are taken: central differences, or forward ones as first published
    #[arg(long, value_name = "KIND", default_value = "central")]
    pub(crate) normal: NormalKind,
    /// How normals become bytes [default: unorm; forward: biased]
    #[arg(long, value_name = "CODEC")]
    pub(crate) codec: Option<CodecName>,
    /// What lies beyond the edge of the image [default: wrap; forward: a flat border]
    #[arg(long, value_name = "MODE")]
    pub(crate) edge: Option<EdgeName>,
    /// How far height 1 lies above height 0, in widths of the image (texels are square)
    #[arg(
        long,
        value_name = "WIDTHS",
        default_value = "0.04",
        allow_negative_numbers = true
    )]
    pub(crate) scale: f32,
    /// The channel of the image that holds the height
    #[arg(long, value_name = "CHANNEL", default_value = "red")]
    pub(crate) channel: ChannelName,
    /// Bake on the graphics adapter instead of the processor (same bytes)
    #[arg(long)]
    pub(crate) gpu: bool,
}

/// Ways to take a slope.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum NormalKind {
    Central,
    Forward,
}

/// Normal codecs.
#[derive(Clone, Copy, Debug, ValueEnum)]
pub(crate) enum CodecName {
    Unorm,
    Biased,
}

/// Edge modes.
#[derive(Clone, Copy, Debug, ValueEnum)]
pub(crate) enum EdgeName {
    Wrap,
    Mirror,
    Clamp,
}

/// Image channels.
#[derive(Clone, Copy, Debug, ValueEnum)]
pub(crate) enum ChannelName {
    Red,
    Green,
    Blue,
    Alpha,
    Luminance,
}
