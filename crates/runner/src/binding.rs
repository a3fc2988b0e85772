//! Makes bind groups of a job's resources, by what the manifest says the shaders bind.
//!
//! wgpu's Vulkan backend numbers a group's descriptors anew without gaps and rewrites its own compiler's output to match.
//! SPIR-V that is passed through can't be rewritten, so gaps are filled with bindings that no stage sees: then both
//! numberings are the same.

use std::collections::BTreeMap;

use bossage_translate::manifest::{Binding, Entry, Kind};

use crate::cache::Layout;
use crate::code::{Code, Shader};
use crate::device::Device;
use crate::error::Error;
use crate::layout;
use crate::pipeline;
use crate::resources::{BufferData, Resources, slot};
use crate::sentinel;
use crate::texture::{SamplerSettings, TextureData, TextureDimension};
use crate::uniforms;
use crate::upload;

/// A binding that one or both stages have.
struct Slot<'a> {
    binding: &'a Binding,
    entry: &'a Entry,
    visibility: wgpu::ShaderStages,
}

/// The bindings of a pipeline, by (group, binding).
type Slots<'a> = BTreeMap<(u32, u32), Slot<'a>>;

/// A resource on the device.
enum Resource {
    Buffer(wgpu::Buffer),
    View(wgpu::TextureView),
    Sampler(wgpu::Sampler),
}

impl Resource {
    fn wgpu(&self) -> wgpu::BindingResource<'_> {
        match self {
            Self::Buffer(buffer) => buffer.as_entire_binding(),
            Self::View(view) => wgpu::BindingResource::TextureView(view),
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
    let slots = merge(job, shaders)?;
    check_buffers_are_known(job, &slots, resources)?;
    let unchecked = shaders.iter().any(|shader| matches!(shader.code, Code::Spirv(_)));
    let binder = Binder {
        device,
        job,
        resources,
        unchecked,
    };
    device.scoped(job, || binder.bind(&slots))
}

fn merge<'a>(job: &str, shaders: &[&Shader<'a>]) -> Result<Slots<'a>, Error> {
    let mut slots = Slots::new();
    for shader in shaders {
        let visibility = pipeline::visibility(shader.entry.stage);
        for binding in &shader.entry.bindings {
            let new = Slot {
                binding,
                entry: shader.entry,
                visibility,
            };
            let place = shader.place(binding);
            let slot = slots.entry(place).or_insert(new);
            agree(job, place, slot, shader.entry, binding)?;
            slot.visibility |= visibility;
        }
    }
    Ok(slots)
}

/// Two stages that share a place must mean the same by it.
fn agree(
    job: &str,
    place: (u32, u32),
    slot: &Slot<'_>,
    entry: &Entry,
    binding: &Binding,
) -> Result<(), Error> {
    let said = |binding: &Binding, entry: &Entry| {
        let layout =
            block(entry, binding).map_or_else(String::new, |block| format!(", {} bytes", block.size));
        format!("{}: {}{layout}", binding.name, binding.ty)
    };
    let first = (&slot.binding.name, slot.binding.kind, &slot.binding.ty);
    let same_type = first == (&binding.name, binding.kind, &binding.ty);
    if same_type && block(slot.entry, slot.binding) == block(entry, binding) {
        return Ok(());
    }
    let (group, binding_index) = place;
    let (first, second) = (said(slot.binding, slot.entry), said(binding, entry));
    Err(Error::StagesDisagree {
        job: job.to_owned(),
        group,
        binding: binding_index,
        first,
        second,
    })
}

fn block<'a>(entry: &'a Entry, binding: &Binding) -> Option<&'a bossage_translate::manifest::Block> {
    entry
        .uniforms
        .iter()
        .find(|block| (block.group, block.binding) == (binding.group, binding.binding))
}

/// A storage buffer that goes nowhere is a mistake; values, textures and samplers beyond what is asked for are not.
fn check_buffers_are_known(job: &str, slots: &Slots<'_>, resources: &Resources<'_>) -> Result<(), Error> {
    let is_known = |key: &String| slots.values().any(|slot| keys(slot.binding).contains(key));
    match resources.buffers.keys().find(|key| !is_known(key)) {
        None => Ok(()),
        Some(name) => Err(Error::UnknownResource {
            job: job.to_owned(),
            name: name.clone(),
            known: slots.values().map(|slot| slot.binding.name.clone()).collect(),
        }),
    }
}

/// The keys under which a resource of this binding is looked for.
fn keys(binding: &Binding) -> [String; 2] {
    [binding.name.clone(), slot(binding.group, binding.binding)]
}

fn look_up<'a, T>(table: &'a BTreeMap<String, T>, binding: &Binding) -> Option<&'a T> {
    keys(binding).iter().find_map(|key| table.get(key))
}

