//! A render job on the device: pipelines, buffers and surfaces, ready to be drawn once or many times.

use crate::binding::{self, Bound};
use crate::device::Device;
use crate::error::Error;
use crate::layout::{self, Located};
use crate::limits::within;
use crate::mesh::Mesh;
use crate::picture::Picture;
use crate::pipeline::{self, RenderKey};
use crate::readback::PictureCopy;
use crate::render::{Draw, RenderJob, RenderOutput};
use crate::surfaces::Surfaces;
use crate::target::{Blend, TargetFormat};
use crate::upload;

/// A draw, ready.
struct PreparedDraw {
    pipeline: wgpu::RenderPipeline,
    bound: Bound,
    attributes: Vec<wgpu::Buffer>,
    indices: wgpu::Buffer,
    index_count: u32,
}

/// A job, ready.
pub(crate) struct PreparedRender {
    surfaces: Surfaces,
    passes: Vec<Vec<PreparedDraw>>,
}

/// Where a device writes timestamps: when the first pass begins, and when the last ends.
#[derive(Clone, Copy)]
pub(crate) struct Stamps<'a> {
    pub(crate) queries: &'a wgpu::QuerySet,
    pub(crate) begin: Option<u32>,
    pub(crate) end: Option<u32>,
}

impl RenderJob<'_> {
    pub(crate) fn prepare(&self, device: &Device) -> Result<PreparedRender, Error> {
        self.check_targets(device)?;
        let pass = |draws: &Vec<Draw<'_>>| draws.iter().map(|draw| draw.prepare(device, self)).collect();
        let passes = self.passes.iter().map(pass).collect::<Result<_, Error>>()?;
        let surfaces = device.scoped(self.name, || Ok(Surfaces::new(device, self)))?;
        Ok(PreparedRender { surfaces, passes })
    }

    fn check_targets(&self, device: &Device) -> Result<(), Error> {
        let limits = device.limits();
        for (location, target) in self.targets.iter().enumerate() {
            target.validate(self.name, location)?;
        }
        let (shorter, longer) = (self.width.min(self.height), self.width.max(self.height));
        if shorter == 0 {
            let problem = format!("a picture of {} x {} pixels", self.width, self.height);
            return Err(Error::Texture {
                name: self.name.to_owned(),
                problem,
            });
        }
        let targets = self.targets.len() as u64;
        let bytes: u64 = self.targets.iter().map(|target| target.format.pixel_cost()).sum();
        let side = u64::from(limits.max_texture_dimension_2d);
        within(self.name, "the picture's side", u64::from(longer), side)?;
        within(
            self.name,
            "the number of targets",
            targets,
            u64::from(limits.max_color_attachments),
        )?;
        let most = u64::from(limits.max_color_attachment_bytes_per_sample);
        within(
            self.name,
            "the size of a pixel in all targets, in bytes,",
            bytes,
            most,
        )
    }
}

impl RenderJob<'_> {
    fn is_float(&self, location: usize) -> bool {
        let format = self.targets.get(location).map(|target| target.format);
        format == Some(TargetFormat::Rgba32Float)
    }
}

impl Draw<'_> {
    fn prepare(&self, device: &Device, job: &RenderJob<'_>) -> Result<PreparedDraw, Error> {
        self.validate(job)?;
        if self.blend != Blend::Replace && job.is_float(0) {
            device.require(
                job.name,
                wgpu::Features::FLOAT32_BLENDABLE,
                "the blending of 32-bit floats",
            )?;
        }
        let inputs = layout::located(self.vertex.entry, &self.vertex.entry.inputs)?;
        let bound = binding::bind(device, job.name, &[&self.vertex, &self.fragment], &self.resources)?;
        let key = RenderKey {
            vertex: pipeline::stage(device, job.name, &self.vertex)?,
            fragment: pipeline::stage(device, job.name, &self.fragment)?,
            layout: bound.layout.pipeline.clone(),
            attributes: inputs
                .iter()
                .map(|input| (input.location, input.components))
                .collect(),
            targets: job
                .targets
                .iter()
                .map(|target| target.format)
                .zip(self.written(job.targets.len())?)
                .collect(),
            cull: self.cull,
            blend: self.blend,
            depth: self.depth,
        };
        let pipeline = pipeline::render(device, job.name, key)?;
        device.scoped(job.name, || {
            Ok(upload_draw(device, job.name, self.mesh, &inputs, pipeline, bound))
        })
    }
}

