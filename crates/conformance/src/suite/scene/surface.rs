//! A draw's uniforms and textures in the words of the two oracles: the f64 material, and the bounded surface.
//!
//! Both read the same uniforms by their names in the shader interface; which of them count follows from the feature set.

use bossage_reference::surface::{self as reference, Light as TruthLight, Material};
use bossage_reference::{Form as TruthForm, texture::Texture};
use bossage_scene::{Draw, Texels, TextureShape};
use bossage_shaders::{Albedo, Alpha, Form, Lights, NormalSource, Relief as FeatureRelief};
use glam::{DVec2, DVec3, DVec4};

use crate::tolerance::surface::{Interpolants, Light, Map, Relief, Surface};
use crate::tolerance::texture::Storage;

/// The textures that the draw's features read, decoded.
pub(super) struct Maps {
    albedo: Option<(Texture, Storage)>,
    normal: Option<(Texture, Storage)>,
    height: Option<(Texture, Storage)>,
}

impl Maps {
    pub(super) fn new(draw: &Draw) -> Self {
        let features = draw.features.canonical();
        let read = |name: &str, wanted: bool| if wanted { decoded(draw, name) } else { None };
        Self {
            albedo: read("albedo_map", features.albedo == Albedo::Map),
            normal: read("normal_map", features.normal == NormalSource::Map),
            height: read("height_map", features.relief != FeatureRelief::None),
        }
    }
}

/// Level 0 as the sampler returns it.
fn decoded(draw: &Draw, name: &str) -> Option<(Texture, Storage)> {
    let texture = draw.textures.get(name)?;
    let level = texture
        .levels
        .first()
        .filter(|_| texture.shape == TextureShape::Plane)?;
    let (width, height) = (level.width, level.height);
    Some(match &level.texels {
        // No plane is stored so.
        Texels::Rgba16Unorm(_) => return None,
        Texels::Rgba8Unorm(texels) => (
            Texture::from_rgba8(width, height, texels.as_flattened()),
            Storage::Unorm8,
        ),
        Texels::R32Float(texels) => (Texture::from_r32float(width, height, texels), Storage::Float32),
        Texels::Rgba32Float(texels) => {
            let texels = texels
                .iter()
                .map(|t| DVec4::from_array(t.map(f64::from)))
                .collect();
            (
                Texture {
                    width,
                    height,
                    texels,
                },
                Storage::Float32,
            )
        }
    })
}

/// N numbers of a uniform; zeros where the draw does not have it.
fn uniform<const N: usize>(draw: &Draw, name: &str) -> [f32; N] {
    let values = draw.uniforms.get(name).map(Vec::as_slice).unwrap_or_default();
    values.first_chunk::<N>().copied().unwrap_or([0.0; N])
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

/// The f64 material.
pub(super) fn material(draw: &Draw, maps: &Maps) -> Material {
    let surface = bounded(draw, maps);
    let texture = |map: &Option<(Texture, Storage)>| map.as_ref().map(|(texture, _)| texture.clone());
    let [scale, bias, v_factor] = surface.elevation.map(f64::from);
    Material {
        albedo: DVec4::from_array(surface.albedo.map(f64::from)),
        albedo_map: texture(&maps.albedo),
        normal_map: texture(&maps.normal),
        normal_decode: DVec2::from_array(surface.normal_decode.map(f64::from)),
        height_map: texture(&maps.height),
        relief: match surface.relief {
            Relief::None => reference::Relief::None,
            Relief::Offset => reference::Relief::Offset {
                form: form(draw),
                scale,
                bias,
                v_factor,
            },
            Relief::OffsetLimited => reference::Relief::OffsetLimited {
                scale,
                bias,
                v_factor,
            },
        },
        ambient: vector(surface.ambient),
        specular: surface.specular.map(vector),
        shininess: f64::from(surface.shininess),
        alpha_cutoff: surface.alpha_cutoff.map(f64::from),
        edge: surface.edge,
    }
}

/// Eye, lights and form for the f64 surface.
pub(super) fn view(draw: &Draw) -> (DVec3, Vec<TruthLight>, TruthForm) {
    let light = |light: Light| {
        let (place, radiance) = (
            vector([light.vector[0], light.vector[1], light.vector[2]]),
            vector(light.radiance),
        );
        if light.vector[3] == 0.0 {
            TruthLight::Directional {
                toward: place,
                radiance,
            }
        } else {
            TruthLight::Point {
                position: place,
                radiance,
            }
        }
    };
    (
        vector(uniform(draw, "view.eye")),
        lights(draw).into_iter().map(light).collect(),
        form(draw),
    )
}

/// The interpolants in f64.
pub(super) fn doubles(at: &Interpolants) -> reference::Interpolants {
    reference::Interpolants {
        position: vector(at.position),
        normal: vector(at.normal),
        tangent: DVec4::from_array(at.tangent.map(f64::from)),
        uv: DVec2::from_array(at.uv.map(f64::from)),
    }
}

fn form(draw: &Draw) -> TruthForm {
    match draw.features.canonical().form {
        Form::Published => TruthForm::Published,
        Form::Hardened => TruthForm::Hardened,
    }
}

fn vector(v: [f32; 3]) -> DVec3 {
    DVec3::from_array(v.map(f64::from))
}
