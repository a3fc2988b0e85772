//! CPU time of a job, on a driver that runs on the CPU: unlike the wall clock it does not count what other programs take meanwhile.
//!
//! All threads of this process are summed, from what Linux says of each. Preparing a job costs as well; so a run is the difference
//! between many repetitions and one.

use bossage_runner::{Clock, ComputeJob, Device, TimedJob, Timing, TimingOptions, time};

use crate::Failure;

const REPETITIONS: usize = 8;

/// Times jobs in turns, in milliseconds of CPU time a repetition.
pub(crate) fn cpu_times(
    device: &Device,
    jobs: &[ComputeJob<'_>],
    runs: usize,
) -> Result<Vec<Timing>, Failure> {
    let mut all = vec![Vec::with_capacity(runs); jobs.len()];
    for _ in 0..runs {
        for (job, runs_ms) in jobs.iter().zip(&mut all) {
            let once = cost_ms(device, job, 1)?;
            let often = cost_ms(device, job, 1 + REPETITIONS)?;
            runs_ms.push((often - once) / REPETITIONS as f64);
        }
    }
    Ok(all.into_iter().map(summed).collect())
}

/// What timing a job so often costs, with all that goes with it.
fn cost_ms(device: &Device, job: &ComputeJob<'_>, runs: usize) -> Result<f64, Failure> {
    let options = TimingOptions {
        run_ms: 0.0,
        runs,
        max_repetitions: 1,
    };
    let before = process_ms()?;
    time(device, &[TimedJob::Compute(job)], &options)?;
    Ok(process_ms()? - before)
}

/// CPU time of this process's threads so far.
fn process_ms() -> Result<f64, Failure> {
    let mut total_ns = 0.0;
    for task in std::fs::read_dir("/proc/self/task")? {
        let said = std::fs::read_to_string(task?.path().join("schedstat"))?;
        total_ns += said.split(' ').next().unwrap_or_default().parse::<f64>()?;
    }
    Ok(total_ns / 1e6)
}

fn summed(runs_ms: Vec<f64>) -> Timing {
    let mut sorted = runs_ms.clone();
    sorted.sort_by(f64::total_cmp);
    let (min_ms, median_ms, max_ms) = (sorted[0], sorted[sorted.len() / 2], sorted[sorted.len() - 1]);
    Timing {
        median_ms,
        min_ms,
        max_ms,
        spread: (max_ms - min_ms) / median_ms,
        runs_ms,
        repetitions: REPETITIONS as u32,
        clock: Clock::Wall,
    }
}
