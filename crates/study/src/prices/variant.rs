//! The variants of a chart, timed in turns and summed up.

use bossage_runner::{ComputeJob, RenderJob, TimedJob, Timing, TimingOptions};

use super::frame::{Cost, Measured};
use super::{Context, Error};
use crate::record::{Price, Time};

/// What is timed of a variant: one frame.
pub(super) enum Timed<'a> {
    Compute(ComputeJob<'a>),
    Render(RenderJob<'a>),
}

/// One variant, measured but for its time.
pub(super) struct Variant<'a> {
    pub(super) name: String,
    /// Error of each item, in the chart's unit.
    pub(super) errors: Vec<f64>,
    pub(super) cost: Cost,
    pub(super) bytes: f64,
    /// One frame, or why it is not timed.
    pub(super) timed: Result<Timed<'a>, String>,
}

impl Timed<'_> {
    fn job(&self) -> TimedJob<'_> {
        match self {
            Self::Compute(job) => TimedJob::Compute(job),
            Self::Render(job) => TimedJob::Render(job),
        }
    }
}

impl<'a> Variant<'a> {
    /// Of a frame that was run, with its errors.
    pub(super) fn new(name: &str, measured: Measured<'a>, bytes: f64, errors: Vec<f64>) -> Self {
        Self {
            name: name.to_owned(),
            errors,
            cost: measured.cost,
            bytes,
            timed: measured.timed,
        }
    }
}

/// Errors summed up.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Quantiles {
    pub(super) p50: f64,
    pub(super) p99: f64,
    pub(super) max: f64,
}

impl Quantiles {
    /// Of finite errors; 0 where there are none. The quantile q is the least error that a share q of all does not exceed.
    pub(super) fn of(mut errors: Vec<f64>) -> Self {
        errors.sort_by(f64::total_cmp);
        let at = |share: f64| {
            let index = (share * errors.len() as f64).ceil() as usize;
            errors.get(index.saturating_sub(1)).copied().unwrap_or(0.0)
        };
        Self {
            p50: at(0.5),
            p99: at(0.99),
            max: at(1.0),
        }
    }
}

/// Times the variants of a chart in turns and makes its entries.
pub(super) fn prices(
    context: &Context<'_>,
    chart: &str,
    unit: &str,
    variants: Vec<Variant<'_>>,
) -> Result<Vec<Price>, Error> {
    let jobs = variants.iter().filter_map(|variant| variant.timed.as_ref().ok());
    let jobs: Vec<TimedJob<'_>> = jobs.map(Timed::job).collect();
    let mut times = times(context, &jobs)?.into_iter();
    let price = |variant: Variant<'_>| {
        let Quantiles { p50, p99, max } = Quantiles::of(variant.errors);
        let time = variant
            .timed
            .and_then(|_| times.next().ok_or_else(|| no_clock(context)));
        Price {
            chart: chart.to_owned(),
            variant: variant.name,
            unit: unit.to_owned(),
            p50,
            p99,
            max,
            no_time: time.as_ref().err().cloned(),
            time_ms: time.ok(),
            ops: variant.cost.ops,
            fetches: variant.cost.fetches,
            bytes: variant.bytes,
            rerun: context.rerun(chart),
        }
    };
    Ok(variants.into_iter().map(price).collect())
}

/// The times of jobs that take turns, in order; none on a machine without a clock.
pub(super) fn times(context: &Context<'_>, jobs: &[TimedJob<'_>]) -> Result<Vec<Time>, Error> {
    match context.machine.time(jobs, &options(context)) {
        Some(times) => Ok(times?.iter().map(time).collect()),
        None => Ok(Vec::new()),
    }
}

fn options(context: &Context<'_>) -> TimingOptions {
    if context.quick {
        TimingOptions {
            run_ms: 5.0,
            runs: 5,
            ..TimingOptions::default()
        }
    } else {
        TimingOptions::default()
    }
}

/// Why there are no times on a machine without a clock.
pub(super) fn no_clock(context: &Context<'_>) -> String {
    format!(
        "no driver: the times of `{}` say nothing of a GPU's",
        context.machine.info().name
    )
}

fn time(timing: &Timing) -> Time {
    Time {
        median: timing.median_ms,
        min: timing.min_ms,
        max: timing.max_ms,
        runs: timing.runs_ms.len() as u32,
    }
}

#[cfg(test)]
mod tests {
    use super::Quantiles;

    #[test]
    fn quantiles_are_errors_that_occurred() {
        let hundred = (1..=100).rev().map(f64::from).collect();
        let expected = Quantiles {
            p50: 50.0,
            p99: 99.0,
            max: 100.0,
        };
        assert_eq!(Quantiles::of(hundred), expected);
        let one = Quantiles::of(vec![3.0]);
        assert_eq!([one.p50, one.p99, one.max], [3.0; 3]);
        assert_eq!(Quantiles::of(Vec::new()), Quantiles::default());
    }
}
