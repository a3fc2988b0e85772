//! What a job can bind.

use bossage_bounds::ranges::{Inputs, TextureInput};
use bossage_bounds::{Dimension, TexelFormat};
use bossage_translate::manifest::Kind;
use bossage_translate::{EmitOptions, Shader, manifest};

/// Whether everything that the entry point uses can be bound by a job.
pub(super) fn bindable(shader: &Shader, entry: &str, inputs: &Inputs) -> Result<(), String> {
    let manifest = manifest(shader, &EmitOptions::default(), &[]);
    let described = manifest
        .entry(entry)
        .ok_or_else(|| format!("the manifest lacks `{entry}`"))?;
    if described.immediates.is_some() {
        return Err("push constants are not bound here".to_owned());
    }
    for binding in &described.bindings {
        let refused = |what: &str| Err(format!("`{}` is {what}, which is not bound here", binding.name));
        if binding.count.is_some() {
            return refused("a binding array");
        }
        match binding.kind {
            Kind::UniformBuffer
            | Kind::ReadOnlyStorageBuffer
            | Kind::StorageBuffer
            | Kind::Texture
            | Kind::Sampler => {}
            Kind::DepthTexture => return refused("a depth texture"),
            Kind::StorageTexture => return refused("a storage texture"),
            Kind::ComparisonSampler => return refused("a comparison sampler"),
        }
    }
    let plain = |texture: &&TextureInput| {
        let layers = if texture.dimension == Dimension::Cube {
            6
        } else {
            1
        };
        matches!(texture.dimension, Dimension::D2 | Dimension::Cube)
            && texture.layers == layers
            && texture.samples == 1
            && texture.format == TexelFormat::Rgba32Float
    };
    match inputs.textures.iter().find(|texture| !plain(texture)) {
        None => Ok(()),
        Some(other) => Err(format!(
            "`{}` is no plain 2D or cube texture of floats, and others are not bound here",
            other.name
        )),
    }
}
