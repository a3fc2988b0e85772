//! A draw for any feature set: one bent sheet under lights of all kinds, whose every number is another.
//!
//! Made so that what a shader does can be told apart. Nothing is white, no channel equals another, no direction lies along an axis, the
//! sheet is bent and seen with perspective. Its maps are smooth and in floats: a sampler's weights keep 8 bits, so it may be off by 2⁻⁸
//! of the step between two texels, which are small steps here. So the intervals are narrow, on any driver.
//!
//! The sheet overlaps itself nowhere in the picture: each pixel belongs to at most one triangle.

use std::f64::consts::TAU;
use std::sync::Arc;

use bossage_assets::normal_mips::NormalMips;
use bossage_assets::normalisation_cube_map::{Depth, NormalisationCubeMap};
use bossage_assets::{ColorMap, CubeMap, HeightField, Mesh, NormalCodec, NormalMap};
use bossage_reference::relief_search::Search;
use bossage_scene::{
    AlphaMode, Draw, Elevation, Environment, HeightSource, Level, Material, NormalSource, Normaliser, Scene,
    Shadow, Technique, TechniquePin, Texels, Texture,
};
use bossage_shaders::{
    Albedo, Alpha, FeatureSet, Lights, Normaliser as Normalises, Relief, Shading, Shadow as Shades, Transform,
};
use glam::{DVec2, DVec3, DVec4, Mat4, Vec3};

use crate::case::with_causes;

/// Texels along a side of the maps.
const MAP_SIDE: u32 = 64;
/// Rows of the height map: its sides differ.
const HEIGHT_ROWS: u32 = 48;
/// Texels along a side of the surroundings and of the normalisation cube map.
const CUBE_SIDE: u32 = 32;

/// Pixels of its picture.
pub(super) const SIZE: [u32; 2] = [40, 30];

/// The alpha below which `wrap_lambert` cuts out.
const WRAP_CUTOFF: f64 = 0.01;

const SCENE: &str = r#"
schema = 1
ambient = [0.13, 0.07, 0.05]

[camera]
position = [0.3, -1.1, 2.6]
target = [0.05, 0.0, 0.0]
fov_deg = 46.0
near = 0.1
far = 20.0
size = [40, 30]

LIGHTS

[[materials]]
name = "specimen"
albedo = { color = [0.9, 0.65, 0.8, 0.95] }
specular = [0.55, 0.3, 0.15]
shininess = 11.0

[[objects]]
name = "sheet"
shape = "plane"
size = [2.0, 1.5]
segments = [6, 6]
material = "specimen"
TRANSFORM
"#;

const SUN: &str = r#"
[[lights]]
name = "sun"
kind = "directional"
direction = [-0.35, 0.45, -0.8]
color = [0.8, 0.6, 0.45]
"#;

const LAMP: &str = r#"
[[lights]]
name = "lamp"
kind = "point"
position = [0.7, 0.4, 0.9]
color = [0.5, 0.75, 0.65]
"#;

/// Where the lights are, and where they are for embossing and for shadows: low, so that a part of the sheet has them below it.
const HIGH_SUN: &str = "[-0.35, 0.45, -0.8]";
const LOW_SUN: &str = "[0.7, -0.5, -0.25]";
const HIGH_LAMP: &str = "[0.7, 0.4, 0.9]";
const LOW_LAMP: &str = "[-0.7, 0.3, 0.5]";

const RIGID: &str = r#"
translate = [0.06, -0.04, 0.1]
rotate = { axis = [0.3, 1.0, 0.2], angle_deg = 17.0 }
"#;

/// Mirrors, and scales along no two axes alike.
const GENERAL: &str = r#"
translate = [0.06, -0.04, 0.1]
rotate = { axis = [0.3, 1.0, 0.2], angle_deg = 17.0 }
scale = [-0.9, 1.2, 1.4]
"#;

