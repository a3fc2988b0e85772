//! The machine: jobs in, results out, programs compiled once.

use bossage_runner::{
    AdapterInfo, ComputeJob, ComputeOutput, DispatchLimits, Error, Machine, RenderJob, RenderOutput,
};

use crate::bind::MAX_BUFFER_BYTES;
use crate::program::Programs;
use crate::render::render;
use crate::stages::Evaluated;
use crate::{compute, select};

/// Workgroups of a dispatch along an axis: what WebGPU promises everywhere.
const MAX_WORKGROUPS: u32 = 65_535;

/// A machine without a driver. It can be shared between threads; it uses all cores by itself.
///
/// How it rasterises:
/// - Triangles are clipped in homogeneous coordinates at the near and the far plane and at a guard band, in f64. Clipping decides
///   what is covered and nothing else: inputs of fragments are interpolated over the whole triangle.
/// - Positions are snapped to 1/256 of a pixel, as drivers do, and coverage is exact integer arithmetic by the top-left rule: a
///   pixel's centre on an edge that two triangles share belongs to exactly one of them.
/// - Inputs of fragments are interpolated at the pixel's centre from the unsnapped positions, with perspective, in f64, and
///   rounded once to f32; so is depth.
/// - Fragments are shaded in quads of 2 × 2, helper invocations included, so that derivatives are what the quad's are.
/// - Draws and triangles meet the targets in their order.
#[derive(Debug)]
pub struct Embedded {
    info: AdapterInfo,
    pub(crate) programs: Programs,
}

impl Embedded {
    /// A machine with nothing compiled yet.
    #[must_use]
    pub fn new() -> Self {
        Self {
            info: select::info(),
            programs: Programs::default(),
        }
    }
}

impl Default for Embedded {
    fn default() -> Self {
        Self::new()
    }
}

impl Machine for Embedded {
    fn info(&self) -> &AdapterInfo {
        &self.info
    }

    fn dispatch_limits(&self) -> DispatchLimits {
        DispatchLimits {
            workgroups: MAX_WORKGROUPS,
            buffer_bytes: MAX_BUFFER_BYTES,
        }
    }

    fn compute(&self, job: &ComputeJob<'_>) -> Result<ComputeOutput, Error> {
        compute::run(self, job)
    }

    fn render(&self, job: &RenderJob<'_>) -> Result<RenderOutput, Error> {
        render(job, &|draw| Ok(Box::new(Evaluated::new(self, job.name, draw)?)))
    }
}