impl Binder<'_> {
    fn bind(&self, slots: &Slots<'_>) -> Result<Bound, Error> {
        let mut made = Made::new();
        let mut written = Vec::new();
        for (place, slot) in slots {
            let (ty, resource) = self.resource(slot)?;
            if let (Kind::StorageBuffer, Resource::Buffer(buffer)) = (slot.binding.kind, &resource) {
                written.push(Written {
                    name: slot.binding.name.clone(),
                    buffer: buffer.clone(),
                });
            }
            made.insert(*place, (entry(place.1, slot.visibility, ty), resource));
        }
        self.fill_gaps(&mut made);
        let layout = pipeline::layout(self.device, self.job, layout_entries(&made))?;
        let groups = self.groups(&layout, &made);
        Ok(Bound {
            layout,
            groups,
            written,
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

    fn resource(&self, slot: &Slot<'_>) -> Result<(wgpu::BindingType, Resource), Error> {
        match slot.binding.kind {
            Kind::UniformBuffer => self.uniform(slot),
            Kind::ReadOnlyStorageBuffer | Kind::StorageBuffer => self.storage(slot),
            Kind::Texture => self.texture(slot),
            Kind::Sampler => self.sampler(slot),
            Kind::DepthTexture | Kind::StorageTexture | Kind::ComparisonSampler => {
                let problem = format!("the runner can't bind a {}", layout::describe(slot.binding));
                Err(layout::misfit(slot.entry, &slot.binding.name, problem))
            }
        }
    }

    fn uniform(&self, slot: &Slot<'_>) -> Result<(wgpu::BindingType, Resource), Error> {
        let block = block(slot.entry, slot.binding);
        let block = block.ok_or_else(|| self.undescribed(slot))?;
        let bytes = uniforms::pack(self.job, block, &self.resources.uniforms)?;
        self.buffer(
            slot,
            &bytes,
            wgpu::BufferUsages::UNIFORM,
            self.device.limits().max_uniform_buffer_binding_size,
        )
    }

    fn storage(&self, slot: &Slot<'_>) -> Result<(wgpu::BindingType, Resource), Error> {
        let limit = self.device.limits().max_storage_buffer_binding_size;
        match look_up(&self.resources.buffers, slot.binding) {
            None => Err(self.missing(slot)),
            Some(BufferData::Bytes(bytes)) => self.buffer(slot, bytes, wgpu::BufferUsages::STORAGE, limit),
            Some(BufferData::Output(_)) if slot.binding.kind == Kind::ReadOnlyStorageBuffer => {
                Err(self.wrong(slot, "an output".to_owned()))
            }
            Some(BufferData::Output(bytes)) => {
                self.device
                    .within(self.job, "a buffer's size in bytes", *bytes as u64, limit)?;
                self.buffer(slot, &sentinel::fill(*bytes), wgpu::BufferUsages::STORAGE, limit)
            }
        }
    }

    fn buffer(
        &self,
        slot: &Slot<'_>,
        bytes: &[u8],
        usage: wgpu::BufferUsages,
        limit: u64,
    ) -> Result<(wgpu::BindingType, Resource), Error> {
        if bytes.is_empty() || !bytes.len().is_multiple_of(4) {
            return Err(Error::Length {
                job: self.job.to_owned(),
                what: format!("buffer `{}` in bytes", slot.binding.name),
                given: bytes.len(),
                expected: bytes.len().next_multiple_of(4).max(4),
            });
        }
        self.device
            .within(self.job, "a buffer's size in bytes", bytes.len() as u64, limit)?;
        let ty = layout::buffer_type(slot.binding.kind).ok_or_else(|| self.undescribed(slot))?;
        Ok((
            ty,
            Resource::Buffer(upload::buffer(self.device, self.job, bytes, usage)),
        ))
    }

    fn texture(&self, slot: &Slot<'_>) -> Result<(wgpu::BindingType, Resource), Error> {
        let data: &TextureData =
            look_up(&self.resources.textures, slot.binding).ok_or_else(|| self.missing(slot))?;
        let filterable = !data.format.is_float() || self.device.filters_floats();
        self.check_filtering(filterable)?;
        let ty = layout::texture_type(slot.entry, slot.binding, filterable)?;
        let wanted = match ty {
            wgpu::BindingType::Texture {
                view_dimension: wgpu::TextureViewDimension::Cube,
                ..
            } => TextureDimension::Cube,
            _ => TextureDimension::Plane,
        };
        if data.dimension != wanted {
            return Err(self.wrong(slot, format!("{:?} texture", data.dimension).to_lowercase()));
        }
        Ok((
            ty,
            Resource::View(upload::texture(self.device, self.job, &slot.binding.name, data)?),
        ))
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

    fn sampler(&self, slot: &Slot<'_>) -> Result<(wgpu::BindingType, Resource), Error> {
        let settings = look_up(&self.resources.samplers, slot.binding).ok_or_else(|| self.missing(slot))?;
        let ty = match settings.is_filtering() {
            true => wgpu::SamplerBindingType::Filtering,
            false => wgpu::SamplerBindingType::NonFiltering,
        };
        let sampler = upload::sampler(self.device, self.job, settings);
        Ok((wgpu::BindingType::Sampler(ty), Resource::Sampler(sampler)))
    }

    fn missing(&self, slot: &Slot<'_>) -> Error {
        Error::MissingResource {
            job: self.job.to_owned(),
            name: slot.binding.name.clone(),
            group: slot.binding.group,
            binding: slot.binding.binding,
            kind: layout::describe(slot.binding),
        }
    }

    fn wrong(&self, slot: &Slot<'_>, given: String) -> Error {
        let (job, name) = (self.job.to_owned(), slot.binding.name.clone());
        Error::WrongResource {
            job,
            name,
            expected: layout::describe(slot.binding),
            given,
        }
    }

    fn undescribed(&self, slot: &Slot<'_>) -> Error {
        layout::misfit(
            slot.entry,
            &slot.binding.name,
            "the manifest doesn't describe its members".to_owned(),
        )
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
