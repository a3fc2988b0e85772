//! The targets of a job and its depth buffer, and how fragments meet them.

use bossage_runner::{Blend, Depth, Draw, RenderJob, RenderOutput};

use crate::shade::{Quad, Shaded, Shading};
use crate::surface::{Surface, passes, writes};

/// Everything that draws leave their results in.
#[derive(Debug)]
pub(crate) struct Frame {
    width: u32,
    height: u32,
    surfaces: Vec<Surface>,
    depth: Vec<f32>,
}

impl Frame {
    /// Cleared targets, and depths of 1.
    pub(crate) fn new(job: &RenderJob<'_>) -> Self {
        let pixels = job.width as usize * job.height as usize;
        let surface = |target| Surface::new(target, pixels);
        Self {
            width: job.width,
            height: job.height,
            surfaces: job.targets.iter().map(surface).collect(),
            depth: vec![1.0; pixels],
        }
    }

    /// What the job leaves.
    pub(crate) fn finish(self, read_depth: bool) -> RenderOutput {
        let (width, height) = (self.width, self.height);
        let picture = |surface: Surface| surface.picture(width, height);
        RenderOutput {
            targets: self.surfaces.into_iter().map(picture).collect(),
            depth: read_depth.then_some(self.depth),
        }
    }

    fn index(&self, [x, y]: [u32; 2]) -> usize {
        y as usize * self.width as usize + x as usize
    }

    /// The depth test before shading, for stages that neither discard nor return a depth: only what is seen is left. Where
    /// colours replace each other, that is one fragment a pixel.
    pub(crate) fn test_early(
        &mut self,
        quads: Vec<Quad>,
        shading: &Shading<'_>,
        draw: &Draw<'_>,
    ) -> Vec<Quad> {
        let mut last = vec![u32::MAX; self.depth.len()];
        let mut passed = Vec::with_capacity(quads.len());
        for (number, mut quad) in (0..).zip(quads) {
            for lane in quad.lanes() {
                let at = self.index(quad.pixel(lane));
                let depth = shading.weights(&quad, lane).depth();
                if self.test(at, depth, draw.depth) {
                    last[at] = number;
                } else {
                    quad.mask &= !(1 << lane);
                }
            }
            passed.push(quad);
        }
        if draw.blend == Blend::Replace {
            for (number, quad) in (0..).zip(&mut passed) {
                for lane in quad.lanes() {
                    if last[self.index(quad.pixel(lane))] != number {
                        quad.mask &= !(1 << lane);
                    }
                }
            }
        }
        passed.retain(|quad| quad.mask != 0);
        passed
    }

    /// Leaves out what is hidden whatever the draw does: depths only ever come nearer.
    pub(crate) fn leave_hidden_out(
        &self,
        mut quads: Vec<Quad>,
        shading: &Shading<'_>,
        depth: Depth,
    ) -> Vec<Quad> {
        for quad in &mut quads {
            for lane in quad.lanes() {
                let kept = self.depth[self.index(quad.pixel(lane))];
                if !passes(depth, shading.weights(quad, lane).depth(), kept) {
                    quad.mask &= !(1 << lane);
                }
            }
        }
        quads.retain(|quad| quad.mask != 0);
        quads
    }

    /// Writes shaded quads in their order. `late` says that the depth test is still to be made.
    pub(crate) fn write(
        &mut self,
        quads: &[Quad],
        shading: &Shading<'_>,
        shaded: &Shaded,
        draw: &Draw<'_>,
        late: bool,
    ) {
        for (number, quad) in quads.iter().enumerate() {
            for lane in quad.lanes() {
                let fragment = 4 * number + lane as usize;
                let at = self.index(quad.pixel(lane));
                if late {
                    let own = || shading.weights(quad, lane).depth();
                    let depth = shaded.depth(fragment).unwrap_or_else(own);
                    if !shaded.is_kept(fragment) || !self.test(at, depth, draw.depth) {
                        continue;
                    }
                }
                for (location, surface) in (0..).zip(&mut self.surfaces) {
                    let blend = if location == 0 { draw.blend } else { Blend::Replace };
                    if let Some(colour) = shaded.colour(location, fragment) {
                        surface.write(at, colour, blend);
                    }
                }
            }
        }
    }

    /// The depth test of one fragment, which leaves its depth where it passes.
    fn test(&mut self, at: usize, depth: f32, test: Depth) -> bool {
        let passed = passes(test, depth, self.depth[at]);
        if passed && writes(test) {
            self.depth[at] = depth;
        }
        passed
    }
}
