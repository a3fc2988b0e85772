//! Textures of a user's shader: as jobs bind them, and what comes back of those that it writes.

use bossage_bounds::ranges::TextureInput;
use bossage_bounds::{Dimension, Domain, Scalar, TexelFormat};

use super::request::{Shape, Texels};

/// A texture with texels of four channels each.
pub(super) fn bound(texture: &TextureInput, texels: &[f64], written: bool) -> Texels {
    let shape = match (texture.dimension, texture.layers) {
        (Dimension::D1, _) => Shape::Line,
        (Dimension::D2, 1) => Shape::Plane,
        (Dimension::D2, layers) => Shape::Array(layers),
        (Dimension::D3, _) => Shape::Volume(texture.size[2]),
        (Dimension::Cube, 6) => Shape::Cube,
        (Dimension::Cube, layers) => Shape::CubeArray(layers / 6),
    };
    Texels {
        binding: texture.binding,
        shape,
        size: [texture.size[0], texture.size[1]],
        format: format!("{:?}", texture.format),
        bytes: texture.bytes(texels),
        written,
    }
}

/// The names of a texture's scalars: `image[3, 0].r`, of an array and of slices with a third number.
pub(super) fn names(texture: &TextureInput) -> Vec<String> {
    let [width, height, slices] = texture.size;
    let (layers, channels) = (texture.layers * slices, texture.format.channels());
    let mut names = Vec::new();
    for layer in 0..layers {
        for (y, x) in (0..height).flat_map(|y| (0..width).map(move |x| (y, x))) {
            let third = if layers > 1 {
                format!(", {layer}")
            } else {
                String::new()
            };
            let letters = "rgba".chars().take(channels);
            names.extend(letters.map(|letter| format!("{}[{x}, {y}{third}].{letter}", texture.name)));
        }
    }
    names
}

/// The scalars of the channels that a format has, of four a texel.
pub(super) fn held<D: Domain>(format: TexelFormat, scalars: Vec<Scalar<D>>) -> Vec<Scalar<D>> {
    let channels = format.channels();
    scalars
        .into_iter()
        .enumerate()
        .filter(|(at, _)| at % 4 < channels)
        .map(|(_, scalar)| scalar)
        .collect()
}
