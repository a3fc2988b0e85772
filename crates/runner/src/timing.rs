//! How long a job takes on the adapter.
//!
//! Each run repeats the job until it takes [`TimingOptions::run_ms`]; there are [`TimingOptions::runs`] runs of each job, the jobs
//! taking turns, so that a machine that slows down slows all of them. Timestamps of the device are used where there are any,
//! otherwise the wall clock around submission and completion; [`Timing::clock`] says which.
//!
//! What is timed is the dispatch or the passes alone: no upload, no read-back, no compilation. On the `wgsl` route the
//! code holds wgpu's bounds checks; compare times on one route only.

use std::time::Instant;

use crate::compute::{ComputeJob, PreparedCompute};
use crate::device::Device;
use crate::error::Error;
use crate::passes::{PreparedRender, Stamps};
use crate::readback;
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
        Self {
            run_ms: 20.0,
            runs: 9,
            max_repetitions: 4096,
        }
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
    let stopwatch = Stopwatch::new(device);
    let prepared = jobs
        .iter()
        .map(|job| Prepared::new(device, job))
        .collect::<Result<Vec<_>, Error>>()?;
    let repetitions = |job: &Prepared<'_>| stopwatch.calibrate(job, options);
    let repetitions = prepared
        .iter()
        .map(repetitions)
        .collect::<Result<Vec<_>, Error>>()?;
    let mut runs = vec![Vec::with_capacity(options.runs); jobs.len()];
    for _ in 0..options.runs.max(1) {
        for ((job, repetitions), runs) in prepared.iter().zip(&repetitions).zip(&mut runs) {
            let total_ms = stopwatch.measure(job, *repetitions)?;
            runs.push(total_ms / f64::from(*repetitions));
        }
    }
    let summed = runs.into_iter().zip(&repetitions);
    Ok(summed
        .map(|(runs_ms, repetitions)| Timing::of(runs_ms, *repetitions, stopwatch.clock()))
        .collect())
}

impl Timing {
    /// Sums runs up. There is at least one.
    fn of(runs_ms: Vec<f64>, repetitions: u32, clock: Clock) -> Self {
        let mut sorted = runs_ms.clone();
        sorted.sort_by(f64::total_cmp);
        let median_ms = median(&sorted);
        let min_ms = sorted.first().copied().unwrap_or(0.0);
        let max_ms = sorted.last().copied().unwrap_or(0.0);
        let spread = if median_ms > 0.0 {
            (max_ms - min_ms) / median_ms
        } else {
            0.0
        };
        Self {
            median_ms,
            min_ms,
            max_ms,
            spread,
            runs_ms,
            repetitions,
            clock,
        }
    }
}

/// The middle of sorted values; of an even number the mean of the two in the middle.
fn median(sorted: &[f64]) -> f64 {
    let Some(last) = sorted.len().checked_sub(1) else {
        return 0.0;
    };
    (sorted[last / 2] + sorted[last.div_ceil(2)]) / 2.0
}

/// A job on the device.
struct Prepared<'a> {
    name: &'a str,
    work: Work,
}

enum Work {
    Compute(PreparedCompute),
    Render(PreparedRender),
}

impl<'a> Prepared<'a> {
    fn new(device: &Device, job: &TimedJob<'a>) -> Result<Self, Error> {
        Ok(match job {
            TimedJob::Compute(job) => Self {
                name: job.name,
                work: Work::Compute(job.prepare(device)?),
            },
            TimedJob::Render(job) => Self {
                name: job.name,
                work: Work::Render(job.prepare(device)?),
            },
        })
    }

    /// Encodes the repetitions, the first writing a timestamp when it begins and the last when it ends.
    fn encode(&self, encoder: &mut wgpu::CommandEncoder, repetitions: u32, queries: Option<&wgpu::QuerySet>) {
        match &self.work {
            Work::Compute(job) => {
                let stamps = queries.map(|query_set| wgpu::ComputePassTimestampWrites {
                    query_set,
                    beginning_of_pass_write_index: Some(0),
                    end_of_pass_write_index: Some(1),
                });
                job.encode(encoder, repetitions, stamps);
            }
            Work::Render(job) => (0..repetitions).for_each(|pass| {
                let stamps = queries.map(|queries| Stamps {
                    queries,
                    begin: (pass == 0).then_some(0),
                    end: (pass + 1 == repetitions).then_some(1),
                });
                job.encode(encoder, stamps);
            }),
        }
    }
}

/// Two timestamps, and the buffer that they are resolved into.
struct Queries {
    set: wgpu::QuerySet,
    resolved: wgpu::Buffer,
}

