//! Makes bind groups of a job's resources, by what the manifest says the shaders bind.
//!
//! wgpu's Vulkan backend numbers a group's descriptors anew without gaps and rewrites its own compiler's output to match.
//! SPIR-V that is passed through can't be rewritten, so gaps are filled with bindings that no stage sees: then both
//! numberings are the same.

use std::collections::BTreeMap;

use bossage_translate::manifest::Kind;

use crate::cache::Layout;
use crate::code::{Code, Shader};
use crate::device::Device;
use crate::error::Error;
use crate::layout;
use crate::limits::within;
use crate::pipeline;
use crate::resolve::{Resolved, Value, push_constants, resolve};
use crate::resources::{BufferData, Resources};
use crate::texture::{SamplerSettings, TextureData};
use crate::upload;

/// A resource on the device.
enum Resource {
    Buffer(wgpu::Buffer),
    View(wgpu::TextureView),
    /// With the texture, which may be read back.
    Stored(wgpu::TextureView, wgpu::Texture),
    Sampler(wgpu::Sampler),
}

impl Resource {
    fn wgpu(&self) -> wgpu::BindingResource<'_> {
        match self {
            Self::Buffer(buffer) => buffer.as_entire_binding(),
            Self::View(view) | Self::Stored(view, _) => wgpu::BindingResource::TextureView(view),
            Self::Sampler(sampler) => wgpu::BindingResource::Sampler(sampler),
        }
    }
}

/// Resources and how they are declared, by (group, binding).
type Made = BTreeMap<(u32, u32), (wgpu::BindGroupLayoutEntry, Resource)>;

/// A buffer that the shader may have written.
#[derive(Debug)]
pub(crate) struct Written {
    pub(crate) name: String,
    pub(crate) buffer: wgpu::Buffer,
}

/// Bound resources.
#[derive(Debug)]
pub(crate) struct Bound {
    pub(crate) layout: Layout,
    pub(crate) groups: Vec<Option<wgpu::BindGroup>>,
    pub(crate) written: Vec<Written>,
    pub(crate) stored: Vec<Stored>,
    pub(crate) push_constants: Vec<u8>,
}

/// A texture that the shader may have written.
#[derive(Debug)]
pub(crate) struct Stored {
    pub(crate) name: String,
    pub(crate) texture: wgpu::Texture,
    pub(crate) texel_bytes: u32,
}

/// What a job binds, on its way to the device.
struct Binder<'a> {
    device: &'a Device,
    job: &'a str,
    resources: &'a Resources<'a>,
    /// Whether a stage's code goes to the driver unseen, so that nobody checks what it samples.
    unchecked: bool,
}

