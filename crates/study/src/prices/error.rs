//! What can go wrong while prices are measured.

use super::CHARTS;

/// Why a chart of prices could not be made.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// The name is no chart's.
    #[error("no chart of prices is called `{given}`; there are: {}", CHARTS.join(", "))]
    NoSuchChart {
        /// What was asked for.
        given: String,
    },
    /// A kernel does not assemble.
    #[error("a kernel of the study does not assemble")]
    Assemble(#[from] bossage_shaders::Error),
    /// A kernel does not translate, or leaves something out.
    #[error("kernel `{kernel}`: {problem}")]
    Kernel {
        /// The kernel.
        kernel: String,
        /// What is wrong with it.
        problem: String,
    },
    /// The machine refuses a job.
    #[error("the machine refuses a job of the study")]
    Run(#[from] bossage_runner::Error),
    /// The operations of a kernel cannot be counted.
    #[error("the operations of a kernel of the study cannot be counted")]
    Count(#[from] bossage_bounds::Error),
    /// A map cannot be made.
    #[error("a map of the study cannot be made")]
    Map(#[from] bossage_assets::Error),
}