/// The sheet, drawn with these features.
pub(super) fn draw(features: &FeatureSet) -> Result<Draw, String> {
    let scene = scene(features)?;
    let pinned = |material: usize| Technique::pinned(&scene.materials[material]);
    let settings = |material| pinned(material).map(Technique::settings).unwrap_or_default();
    let mut draw = bossage_scene::draws_with(&scene, |material| (*features, settings(material)))
        .pop()
        .ok_or("nothing is drawn")?;
    draw.mesh = Arc::new(bent(&draw.mesh, features.mirrored_uv));
    for texture in draw.textures.values_mut() {
        *texture = Arc::new(floats(texture));
    }
    if features.lights == Lights::Many {
        // A march toward each light takes its time: two of them say as much.
        let all_count = features.albedo == Albedo::Map && features.shadow == Shades::None;
        crowd(&mut draw, all_count);
    }
    Ok(draw)
}

/// Fills the places for lights beyond the scene's with lights that differ. They either do not count, or as many are counted as there is
/// no room for: then all places count, and no more.
fn crowd(draw: &mut Draw, all_count: bool) {
    let Some(items) = draw.uniforms.get_mut("lights.items") else {
        return;
    };
    for (number, light) in items.chunks_exact_mut(8).enumerate().skip(2) {
        let angle = 2.4 * number as f32;
        let toward = Vec3::new(angle.cos(), angle.sin(), 1.5).normalize();
        let bright = if all_count { 0.05 } else { 3.0 };
        let radiance = bright * Vec3::new(1.0, 0.7 + 0.3 * angle.sin(), 0.5);
        light.copy_from_slice(&[
            toward.x, toward.y, toward.z, 0.0, radiance.x, radiance.y, radiance.z, 0.0,
        ]);
    }
    if all_count {
        draw.uniforms
            .insert("lights.count".to_owned(), vec![40.0, 0.0, 0.0, 0.0]);
    }
}

fn scene(features: &FeatureSet) -> Result<Scene, String> {
    let lights = match features.lights {
        Lights::None => String::new(),
        Lights::Directional => SUN.to_owned(),
        Lights::Point => LAMP.to_owned(),
        Lights::Many => format!("{SUN}{LAMP}"),
    };
    let low = features.shading == Shading::Emboss || features.shadow != Shades::None;
    let lights = if low {
        lights.replace(HIGH_SUN, LOW_SUN).replace(HIGH_LAMP, LOW_LAMP)
    } else {
        lights
    };
    let transform = match features.transform {
        Transform::Rigid => RIGID,
        Transform::General => GENERAL,
    };
    let mut text = SCENE.replace("LIGHTS", &lights).replace("TRANSFORM", transform);
    if features.shading == Shading::WrapLambert {
        // More than 1, which an occlusion never is.
        text = text.replace("ambient = [0.13,", "ambient = [1.13,");
    }
    let mut scene = bossage_scene::load_str("specimen.toml", &text).map_err(|error| with_causes(&error))?;
    if features.environment {
        scene.environment = Some(Environment {
            paths: Vec::new(),
            map: Arc::new(CubeMap::from_fn(CUBE_SIDE, 1, surroundings)),
        });
    }
    let material = scene.materials.first_mut().ok_or("the scene has a material")?;
    furnish(material, features)?;
    Ok(scene)
}

/// Few steps: each may be undecided, and then both ways are gone.
fn search(relief: Relief) -> Option<Search> {
    match relief {
        Relief::ParallaxIterative => Some(Search::ParallaxIterative { iterations: 2 }),
        Relief::SteepParallax => Some(Search::SteepParallax { layers: 6 }),
        Relief::ParallaxOcclusion => Some(Search::ParallaxOcclusion { layers: 6 }),
        Relief::Relief => Some(Search::Relief {
            layers: 5,
            refinements: 2,
        }),
        Relief::ConeStep => Some(Search::ConeStep { steps: 4 }),
        Relief::RelaxedConeStep => Some(Search::RelaxedConeStep {
            steps: 3,
            refinements: 2,
        }),
        Relief::Exact => Some(Search::Exact),
        Relief::None
        | Relief::ParallaxOffset
        | Relief::ParallaxOffsetLimited
        | Relief::ParallaxSlopeAo
        | Relief::ParallaxSlopeAoDirected
        | Relief::Displacement => None,
    }
}

