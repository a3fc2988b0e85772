//! Flat surfaces to draw: a mesh of one rectangle, shaders that give one colour, and jobs of eight pixels squared.

use bossage_runner::{Blend, Clear, Cull, Depth, Draw, Mesh, RenderJob, RenderTarget, Resources, Shader};

use crate::support::Compiled;

pub(crate) const SURFACE: &str = "
struct Varyings { @builtin(position) clip: vec4f, @location(0) uv: vec2f }
@vertex fn vertex(@location(0) position: vec3f, @location(2) uv: vec2f) -> Varyings {
    return Varyings(vec4f(position, 1.0), uv);
}
struct Targets { @location(0) colour: vec4f, @location(2) uv: vec4f }
@group(0) @binding(0) var<uniform> colour: vec4f;
@fragment fn fragment(in: Varyings) -> Targets { return Targets(colour, vec4f(in.uv, 0.0, 1.0)); }
@fragment fn holes(in: Varyings) -> @location(0) vec4f {
    if (u32(in.clip.x) + u32(in.clip.y)) % 2u == 0u { discard; }
    return colour;
}
@group(1) @binding(0) var picture: texture_2d<f32>;
@group(1) @binding(1) var picture_sampler: sampler;
@fragment fn textured(in: Varyings) -> @location(0) vec4f { return textureSample(picture, picture_sampler, in.uv); }
";

pub(crate) const SIZE: u32 = 8;

/// A rectangle at depth z, with uv = (0, 0) at its top left and (1, 1) at its bottom right, counter-clockwise.
pub(crate) fn rectangle([left, bottom, right, top]: [f32; 4], z: f32) -> Mesh {
    let positions = [
        [left, bottom, z],
        [right, bottom, z],
        [right, top, z],
        [left, top, z],
    ];
    Mesh::new(vec![0, 1, 2, 0, 2, 3])
        .with("position", &positions)
        .with("uv", &[[0.0, 1.0], [1.0, 1.0], [1.0, 0.0], [0.0, 0.0]])
}

pub(crate) const WHOLE: [f32; 4] = [-1.0, -1.0, 1.0, 1.0];

pub(crate) fn draw<'a>(
    vertex: Shader<'a>,
    fragment: Shader<'a>,
    mesh: &'a Mesh,
    colour: [f32; 4],
) -> Draw<'a> {
    let mut resources = Resources::default();
    resources.uniforms.insert("colour".into(), colour.to_vec());
    let (cull, blend, depth) = (Cull::None, Blend::Replace, Depth::TestAndWrite);
    Draw {
        vertex,
        fragment,
        mesh,
        resources,
        cull,
        blend,
        depth,
    }
}

pub(crate) fn plain<'a>(surface: &'a Compiled, mesh: &'a Mesh, colour: [f32; 4]) -> Draw<'a> {
    draw(surface.wgsl("vertex"), surface.wgsl("fragment"), mesh, colour)
}

pub(crate) fn job(draws: Vec<Draw<'_>>) -> RenderJob<'_> {
    RenderJob {
        name: "picture",
        width: SIZE,
        height: SIZE,
        targets: vec![RenderTarget::floats(Clear::Sentinel); 3],
        read_depth: true,
        passes: vec![draws],
    }
}
