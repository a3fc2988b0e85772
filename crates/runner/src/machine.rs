//! What runs jobs: a [`Device`] with a driver, or any other implementation that answers the same questions.
//!
//! A job says what is to be computed, a machine computes it. Whoever runs jobs takes `&dyn Machine`, so that it works as well
//! where there is no driver. Times come from a `Device` alone: what no driver has run says nothing about a GPU's speed.

use std::fmt::Debug;

use crate::adapter::AdapterInfo;
use crate::compute::{ComputeJob, ComputeOutput};
use crate::device::Device;
use crate::error::Error;
use crate::render::{RenderJob, RenderOutput};
use crate::timing::{self, TimedJob, Timing, TimingOptions};

/// How much goes into one dispatch.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct DispatchLimits {
    /// Workgroups along an axis.
    pub workgroups: u32,
    /// Bytes of one buffer.
    pub buffer_bytes: u64,
}

/// Something that runs jobs. It can be shared between threads.
pub trait Machine: Debug + Send + Sync {
    /// What it is, as reports have it.
    fn info(&self) -> &AdapterInfo;

    /// How much goes into one dispatch.
    fn dispatch_limits(&self) -> DispatchLimits;

    /// Runs a dispatch and reads its writable buffers back. What was never written holds the [sentinel](crate::SENTINEL).
    ///
    /// # Errors
    /// When the resources don't fit the shader, the machine refuses, or memory ends.
    fn compute(&self, job: &ComputeJob<'_>) -> Result<ComputeOutput, Error>;

    /// Renders and reads back.
    ///
    /// # Errors
    /// When meshes, resources or targets don't fit the shaders, the machine refuses, or memory ends.
    fn render(&self, job: &RenderJob<'_>) -> Result<RenderOutput, Error>;

    /// How long jobs take, in turns; `None` from a machine whose times say nothing about a driver's.
    ///
    /// # Errors
    /// As running the jobs.
    fn time(&self, _jobs: &[TimedJob<'_>], _options: &TimingOptions) -> Option<Result<Vec<Timing>, Error>> {
        None
    }
}

impl Machine for Device {
    fn info(&self) -> &AdapterInfo {
        Self::info(self)
    }

    fn dispatch_limits(&self) -> DispatchLimits {
        let limits = self.limits();
        DispatchLimits {
            workgroups: limits.max_compute_workgroups_per_dimension,
            buffer_bytes: limits.max_storage_buffer_binding_size.min(limits.max_buffer_size),
        }
    }

    fn compute(&self, job: &ComputeJob<'_>) -> Result<ComputeOutput, Error> {
        job.prepare(self)?.run(self, job.name)
    }

    fn render(&self, job: &RenderJob<'_>) -> Result<RenderOutput, Error> {
        job.prepare(self)?.run(self, job)
    }

    fn time(&self, jobs: &[TimedJob<'_>], options: &TimingOptions) -> Option<Result<Vec<Timing>, Error>> {
        Some(timing::time(self, jobs, options))
    }
}

impl<M: Machine + ?Sized> Machine for &M {
    fn info(&self) -> &AdapterInfo {
        (**self).info()
    }

    fn dispatch_limits(&self) -> DispatchLimits {
        (**self).dispatch_limits()
    }

    fn compute(&self, job: &ComputeJob<'_>) -> Result<ComputeOutput, Error> {
        (**self).compute(job)
    }

    fn render(&self, job: &RenderJob<'_>) -> Result<RenderOutput, Error> {
        (**self).render(job)
    }

    fn time(&self, jobs: &[TimedJob<'_>], options: &TimingOptions) -> Option<Result<Vec<Timing>, Error>> {
        (**self).time(jobs, options)
    }
}