/// Gives the material all that its features read.
fn furnish(material: &mut Material, features: &FeatureSet) -> Result<(), String> {
    let wrap = features.shading == Shading::WrapLambert;
    material.albedo.map = Some(("waves".into(), Arc::new(colours())));
    material.normal = Some(NormalSource {
        path: "waves".into(),
        map: Arc::new(normals()),
        mips: NormalMips::default(),
    });
    material.height = Some(HeightSource {
        path: "waves".into(),
        field: Arc::new(heights()),
        elevation: Elevation {
            scale: DVec2::new(0.09, 0.12),
            bias: DVec2::new(-0.03, -0.04),
        },
    });
    material.alpha = match features.alpha {
        Alpha::Opaque => AlphaMode::Opaque,
        Alpha::Mask => AlphaMode::Mask {
            cutoff: if wrap { WRAP_CUTOFF } else { 0.4 },
        },
    };
    material.technique = match features.relief {
        Relief::None => TechniquePin::None,
        Relief::ParallaxOffset => TechniquePin::ParallaxOffset,
        Relief::ParallaxOffsetLimited => TechniquePin::ParallaxOffsetLimited,
        Relief::ParallaxSlopeAo => TechniquePin::ParallaxSlopeAo,
        Relief::ParallaxSlopeAoDirected => TechniquePin::ParallaxSlopeAoDirected,
        Relief::Displacement => TechniquePin::Displacement,
        Relief::ParallaxIterative => TechniquePin::ParallaxIterative,
        Relief::SteepParallax => TechniquePin::SteepParallax,
        Relief::ParallaxOcclusion => TechniquePin::ParallaxOcclusion,
        Relief::Relief => TechniquePin::Relief,
        Relief::ConeStep => TechniquePin::ConeStep,
        Relief::RelaxedConeStep => TechniquePin::RelaxedConeStep,
        Relief::Exact => TechniquePin::Exact,
    };
    material.search = search(features.relief);
    material.shadow = match features.shadow {
        Shades::None => Shadow::None,
        Shades::Hard => Shadow::Hard { samples: 4 },
        Shades::Soft => Shadow::Soft {
            samples: 3,
            half_width: 0.6,
        },
    };
    material.pixel_depth = features.pixel_depth;
    material.shading = features.shading;
    material.form = features.form;
    material.occlusion = 2.5;
    material.emboss_texels = 1.5;
    if features.normaliser == Normalises::Cube {
        let map =
            NormalisationCubeMap::generate(CUBE_SIDE, Depth::Sixteen).map_err(|error| with_causes(&error))?;
        material.normaliser = Normaliser::Cube(Arc::new(map));
    }
    Ok(())
}

/// A wave over a map of texels, in [−1, 1].
fn wave(x: u32, y: u32, along: DVec2, phase: f64) -> f64 {
    let place = DVec2::new(f64::from(x), f64::from(y)) / f64::from(MAP_SIDE);
    (TAU * (place.dot(along) + phase)).sin()
}

fn places() -> impl Iterator<Item = (u32, u32)> {
    (0..MAP_SIDE * MAP_SIDE).map(|at| (at % MAP_SIDE, at / MAP_SIDE))
}

