//! What a job can bind.

use bossage_bounds::TexelFormat;
use bossage_bounds::ranges::Inputs;
use bossage_translate::manifest::{Binding, Entry, Kind};
use bossage_translate::{EmitOptions, Shader, Stage, manifest};

use super::request::format_named;

/// Bindings of textures that a compute shader may write.
pub(super) type Stored = Vec<(u32, u32)>;

/// Whether everything that the entry point uses can be bound by a job, and which textures it writes. Depths become 16-bit numbers, the only
/// ones that a texture can be filled with.
///
/// # Errors
/// What it is that cannot be bound, by name.
pub(super) fn bindable(shader: &Shader, entry: &str, inputs: &mut Inputs) -> Result<Stored, String> {
    let manifest = manifest(shader, &EmitOptions::default(), &[]);
    let described = manifest
        .entry(entry)
        .ok_or_else(|| format!("the manifest lacks `{entry}`"))?;
    for texture in &mut inputs.textures {
        if texture.format == TexelFormat::Depth32Float {
            texture.format = TexelFormat::Depth16Unorm;
        }
    }
    for binding in &described.bindings {
        check(described, binding)?;
    }
    for texture in &inputs.textures {
        if format_named(&format!("{:?}", texture.format)).is_none() {
            return Err(format!(
                "`{}` is a texture of {:?}, which is not bound here",
                texture.name, texture.format
            ));
        }
    }
    let stored = described.bindings.iter().filter(|binding| is_written(binding));
    Ok(stored.map(|binding| (binding.group, binding.binding)).collect())
}

fn check(described: &Entry, binding: &Binding) -> Result<(), String> {
    let refused = |what: &str| Err(format!("`{}` is {what}, which is not bound here", binding.name));
    if binding.count.is_some() {
        return refused("a binding array");
    }
    let Some(texture) = &binding.texture else {
        return Ok(());
    };
    if texture.multisampled {
        return refused("a multisampled texture");
    }
    if binding.ty == "texture_external" {
        return refused("an external texture");
    }
    if texture.access.as_deref() == Some("atomic") {
        return refused("a texture of atomics");
    }
    if is_written(binding) && described.stage != Stage::Compute {
        return Err(format!(
            "it writes the texture `{}`, and of what is drawn only targets are read back",
            binding.name
        ));
    }
    Ok(())
}

fn is_written(binding: &Binding) -> bool {
    let access = binding
        .texture
        .as_ref()
        .and_then(|texture| texture.access.as_deref());
    binding.kind == Kind::StorageTexture && access != Some("read")
}
