//! Offscreen rendering to targets of floats or bytes.
//!
//! All passes of a job share the targets and one depth buffer: the first clears them, each later one goes on where the one
//! before it ended. Within a pass draws meet the targets in their order, so one pass of two draws and two passes of one leave
//! the same picture; what differs is what an adapter has to load and store between them.
//!
//! Clip space is WebGPU's on both routes (y up, depth 0 to 1): emit SPIR-V without a clip-space adjustment, as `EmitOptions`
//! does unless told otherwise. wgpu gives Vulkan a viewport of negative height, which is what such modules expect.
//!
//! A target that is cleared to the [sentinel](crate::SENTINEL) tells which pixels a draw wrote: see
//! [`Picture::covered`]. No multisampling.

use bossage_translate::Stage;

use crate::code::Shader;
use crate::error::Error;
use crate::layout;
use crate::machine::Machine;
use crate::mesh::Mesh;
use crate::picture::Picture;
use crate::resources::Resources;
use crate::target::{Blend, RenderTarget};

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

/// How a draw uses the depth buffer.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Depth {
    /// Nearer wins, and is written.
    #[default]
    TestAndWrite,
    /// What is as near or nearer wins, and nothing is written.
    TestOnly,
    /// What is exactly as near wins, and nothing is written: for a second pass over the same mesh by the same vertex stage. Other
    /// vertex stages may place a vertex a rounding away.
    Equal,
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

/// A picture to render: `targets.len()` pictures at once.
#[derive(Clone, Debug)]
pub struct RenderJob<'a> {
    /// The name that errors use.
    pub name: &'a str,
    /// In pixels.
    pub width: u32,
    /// In pixels.
    pub height: u32,
    /// The target of each `@location`. A draw whose fragment stage lacks a location leaves that target alone; an output beyond
    /// the last target is an error.
    pub targets: Vec<RenderTarget>,
    /// Whether the depth buffer is read back as well.
    pub read_depth: bool,
    /// The draws of each pass, all in this order. Without any pass the targets are cleared.
    pub passes: Vec<Vec<Draw<'a>>>,
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

impl Draw<'_> {
    /// Checks what needs no device: both stages take one route and are what they should be, and the mesh has what is read of it.
    ///
    /// # Errors
    /// [`Error::MixedRoutes`], [`Error::Interface`] or [`Error::Mesh`].
    pub fn validate(&self, job: &RenderJob<'_>) -> Result<(), Error> {
        // wgpu checks each stage against the one before it, which it can't where only one of them is passed through.
        let (vertex, fragment) = (self.vertex.code.route(), self.fragment.code.route());
        if vertex != fragment {
            return Err(Error::MixedRoutes {
                job: job.name.to_owned(),
                vertex,
                fragment,
            });
        }
        self.vertex.expect(Stage::Vertex)?;
        self.fragment.expect(Stage::Fragment)?;
        self.mesh.validate(job.name, self.vertex.entry)
    }

    /// For each target whether the fragment stage has an output of its location.
    ///
    /// # Errors
    /// [`Error::Interface`] for an output beyond the last target, and for a draw that is blended and writes nothing that is.
    pub fn written(&self, targets: usize) -> Result<Vec<bool>, Error> {
        let mut written = vec![false; targets];
        for (output, location) in layout::outputs(self.fragment.entry)? {
            let Some(target) = written.get_mut(location as usize) else {
                let problem = format!("it goes to @location({location}), the job has {targets} targets");
                return Err(Error::misfit(self.fragment.entry, &output.name, problem));
            };
            *target = true;
        }
        if self.blend != Blend::Replace && written.first() != Some(&true) {
            let problem = "the draw is blended, but nothing goes to @location(0)".to_owned();
            return Err(Error::misfit(
                self.fragment.entry,
                &self.fragment.entry.name,
                problem,
            ));
        }
        Ok(written)
    }
}
