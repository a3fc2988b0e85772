//! Offscreen rendering to float targets.
//!
//! All draws of a job share the targets and one depth buffer. Clip space is WebGPU's on both routes (y up, depth 0 to 1):
//! emit SPIR-V without a clip-space adjustment, as `EmitOptions` does unless told otherwise. wgpu gives Vulkan a viewport of
//! negative height, which is what such modules expect.
//!
//! A target that is cleared to the [sentinel](crate::SENTINEL) tells which pixels a draw wrote: see
//! [`Picture::covered`]. No multisampling.

use crate::code::Shader;
use crate::error::Error;
use crate::machine::Machine;
use crate::mesh::Mesh;
use crate::resources::Resources;

/// What a target holds before the first draw.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Clear {
    /// A colour.
    Colour([f32; 4]),
    /// The sentinel in every component.
    Sentinel,
}

/// Which side of triangles is left out.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Cull {
    /// None.
    #[default]
    None,
    /// Those seen from behind (clockwise).
    Back,
    /// Those seen from the front (counter-clockwise).
    Front,
}

/// How a draw's colour meets what the target holds.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Blend {
    /// It replaces it.
    #[default]
    Replace,
    /// It is added.
    Add,
    /// It is multiplied.
    Multiply,
}

/// How a draw uses the depth buffer.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Depth {
    /// Nearer wins, and is written.
    #[default]
    TestAndWrite,
    /// What is as near or nearer wins, and nothing is written: for a second pass over the same mesh.
    TestOnly,
    /// No test, nothing is written.
    Ignore,
}

/// One mesh with one pair of shaders.
#[derive(Clone, Debug)]
pub struct Draw<'a> {
    /// The vertex stage. Both stages take the same route.
    pub vertex: Shader<'a>,
    /// The fragment stage.
    pub fragment: Shader<'a>,
    /// What is drawn.
    pub mesh: &'a Mesh,
    /// What both stages bind.
    pub resources: Resources<'a>,
    /// Which side is left out.
    pub cull: Cull,
    /// How `@location(0)` meets the target. Other targets are replaced.
    pub blend: Blend,
    /// How the depth buffer is used.
    pub depth: Depth,
}

/// A picture to render: `targets.len()` pictures in rgba32float at once.
#[derive(Clone, Debug)]
pub struct RenderJob<'a> {
    /// The name that errors use.
    pub name: &'a str,
    /// In pixels.
    pub width: u32,
    /// In pixels.
    pub height: u32,
    /// What the target of each `@location` holds before the first draw. A draw whose fragment stage lacks a location leaves
    /// that target alone; an output beyond the last target is an error.
    pub targets: Vec<Clear>,
    /// Whether the depth buffer is read back as well.
    pub read_depth: bool,
    /// Drawn in this order.
    pub draws: Vec<Draw<'a>>,
}

/// One target's pixels, row 0 at the top.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Picture {
    /// In pixels.
    pub width: u32,
    /// In pixels.
    pub height: u32,
    /// The pixels.
    pub pixels: Vec<[f32; 4]>,
}

impl Picture {
    /// The pixel at (x, y) from the top left.
    #[must_use]
    pub fn pixel(&self, x: u32, y: u32) -> Option<[f32; 4]> {
        if x >= self.width || y >= self.height {
            return None;
        }
        self.pixels
            .get(y as usize * self.width as usize + x as usize)
            .copied()
    }

    /// For each pixel of a target that was cleared to the sentinel: whether a draw wrote it.
    #[must_use]
    pub fn covered(&self) -> Vec<bool> {
        let is_written = |pixel: &[f32; 4]| !pixel.iter().all(|value| crate::is_unwritten(*value));
        self.pixels.iter().map(is_written).collect()
    }
}

/// What a render job leaves.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct RenderOutput {
    /// By `@location`.
    pub targets: Vec<Picture>,
    /// The depth buffer, row by row from the top, where it was asked for; 1 where nothing was drawn.
    pub depth: Option<Vec<f32>>,
}

impl RenderJob<'_> {
    /// Renders and reads back.
    ///
    /// # Errors
    /// When meshes, resources or targets don't fit the shaders, the machine refuses, or memory ends.
    pub fn run(&self, machine: &dyn Machine) -> Result<RenderOutput, Error> {
        machine.render(self)
    }
}
