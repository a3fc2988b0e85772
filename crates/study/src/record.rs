//! What a study found, as `study.json` holds it: schema 1.

use std::collections::BTreeMap;
use std::fmt;

use serde::{Deserialize, Serialize};

/// Version of this form.
pub const SCHEMA: u32 = 1;

/// A whole study.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Study {
    /// [`SCHEMA`].
    pub schema: u32,
    /// What it ran on, as reports have it: adapter, driver, CPU, versions.
    pub environment: BTreeMap<String, String>,
    /// The relief ladder: one entry a technique, settings, map and view angle.
    pub points: Vec<Point>,
    /// `exact` beside marching, one entry a map and view angle where both were timed.
    #[serde(default)]
    pub exact_against_marching: Vec<Versus>,
    /// The other prices of accuracy, one entry a chart and variant.
    pub prices: Vec<Price>,
}

impl Default for Study {
    fn default() -> Self {
        Self {
            schema: SCHEMA,
            environment: BTreeMap::new(),
            points: Vec::new(),
            exact_against_marching: Vec::new(),
            prices: Vec::new(),
        }
    }
}

/// A technique with its settings, on one map, seen at one angle.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Point {
    /// Technique id, or `user:NAME` for a shader of one's own.
    pub technique: String,
    /// Numbers that the technique takes.
    pub settings: Settings,
    /// The height map's name.
    pub map: String,
    /// Angle of the view from the polygon's normal, degrees.
    pub view_deg: f64,
    /// How many rays it is of.
    #[serde(default)]
    pub rays: u64,
    /// Distance from the nearest hit that counts.
    pub error_texels: ErrorTexels,
    /// Where answers and truth differ in kind.
    #[serde(default)]
    pub disagreement: Disagreement,
    /// Share of rays with more than one hit that counts, in [0, 1].
    #[serde(default)]
    pub grazing: f64,
    /// What it is on screen; none but for rays of a scene's camera.
    #[serde(default)]
    pub scene: Option<SceneError>,
    /// Time of one frame of rays; none where no driver was timed.
    pub time_ms: Option<Time>,
    /// Why there is no time.
    #[serde(default)]
    pub no_time: Option<String>,
    /// Operations a ray, counted; the mean.
    pub ops: f64,
    /// Texture reads a ray, counted; the mean.
    pub fetches: f64,
    /// Steps a ray of the reference search in f64; the mean. None for shaders that have no reference.
    #[serde(default)]
    pub steps: Option<f64>,
    /// Whether no other point of the same map and angle is at least as fast and as accurate (p99), and better in one of both.
    pub pareto: bool,
    /// The command that makes this point again.
    pub rerun: String,
}

/// Numbers that a technique takes, by name, sorted.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(transparent)]
pub struct Settings(pub BTreeMap<String, f64>);

impl Settings {
    /// From names and numbers.
    #[must_use]
    pub fn of<const N: usize>(settings: [(&str, f64); N]) -> Self {
        Self(
            settings
                .into_iter()
                .map(|(name, value)| (name.to_owned(), value))
                .collect(),
        )
    }
}

impl fmt::Display for Settings {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (index, (name, value)) in self.0.iter().enumerate() {
            let gap = if index == 0 { "" } else { " " };
            write!(f, "{gap}{name}={value}")?;
        }
        Ok(())
    }
}

/// Distances between answers and true hits over many rays, in texels.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct ErrorTexels {
    /// Mean.
    pub mean: f64,
    /// Median.
    pub p50: f64,
    /// 99th percentile.
    pub p99: f64,
    /// Greatest.
    pub max: f64,
    /// Share of rays that are more than one texel off, in [0, 1].
    pub over_1: f64,
}

/// Mean, percentiles and greatest of some values; percentiles are values of the sample.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Spread {
    /// Mean.
    pub mean: f64,
    /// Median.
    pub p50: f64,
    /// 99th percentile.
    pub p99: f64,
    /// Greatest.
    pub max: f64,
}

/// Shares of rays whose answer is of another kind than the truth, in [0, 1].
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Disagreement {
    /// More than one texel behind the hit along the ray: it went through the surface.
    pub missed: f64,
    /// More than one texel before the hit: it stopped where nothing is.
    pub early: f64,
    /// No number. Such answers have no distance and are left out of the errors.
    pub lost: f64,
    /// Another status than the truth's: the cap was reached, say.
    pub status: f64,
}

/// What an error is in a scene's picture.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct SceneError {
    /// The scene's name.
    pub scene: String,
    /// Distances to the nearest hit that counts, on screen, pixels.
    pub error_px: Spread,
    /// Differences of colour to the scene's f64 picture, over the pixels of its surfaces: of each the channel that is farthest off, in
    /// linear light. None where the technique was not drawn.
    #[serde(default)]
    pub colour: Option<Spread>,
    /// Mean FLIP to the scene's f64 picture, in [0, 1]; none where the technique was not drawn.
    #[serde(default)]
    pub flip: Option<f64>,
    /// Why it was not drawn.
    #[serde(default)]
    pub not_drawn: Option<String>,
}

/// `exact` beside the marching techniques, on one map at one angle.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Versus {
    /// The height map's name.
    pub map: String,
    /// Angle of the view from the polygon's normal, degrees.
    pub view_deg: f64,
    /// `exact`.
    pub exact: Rival,
    /// The p99 error at which times are compared, texels.
    pub error_texels: f64,
    /// Whether `exact` has at most that error.
    pub exact_gets_there: bool,
    /// The fastest march with at most that error, or else the one that comes nearest to it.
    pub at_equal_error: Rival,
    /// Whether it has at most that error.
    pub gets_there: bool,
    /// Its time over that of `exact`.
    pub times_faster: f64,
    /// The most exact march that takes no longer than `exact`, or else the fastest.
    pub at_equal_time: Rival,
    /// Whether it takes no longer.
    pub is_as_fast: bool,
    /// Its p99 error over that of `exact`; none where `exact` has no error.
    pub times_smaller: Option<f64>,
}

/// A point in a comparison.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Rival {
    /// Technique id.
    pub technique: String,
    /// Its settings.
    pub settings: Settings,
    /// 99th percentile of its error, texels.
    pub p99: f64,
    /// Median time, milliseconds.
    pub ms: f64,
}

/// Times of one job, milliseconds.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Time {
    /// Median of the runs.
    pub median: f64,
    /// Fastest run.
    pub min: f64,
    /// Slowest run.
    pub max: f64,
    /// How many runs.
    pub runs: u32,
}

/// One variant of something else whose accuracy has a price: arithmetic, codecs, normalisers, filters, bit depths, passes, forms.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Price {
    /// The chart that it belongs to, as `arithmetic`, `normaliser`, `codec`.
    pub chart: String,
    /// The variant, as `f16`.
    pub variant: String,
    /// What the error is measured in, as `degrees`.
    pub unit: String,
    /// Median error.
    pub p50: f64,
    /// 99th percentile of the error.
    pub p99: f64,
    /// Greatest error.
    pub max: f64,
    /// Time of one frame; none where no driver was timed.
    pub time_ms: Option<Time>,
    /// Why there is no time.
    #[serde(default)]
    pub no_time: Option<String>,
    /// Operations an item, counted; the mean.
    pub ops: f64,
    /// Texture reads an item, counted; the mean.
    pub fetches: f64,
    /// Bytes that a texel or an entry takes; 0 where nothing is stored.
    pub bytes: f64,
    /// The command that makes this point again.
    pub rerun: String,
}
