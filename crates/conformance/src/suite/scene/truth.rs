//! A draw's uniforms and textures in the words of the f64 surface.
//!
//! Values are read by their names in the shader interface; which of them count follows from the feature set.

pub(super) mod search;

use bossage_reference::cube::Seams;
use bossage_reference::dot3_single_pass::Normaliser;
use bossage_reference::environment_bump::Environment;
use bossage_reference::normalisation_cube_map::{Depth, Map};
use bossage_reference::relief_ray::Layer;
use bossage_reference::surface::{Light, Material, Pass, Relief, Shading, Viewer};
use bossage_reference::{Form as TruthForm, texture::Texture};
use bossage_scene::{Draw, Texels, TextureShape};
use bossage_shaders::{
    Albedo, Alpha, FeatureSet, Form, Lights, NormalSource, Normaliser as Normalises, Relief as Feature,
    Shading as Kind, Stage,
};
use glam::{DVec2, DVec3, DVec4};

/// Level 0 of a plane as the sampler returns it.
pub(super) fn plane(draw: &Draw, name: &str) -> Option<Texture> {
    let texture = draw.textures.get(name)?;
    let level = texture
        .levels
        .first()
        .filter(|_| texture.shape == TextureShape::Plane)?;
    Some(Texture {
        width: level.width,
        height: level.height,
        texels: texels(&level.texels),
    })
}

fn texels(stored: &Texels) -> Vec<DVec4> {
    let four = |texel: &[f32; 4]| DVec4::from_array(texel.map(f64::from));
    match stored {
        Texels::Rgba8Unorm(texels) => {
            let unorm = |texel: &[u8; 4]| DVec4::from_array(texel.map(|code| f64::from(code) / 255.0));
            texels.iter().map(unorm).collect()
        }
        Texels::Rgba16Unorm(texels) => {
            let unorm = |texel: &[u16; 4]| DVec4::from_array(texel.map(|code| f64::from(code) / 65535.0));
            texels.iter().map(unorm).collect()
        }
        Texels::R32Float(texels) => {
            let one = |value: &f32| DVec4::new(f64::from(*value), 0.0, 0.0, 1.0);
            texels.iter().map(one).collect()
        }
        Texels::Rgba32Float(texels) => texels.iter().map(four).collect(),
    }
}

/// N numbers of a uniform; zeros where the draw does not have it.
pub(super) fn uniform<const N: usize>(draw: &Draw, name: &str) -> [f32; N] {
    let values = draw.uniforms.get(name).map(Vec::as_slice).unwrap_or_default();
    values.first_chunk::<N>().copied().unwrap_or([0.0; N])
}

/// The f64 material, shaded as that fragment stage does it. It has the maps that the draw's features read.
pub(super) fn material(draw: &Draw, stage: Stage) -> Material {
    let features = draw.features.canonical();
    let map = |name: &str, wanted: bool| if wanted { plane(draw, name) } else { None };
    let [alpha_cutoff] = uniform(draw, "material.alpha_cutoff");
    let [shininess] = uniform(draw, "material.shininess");
    let specular = || vector(uniform(draw, "material.specular"));
    Material {
        albedo: DVec4::from_array(uniform(draw, "material.albedo").map(f64::from)),
        albedo_map: map("albedo_map", features.albedo == Albedo::Map),
        normal_map: map("normal_map", features.normal == NormalSource::Map),
        normal_decode: DVec2::from_array(uniform(draw, "material.normal_decode").map(f64::from)),
        height_map: map(
            "height_map",
            features.relief.reads_heights() || features.shading == Kind::Emboss,
        ),
        search_maps: search::maps(draw, &features),
        relief: relief(draw, &features),
        shadow: search::shadow(draw, &features),
        depth: search::depth(draw, &features),
        ambient: vector(uniform(draw, "material.ambient")),
        specular: features.specular.then(specular),
        shininess: f64::from(shininess),
        shading: shading(draw, &features, stage),
        reflection: features.environment.then(|| (environment(draw), specular())),
        alpha_cutoff: (features.alpha == Alpha::Mask).then_some(f64::from(alpha_cutoff)),
        edge: draw.edge,
    }
}