/// Four different waves; alpha is 0 over some of the map, and crosses both cutoffs.
fn colours() -> ColorMap {
    let colour = |(x, y)| {
        let of = |u: f64, v: f64, phase: f64| wave(x, y, DVec2::new(u, v), phase);
        let shares = [
            150.0 + 60.0 * of(1.0, 1.0, 0.1),
            140.0 + 70.0 * of(1.0, -1.0, 0.3),
            160.0 + 50.0 * of(0.0, 2.0, 0.6),
            130.0 + 150.0 * of(1.0, 0.0, 0.2),
        ];
        shares.map(|share| share.clamp(0.0, 255.0) as u8)
    };
    ColorMap {
        width: MAP_SIDE,
        height: MAP_SIDE,
        texels: places().map(colour).collect(),
    }
}

fn normals() -> NormalMap {
    let normal = |(x, y)| {
        let along = |u: f64, v: f64, phase: f64| wave(x, y, DVec2::new(u, v), phase);
        let slope = DVec2::new(along(1.0, 1.0, 0.0), along(-1.0, 1.0, 0.4));
        let n = slope.extend(1.8).normalize().as_vec3();
        let [r, g, b] = n.to_array().map(|c| NormalCodec::Unorm.encode(c));
        [r, g, b, 255]
    };
    NormalMap {
        width: MAP_SIDE,
        height: MAP_SIDE,
        codec: NormalCodec::Unorm,
        texels: places().map(normal).collect(),
    }
}

fn heights() -> HeightField {
    HeightField::from_fn(MAP_SIDE, HEIGHT_ROWS, |x, y| {
        // Whole waves along either side.
        let y = y * MAP_SIDE / HEIGHT_ROWS;
        let waves =
            0.25 * wave(x, y, DVec2::new(1.0, 0.0), 0.15) + 0.2 * wave(x, y, DVec2::new(1.0, 1.0), 0.55);
        (0.5 + waves) as f32
    })
}

fn surroundings(direction: DVec3) -> DVec3 {
    0.5 + 0.4 * DVec3::new(direction.y, direction.z, direction.x)
}

/// The sheet bent: heights, normals and tangents differ from vertex to vertex; where the texture is mirrored somewhere, it is in one half.
fn bent(mesh: &Mesh, mirrored: bool) -> Mesh {
    let mut bent = mesh.clone();
    for (at, position) in mesh.positions.iter().enumerate() {
        let (x, y) = (f64::from(position.x), f64::from(position.y));
        let lift = 0.12 * (1.7 * x + 0.4).sin() + 0.1 * (2.1 * y - 0.3).cos();
        let slope = DVec2::new(0.204 * (1.7 * x + 0.4).cos(), -0.21 * (2.1 * y - 0.3).sin());
        let normal = DVec3::new(-slope.x, -slope.y, 1.0).normalize();
        // Nearly along +x on the sheet, and nearly at right angles to the normal, as interpolated tangents are.
        let tangent = DVec3::new(1.0, 0.2, slope.x - 0.15).normalize();
        let handedness = if mirrored && position.x < 0.0 { -1.0 } else { 1.0 };
        bent.positions[at] = Vec3::new(position.x, position.y, lift as f32);
        bent.normals[at] = normal.as_vec3();
        bent.tangents[at] = tangent.extend(handedness).as_vec4();
    }
    bent
}

/// The first level, bytes as the floats that they stand for.
pub(super) fn floats(texture: &Texture) -> Texture {
    let first = texture.levels.first().map(|level| Level {
        texels: match &level.texels {
            Texels::Rgba8Unorm(bytes) => {
                let one = |texel: &[u8; 4]| texel.map(|byte| f32::from(byte) / 255.0);
                Texels::Rgba32Float(bytes.iter().map(one).collect())
            }
            other => other.clone(),
        },
        ..*level
    });
    Texture {
        shape: texture.shape,
        levels: first.into_iter().collect(),
    }
}

