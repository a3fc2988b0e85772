//! The `spirv` route draws what the `wgsl` route draws, bit for bit, and a difference would be seen.
//!
//! Both are naga's translation of one text, for the same driver; they differ in bounds checks, which don't touch values
//! in range, and in the way to the driver. No tolerance is needed.

use bossage_runner::{
    Blend, Clear, Cull, Depth, Device, Draw, Error, Mesh, RenderJob, RenderOutput, RenderTarget, Resources,
    SamplerSettings, Shader, TextureData,
};
use bossage_translate::EmitOptions;

use crate::support::{bits, compile, compile_with, device};

/// Everything that could tell up from down or front from back: derivatives, facing, the fragment's position, a picture
/// without symmetry; and bindings with gaps.
const SURFACE: &str = "
struct Object { clip_from_local: mat4x4f, tint: vec4f }
@group(1) @binding(2) var<uniform> object: Object;
struct Varyings { @builtin(position) clip: vec4f, @location(0) uv: vec2f, @location(1) normal: vec3f }
@vertex fn vertex(@location(0) position: vec3f, @location(1) normal: vec3f, @location(2) uv: vec2f) -> Varyings {
    return Varyings(object.clip_from_local * vec4f(position, 1.0), uv, normal);
}
@group(2) @binding(1) var picture: texture_2d<f32>;
@group(2) @binding(4) var picture_sampler: sampler;
struct Targets { @location(0) colour: vec4f, @location(1) where_: vec4f }
@fragment fn fragment(in: Varyings, @builtin(front_facing) front: bool) -> Targets {
    let along = dpdx(in.uv);
    let down = dpdy(in.uv);
    let colour = textureSampleGrad(picture, picture_sampler, in.uv, along, down);
    let lit = normalize(in.normal).z * object.tint * colour;
    return Targets(select(-lit, lit, front), vec4f(in.clip.xy, along.x, down.y));
}";

fn mesh() -> Mesh {
    let positions = [
        [-0.9, -0.7, 0.1],
        [0.8, -0.4, 0.3],
        [0.2, 0.95, 0.6],
        [-0.9, 0.9, 0.9],
    ];
    let normals = [
        [0.1, 0.2, 0.9],
        [0.5, -0.2, 0.7],
        [-0.3, 0.3, 0.8],
        [0.0, 0.0, 1.0],
    ];
    // The second triangle is turned over.
    Mesh::new(vec![0, 1, 2, 0, 3, 2])
        .with("position", &positions)
        .with("normal", &normals)
        .with("uv", &[[0.0, 0.0], [1.7, 0.1], [0.9, 1.3], [-0.4, 0.8]])
}

/// A perspective matrix, column by column: w = 1.5 + z / 2.
const CLIP_FROM_LOCAL: [f32; 16] = [
    1.2, 0.1, 0.0, 0.0, -0.2, 1.1, 0.0, 0.0, 0.1, 0.0, 0.5, 0.5, 0.05, -0.1, 0.25, 1.5,
];

fn picture() -> TextureData {
    let texel = |index: u8| {
        [
            index.wrapping_mul(37),
            index.wrapping_mul(91),
            index.wrapping_mul(53),
            255,
        ]
    };
    let large: Vec<[u8; 4]> = (0..64).map(texel).collect();
    let small: Vec<[u8; 4]> = (64..80).map(texel).collect();
    TextureData::rgba8(8, 8, &large).with_level(&small)
}

fn try_render(
    device: &Device,
    vertex: Shader<'_>,
    fragment: Shader<'_>,
    cull: Cull,
) -> Result<RenderOutput, Error> {
    let (mesh, picture) = (mesh(), picture());
    let mut resources = Resources::default();
    resources
        .uniforms
        .insert("object.clip_from_local".into(), CLIP_FROM_LOCAL.to_vec());
    resources
        .uniforms
        .insert("object.tint".into(), vec![1.0, 0.5, 0.25, 1.0]);
    resources.textures.insert("picture".into(), &picture);
    resources
        .samplers
        .insert("picture_sampler".into(), SamplerSettings::default());
    let (blend, depth) = (Blend::Replace, Depth::TestAndWrite);
    let draw = Draw {
        vertex,
        fragment,
        mesh: &mesh,
        resources,
        cull,
        blend,
        depth,
    };
    let targets = vec![RenderTarget::floats(Clear::Sentinel); 2];
    let job = RenderJob {
        name: "route",
        width: 50,
        height: 30,
        targets,
        read_depth: true,
        passes: vec![vec![draw]],
    };
    job.run(device)
}