fn upload_draw(
    device: &Device,
    job: &str,
    mesh: &Mesh,
    inputs: &[Located],
    pipeline: wgpu::RenderPipeline,
    bound: Bound,
) -> PreparedDraw {
    let values = inputs.iter().filter_map(|input| mesh.attributes.get(&input.name));
    let vertex = |bytes: &[u8]| upload::buffer(device, job, bytes, wgpu::BufferUsages::VERTEX);
    PreparedDraw {
        pipeline,
        bound,
        attributes: values
            .map(|attribute| vertex(bytemuck::cast_slice(&attribute.values)))
            .collect(),
        indices: upload::buffer(
            device,
            job,
            bytemuck::cast_slice(&mesh.indices),
            wgpu::BufferUsages::INDEX,
        ),
        index_count: mesh.indices.len() as u32,
    }
}

impl PreparedRender {
    /// Encodes all passes; the first clears. A job without any still clears.
    pub(crate) fn encode(&self, encoder: &mut wgpu::CommandEncoder, stamps: Option<Stamps<'_>>) {
        let last = self.passes.len().saturating_sub(1);
        for index in 0..=last {
            let writes = stamps.and_then(|stamps| stamps.of_pass(index == 0, index == last));
            let mut pass = self.surfaces.begin(encoder, index == 0, writes);
            for draw in self.passes.get(index).into_iter().flatten() {
                draw.encode(&mut pass);
            }
        }
    }

    pub(crate) fn run(&self, device: &Device, job: &RenderJob<'_>) -> Result<RenderOutput, Error> {
        device.scoped(job.name, || {
            let mut encoder = device
                .device
                .create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
            self.encode(&mut encoder, None);
            let copies = self.surfaces.copy_targets(device, &mut encoder);
            let depth = job
                .read_depth
                .then(|| self.surfaces.copy_depth(device, &mut encoder));
            let submission = device.queue.submit([encoder.finish()]);
            let read = |copy: &PictureCopy| copy.read(device, job.name, submission.clone());
            let picture = |(copy, format): (&PictureCopy, TargetFormat)| {
                Ok(Picture {
                    width: job.width,
                    height: job.height,
                    format,
                    pixels: format.pixels(&read(copy)?),
                })
            };
            let formats = job.targets.iter().map(|target| target.format);
            Ok(RenderOutput {
                targets: copies
                    .iter()
                    .zip(formats)
                    .map(picture)
                    .collect::<Result<_, Error>>()?,
                depth: depth.as_ref().map(read).transpose()?.map(|bytes| floats(&bytes)),
            })
        })
    }
}

fn floats(bytes: &[u8]) -> Vec<f32> {
    let words = bytes.as_chunks::<4>().0;
    words.iter().map(|word| f32::from_le_bytes(*word)).collect()
}

impl<'a> Stamps<'a> {
    fn of_pass(self, is_first: bool, is_last: bool) -> Option<wgpu::RenderPassTimestampWrites<'a>> {
        let begin = self.begin.filter(|_| is_first);
        let end = self.end.filter(|_| is_last);
        (begin.is_some() || end.is_some()).then_some(wgpu::RenderPassTimestampWrites {
            query_set: self.queries,
            beginning_of_pass_write_index: begin,
            end_of_pass_write_index: end,
        })
    }
}

impl PreparedDraw {
    fn encode(&self, pass: &mut wgpu::RenderPass<'_>) {
        pass.set_pipeline(&self.pipeline);
        for (index, group) in (0..).zip(&self.bound.groups) {
            pass.set_bind_group(index, group.as_ref(), &[]);
        }
        if !self.bound.push_constants.is_empty() {
            pass.set_immediates(0, &self.bound.push_constants);
        }
        for (slot, buffer) in (0..).zip(&self.attributes) {
            pass.set_vertex_buffer(slot, buffer.slice(..));
        }
        pass.set_index_buffer(self.indices.slice(..), wgpu::IndexFormat::Uint32);
        pass.draw_indexed(0..self.index_count, 0, 0..1);
    }
}