/// The sheet in one colour whose alpha is the cutoff itself, or the next float below it.
pub(super) fn at_cutoff(features: &FeatureSet, below: bool) -> Result<Draw, String> {
    let mut draw = draw(features)?;
    let cutoff = draw
        .uniforms
        .get("material.alpha_cutoff")
        .and_then(|values| values.first());
    let cutoff = *cutoff.ok_or("the draw has a cutoff")?;
    let alpha = if below { cutoff.next_down() } else { cutoff };
    draw.uniforms.insert(
        "material.albedo".to_owned(),
        DVec4::new(0.9, 0.65, 0.8, 1.0).as_vec4().to_array().to_vec(),
    );
    let texture = Texture::constant([0.5, 0.25, 0.75, alpha]);
    draw.textures.insert("albedo_map".to_owned(), Arc::new(texture));
    Ok(draw)
}

/// The sheet's frame along the world's axes everywhere, and a light that lies exactly in its plane.
pub(super) fn at_horizon(features: &FeatureSet) -> Result<Draw, String> {
    let mut draw = draw(features)?;
    let mut mesh = Mesh::clone(&draw.mesh);
    mesh.normals.fill(Vec3::Z);
    mesh.tangents.fill(Vec3::X.extend(1.0));
    draw.mesh = Arc::new(mesh);
    let numbers = [
        ("object.world_from_local", Mat4::IDENTITY.to_cols_array().to_vec()),
        ("light.vector", vec![1.0, 0.0, 0.0, 0.0]),
    ];
    let named = numbers.map(|(name, values)| (name.to_owned(), values));
    draw.uniforms.extend(named);
    Ok(draw)
}

#[cfg(test)]
mod tests {
    use glam::DMat4;

    use super::super::truth::uniform;
    use super::*;

    #[test]
    fn the_maps_are_smooth_and_alpha_crosses_the_cutoffs() {
        let map = colours();
        let alphas: Vec<u8> = map.texels.iter().map(|texel| texel[3]).collect();
        assert!(alphas.contains(&0) && alphas.iter().any(|alpha| *alpha > 102 && *alpha < 255));
        let heights = heights();
        let step = |x: u32, y: u32| (heights.texel((x + 1) % MAP_SIDE, y) - heights.texel(x, y)).abs();
        assert!(places().all(|(x, y)| step(x, y.min(HEIGHT_ROWS - 1)) < 0.06));
    }

    #[test]
    fn embossing_has_its_light_above_and_below() {
        for lights in [Lights::Directional, Lights::Point] {
            let features = FeatureSet {
                lights,
                shading: Shading::Emboss,
                ..FeatureSet::default()
            };
            let draw = draw(&features).unwrap();
            let vector = DVec3::from_slice(&uniform::<4>(&draw, "light.vector").map(f64::from));
            let matrix =
                DMat4::from_cols_array(&uniform::<16>(&draw, "object.world_from_local").map(f64::from));
            let height = |(place, normal): (&Vec3, &Vec3)| {
                let place = matrix.transform_point3(place.as_dvec3());
                let toward = if lights == Lights::Point {
                    vector - place
                } else {
                    vector
                };
                matrix.transform_vector3(normal.as_dvec3()).dot(toward)
            };
            let heights: Vec<f64> = draw
                .mesh
                .positions
                .iter()
                .zip(&draw.mesh.normals)
                .map(height)
                .collect();
            assert!(
                heights.iter().any(|h| *h > 0.05) && heights.iter().any(|h| *h < -0.05),
                "{heights:?}"
            );
        }
    }

    #[test]
    fn the_sheet_has_unit_frames_that_differ() {
        let draw = draw(&FeatureSet::default()).unwrap();
        let mesh = &draw.mesh;
        assert_eq!(mesh.positions.len(), 7 * 7);
        for (normal, tangent) in mesh.normals.iter().zip(&mesh.tangents) {
            let along = tangent.truncate();
            assert!((normal.length() - 1.0).abs() < 1e-6 && (along.length() - 1.0).abs() < 1e-6);
            assert!(along.dot(*normal).abs() < 0.25);
        }
        assert!(mesh.normals[0] != mesh.normals[1]);
    }
}
