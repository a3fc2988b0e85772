//! From the manifest's words to wgpu's: bindings and located values of entry points.

use bossage_translate::manifest::{Binding, Entry, Kind, Varying};

use crate::error::Error;
use crate::texture::{TexelFormat, TextureData};

/// A vertex attribute at a location, of 32-bit floats.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Located {
    pub(crate) name: String,
    pub(crate) location: u32,
    pub(crate) components: u32,
}

/// The values of a list that have a location, in the order of their locations.
pub(crate) fn located(entry: &Entry, values: &[Varying]) -> Result<Vec<Located>, Error> {
    let with_location = values
        .iter()
        .filter_map(|value| value.location.map(|location| (value, location)));
    let read = |(value, location): (&Varying, u32)| {
        let components = float_components(&value.ty).ok_or_else(|| {
            Error::misfit(
                entry,
                &value.name,
                format!("its type `{}` is not of 32-bit floats", value.ty),
            )
        })?;
        Ok(Located {
            name: value.name.clone(),
            location,
            components,
        })
    };
    let mut list = with_location.map(read).collect::<Result<Vec<_>, Error>>()?;
    list.sort_by_key(|value| value.location);
    Ok(list)
}

/// The fragment outputs that have a location, in the order of their locations: floats or integers of 32 bits.
pub(crate) fn outputs(entry: &Entry) -> Result<Vec<(&Varying, u32)>, Error> {
    let located = entry
        .outputs
        .iter()
        .filter_map(|output| output.location.map(|location| (output, location)));
    let mut list: Vec<(&Varying, u32)> = located.collect();
    if let Some((odd, _)) = list.iter().find(|(output, _)| !fits_a_target(&output.ty)) {
        let problem = format!("its type `{}` is not of 32-bit floats or integers", odd.ty);
        return Err(Error::misfit(entry, &odd.name, problem));
    }
    list.sort_by_key(|(_, location)| *location);
    Ok(list)
}

/// Whether a fragment output of this type is kept in a target.
fn fits_a_target(ty: &str) -> bool {
    let as_floats = ty
        .replace("<u32>", "f")
        .replace("<i32>", "f")
        .replace(['u', 'i'], "f");
    float_components(&as_floats).is_some()
}

/// How many floats a WGSL type of 32-bit floats has, unless it is another type.
fn float_components(ty: &str) -> Option<u32> {
    match ty.replace("<f32>", "f").as_str() {
        "f32" => Some(1),
        "vec2f" => Some(2),
        "vec3f" => Some(3),
        "vec4f" => Some(4),
        _ => None,
    }
}

/// What a binding is, in the words of a message.
pub(crate) fn describe(binding: &Binding) -> String {
    match binding.kind {
        Kind::UniformBuffer => "uniform buffer".to_owned(),
        Kind::ReadOnlyStorageBuffer => "read-only storage buffer".to_owned(),
        Kind::StorageBuffer => "storage buffer".to_owned(),
        Kind::Texture | Kind::DepthTexture | Kind::StorageTexture => binding.ty.clone(),
        Kind::Sampler => "sampler".to_owned(),
        Kind::ComparisonSampler => "comparison sampler".to_owned(),
    }
}

/// wgpu's type of a bound buffer; `None` for what is no buffer.
pub(crate) fn buffer_type(kind: Kind) -> Option<wgpu::BindingType> {
    let ty = match kind {
        Kind::UniformBuffer => wgpu::BufferBindingType::Uniform,
        Kind::ReadOnlyStorageBuffer => wgpu::BufferBindingType::Storage { read_only: true },
        Kind::StorageBuffer => wgpu::BufferBindingType::Storage { read_only: false },
        Kind::Texture
        | Kind::DepthTexture
        | Kind::StorageTexture
        | Kind::Sampler
        | Kind::ComparisonSampler => {
            return None;
        }
    };
    Some(wgpu::BindingType::Buffer {
        ty,
        has_dynamic_offset: false,
        min_binding_size: None,
    })
}

/// wgpu's type of a bound texture.
pub(crate) fn texture_type(kind: Kind, data: &TextureData, filterable: bool) -> wgpu::BindingType {
    let sample_type = match (kind, data.format.sample_type()) {
        (Kind::DepthTexture, _) => wgpu::TextureSampleType::Depth,
        (_, "u32") => wgpu::TextureSampleType::Uint,
        (_, "i32") => wgpu::TextureSampleType::Sint,
        _ => wgpu::TextureSampleType::Float { filterable },
    };
    wgpu::BindingType::Texture {
        sample_type,
        view_dimension: data.dimension.view(),
        multisampled: false,
    }
}

/// wgpu's type of a bound storage texture.
pub(crate) fn storage_type(binding: &Binding, data: &TextureData) -> wgpu::BindingType {
    let access = match access(binding) {
        "read" => wgpu::StorageTextureAccess::ReadOnly,
        "write" => wgpu::StorageTextureAccess::WriteOnly,
        "atomic" => wgpu::StorageTextureAccess::Atomic,
        _ => wgpu::StorageTextureAccess::ReadWrite,
    };
    wgpu::BindingType::StorageTexture {
        access,
        format: data.format.wgpu(),
        view_dimension: data.dimension.view(),
    }
}

/// Whether a shader may write a bound texture.
pub(crate) fn is_written(binding: &Binding) -> bool {
    binding.kind == Kind::StorageTexture && access(binding) != "read"
}

fn access(binding: &Binding) -> &str {
    let texture = binding.texture.as_ref();
    texture
        .and_then(|texture| texture.access.as_deref())
        .unwrap_or_default()
}

/// Why a texture cannot stand at a binding, if it cannot.
pub(crate) fn misfit_of_texture(
    entry: &Entry,
    binding: &Binding,
    data: &TextureData,
) -> Result<Option<String>, Error> {
    let texture = binding.texture.as_ref().ok_or_else(|| {
        Error::misfit(
            entry,
            &binding.name,
            "the manifest doesn't describe it".to_owned(),
        )
    })?;
    if texture.multisampled {
        return Err(Error::misfit(
            entry,
            &binding.name,
            format!("the runner has no textures of type {}", binding.ty),
        ));
    }
    let shape = (texture.dimension.as_str(), texture.arrayed);
    let is_depth = data.format == TexelFormat::Depth16Unorm;
    if shape != data.dimension.words() {
        return Ok(Some(format!("{:?} texture", data.dimension).to_lowercase()));
    }
    let format = texture.format.as_deref();
    let fits = match binding.kind {
        Kind::DepthTexture => is_depth,
        Kind::StorageTexture => format == Some(format!("{:?}", data.format).to_lowercase().as_str()),
        _ => !is_depth && texture.sample_type == data.format.sample_type(),
    };
    Ok((!fits).then(|| format!("texture of {:?}", data.format)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn float_types_are_read_in_both_spellings() {
        for (ty, components) in [("f32", 1), ("vec2f", 2), ("vec3<f32>", 3), ("vec4<f32>", 4)] {
            assert_eq!(float_components(ty), Some(components), "{ty}");
        }
        for ty in ["u32", "vec2u", "vec2<i32>", "mat2x2<f32>", "vec5f", "f16"] {
            assert_eq!(float_components(ty), None, "{ty}");
        }
        for ty in ["u32", "vec2u", "vec2<i32>", "vec4<f32>"] {
            assert!(fits_a_target(ty), "{ty}");
        }
        for ty in ["mat2x2<f32>", "vec5u", "f16", "vec4<bool>"] {
            assert!(!fits_a_target(ty), "{ty}");
        }
    }
}
