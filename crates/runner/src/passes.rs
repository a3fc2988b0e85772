//! A render job on the device: targets, pipelines and buffers, ready to be drawn once or many times.

use bossage_translate::Stage;

use crate::binding::{self, Bound};
use crate::code::Shader;
use crate::device::Device;
use crate::error::Error;
use crate::layout::{self, Located};
use crate::mesh::Mesh;
use crate::pipeline::{self, COLOUR_FORMAT, DEPTH_FORMAT, RenderKey};
use crate::readback::PictureCopy;
use crate::render::{Blend, Clear, Draw, Picture, RenderJob, RenderOutput};
use crate::{sentinel, upload};

/// Bytes of a pixel of a colour target.
const PIXEL_BYTES: u32 = 16;

/// A colour target.
struct Target {
    texture: wgpu::Texture,
    view: wgpu::TextureView,
    clear: Clear,
}

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
    targets: Vec<Target>,
    depth: wgpu::Texture,
    depth_view: wgpu::TextureView,
    draws: Vec<PreparedDraw>,
}

impl RenderJob<'_> {
    pub(crate) fn prepare(&self, device: &Device) -> Result<PreparedRender, Error> {
        self.check_limits(device)?;
        let draws = self
            .draws
            .iter()
            .map(|draw| draw.prepare(device, self))
            .collect::<Result<_, Error>>()?;
        device.scoped(self.name, || {
            let targets = self
                .targets
                .iter()
                .map(|clear| self.target(device, *clear))
                .collect();
            let depth = self.texture(device, DEPTH_FORMAT);
            let depth_view = depth.create_view(&wgpu::TextureViewDescriptor::default());
            Ok(PreparedRender {
                targets,
                depth,
                depth_view,
                draws,
            })
        })
    }

    fn check_limits(&self, device: &Device) -> Result<(), Error> {
        let limits = device.limits();
        let (shorter, longer) = (self.width.min(self.height), self.width.max(self.height));
        if shorter == 0 {
            let problem = format!("a picture of {} x {} pixels", self.width, self.height);
            return Err(Error::Texture {
                name: self.name.to_owned(),
                problem,
            });
        }
        let targets = self.targets.len() as u64;
        let bytes = targets * u64::from(PIXEL_BYTES);
        let side = u64::from(limits.max_texture_dimension_2d);
        device.within(self.name, "the picture's side", u64::from(longer), side)?;
        device.within(
            self.name,
            "the number of targets",
            targets,
            u64::from(limits.max_color_attachments),
        )?;
        let most = u64::from(limits.max_color_attachment_bytes_per_sample);
        device.within(
            self.name,
            "the size of a pixel in all targets, in bytes,",
            bytes,
            most,
        )
    }

    fn texture(&self, device: &Device, format: wgpu::TextureFormat) -> wgpu::Texture {
        device.device.create_texture(&wgpu::TextureDescriptor {
            label: Some(self.name),
            size: wgpu::Extent3d {
                width: self.width,
                height: self.height,
                depth_or_array_layers: 1,
            },
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format,
            usage: wgpu::TextureUsages::RENDER_ATTACHMENT
                | wgpu::TextureUsages::COPY_SRC
                | wgpu::TextureUsages::COPY_DST,
            view_formats: &[],
        })
    }

    /// A target. The sentinel is copied in rather than cleared to, since a clear colour goes through a conversion that may
    /// change the bits of a NaN.
    fn target(&self, device: &Device, clear: Clear) -> Target {
        let texture = self.texture(device, COLOUR_FORMAT);
        if clear == Clear::Sentinel {
            let row = self.width * PIXEL_BYTES;
            let bytes = sentinel::fill(row as usize * self.height as usize);
            let layout = wgpu::TexelCopyBufferLayout {
                offset: 0,
                bytes_per_row: Some(row),
                rows_per_image: None,
            };
            device
                .queue
                .write_texture(texture.as_image_copy(), &bytes, layout, texture.size());
        }
        let view = texture.create_view(&wgpu::TextureViewDescriptor::default());
        Target { texture, view, clear }
    }
}

impl Draw<'_> {
    fn prepare(&self, device: &Device, job: &RenderJob<'_>) -> Result<PreparedDraw, Error> {
        expect_one_route(job.name, &self.vertex, &self.fragment)?;
        expect_stage(&self.vertex, Stage::Vertex)?;
        expect_stage(&self.fragment, Stage::Fragment)?;
        if self.blend != Blend::Replace {
            device.require(
                job.name,
                wgpu::Features::FLOAT32_BLENDABLE,
                "the blending of 32-bit floats",
            )?;
        }
        self.mesh.validate(job.name, self.vertex.entry)?;
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
            written: self.written(job.targets.len())?,
            cull: self.cull,
            blend: self.blend,
            depth: self.depth,
        };
        let pipeline = pipeline::render(device, job.name, key)?;
        device.scoped(job.name, || {
            Ok(upload_draw(device, job.name, self.mesh, &inputs, pipeline, bound))
        })
    }

    /// For each target whether the fragment stage has an output of its location.
    fn written(&self, targets: usize) -> Result<Vec<bool>, Error> {
        let mut written = vec![false; targets];
        for output in layout::located(self.fragment.entry, &self.fragment.entry.outputs)? {
            let Some(target) = written.get_mut(output.location as usize) else {
                let problem = format!(
                    "it goes to @location({}), the job has {targets} targets",
                    output.location
                );
                return Err(layout::misfit(self.fragment.entry, &output.name, problem));
            };
            *target = true;
        }
        Ok(written)
    }
}

