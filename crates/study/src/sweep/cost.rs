//! What a shader does for a ray, counted: operations and texture reads, by the evaluator in f32.
//!
//! The count is of the text that is run, on the first rays of those that are measured; it does not depend on a machine. An operation is one of
//! a scalar, so a `vec4f` sum counts as four; a read is a filtered sample, or a texel that is loaded.

use bossage_bounds::{F32, Limits, run_compute};
use bossage_conformance::route::Prepared;
use bossage_embedded::bindings;
use bossage_runner::{Code, ComputeJob, Shader, resolve};

use crate::error::Error;

/// Means over rays.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cost {
    /// Scalar operations.
    pub ops: f64,
    /// Samples and texels.
    pub fetches: f64,
}

/// Counts a dispatch that handles so many rays.
///
/// # Errors
/// When the evaluator lacks what the shader needs, or the shader does not end.
pub fn count(prepared: &Prepared, job: &ComputeJob<'_>, rays: usize) -> Result<Cost, Error> {
    let entry = job.shader.entry;
    let refused =
        |problem: String| Error::Shader(format!("{}: its cost cannot be counted: {problem}", job.name));
    let program = prepared.program(&entry.name).map_err(refused)?;
    let shader = Shader {
        code: Code::Wgsl(prepared.text()),
        entry,
    };
    let resolved = resolve(job.name, &[&shader], &job.resources)?;
    let mut bound = bindings::<F32>(job.name, &resolved)?;
    let outcome = run_compute(&program, &mut bound, job.workgroups, &Limits::default())
        .map_err(|error| refused(error.to_string()))?;
    let mean = |count: u64| count as f64 / rays.max(1) as f64;
    Ok(Cost {
        ops: mean(outcome.counters.operations),
        fetches: mean(outcome.counters.fetches),
    })
}
