//! A planned scene → a picture in linear light, on an adapter.
//!
//! Where every object is shaded by `dot3`, in one pass or in two, the target keeps bytes, as that of the technique's article did: the
//! picture is what texture combiners and a blending unit leave. Everything else is drawn in floats.
//!
//! The shaders are the planned permutations, bound by the manifest alone: names of uniforms, textures and vertex attributes
//! are those that `emit` states for engines.

use std::collections::BTreeMap;
use std::sync::Arc;

use bossage_assets::EdgeMode;
use bossage_runner::{
    AddressMode, Blend, Clear, Code, Cull, Depth, Draw, Machine, Mesh, RenderJob, RenderTarget, Resources,
    SamplerSettings, Shader as Stage, TexelFormat, TextureData, TextureDimension,
};
use bossage_scene::{Pass, Plan, Scene, Texels, Texture, TextureShape};
use bossage_shaders::{Library, Stage as Part};
use bossage_translate::manifest::Entry;
use rayon::prelude::*;

use crate::error::{Error, Result};
use crate::inputs;
use crate::picture::Linear;

/// What is seen where nothing is: a dark grey, so that black surfaces stand out.
const BACKGROUND: [f32; 4] = [0.01, 0.01, 0.01, 1.0];

/// The vertex stage's inputs by the names of the surface interface, and the one sampler.
const SAMPLER: &str = "surface_sampler";

/// Draws a scene as planned, in the camera's size.
pub(crate) fn draw(machine: &dyn Machine, scene: &Scene, plan: &Plan, library: &Library) -> Result<Linear> {
    let modules = modules(plan, library)?;
    let draws = bossage_scene::draws(scene, plan);
    let meshes: Vec<Mesh> = draws.iter().map(|draw| mesh(&draw.mesh)).collect();
    let textures = upload(&draws);
    let job = RenderJob {
        name: "picture",
        width: scene.camera.size[0],
        height: scene.camera.size[1],
        targets: vec![target(&draws)],
        read_depth: false,
        passes: vec![
            draws
                .iter()
                .zip(&meshes)
                .map(|(draw, mesh)| all_of(draw, mesh, &modules, &textures))
                .collect::<Result<Vec<_>>>()?
                .concat(),
        ],
    };
    let output = job.run(machine)?;
    let target = output.targets.into_iter().next().unwrap_or_default();
    let pixels = target.pixels.iter().map(|[r, g, b, _]| [*r, *g, *b]).collect();
    Ok(Linear {
        width: target.width,
        height: target.height,
        pixels,
    })
}

/// A module of the plan with its one entry point.
struct Module {
    wgsl: String,
    entry: Entry,
}

fn modules(plan: &Plan, library: &Library) -> Result<BTreeMap<String, Module>> {
    let assembled = inputs::assemble(library, plan)?;
    assembled
        .into_par_iter()
        .map(|assembled| {
            let entry = inputs::entry(&assembled)?;
            Ok((
                assembled.name,
                Module {
                    wgsl: assembled.wgsl,
                    entry,
                },
            ))
        })
        .collect()
}

/// Bytes where every object is shaded by `dot3`, floats otherwise.
fn target(draws: &[bossage_scene::Draw]) -> RenderTarget {
    if !draws.is_empty() && draws.iter().all(|draw| draw.features.shading.is_dot3()) {
        return RenderTarget::bytes(BACKGROUND);
    }
    RenderTarget::floats(Clear::Colour(BACKGROUND))
}

/// An object, as often as it is drawn.
fn all_of<'a>(
    draw: &bossage_scene::Draw,
    mesh: &'a Mesh,
    modules: &'a BTreeMap<String, Module>,
    textures: &'a Uploaded,
) -> Result<Vec<Draw<'a>>> {
    let stage = |part: Part| -> Result<Stage<'a>> {
        let name = draw.features.module_name(part);
        let module = modules
            .get(&name)
            .ok_or_else(|| Error::Call(format!("the plan has no module {name}")))?;
        Ok(Stage {
            code: Code::Wgsl(&module.wgsl),
            entry: &module.entry,
        })
    };
    let vertex = stage(Part::Vertex)?;
    let one = |pass: Pass| -> Result<Draw<'a>> {
        let fragment = stage(pass.fragment)?;
        let (blend, depth) = match pass.multiplies {
            true => (Blend::Multiply, Depth::Equal),
            false => (Blend::Replace, Depth::TestAndWrite),
        };
        Ok(Draw {
            vertex,
            fragment,
            mesh,
            resources: resources(draw, &[&vertex, &fragment], textures),
            cull: Cull::None,
            blend,
            depth,
        })
    };
    draw.passes().into_iter().map(one).collect()
}

