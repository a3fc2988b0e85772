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
    /// The other prices of accuracy, one entry a chart and variant.
    pub prices: Vec<Price>,
}

impl Default for Study {
    fn default() -> Self {
        Self {
            schema: SCHEMA,
            environment: BTreeMap::new(),
            points: Vec::new(),
            prices: Vec::new(),
        }
    }
}

/// A technique with its settings, on one map, seen at one angle.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Point {
    /// Technique id, or `user:NAME` for a shader of one's own.
    pub technique: String,
    /// Numbers that the technique takes.
    pub settings: Settings,
    /// The height map's name.
    pub map: String,
    /// Angle of the view from the polygon's normal, degrees.
    pub view_deg: f64,
    /// Distance from the true hit.
    pub error_texels: ErrorTexels,
    /// Time of one frame of rays; none where no driver was timed.
    pub time_ms: Option<Time>,
    /// Operations a ray, counted; the mean.
    pub ops: f64,
    /// Texture reads a ray, counted; the mean.
    pub fetches: f64,
    /// Whether no other point of the same map and angle is both faster and more accurate (p99).
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
    /// Operations an item, counted; the mean.
    pub ops: f64,
    /// Texture reads an item, counted; the mean.
    pub fetches: f64,
    /// Bytes that a texel or an entry takes; 0 where nothing is stored.
    pub bytes: f64,
    /// The command that makes this point again.
    pub rerun: String,
}
