//! Flags of `bossage render`.

use std::path::PathBuf;
use std::str::FromStr;

pub(crate) const EXAMPLE: &str = "\
Examples:
  bossage render examples/brick_wall.toml -o wall.png --size 1280x720
  bossage render examples/brick_wall.toml -o limits.png --compare parallax_offset,parallax_offset_limited
  bossage render examples/parallax_occlusion.toml -o occlusion.png --compare occlusion=40,occlusion=0";

/// `bossage render`.
#[derive(Debug, clap::Args)]
pub(crate) struct Render {
    /// The scene file
    pub(crate) scene: PathBuf,
    /// The picture to write, as PNG
    #[arg(short, long, value_name = "PNG")]
    pub(crate) output: PathBuf,
    /// Draw with this relief technique instead of the planned one, or with KEY=VALUE in every material
    #[arg(long, value_name = "TECHNIQUE")]
    pub(crate) technique: Option<String>,
    /// Width and height in pixels [default: the scene's]
    #[arg(long, value_name = "WxH")]
    pub(crate) size: Option<Size>,
    /// Draw two techniques, or two KEY=VALUE, side by side, and their difference, amplified
    #[arg(long, value_name = "A,B", conflicts_with = "technique")]
    pub(crate) compare: Option<Pair>,
    /// Draw on the first adapter whose name contains this
    #[arg(long, value_name = "ADAPTER")]
    pub(crate) adapter: Option<String>,
}

/// A picture's size in pixels.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Size {
    pub(crate) width: u32,
    pub(crate) height: u32,
}

/// Two techniques or settings to compare.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Pair(pub(crate) [String; 2]);

impl FromStr for Pair {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        match text.split(',').collect::<Vec<_>>().as_slice() {
            [a, b] if !a.is_empty() && !b.is_empty() => Ok(Self([*a, *b].map(str::to_owned))),
            _ => Err(
                "name two techniques or settings with a comma between, for example none,parallax_offset"
                    .to_owned(),
            ),
        }
    }
}

/// The largest picture side that `render` draws; every adapter of interest can do it.
pub(crate) const MAX_SIDE: u32 = 8192;

impl FromStr for Size {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        let sides = text
            .split_once(['x', 'X'])
            .and_then(|(w, h)| Some((w.parse().ok()?, h.parse().ok()?)));
        match sides {
            Some((width, height)) if (1..=MAX_SIDE).contains(&width) && (1..=MAX_SIDE).contains(&height) => {
                Ok(Self { width, height })
            }
            Some(_) => Err(format!("each side must be 1 to {MAX_SIDE} pixels")),
            None => Err("write it as WIDTHxHEIGHT, for example 1280x720".to_owned()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{Pair, Size};

    #[test]
    fn pairs_are_two_names() {
        assert_eq!("a,b".parse(), Ok(Pair(["a".to_owned(), "b".to_owned()])));
        for wrong in ["", "a", "a,", ",b", "a,b,c"] {
            assert!(wrong.parse::<Pair>().is_err(), "{wrong} is no pair");
        }
    }

    #[test]
    fn sizes_are_width_x_height() {
        assert_eq!(
            "640x480".parse(),
            Ok(Size {
                width: 640,
                height: 480
            })
        );
        assert_eq!("1X1".parse(), Ok(Size { width: 1, height: 1 }));
        for wrong in [
            "",
            "640",
            "640x",
            "x480",
            "0x480",
            "640x8193",
            "-1x2",
            "1.5x2",
            "640x480x3",
        ] {
            assert!(wrong.parse::<Size>().is_err(), "{wrong} is no size");
        }
    }
}
