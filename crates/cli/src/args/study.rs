//! Flags of `bossage study`.

use std::path::PathBuf;

use clap::ValueEnum;

use super::bake::EdgeName;

pub(crate) const EXAMPLE: &str = "\
Examples:
  bossage study -o study
  bossage study --quick -o study
  bossage study --technique exact --technique parallax_occlusion:layers=64 --map bricks --view-deg 75 -o study
  bossage study --shader my_relief.wgsl --map examples/textures/bricks_height.png -o study
  bossage study --price codec --price normaliser -o study
  bossage study --calibrate my_gpu.toml --adapter NVIDIA -o study";

/// `bossage study`.
#[derive(Debug, clap::Args)]
pub(crate) struct Study {
    /// The folder for study.json, the report and the finished points, with which an interrupted study goes on
    #[arg(short, long, value_name = "DIR")]
    pub(crate) output: PathBuf,
    /// A technique with all of its usual settings, or with these, as `relief:layers=16,refinements=5` [default: all]
    #[arg(long, value_name = "TECHNIQUE")]
    pub(crate) technique: Vec<String>,
    /// A relief shader of your own (.wgsl, .wesl) with the bindings of the library's `relief_hits`
    #[arg(long, value_name = "FILE")]
    pub(crate) shader: Vec<PathBuf>,
    /// A chart of other prices, as codec, and no rays [default: all charts, where no technique, map, scene, shader or angle is chosen]
    #[arg(long, value_name = "CHART", conflicts_with_all = ["technique", "shader", "calibrate"])]
    pub(crate) price: Vec<String>,
    #[command(flatten, next_help_heading = "What is seen")]
    pub(crate) seen: Seen,
    #[command(flatten, next_help_heading = "How it is measured")]
    pub(crate) measured: Measured,
}

impl Study {
    /// Whether nothing is chosen, so that everything is meant.
    pub(crate) fn is_whole(&self) -> bool {
        let Seen {
            map, scene, view_deg, ..
        } = &self.seen;
        self.technique.is_empty()
            && self.shader.is_empty()
            && map.is_empty()
            && scene.is_empty()
            && view_deg.is_empty()
    }
}

/// Maps and rays.
#[derive(Debug, clap::Args)]
pub(crate) struct Seen {
    /// A height map: an image, or bricks or jacksboro, which are bundled [default: both, without --scene]
    #[arg(long, value_name = "FILE")]
    pub(crate) map: Vec<String>,
    /// A scene, or brick_wall or elevation, which are bundled: its materials with a height map, at their own depth, at all angles and as its
    /// camera sees them
    #[arg(long, value_name = "SCENE")]
    pub(crate) scene: Vec<PathBuf>,
    /// Angles of the view from the surface's normal, degrees [default: 0, 30, 60, 75, 85]
    #[arg(long, value_name = "DEGREES", value_delimiter = ',', allow_negative_numbers = true, value_parser = view_deg)]
    pub(crate) view_deg: Vec<f64>,
    /// How deep the relief of a map is, in widths of its tile
    #[arg(long, value_name = "WIDTHS", default_value_t = 0.05, allow_negative_numbers = true, value_parser = depth)]
    pub(crate) depth: f64,
    /// What lies beyond the edge of a map [default: wrap; jacksboro: clamp]
    #[arg(long, value_name = "MODE")]
    pub(crate) edge: Option<EdgeName>,
}

/// Rays, times and where they go.
#[derive(Debug, clap::Args)]
pub(crate) struct Measured {
    /// Fewer rays, settings and angles: a first look, in about a minute
    #[arg(long)]
    pub(crate) quick: bool,
    /// How many rays at each angle of each map [default: 65536; quick: 16384]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=1 << 22))]
    pub(crate) rays: Option<u32>,
    /// The seed of the rays
    #[arg(long, value_name = "SEED", default_value_t = 1)]
    pub(crate) seed: u64,
    /// Measure everything again, also what the folder has finished
    #[arg(long)]
    pub(crate) fresh: bool,
    /// Write what a ray and a step of each technique cost on this adapter, as a cost profile for scenes
    #[arg(long, value_name = "FILE", conflicts_with = "quick")]
    pub(crate) calibrate: Option<PathBuf>,
    /// What the driver is given: the emitted SPIR-V as it is, or WGSL with wgpu's checks of bounds and loops
    #[arg(long, value_name = "ROUTE", default_value = "spirv")]
    pub(crate) route: RouteName,
    /// Measure on the first adapter whose name contains this
    #[arg(long, value_name = "ADAPTER")]
    pub(crate) adapter: Option<String>,
}

/// Routes that are timed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum RouteName {
    Spirv,
    Wgsl,
}

/// An angle that a surface can be seen at from above.
fn view_deg(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(degrees) if (0.0..90.0).contains(&degrees) => Ok(degrees),
        _ => Err("write degrees from the normal, from 0 and below 90".to_owned()),
    }
}

/// A thickness that f32 holds.
fn depth(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(widths) if (0.0..=10.0).contains(&widths) => Ok(widths),
        _ => Err("write widths of the tile, from 0 to 10".to_owned()),
    }
}

#[cfg(test)]
mod tests {
    use super::{depth, view_deg};

    #[test]
    fn angles_and_depths_are_numbers_in_their_range() {
        assert_eq!(view_deg("75"), Ok(75.0));
        assert_eq!(depth("0"), Ok(0.0));
        for wrong in ["", "-1", "90", "NaN", "inf", "a"] {
            assert!(view_deg(wrong).is_err(), "{wrong} is no angle");
        }
        for wrong in ["", "-0.1", "11", "NaN", "inf"] {
            assert!(depth(wrong).is_err(), "{wrong} is no depth");
        }
    }
}