/// What these stages bind, by the names of the draw.
fn resources<'a>(draw: &bossage_scene::Draw, stages: &[&Stage<'_>], textures: &'a Uploaded) -> Resources<'a> {
    let bound = |name: &str| stages.iter().any(|stage| stage.binding(name).is_some());
    let named = draw.textures.iter().filter(|(name, _)| bound(name));
    let sampler = SamplerSettings {
        address: address(draw.edge),
        ..SamplerSettings::default()
    };
    Resources {
        uniforms: draw.uniforms.clone(),
        textures: named
            .map(|(name, texture)| (name.clone(), &textures[&key(texture)]))
            .collect(),
        samplers: bound(SAMPLER)
            .then(|| (SAMPLER.to_owned(), sampler))
            .into_iter()
            .collect(),
        ..Resources::default()
    }
}

fn mesh(mesh: &bossage_assets::Mesh) -> Mesh {
    let vectors = |vectors: &[glam::Vec3]| vectors.iter().map(|v| v.to_array()).collect::<Vec<_>>();
    let uvs: Vec<[f32; 2]> = mesh.uvs.iter().map(|v| v.to_array()).collect();
    let tangents: Vec<[f32; 4]> = mesh.tangents.iter().map(|v| v.to_array()).collect();
    Mesh::new(mesh.indices.clone())
        .with("position", &vectors(&mesh.positions))
        .with("normal", &vectors(&mesh.normals))
        .with("uv", &uvs)
        .with("tangent", &tangents)
}

/// Textures by identity: objects that share a material share its textures.
type Uploaded = BTreeMap<usize, TextureData>;

fn key(texture: &Arc<Texture>) -> usize {
    Arc::as_ptr(texture).addr()
}

fn upload(draws: &[bossage_scene::Draw]) -> Uploaded {
    let all: BTreeMap<usize, &Arc<Texture>> = draws
        .iter()
        .flat_map(|draw| draw.textures.values())
        .map(|texture| (key(texture), texture))
        .collect();
    all.into_iter()
        .map(|(key, texture)| (key, data(texture)))
        .collect()
}

fn data(texture: &Texture) -> TextureData {
    let first = texture.levels.first();
    TextureData {
        width: first.map_or(0, |level| level.width),
        height: first.map_or(0, |level| level.height),
        format: first.map_or(TexelFormat::Rgba8Unorm, |level| format(&level.texels)),
        dimension: match texture.shape {
            TextureShape::Plane => TextureDimension::Plane,
            TextureShape::Cube => TextureDimension::Cube,
        },
        levels: texture.levels.iter().map(|level| bytes(&level.texels)).collect(),
    }
}

const fn format(texels: &Texels) -> TexelFormat {
    match texels {
        Texels::Rgba8Unorm(_) => TexelFormat::Rgba8Unorm,
        Texels::Rgba16Unorm(_) => TexelFormat::Rgba16Unorm,
        Texels::Rgba32Float(_) => TexelFormat::Rgba32Float,
        Texels::R32Float(_) => TexelFormat::R32Float,
    }
}

fn bytes(texels: &Texels) -> Vec<u8> {
    match texels {
        Texels::Rgba8Unorm(texels) => texels.as_flattened().to_vec(),
        Texels::Rgba16Unorm(texels) => texels
            .as_flattened()
            .iter()
            .flat_map(|value| value.to_ne_bytes())
            .collect(),
        Texels::Rgba32Float(texels) => texels
            .as_flattened()
            .iter()
            .flat_map(|value| value.to_ne_bytes())
            .collect(),
        Texels::R32Float(texels) => texels.iter().flat_map(|value| value.to_ne_bytes()).collect(),
    }
}

const fn address(edge: EdgeMode) -> AddressMode {
    match edge {
        EdgeMode::Wrap => AddressMode::Wrap,
        EdgeMode::Mirror => AddressMode::Mirror,
        EdgeMode::Clamp => AddressMode::Clamp,
    }
}
