//! The sweep: every technique with every setting, over every map at every view angle.
//!
//! A *cell* is a map with its rays. Truth is made once a cell; all techniques answer the same rays, and they are timed in turns, so that
//! a machine that slows down slows all of them. When a cell is done its points are kept in the [`journal`], and a study that is interrupted
//! goes on with the cell that it was at.
//!
//! What is measured, and what is not, is in `docs/study.md`.

pub mod cost;
pub mod journal;
pub mod kernel;
mod key;
pub mod ladder;
pub mod map;
pub mod rays;
pub mod seen;
pub mod statistics;
pub mod subject;
mod textures;
pub mod truth;

use std::sync::Arc;

use bossage_runner::{ComputeJob, Machine, TimedJob, TimingOptions};
use rayon::prelude::*;

use crate::error::Error;
use crate::record::{Point, SceneError, Time};
use cost::Cost;
use journal::Journal;
use map::Map;
use rays::ViewRay;
use seen::Screen;
use statistics::Summary;
use subject::Subject;

/// How a sweep measures.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Options {
    /// Of so many rays operations and reads are counted; errors and times are of all.
    pub counted: usize,
    /// How times are taken.
    pub timing: TimingOptions,
}

/// A map with its rays.
#[derive(Clone, Debug)]
pub struct Cell {
    /// The map.
    pub map: Arc<Map>,
    /// Angle from the normal that its points state, degrees.
    pub view_deg: f64,
    /// The rays.
    pub rays: Vec<ViewRay>,
    /// What the rays are on a screen, where they are those of a scene's camera.
    pub screen: Option<Screen>,
    /// The flags that make the cell again, after `bossage study`.
    pub flags: String,
}

/// What was found of one technique in a cell, but for its time.
struct Measured {
    summary: Summary,
    scene: Option<SceneError>,
    cost: Cost,
    steps: Option<f64>,
}

/// Who is told how far a sweep is.
pub trait Watch {
    /// So many cells there are.
    fn start(&mut self, cells: usize);
    /// One begins.
    fn begin(&mut self, cell: &Cell);
    /// One is done; so many of its points were measured now, the others had been before.
    fn done(&mut self, measured: usize);
}

/// Nobody.
#[derive(Clone, Copy, Debug)]
pub struct Unwatched;

impl Watch for Unwatched {
    fn start(&mut self, _cells: usize) {}
    fn begin(&mut self, _cell: &Cell) {}
    fn done(&mut self, _measured: usize) {}
}

/// Everything that a sweep needs.
#[derive(Clone, Copy, Debug)]
pub struct Sweep<'a> {
    /// What runs the shaders.
    pub machine: &'a dyn Machine,
    /// Techniques with their settings.
    pub subjects: &'a [Subject],
    /// Maps with their rays.
    pub cells: &'a [Cell],
    /// How.
    pub options: Options,
}

impl Sweep<'_> {
    /// Measures what the journal does not have, and answers all points: cell by cell, in the subjects' order.
    ///
    /// # Errors
    /// Nothing to measure; a shader that cannot be run; a journal that cannot be written.
    pub fn run(&self, journal: &mut Journal, watch: &mut dyn Watch) -> Result<Vec<Point>, Error> {
        if self.subjects.is_empty() {
            return Err(Error::Nothing(
                "no technique is left to measure; name one with --technique".to_owned(),
            ));
        }
        if self.cells.iter().all(|cell| cell.rays.is_empty()) {
            return Err(Error::Nothing(
                "no ray is left to measure; name a map and a view angle".to_owned(),
            ));
        }
        let mut points = Vec::new();
        watch.start(self.cells.len());
        for cell in self.cells {
            watch.begin(cell);
            let keys: Vec<String> = self
                .subjects
                .iter()
                .map(|subject| self.key(cell, subject))
                .collect();
            let missing: Vec<usize> = (0..keys.len())
                .filter(|at| journal.get(&keys[*at]).is_none())
                .collect();
            if !missing.is_empty() {
                let measured = self.measure(cell, &missing)?;
                let keyed = missing.iter().map(|at| keys[*at].clone()).zip(measured);
                journal.keep(keyed.collect())?;
            }
            points.extend(keys.iter().filter_map(|key| journal.get(key).cloned()));
            watch.done(missing.len());
        }
        Ok(points)
    }

    fn key(&self, cell: &Cell, subject: &Subject) -> String {
        key::of(self.machine.info(), cell, subject, &self.options)
    }

    /// The points of some subjects in one cell.
    fn measure(&self, cell: &Cell, which: &[usize]) -> Result<Vec<Point>, Error> {
        let truths = truth::trace(&cell.map, &cell.rays);
        let counted = &cell.rays[..cell.rays.len().min(self.options.counted)];
        let (all, first) = (kernel::pack(&cell.rays), kernel::pack(counted));
        let subjects: Vec<&Subject> = which.iter().map(|at| &self.subjects[*at]).collect();
        let whole: Vec<ComputeJob<'_>> = subjects
            .iter()
            .map(|subject| subject.job(&cell.map, &all))
            .collect::<Result<_, _>>()?;
        let cost = |subject: &&Subject| {
            let job = subject.job(&cell.map, &first)?;
            cost::count(&subject.prepared, &job, counted.len())
        };
        let costs: Vec<Cost> = subjects.par_iter().map(cost).collect::<Result<_, _>>()?;
        let mut measures = Vec::with_capacity(whole.len());
        for ((subject, job), cost) in subjects.iter().zip(&whole).zip(costs) {
            let answers = kernel::answers(&job.run(self.machine)?, cell.rays.len());
            measures.push(Measured {
                steps: subject.steps(&cell.map, counted),
                summary: statistics::summarise(&truths, &answers),
                scene: cell.screen.as_ref().map(|screen| screen.error(&truths, &answers)),
                cost,
            });
        }
        let times = self.times(&whole)?;
        let point = |((subject, measured), time)| self.point(cell, subject, measured, time);
        Ok(subjects.into_iter().zip(measures).zip(times).map(point).collect())
    }

    /// Times of all jobs, in turns; none from a machine that has no driver.
    fn times(&self, jobs: &[ComputeJob<'_>]) -> Result<Vec<Option<Time>>, Error> {
        let timed: Vec<TimedJob<'_>> = jobs.iter().map(TimedJob::Compute).collect();
        let Some(timings) = self.machine.time(&timed, &self.options.timing) else {
            return Ok(vec![None; jobs.len()]);
        };
        let of = |timing: bossage_runner::Timing| Time {
            median: timing.median_ms,
            min: timing.min_ms,
            max: timing.max_ms,
            runs: timing.runs_ms.len() as u32,
        };
        Ok(timings?.into_iter().map(of).map(Some).collect())
    }

    fn point(&self, cell: &Cell, subject: &Subject, measured: Measured, time: Option<Time>) -> Point {
        let Measured {
            summary,
            scene,
            cost,
            steps,
        } = measured;
        let no_time = time.is_none().then(|| {
            let adapter = &self.machine.info().name;
            format!("`{adapter}` has no driver: its times say nothing about a GPU")
        });
        Point {
            technique: subject.id.clone(),
            settings: subject.settings.clone(),
            map: cell.map.name.clone(),
            view_deg: cell.view_deg,
            rays: cell.rays.len() as u64,
            error_texels: summary.error_texels,
            disagreement: summary.disagreement,
            grazing: summary.grazing,
            scene,
            time_ms: time,
            no_time,
            ops: cost.ops,
            fetches: cost.fetches,
            steps,
            pareto: false,
            rerun: format!("bossage study {} {}", subject.flags, cell.flags),
        }
    }
}
