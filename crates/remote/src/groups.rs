//! What a job binds, as WebGPU describes it.

use bossage_runner::{
    AddressMode, Error, Filter, Resolved, Resources, SamplerSettings, Shader, TexelFormat, TextureData,
    TextureDimension, Value, push_constants, resolve,
};
use bossage_translate::Stage as ShaderStage;
use bossage_translate::manifest::Kind as BindingKind;

use crate::kind::Kind;
use crate::machine::Remote;
use crate::message::{Data, Entry, GlslSlot, Resource, Sampler, Stage};

/// An entry point's text, exactly as it is given.
pub(crate) fn stage(remote: &Remote, job: &str, shader: &Shader<'_>) -> Result<Stage, Error> {
    let text = remote.kind.text(shader.code);
    let text = text.map_err(|message| Error::invalid(job, message))?;
    Ok(Stage {
        text: text.to_owned(),
        entry: shader.entry_point().to_owned(),
    })
}

/// The groups of these stages of one pipeline, by number, and the names of the buffers that they may write, in the order in which
/// they are bound.
pub(crate) fn groups(
    remote: &Remote,
    job: &str,
    shaders: &[&Shader<'_>],
    resources: &Resources<'_>,
    data: &mut Data,
) -> Result<(Vec<Vec<Entry>>, Vec<String>), Error> {
    let mut groups: Vec<Vec<Entry>> = Vec::new();
    let mut written = Vec::new();
    let resolved = resolve(job, shaders, resources)?;
    if !push_constants(job, shaders, resources)?.is_empty() {
        return Err(remote.lacks(job, "push constants".to_owned()));
    }
    for one in &resolved {
        let (group, binding) = one.place;
        let resource = resource(remote, job, one, data)?;
        if matches!(resource, Resource::Storage { writable: true, .. }) {
            written.push(one.binding.name.clone());
        }
        let group = group as usize;
        if groups.len() <= group {
            groups.resize_with(group + 1, Vec::new);
        }
        groups[group].push(Entry {
            binding,
            visibility: one.stages.iter().fold(0, |all, stage| all | visibility(*stage)),
            resource,
            glsl: (remote.kind == Kind::OpenGl)
                .then(|| glsl_slot(one, shaders, &resolved))
                .flatten(),
        });
    }
    Ok((groups, written))
}

/// Where GLSL has a binding: by the manifest's word of each stage.
fn glsl_slot(one: &Resolved<'_>, shaders: &[&Shader<'_>], resolved: &[Resolved<'_>]) -> Option<GlslSlot> {
    let place = (one.binding.group, one.binding.binding);
    let slots: Vec<_> = shaders
        .iter()
        .flat_map(|shader| &shader.entry.bindings)
        .filter(|binding| (binding.group, binding.binding) == place)
        .filter_map(|binding| binding.glsl.as_ref())
        .collect();
    let sampler = slots
        .iter()
        .find_map(|slot| slot.sampler.as_ref())
        .and_then(|name| {
            resolved.iter().find_map(|other| match &other.value {
                Value::Sampler(settings) if other.binding.name == *name => Some(settings),
                _ => None,
            })
        });
    Some(GlslSlot {
        unit: slots.first()?.unit,
        names: slots.iter().map(|slot| slot.name.clone()).collect(),
        sampler: sampler.map(described),
    })
}

/// WebGPU's flag of a stage.
fn visibility(stage: ShaderStage) -> u32 {
    match stage {
        ShaderStage::Vertex => 1,
        ShaderStage::Fragment => 2,
        ShaderStage::Compute => 4,
    }
}

fn resource(remote: &Remote, job: &str, one: &Resolved<'_>, data: &mut Data) -> Result<Resource, Error> {
    let lacks = |what: String| Err(remote.lacks(job, what));
    Ok(match &one.value {
        Value::Uniform(bytes) => Resource::Uniform {
            data: data.add(bytes),
        },
        Value::Storage(held) => Resource::Storage {
            data: data.add(&held.bytes()),
            writable: one.binding.kind == BindingKind::StorageBuffer,
        },
        Value::Texture(_) if one.binding.kind == BindingKind::DepthTexture => {
            return lacks("depth textures".to_owned());
        }
        Value::Texture(held) => texture(remote, job, held, data)?,
        Value::StorageTexture(_) => return lacks("storage textures".to_owned()),
        Value::Sampler(_) if one.binding.kind == BindingKind::ComparisonSampler => {
            return lacks("comparison samplers".to_owned());
        }
        Value::Sampler(settings) => sampler(settings),
    })
}

fn texture(remote: &Remote, job: &str, held: &TextureData, data: &mut Data) -> Result<Resource, Error> {
    let dimension = match held.dimension {
        TextureDimension::Plane => "2d",
        TextureDimension::Cube => "cube",
        other => return Err(remote.lacks(job, format!("textures of shape {other:?}"))),
    };
    let as_floats = held.format.is_norm16() && !remote.has("texture-formats-tier1");
    let format = match held.format {
        TexelFormat::R16Unorm if as_floats => Some("r32float"),
        TexelFormat::Rg16Unorm | TexelFormat::Rg16Snorm if as_floats => Some("rg32float"),
        TexelFormat::Rgba16Unorm | TexelFormat::Rgba16Snorm if as_floats => Some("rgba32float"),
        other => format(other),
    };
    let format = format.ok_or_else(|| remote.lacks(job, format!("textures of {:?}", held.format)))?;
    let texel_bytes = held.format.texel_bytes();
    let levels = held.levels.iter().map(|level| match as_floats {
        true => data.add(&floats(held.format, level)),
        false => data.add(level),
    });
    Ok(Resource::Texture {
        width: held.width,
        height: held.height,
        layers: held.dimension.layers(),
        dimension,
        format,
        texel_bytes: if as_floats { 2 * texel_bytes } else { texel_bytes },
        levels: levels.collect(),
        filterable: !(held.format.is_float() || as_floats) || remote.has("float32-filterable"),
    })
}

/// What 16-bit normalised integers stand for, where the device has floats only.
fn floats(format: TexelFormat, level: &[u8]) -> Vec<u8> {
    let is_signed = matches!(format, TexelFormat::Rg16Snorm | TexelFormat::Rgba16Snorm);
    let float = |word: &[u8; 2]| match is_signed {
        true => (f32::from(i16::from_le_bytes(*word)) / 32_767.0).max(-1.0),
        false => f32::from(u16::from_le_bytes(*word)) / 65_535.0,
    };
    let words = level.as_chunks::<2>().0.iter();
    words.flat_map(|word| float(word).to_le_bytes()).collect()
}

/// WebGPU's name of a format of floats and of what is read as such; `None` of others.
fn format(format: TexelFormat) -> Option<&'static str> {
    Some(match format {
        TexelFormat::R8Unorm => "r8unorm",
        TexelFormat::R16Unorm => "r16unorm",
        TexelFormat::Rg8Unorm => "rg8unorm",
        TexelFormat::Rg8Snorm => "rg8snorm",
        TexelFormat::Rg16Unorm => "rg16unorm",
        TexelFormat::Rg16Snorm => "rg16snorm",
        TexelFormat::Rgba8Unorm => "rgba8unorm",
        TexelFormat::Rgba8Snorm => "rgba8snorm",
        TexelFormat::Rgba16Unorm => "rgba16unorm",
        TexelFormat::Rgba16Snorm => "rgba16snorm",
        TexelFormat::Rgba32Float => "rgba32float",
        TexelFormat::R32Float => "r32float",
        TexelFormat::Rg32Float => "rg32float",
        _ => return None,
    })
}

fn sampler(settings: &SamplerSettings) -> Resource {
    Resource::Sampler {
        filtering: settings.is_filtering(),
        settings: described(settings),
    }
}

fn described(settings: &SamplerSettings) -> Sampler {
    let address = match settings.address {
        AddressMode::Wrap => "repeat",
        AddressMode::Mirror => "mirror-repeat",
        AddressMode::Clamp => "clamp-to-edge",
    };
    let filter = |filter: Filter| match filter {
        Filter::Nearest => "nearest",
        Filter::Linear => "linear",
    };
    Sampler {
        address_mode_u: address,
        address_mode_v: address,
        address_mode_w: address,
        mag_filter: filter(settings.filter),
        min_filter: filter(settings.filter),
        mipmap_filter: filter(settings.mip_filter),
        max_anisotropy: settings.anisotropy,
    }
}
