//! Flags of `bossage bake`.

use std::path::PathBuf;

use clap::ValueEnum;

pub(crate) const EXAMPLE: &str = "\
Examples:
  bossage bake examples/textures/brick_height.png -o out/brick --normal central --edge wrap --scale 0.04
  bossage bake examples/textures/brick_height.png -o out/brick --codec biased --mips
  bossage bake examples/textures/brick_height.png -o out/brick --max-mip --cone --edge mirror
  bossage bake -o out/cube --normalisation-cube 64 --bits 8";

/// `bossage bake`.
#[derive(Debug, clap::Args)]
pub(crate) struct Bake {
    /// The height image (PNG, JPEG, TGA, BMP, TIFF, OpenEXR, HDR); 1 is highest
    #[arg(required_unless_present = "normalisation_cube")]
    pub(crate) height: Option<PathBuf>,
    /// Where the maps go
    #[arg(short, long, value_name = "DIR")]
    pub(crate) output: PathBuf,
    /// How slopes are taken: central differences, or forward ones as first published
    #[arg(long, value_name = "KIND", default_value = "central")]
    pub(crate) normal: NormalKind,
    /// How normals become bytes [default: unorm; forward: biased]
    #[arg(long, value_name = "CODEC", requires = "height")]
    pub(crate) codec: Option<CodecName>,
    /// What lies beyond the edge of the image [default: wrap; the normal map of forward: a flat border]
    #[arg(long, value_name = "MODE", requires = "height")]
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
    /// Write the smaller levels of the normal map too, each averaged from the one above and made unit vectors again
    #[arg(long, requires = "height")]
    pub(crate) mips: bool,
    #[command(flatten)]
    pub(crate) relief: ReliefMaps,
    /// Write a normalisation cube map of so many texels along an edge, as six images
    #[arg(long, value_name = "SIZE")]
    pub(crate) normalisation_cube: Option<u32>,
    /// Bits a component of the normalisation cube map
    #[arg(long, value_name = "BITS", default_value = "8")]
    pub(crate) bits: Bits,
    /// Bake on the graphics adapter instead of the processor (same bytes; cones within bounds)
    #[arg(long)]
    pub(crate) gpu: bool,
}

/// The maps that tracing reads, beside the normal map.
#[derive(Clone, Copy, Debug, clap::Args)]
pub(crate) struct ReliefMaps {
    /// Write the greatest height of the surface over each texel, and of every smaller level: 16-bit grey, rounded up
    #[arg(long, requires = "height")]
    pub(crate) max_mip: bool,
    /// Write the free cones: 16 bits, red the height rounded up, green the radius in longer sides of the map, a height of 1 above
    /// the tip, rounded down
    #[arg(long, requires = "height")]
    pub(crate) cone: bool,
    /// Write the cones that a ray crosses once, in the same form
    #[arg(long, requires = "height")]
    pub(crate) relaxed_cone: bool,
    /// Write how deep a ray may sink over the 1, 2, 4 and 8 blocks ahead, a quadrant of directions in each quarter: 8-bit RGBA,
    /// rounded down
    #[arg(long, requires = "height")]
    pub(crate) window_maxima: bool,
}

impl ReliefMaps {
    /// The flags that are set.
    pub(crate) fn flags(self) -> impl Iterator<Item = &'static str> {
        let flags = [
            ("--max-mip", self.max_mip),
            ("--cone", self.cone),
            ("--relaxed-cone", self.relaxed_cone),
            ("--window-maxima", self.window_maxima),
        ];
        flags.into_iter().filter(|(_, set)| *set).map(|(flag, _)| flag)
    }
}

/// Ways to take a slope.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum NormalKind {
    Central,
    Forward,
}

/// Normal codecs. The words are those of scene files.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
#[value(rename_all = "snake_case")]
pub(crate) enum CodecName {
    Unorm,
    Biased,
    Snorm,
    TwoChannel,
    Octahedral,
}

/// Bits a component.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Bits {
    #[value(name = "8")]
    Eight,
    #[value(name = "16")]
    Sixteen,
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
