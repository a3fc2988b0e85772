//! Other prices of accuracy: what a format, an arithmetic, a filter or a guard costs, and what it errs.
//!
//! One file a chart, each a function that measures its variants. What is the same for all:
//!
//! - **error** against float64 truth, over seeded inputs: the median, the 99th percentile, the greatest. A chart has one unit. A
//!   result that is not a number counts as the unit's greatest error, so every figure is finite;
//! - **time** of one frame of [`Context::frame`] items, all variants of a chart taking turns ([`bossage_runner::TimingOptions`]); a
//!   machine without a driver has none, and the entry says why;
//! - **operations and texture reads** an item, counted while `bossage-bounds` executes the same code;
//! - **bytes** of a texel or an entry, 0 where nothing is stored.
//!
//! Errors are those of the machine's own results, so a driver's filter or division is in them; where a chart says so, those of the
//! evaluator. All figures but times are the same in each run on one machine.

mod arithmetic;
mod codec;
mod derivative;
mod derivative_bilinear;
mod directions;
mod error;
mod filter;
mod form;
mod frame;
mod height_depth;
mod height_normals;
mod heights;
mod normaliser;
mod passes;
mod retype;
mod variant;
mod waves;

use bossage_runner::Machine;
use bossage_shaders::Library;

pub use error::Error;

use crate::record::Price;

/// What measures, and how much.
#[derive(Clone, Copy, Debug)]
pub struct Context<'a> {
    /// What runs the kernels.
    pub machine: &'a dyn Machine,
    /// The shaders.
    pub library: &'a Library,
    /// Fewer items and shorter runs.
    pub quick: bool,
    /// The seed of the inputs.
    pub seed: u64,
}

impl Context<'_> {
    /// Items along a side of a frame, and in it.
    #[must_use]
    pub fn frame(&self) -> [u32; 2] {
        let side = if self.quick { 128 } else { 256 };
        [side, side * side]
    }

    /// The command that makes a chart again. `DIR` stands for the output folder.
    #[must_use]
    pub fn rerun(&self, chart: &str) -> String {
        let quick = if self.quick { " --quick" } else { "" };
        let adapter = self.machine.info().name.replace('\'', "'\\''");
        let seed = self.seed;
        format!("bossage study --price {chart}{quick} --seed {seed} --adapter '{adapter}' -o DIR")
    }
}

/// A chart's measurement.
type Measure = fn(&Context<'_>) -> Result<Vec<Price>, Error>;

/// Every chart, in the order of the report.
const TABLE: [(&str, Measure); 10] = [
    ("arithmetic", arithmetic::prices),
    ("normaliser", normaliser::prices),
    ("codec", codec::prices),
    ("derivative", derivative::prices),
    ("derivative_bilinear", derivative_bilinear::prices),
    ("filter", filter::prices),
    ("height_depth", height_depth::prices),
    ("height_normals", height_normals::prices),
    ("passes", passes::prices),
    ("form", form::prices),
];

/// The names of the charts, in the order of the report.
pub const CHARTS: [&str; TABLE.len()] = {
    let mut names = [""; TABLE.len()];
    let mut at = 0;
    while at < TABLE.len() {
        names[at] = TABLE[at].0;
        at += 1;
    }
    names
};

/// One chart.
///
/// # Errors
/// [`Error::NoSuchChart`], and what goes wrong while it is measured.
pub fn chart(name: &str, context: &Context<'_>) -> Result<Vec<Price>, Error> {
    match TABLE.into_iter().find(|(chart, _)| *chart == name) {
        Some((_, measure)) => measure(context),
        None => Err(Error::NoSuchChart {
            given: name.to_owned(),
        }),
    }
}

/// All charts.
///
/// # Errors
/// What goes wrong while one is measured.
pub fn all(context: &Context<'_>) -> Result<Vec<Price>, Error> {
    let charts = TABLE
        .into_iter()
        .map(|(_, measure)| measure(context))
        .collect::<Result<Vec<_>, _>>()?;
    Ok(charts.concat())
}

#[cfg(test)]
mod tests;
