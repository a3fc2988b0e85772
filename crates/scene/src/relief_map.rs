//! What a search along the view ray reads besides heights, baked from them: `relief_map`, whose layout goes with the technique.
//!
//! - `exact`: window maxima, one level of 8 bits;
//! - `cone_step`, `relaxed_cone_step`: heights in red, ratios of cones in green, one level;
//! - `parallax_iterative`: heights in red, in green the third component of the surface's unit normal, one level.

use bossage_assets::height_to_normal::{self, Bake};
use bossage_assets::{EdgeMode, HeightField, NormalCodec, cone_map, relaxed_cone_map, window_maxima};
use bossage_shaders::Relief;

use crate::model::HeightSource;
use crate::textures::{Level, Texels, Texture};

/// The map of a technique; none for techniques that read no such map.
pub(crate) fn bake(relief: Relief, height: Option<&HeightSource>, edge: EdgeMode) -> Option<Texture> {
    let flat = HeightField::from_fn(1, 1, |_, _| 0.0);
    let field = height.map_or(&flat, |height| height.field.as_ref());
    match relief {
        Relief::ConeStep => Some(pairs(field, &cone_map::bake(field, edge).ratios)),
        Relief::RelaxedConeStep => Some(pairs(field, &relaxed_cone_map::bake(field, edge).ratios)),
        Relief::Exact => Some(windows(field, edge)),
        Relief::ParallaxIterative => Some(pairs(field, &normals_z(field, height, edge))),
        Relief::None
        | Relief::ParallaxOffset
        | Relief::ParallaxOffsetLimited
        | Relief::ParallaxSlopeAo
        | Relief::ParallaxSlopeAoDirected
        | Relief::Displacement
        | Relief::SteepParallax
        | Relief::ParallaxOcclusion
        | Relief::Relief => None,
    }
}

/// By central differences of the elevation, in tiles of the material.
fn normals_z(field: &HeightField, height: Option<&HeightSource>, edge: EdgeMode) -> Vec<f32> {
    let Some(height) = height else {
        return vec![1.0; field.texels.len()];
    };
    let scale = height.elevation.scale.as_vec2().to_array();
    // The codec is of bytes, which these normals never become. What is too steep for a slope is a wall.
    Bake::central(field, scale, edge, NormalCodec::Unorm).map_or_else(
        |_| vec![0.0; field.texels.len()],
        |bake| {
            let normals = height_to_normal::normals(field, &bake);
            normals.iter().map(|normal| normal.z).collect()
        },
    )
}

fn windows(field: &HeightField, edge: EdgeMode) -> Texture {
    let windows = window_maxima::bake(field, edge);
    Texture::plane(vec![Level {
        width: 2 * windows.columns,
        height: 2 * windows.rows,
        texels: Texels::Rgba8Unorm(windows.texels),
    }])
}

fn pairs(field: &HeightField, numbers: &[f32]) -> Texture {
    let pair = |(height, number): (&f32, &f32)| [*height, *number, 0.0, 1.0];
    Texture::plane(vec![Level {
        width: field.width,
        height: field.height,
        texels: Texels::Rgba32Float(field.texels.iter().zip(numbers).map(pair).collect()),
    }])
}