fn relief(draw: &Draw, features: &FeatureSet) -> Relief {
    let [scale, bias, v_factor] = uniform(draw, "material.relief").map(f64::from);
    let [occlusion] = uniform(draw, "material.occlusion").map(f64::from);
    let form = form(draw);
    let slope = |directed| Relief::Slope {
        directed,
        form,
        scale,
        v_factor,
        occlusion,
    };
    if let Some(search) = search::of(draw, features) {
        let layer = Layer {
            scale,
            bias,
            v_factor,
        };
        return Relief::Search { search, layer };
    }
    match features.relief {
        // Displaced vertices show in the interpolants, and searches are above.
        Feature::None
        | Feature::Displacement
        | Feature::ParallaxIterative
        | Feature::SteepParallax
        | Feature::ParallaxOcclusion
        | Feature::Relief
        | Feature::ConeStep
        | Feature::RelaxedConeStep
        | Feature::Exact => Relief::None,
        Feature::ParallaxOffset => Relief::Offset {
            form,
            scale,
            bias,
            v_factor,
        },
        Feature::ParallaxOffsetLimited => Relief::OffsetLimited {
            scale,
            bias,
            v_factor,
        },
        Feature::ParallaxSlopeAo => slope(false),
        Feature::ParallaxSlopeAoDirected => slope(true),
    }
}

/// The shading of a fragment stage: of one of the passes, where there are two.
fn shading(draw: &Draw, features: &FeatureSet, stage: Stage) -> Shading {
    let normaliser = match (features.normaliser, form(draw)) {
        (Normalises::Cube, _) => Normaliser::Cube(normalisation(draw)),
        (Normalises::Arithmetic, TruthForm::Published) => Normaliser::Arithmetic,
        (Normalises::Arithmetic, TruthForm::Hardened) => Normaliser::Guarded,
    };
    match features.shading {
        Kind::BlinnPhong => Shading::BlinnPhong,
        Kind::WrapLambert => Shading::WrapLambert,
        Kind::Emboss => {
            let [step] = uniform(draw, "material.emboss_step");
            Shading::Emboss {
                step: f64::from(step),
            }
        }
        Kind::Dot3SinglePass => Shading::Dot3 {
            normaliser,
            pass: Pass::Single,
        },
        Kind::Dot3TwoPass => Shading::Dot3 {
            normaliser,
            pass: match stage {
                Stage::SecondPass => Pass::Second,
                Stage::Vertex | Stage::Fragment | Stage::FragmentCapture | Stage::FragmentGivenHit => {
                    Pass::First
                }
            },
        },
    }
}

/// The normalisation cube map of the draw's size and depth, computed anew.
fn normalisation(draw: &Draw) -> Map {
    let level = draw
        .textures
        .get("normalisation_map")
        .and_then(|map| map.levels.first());
    let depth = match level.map(|level| &level.texels) {
        Some(Texels::Rgba16Unorm(_)) => Depth::Sixteen,
        Some(Texels::Rgba8Unorm(_)) | None => Depth::Eight,
        Some(Texels::Rgba32Float(_) | Texels::R32Float(_)) => Depth::Exact,
    };
    Map {
        seams: Seams::Seamless,
        ..Map::new(level.map_or(1, |level| level.width), depth)
    }
}

/// The six faces, one after the other; a black texel each where the draw has none.
fn environment(draw: &Draw) -> Environment {
    let level = draw
        .textures
        .get("environment_map")
        .and_then(|map| map.levels.first());
    Environment {
        size: level.map_or(1, |level| level.width),
        texels: level.map_or_else(|| vec![DVec4::W; 6], |level| texels(&level.texels)),
        seams: Seams::Seamless,
    }
}

/// Viewer, lights and form for the f64 surface.
pub(super) fn view(draw: &Draw) -> (Viewer, Vec<Light>, TruthForm) {
    let viewer = Viewer {
        eye: vector(uniform(draw, "view.eye")),
        backward: vector(uniform(draw, "view.backward")),
    };
    (viewer, lights(draw), form(draw))
}

fn lights(draw: &Draw) -> Vec<Light> {
    let radiance = || vector(uniform(draw, "light.radiance"));
    let place = || vector(uniform(draw, "light.vector"));
    match draw.features.canonical().lights {
        Lights::None => Vec::new(),
        Lights::Directional => vec![Light::Directional {
            toward: place(),
            radiance: radiance(),
        }],
        Lights::Point => vec![Light::Point {
            position: place(),
            radiance: radiance(),
        }],
        Lights::Many => {
            let [count] = uniform(draw, "lights.count");
            let items = draw
                .uniforms
                .get("lights.items")
                .map(Vec::as_slice)
                .unwrap_or_default();
            items
                .chunks_exact(8)
                .take(count as usize)
                .map(one_of_many)
                .collect()
        }
    }
}

fn one_of_many(v: &[f32]) -> Light {
    let (place, radiance) = (vector([v[0], v[1], v[2]]), vector([v[4], v[5], v[6]]));
    if v[3] == 0.0 {
        Light::Directional {
            toward: place,
            radiance,
        }
    } else {
        Light::Point {
            position: place,
            radiance,
        }
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
