//! What a job draws to, on the device: its targets and its depth buffer.

use crate::device::Device;
use crate::pipeline::DEPTH_FORMAT;
use crate::readback::PictureCopy;
use crate::render::RenderJob;
use crate::sentinel;
use crate::target::{Clear, RenderTarget};

/// A texture to draw to.
struct Surface {
    texture: wgpu::Texture,
    view: wgpu::TextureView,
}

/// The targets of a job, and its depth buffer.
pub(crate) struct Surfaces {
    targets: Vec<(RenderTarget, Surface)>,
    depth: Surface,
}

impl Surfaces {
    /// Makes them.
    pub(crate) fn new(device: &Device, job: &RenderJob<'_>) -> Self {
        let target = |target: &RenderTarget| (*target, target.surface(device, job));
        Self {
            targets: job.targets.iter().map(target).collect(),
            depth: Surface::new(device, job, DEPTH_FORMAT),
        }
    }

    /// Begins a pass over all of them, which clears them or goes on where the one before it ended.
    pub(crate) fn begin<'a>(
        &self,
        encoder: &'a mut wgpu::CommandEncoder,
        clears: bool,
        timestamp_writes: Option<wgpu::RenderPassTimestampWrites<'_>>,
    ) -> wgpu::RenderPass<'a> {
        let colours: Vec<_> = self
            .targets
            .iter()
            .map(|(target, surface)| Some(surface.attachment(target.load(clears))))
            .collect();
        let depth = if clears {
            wgpu::LoadOp::Clear(1.0)
        } else {
            wgpu::LoadOp::Load
        };
        encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            color_attachments: &colours,
            depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
                view: &self.depth.view,
                depth_ops: Some(wgpu::Operations {
                    load: depth,
                    store: wgpu::StoreOp::Store,
                }),
                stencil_ops: None,
            }),
            timestamp_writes,
            ..wgpu::RenderPassDescriptor::default()
        })
    }

    /// Encodes the copies of all targets, in their order.
    pub(crate) fn copy_targets(
        &self,
        device: &Device,
        encoder: &mut wgpu::CommandEncoder,
    ) -> Vec<PictureCopy> {
        let all = wgpu::TextureAspect::All;
        let copies = self.targets.iter().map(|(target, surface)| {
            let bytes = target.format.pixel_bytes();
            PictureCopy::encode(device, encoder, &surface.texture, all, bytes)
        });
        copies.collect()
    }

    /// Encodes the copy of the depth buffer, four bytes a pixel.
    pub(crate) fn copy_depth(&self, device: &Device, encoder: &mut wgpu::CommandEncoder) -> PictureCopy {
        let aspect = wgpu::TextureAspect::DepthOnly;
        PictureCopy::encode(device, encoder, &self.depth.texture, aspect, 4)
    }
}

impl Surface {
    fn new(device: &Device, job: &RenderJob<'_>, format: wgpu::TextureFormat) -> Self {
        let texture = device.device.create_texture(&wgpu::TextureDescriptor {
            label: Some(job.name),
            size: wgpu::Extent3d {
                width: job.width,
                height: job.height,
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
        });
        let view = texture.create_view(&wgpu::TextureViewDescriptor::default());
        Self { texture, view }
    }

    fn attachment(&self, load: wgpu::LoadOp<wgpu::Color>) -> wgpu::RenderPassColorAttachment<'_> {
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

impl RenderTarget {
    /// Makes the surface. The sentinel is copied in rather than cleared to, since a clear colour goes through a conversion that
    /// may change the bits of a NaN.
    fn surface(&self, device: &Device, job: &RenderJob<'_>) -> Surface {
        let surface = Surface::new(device, job, self.format.wgpu());
        if self.clear == Clear::Sentinel {
            let row = job.width * self.format.pixel_bytes();
            let bytes = sentinel::fill(row as usize * job.height as usize);
            let layout = wgpu::TexelCopyBufferLayout {
                offset: 0,
                bytes_per_row: Some(row),
                rows_per_image: None,
            };
            let texture = &surface.texture;
            device
                .queue
                .write_texture(texture.as_image_copy(), &bytes, layout, texture.size());
        }
        surface
    }

    fn load(&self, clears: bool) -> wgpu::LoadOp<wgpu::Color> {
        match self.clear {
            Clear::Colour(colour) if clears => {
                let [r, g, b, a] = colour.map(f64::from);
                wgpu::LoadOp::Clear(wgpu::Color { r, g, b, a })
            }
            Clear::Colour(_) | Clear::Sentinel => wgpu::LoadOp::Load,
        }
    }
}