/// wgpu checks each stage against the one before it, which it can't where only one of them is passed through.
fn expect_one_route(job: &str, vertex: &Shader<'_>, fragment: &Shader<'_>) -> Result<(), Error> {
    let (vertex, fragment) = (vertex.code.route(), fragment.code.route());
    if vertex == fragment {
        return Ok(());
    }
    Err(Error::MixedRoutes {
        job: job.to_owned(),
        vertex,
        fragment,
    })
}

fn expect_stage(shader: &Shader<'_>, stage: Stage) -> Result<(), Error> {
    if shader.entry.stage == stage {
        return Ok(());
    }
    let problem = format!("it is a {} shader, not a {stage} shader", shader.entry.stage);
    Err(layout::misfit(shader.entry, &shader.entry.name, problem))
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
    /// Encodes one pass over all draws.
    pub(crate) fn encode(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        timestamp_writes: Option<wgpu::RenderPassTimestampWrites<'_>>,
    ) {
        let colours: Vec<_> = self
            .targets
            .iter()
            .map(|target| Some(target.attachment()))
            .collect();
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            color_attachments: &colours,
            depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
                view: &self.depth_view,
                depth_ops: Some(wgpu::Operations {
                    load: wgpu::LoadOp::Clear(1.0),
                    store: wgpu::StoreOp::Store,
                }),
                stencil_ops: None,
            }),
            timestamp_writes,
            ..wgpu::RenderPassDescriptor::default()
        });
        for draw in &self.draws {
            draw.encode(&mut pass);
        }
    }

    pub(crate) fn run(&self, device: &Device, job: &RenderJob<'_>) -> Result<RenderOutput, Error> {
        device.scoped(job.name, || {
            let mut encoder = device
                .device
                .create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
            self.encode(&mut encoder, None);
            let all = wgpu::TextureAspect::All;
            let mut copy =
                |texture, aspect, bytes| PictureCopy::encode(device, &mut encoder, texture, aspect, bytes);
            let copies: Vec<_> = self
                .targets
                .iter()
                .map(|target| copy(&target.texture, all, PIXEL_BYTES))
                .collect();
            let depth = job
                .read_depth
                .then(|| copy(&self.depth, wgpu::TextureAspect::DepthOnly, 4));
            let submission = device.queue.submit([encoder.finish()]);
            let picture =
                |copy: &PictureCopy| Ok(picture(job, copy.read(device, job.name, submission.clone())?));
            Ok(RenderOutput {
                targets: copies.iter().map(picture).collect::<Result<_, Error>>()?,
                depth: depth
                    .map(|copy| copy.read(device, job.name, submission.clone()))
                    .transpose()?,
            })
        })
    }
}

fn picture(job: &RenderJob<'_>, floats: Vec<f32>) -> Picture {
    Picture {
        width: job.width,
        height: job.height,
        pixels: floats.as_chunks::<4>().0.to_vec(),
    }
}

impl Target {
    fn attachment(&self) -> wgpu::RenderPassColorAttachment<'_> {
        let load = match self.clear {
            Clear::Colour([r, g, b, a]) => {
                let [r, g, b, a] = [r, g, b, a].map(f64::from);
                wgpu::LoadOp::Clear(wgpu::Color { r, g, b, a })
            }
            Clear::Sentinel => wgpu::LoadOp::Load,
        };
        wgpu::RenderPassColorAttachment {
            view: &self.view,
            depth_slice: None,
            resolve_target: None,
            ops: wgpu::Operations {
                load,
                store: wgpu::StoreOp::Store,
            },
        }
    }
}

impl PreparedDraw {
    fn encode(&self, pass: &mut wgpu::RenderPass<'_>) {
        pass.set_pipeline(&self.pipeline);
        for (index, group) in (0..).zip(&self.bound.groups) {
            pass.set_bind_group(index, group.as_ref(), &[]);
        }
        for (slot, buffer) in (0..).zip(&self.attributes) {
            pass.set_vertex_buffer(slot, buffer.slice(..));
        }
        pass.set_index_buffer(self.indices.slice(..), wgpu::IndexFormat::Uint32);
        pass.draw_indexed(0..self.index_count, 0, 0..1);
    }
}
