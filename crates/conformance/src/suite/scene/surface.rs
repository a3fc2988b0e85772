//! A draw's uniforms and textures in the words of the bounded surface.

use bossage_reference::texture::Texture;
use bossage_scene::Draw;
use bossage_shaders::{Alpha, FeatureSet, Form, Lights, Relief as FeatureRelief, Shading};

use super::truth::{Maps, uniform};
use crate::tolerance::surface::{Light, Map, Relief, Surface};
use crate::tolerance::texture::Storage;

/// Whether the bound of a surface has been worked out: lambert and highlight, with an offset or none. A reflection adds exactly
/// nothing where the surroundings are black.
pub(super) fn is_bounded(draw: &Draw) -> bool {
    let FeatureSet {
        shading,
        relief,
        environment,
        ..
    } = draw.features.canonical();
    let black = draw
        .textures
        .get("environment_map")
        .is_some_and(|map| map.levels.iter().all(|level| level.width == 1));
    shading == Shading::BlinnPhong && !relief.is_slope() && (!environment || black)
}

fn lights(draw: &Draw) -> Vec<Light> {
    let light = |v: &[f32]| Light {
        vector: [v[0], v[1], v[2], v[3]],
        radiance: [v[4], v[5], v[6]],
    };
    match draw.features.lights {
        Lights::None => Vec::new(),
        Lights::Directional | Lights::Point => {
            let w = f32::from(u8::from(draw.features.lights == Lights::Point));
            let [x, y, z] = uniform(draw, "light.vector");
            vec![Light {
                vector: [x, y, z, w],
                radiance: uniform(draw, "light.radiance"),
            }]
        }
        Lights::Many => {
            let [count] = uniform(draw, "lights.count");
            let items = draw
                .uniforms
                .get("lights.items")
                .map(Vec::as_slice)
                .unwrap_or_default();
            items.chunks_exact(8).take(count as usize).map(light).collect()
        }
    }
}

/// The bounded surface.
pub(super) fn bounded<'a>(draw: &Draw, maps: &'a Maps) -> Surface<'a> {
    let features = draw.features.canonical();
    let map = |map: &'a Option<(Texture, Storage)>| {
        map.as_ref().map(|(texture, storage)| Map {
            texture,
            storage: *storage,
        })
    };
    let [shininess] = uniform(draw, "material.shininess");
    let [alpha_cutoff] = uniform(draw, "material.alpha_cutoff");
    Surface {
        published: features.form == Form::Published,
        relief: match features.relief {
            FeatureRelief::None => Relief::None,
            FeatureRelief::ParallaxOffset => Relief::Offset,
            FeatureRelief::ParallaxOffsetLimited => Relief::OffsetLimited,
            // Displaced vertices leave nothing to do here; slopes have no bound yet.
            FeatureRelief::Displacement
            | FeatureRelief::ParallaxSlopeAo
            | FeatureRelief::ParallaxSlopeAoDirected => Relief::None,
        },
        eye: uniform(draw, "view.eye"),
        lights: lights(draw),
        albedo: uniform(draw, "material.albedo"),
        ambient: uniform(draw, "material.ambient"),
        specular: features.specular.then(|| uniform(draw, "material.specular")),
        shininess,
        elevation: uniform(draw, "material.relief"),
        normal_decode: uniform(draw, "material.normal_decode"),
        alpha_cutoff: (features.alpha == Alpha::Mask).then_some(alpha_cutoff),
        edge: draw.edge,
        albedo_map: map(&maps.albedo),
        normal_map: map(&maps.normal),
        height_map: map(&maps.height),
    }
}