/// The clock that a device has.
struct Stopwatch<'a> {
    device: &'a Device,
    queries: Option<Queries>,
}

impl<'a> Stopwatch<'a> {
    fn new(device: &'a Device) -> Self {
        let queries = device.has_timestamps().then(|| Queries {
            set: device.device.create_query_set(&wgpu::QuerySetDescriptor {
                label: Some("time"),
                ty: wgpu::QueryType::Timestamp,
                count: 2,
            }),
            resolved: device.device.create_buffer(&wgpu::BufferDescriptor {
                label: Some("time"),
                size: 16,
                usage: wgpu::BufferUsages::QUERY_RESOLVE | wgpu::BufferUsages::COPY_SRC,
                mapped_at_creation: false,
            }),
        });
        Self { device, queries }
    }

    fn clock(&self) -> Clock {
        if self.queries.is_some() {
            Clock::Timestamps
        } else {
            Clock::Wall
        }
    }

    /// How many repetitions make a run long enough. The first run, which also compiles, is left out.
    fn calibrate(&self, job: &Prepared<'_>, options: &TimingOptions) -> Result<u32, Error> {
        self.measure(job, 1)?;
        let most = options.max_repetitions.max(1);
        let mut repetitions = 1;
        loop {
            let total_ms = self.measure(job, repetitions)?;
            if total_ms >= options.run_ms || repetitions >= most {
                return Ok(repetitions);
            }
            repetitions = more(repetitions, total_ms, options.run_ms).min(most);
        }
    }

    /// Milliseconds that all repetitions take together.
    fn measure(&self, job: &Prepared<'_>, repetitions: u32) -> Result<f64, Error> {
        self.device.scoped(job.name, || {
            let mut encoder = self
                .device
                .device
                .create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
            job.encode(
                &mut encoder,
                repetitions,
                self.queries.as_ref().map(|queries| &queries.set),
            );
            match &self.queries {
                Some(queries) => self.by_timestamps(job, encoder, queries),
                None => self.by_wall(job, encoder),
            }
        })
    }

    fn by_timestamps(
        &self,
        job: &Prepared<'_>,
        mut encoder: wgpu::CommandEncoder,
        queries: &Queries,
    ) -> Result<f64, Error> {
        encoder.resolve_query_set(&queries.set, 0..2, &queries.resolved, 0);
        let (bytes, _) = readback::buffers(self.device, job.name, encoder, &[&queries.resolved])?;
        let words = bytes.iter().flat_map(|bytes| bytes.as_chunks::<8>().0);
        let ticks: Vec<u64> = words.map(|word| u64::from_le_bytes(*word)).collect();
        let [begin, end] = ticks[..] else { return Ok(0.0) };
        let nanoseconds =
            end.saturating_sub(begin) as f64 * f64::from(self.device.queue.get_timestamp_period());
        Ok(nanoseconds / 1e6)
    }

    fn by_wall(&self, job: &Prepared<'_>, encoder: wgpu::CommandEncoder) -> Result<f64, Error> {
        let commands = encoder.finish();
        let start = Instant::now();
        let submission = self.device.queue.submit([commands]);
        self.device.wait(job.name, submission)?;
        Ok(start.elapsed().as_secs_f64() * 1e3)
    }
}

/// More repetitions, after so many took so long: a tenth above what the target seems to need, at least twice and at most
/// 64 times as many, since short times are measured badly.
fn more(repetitions: u32, total_ms: f64, target_ms: f64) -> u32 {
    let factor = (1.1 * target_ms / total_ms.max(1e-6)).clamp(2.0, 64.0);
    (f64::from(repetitions) * factor).ceil() as u32
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn median_is_the_middle_or_the_mean_of_two() {
        assert_eq!(median(&[]), 0.0);
        assert_eq!(median(&[3.0]), 3.0);
        assert_eq!(median(&[1.0, 2.0, 9.0]), 2.0);
        assert_eq!(median(&[1.0, 2.0, 4.0, 9.0]), 3.0);
    }

    #[test]
    fn runs_are_summed_up_in_any_order() {
        let timing = Timing::of(vec![4.0, 1.0, 2.0], 7, Clock::Wall);
        assert_eq!(
            (timing.median_ms, timing.min_ms, timing.max_ms, timing.spread),
            (2.0, 1.0, 4.0, 1.5)
        );
        assert_eq!(timing.runs_ms, [4.0, 1.0, 2.0]);
    }

    #[test]
    fn repetitions_grow_within_bounds_even_when_no_time_passed() {
        assert_eq!(more(1, 0.0, 20.0), 64);
        assert_eq!(more(10, 19.9, 20.0), 20);
        assert_eq!(more(10, 2.0, 20.0), 110);
    }
}