fn render(device: &Device, vertex: Shader<'_>, fragment: Shader<'_>, cull: Cull) -> RenderOutput {
    try_render(device, vertex, fragment, cull).expect("a picture")
}

fn target_bits(output: &RenderOutput, target: usize) -> Vec<u32> {
    bits(output.targets[target].pixels.as_flattened())
}

fn assert_same(first: &RenderOutput, second: &RenderOutput, what: &str) {
    for target in 0..2 {
        assert!(
            target_bits(first, target) == target_bits(second, target),
            "{what}: target {target} differs"
        );
    }
    let depth = |output: &RenderOutput| bits(output.depth.as_deref().unwrap_or_default());
    assert_eq!(depth(first), depth(second), "{what}: depth");
}

fn covered(output: &RenderOutput) -> usize {
    output.targets[0]
        .covered()
        .iter()
        .filter(|covered| **covered)
        .count()
}

#[test]
fn passed_through_spirv_draws_the_same_picture() {
    let Some(device) = device("passed_through_spirv_draws_the_same_picture") else {
        return;
    };
    let surface = compile(SURFACE);
    for cull in [Cull::None, Cull::Back, Cull::Front] {
        let wgsl = render(device, surface.wgsl("vertex"), surface.wgsl("fragment"), cull);
        let covered = covered(&wgsl);
        assert!(
            (100..1400).contains(&covered),
            "the picture shows something: {covered} pixels"
        );
        let spirv = render(device, surface.spirv("vertex"), surface.spirv("fragment"), cull);
        assert_same(&wgsl, &spirv, &format!("{cull:?}"));
    }
}

#[test]
fn a_flipped_picture_would_be_seen() {
    let Some(device) = device("a_flipped_picture_would_be_seen") else {
        return;
    };
    let surface = compile(SURFACE);
    let flipped = compile_with(
        SURFACE,
        &EmitOptions {
            adjust_clip_space: true,
            ..EmitOptions::default()
        },
    );
    let wgsl = render(
        device,
        surface.wgsl("vertex"),
        surface.wgsl("fragment"),
        Cull::None,
    );
    let other = render(
        device,
        flipped.spirv("vertex"),
        flipped.spirv("fragment"),
        Cull::None,
    );
    assert_ne!(wgsl.targets[0].covered(), other.targets[0].covered());
}

#[test]
fn stages_from_separate_modules_share_their_bindings() {
    let Some(device) = device("stages_from_separate_modules_share_their_bindings") else {
        return;
    };
    let whole = compile(SURFACE);
    let (vertex, fragment) = SURFACE.split_once("@group(2)").expect("the fragment part");
    let shared = vertex.split_once("@vertex").expect("the vertex stage").0;
    let (vertex, fragment) = (compile(vertex), compile(&format!("{shared}@group(2){fragment}")));
    let expected = render(device, whole.wgsl("vertex"), whole.wgsl("fragment"), Cull::None);
    let wgsl = render(
        device,
        vertex.wgsl("vertex"),
        fragment.wgsl("fragment"),
        Cull::None,
    );
    let spirv = render(
        device,
        vertex.spirv("vertex"),
        fragment.spirv("fragment"),
        Cull::None,
    );
    assert_same(&expected, &wgsl, "separate WGSL modules");
    assert_same(&expected, &spirv, "separate SPIR-V modules");
}

#[test]
fn stages_that_take_different_routes_are_refused() {
    let Some(device) = device("stages_that_take_different_routes_are_refused") else {
        return;
    };
    let surface = compile(SURFACE);
    for (vertex, fragment) in [
        (surface.wgsl("vertex"), surface.spirv("fragment")),
        (surface.spirv("vertex"), surface.wgsl("fragment")),
    ] {
        let error = try_render(device, vertex, fragment, Cull::None).unwrap_err();
        assert!(matches!(error, Error::MixedRoutes { .. }), "{error}");
    }
}