/// Binds what these stages of one pipeline ask for.
pub(crate) fn bind(
    device: &Device,
    job: &str,
    shaders: &[&Shader<'_>],
    resources: &Resources<'_>,
) -> Result<Bound, Error> {
    let resolved = resolve(job, shaders, resources)?;
    let push_constants = push_constants(job, shaders, resources)?;
    check_push_constants(device, job, &push_constants)?;
    let unchecked = shaders.iter().any(|shader| matches!(shader.code, Code::Spirv(_)));
    let binder = Binder {
        device,
        job,
        resources,
        unchecked,
    };
    device.scoped(job, || binder.bind(&resolved, push_constants))
}

fn check_push_constants(device: &Device, job: &str, bytes: &[u8]) -> Result<(), Error> {
    if bytes.is_empty() {
        return Ok(());
    }
    device.require(job, wgpu::Features::IMMEDIATES, "push constants")?;
    let limit = u64::from(device.limits().max_immediate_size);
    within(
        job,
        "the size of the push constants in bytes",
        bytes.len() as u64,
        limit,
    )
}

impl Binder<'_> {
    fn bind(&self, resolved: &[Resolved<'_>], push_constants: Vec<u8>) -> Result<Bound, Error> {
        let mut made = Made::new();
        let (mut written, mut stored) = (Vec::new(), Vec::new());
        for one in resolved {
            let (ty, resource) = self.resource(one)?;
            if let (Kind::StorageBuffer, Resource::Buffer(buffer)) = (one.binding.kind, &resource) {
                written.push(Written {
                    name: one.binding.name.clone(),
                    buffer: buffer.clone(),
                });
            }
            if let (Value::StorageTexture(data), Resource::Stored(_, texture)) = (&one.value, &resource)
                && layout::is_written(one.binding)
            {
                stored.push(Stored {
                    name: one.binding.name.clone(),
                    texture: texture.clone(),
                    texel_bytes: data.format.texel_bytes() as u32,
                });
            }
            let stages = one.stages.iter().map(|stage| pipeline::visibility(*stage));
            let visibility = stages.fold(wgpu::ShaderStages::NONE, |all, stage| all | stage);
            made.insert(one.place, (entry(one.place.1, visibility, ty), resource));
        }
        self.fill_gaps(&mut made);
        let layout = pipeline::layout(
            self.device,
            self.job,
            layout_entries(&made),
            push_constants.len() as u32,
        )?;
        let groups = self.groups(&layout, &made);
        Ok(Bound {
            layout,
            groups,
            written,
            stored,
            push_constants,
        })
    }

    /// Makes the bindings of every group run from 0 to its last without a gap.
    fn fill_gaps(&self, made: &mut Made) {
        let lasts: BTreeMap<u32, u32> = made.keys().copied().collect();
        let places = lasts
            .into_iter()
            .flat_map(|(group, last)| (0..last).map(move |binding| (group, binding)));
        let gaps: Vec<_> = places.filter(|place| !made.contains_key(place)).collect();
        let Some(ty) = layout::buffer_type(Kind::UniformBuffer).filter(|_| !gaps.is_empty()) else {
            return;
        };
        let unused = upload::buffer(self.device, self.job, &[0; 16], wgpu::BufferUsages::UNIFORM);
        for place in gaps {
            let filler = entry(place.1, wgpu::ShaderStages::NONE, ty);
            made.insert(place, (filler, Resource::Buffer(unused.clone())));
        }
    }

    fn groups(&self, layout: &Layout, made: &Made) -> Vec<Option<wgpu::BindGroup>> {
        let make = |(group, layout): (u32, &Option<wgpu::BindGroupLayout>)| {
            let layout = layout.as_ref()?;
            let own = made.range((group, 0)..=(group, u32::MAX));
            let entries: Vec<_> = own
                .map(|(_, (entry, resource))| wgpu::BindGroupEntry {
                    binding: entry.binding,
                    resource: resource.wgpu(),
                })
                .collect();
            let descriptor = wgpu::BindGroupDescriptor {
                label: Some(self.job),
                layout,
                entries: &entries,
            };
            Some(self.device.device.create_bind_group(&descriptor))
        };
        (0..).zip(&layout.groups).map(make).collect()
    }

    fn resource(&self, resolved: &Resolved<'_>) -> Result<(wgpu::BindingType, Resource), Error> {
        let limits = self.device.limits();
        match &resolved.value {
            Value::Uniform(bytes) => {
                let limit = limits.max_uniform_buffer_binding_size;
                self.buffer(
                    resolved,
                    BufferData::Bytes(bytes),
                    wgpu::BufferUsages::UNIFORM,
                    limit,
                )
            }
            Value::Storage(data) => {
                let limit = limits.max_storage_buffer_binding_size;
                self.buffer(resolved, *data, wgpu::BufferUsages::STORAGE, limit)
            }
            Value::Texture(data) => self.texture(resolved, data),
            Value::StorageTexture(data) => self.storage_texture(resolved, data),
            Value::Sampler(settings) => Ok(self.sampler(settings, resolved.binding.kind)),
        }
    }

    fn buffer(
        &self,
        resolved: &Resolved<'_>,
        data: BufferData<'_>,
        usage: wgpu::BufferUsages,
        limit: u64,
    ) -> Result<(wgpu::BindingType, Resource), Error> {
        within(self.job, "a buffer's size in bytes", data.len() as u64, limit)?;
        let ty = layout::buffer_type(resolved.binding.kind).ok_or_else(|| {
            let problem = "the manifest calls it no buffer".to_owned();
            Error::misfit(resolved.entry, &resolved.binding.name, problem)
        })?;
        let buffer = upload::buffer(self.device, self.job, &data.bytes(), usage);
        Ok((ty, Resource::Buffer(buffer)))
    }

    fn texture(
        &self,
        resolved: &Resolved<'_>,
        data: &TextureData,
    ) -> Result<(wgpu::BindingType, Resource), Error> {
        let filterable = !data.format.is_float() || self.device.filters_floats();
        self.check_filtering(filterable)?;
        let ty = layout::texture_type(resolved.binding.kind, data, filterable);
        let usage = wgpu::TextureUsages::TEXTURE_BINDING;
        let texture = upload::texture(self.device, self.job, &resolved.binding.name, data, usage)?;
        Ok((ty, Resource::View(upload::view(&texture, data))))
    }

    fn storage_texture(
        &self,
        resolved: &Resolved<'_>,
        data: &TextureData,
    ) -> Result<(wgpu::BindingType, Resource), Error> {
        let ty = layout::storage_type(resolved.binding, data);
        let usage = wgpu::TextureUsages::STORAGE_BINDING | wgpu::TextureUsages::COPY_SRC;
        let texture = upload::texture(self.device, self.job, &resolved.binding.name, data, usage)?;
        Ok((ty, Resource::Stored(upload::view(&texture, data), texture)))
    }

    /// wgpu checks what a shader filters, unless the shader is passed through: then the job may have no filtering sampler.
    fn check_filtering(&self, filterable: bool) -> Result<(), Error> {
        let filters = self
            .resources
            .samplers
            .values()
            .any(SamplerSettings::is_filtering);
        if filterable || !self.unchecked || !filters {
            return Ok(());
        }
        self.device.require(
            self.job,
            wgpu::Features::FLOAT32_FILTERABLE,
            "the filtering of 32-bit floats",
        )
    }

    fn sampler(&self, settings: &SamplerSettings, kind: Kind) -> (wgpu::BindingType, Resource) {
        let compares = kind == Kind::ComparisonSampler;
        let ty = match settings.is_filtering() {
            _ if compares => wgpu::SamplerBindingType::Comparison,
            true => wgpu::SamplerBindingType::Filtering,
            false => wgpu::SamplerBindingType::NonFiltering,
        };
        let compare = compares.then_some(wgpu::CompareFunction::LessEqual);
        let sampler = upload::sampler(self.device, self.job, settings, compare);
        (wgpu::BindingType::Sampler(ty), Resource::Sampler(sampler))
    }
}

fn entry(binding: u32, visibility: wgpu::ShaderStages, ty: wgpu::BindingType) -> wgpu::BindGroupLayoutEntry {
    wgpu::BindGroupLayoutEntry {
        binding,
        visibility,
        ty,
        count: None,
    }
}

fn layout_entries(made: &Made) -> Vec<Vec<wgpu::BindGroupLayoutEntry>> {
    let groups = made.keys().map(|(group, _)| group + 1).max().unwrap_or(0);
    let of_group = |group| {
        made.range((group, 0)..=(group, u32::MAX))
            .map(|(_, (entry, _))| *entry)
            .collect()
    };
    (0..groups).map(of_group).collect()
}
