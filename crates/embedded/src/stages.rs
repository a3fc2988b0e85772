//! The two stages of a draw: what runs them, and how the evaluator does.

use std::sync::Arc;

use bossage_bounds::{Bindings, F32, Limits, StageInputs, StageOutputs, run_fragment, run_vertex};
use bossage_runner::{Draw, Error, push_constants, resolve};

use crate::bind::bindings;
use crate::failure::of_job;
use crate::machine::Embedded;
use crate::program::Compiled;

/// What runs the two stages of a draw, bound to what the draw binds.
pub trait Stages {
    /// Runs the vertex stage.
    ///
    /// # Errors
    /// What the machine says.
    fn vertices(&mut self, inputs: &StageInputs<F32>) -> Result<StageOutputs<F32>, Error>;

    /// Runs the fragment stage over quads: each four are the pixels (0,0), (1,0), (0,1), (1,1).
    ///
    /// # Errors
    /// What the machine says.
    fn fragments(&mut self, inputs: &StageInputs<F32>) -> Result<StageOutputs<F32>, Error>;

    /// Whether the fragment stage may end without a result.
    fn may_discard(&self) -> bool;
}

/// Opens the stages of a draw, bound to what it binds.
pub type Open<'a> = dyn Fn(&Draw<'_>) -> Result<Box<dyn Stages>, Error> + 'a;

/// The evaluator.
pub(crate) struct Evaluated {
    job: String,
    bindings: Bindings<F32>,
    vertex: Arc<Compiled>,
    fragment: Arc<Compiled>,
}

impl Evaluated {
    /// The stages of a draw, compiled and bound.
    pub(crate) fn new(machine: &Embedded, job: &str, draw: &Draw<'_>) -> Result<Self, Error> {
        let shaders = [&draw.vertex, &draw.fragment];
        let resolved = resolve(job, &shaders, &draw.resources)?;
        let pushed = push_constants(job, &shaders, &draw.resources)?;
        Ok(Self {
            job: job.to_owned(),
            bindings: bindings(job, &resolved)?.immediate(pushed),
            vertex: machine.programs.get(job, &draw.vertex)?,
            fragment: machine.programs.get(job, &draw.fragment)?,
        })
    }
}

impl Stages for Evaluated {
    fn vertices(&mut self, inputs: &StageInputs<F32>) -> Result<StageOutputs<F32>, Error> {
        let limits = Limits::default();
        let run = run_vertex(&self.vertex.program, &mut self.bindings, inputs, &limits);
        run.map(|(outputs, _)| outputs)
            .map_err(|refusal| of_job(&self.job, refusal))
    }

    fn fragments(&mut self, inputs: &StageInputs<F32>) -> Result<StageOutputs<F32>, Error> {
        let limits = Limits::default();
        let run = run_fragment(&self.fragment.program, &mut self.bindings, inputs, &limits);
        run.map(|(outputs, _)| outputs)
            .map_err(|refusal| of_job(&self.job, refusal))
    }

    fn may_discard(&self) -> bool {
        self.fragment.may_discard
    }
}
