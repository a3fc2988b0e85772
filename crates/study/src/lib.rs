//! What accuracy costs in time: techniques and settings swept over maps and view angles, their error against float64 truth set
//! beside their time and their counted operations.
//!
//! [`record::Study`] is what a sweep writes and what pictures and the report page are drawn from.
//!
//! ```
//! use bossage_study::record::{Settings, Study};
//!
//! let settings = Settings::of([("layers", 16.0), ("refinements", 5.0)]);
//! assert_eq!(settings.to_string(), "layers=16 refinements=5");
//! let study = Study::default();
//! assert_eq!(serde_json::to_value(&study)?["schema"], 1);
//! # Ok::<(), serde_json::Error>(())
//! ```

pub mod calibrate;
pub mod chart;
mod error;
pub mod flip;
pub mod pareto;
pub mod pictures;
pub mod prices;
pub mod record;
pub mod report;
#[cfg(test)]
mod sample;
pub mod sweep;
pub mod versus;

pub use error::Error;
