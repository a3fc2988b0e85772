//! Why a chart could not be drawn.

/// What the drawing crates refused.
#[derive(Debug, thiserror::Error)]
#[error("cannot draw the chart {chart}")]
pub struct Error {
    /// The chart's name.
    pub(super) chart: String,
    /// What they said.
    pub(super) source: Box<dyn std::error::Error + Send + Sync>,
}
