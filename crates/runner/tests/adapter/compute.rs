//! Compute: round trips, sentinels, splitting, and everything that can be bound.
//!
//! Arithmetic in these shaders is exact (integers, powers of two), so results are compared bit for bit.

use std::collections::BTreeMap;

use bossage_runner::{
    BufferData, ComputeJob, Filter, Machine, ProbeJob, Resources, SamplerSettings, Shader, TexelFormat,
    TextureData, TextureDimension, run_probe, slot, unwritten,
};

use crate::support::{bits, compile, device};

pub(crate) const DOUBLE: &str = "
@group(0) @binding(0) var<storage, read> inputs: array<f32>;
@group(0) @binding(1) var<storage, read_write> outputs: array<f32>;
@compute @workgroup_size(64) fn double(@builtin(global_invocation_id) id: vec3u) {
    if id.x < arrayLength(&outputs) { outputs[id.x] = 2.0 * inputs[id.x]; }
}";

pub(crate) fn ramp(count: usize) -> Vec<f32> {
    (0..count).map(|index| index as f32 - 300.0).collect()
}

pub(crate) fn probe<'a>(shader: Shader<'a>, inputs: &'a [f32], chunk_items: Option<usize>) -> ProbeJob<'a> {
    ProbeJob {
        name: "probe",
        shader,
        inputs,
        items: inputs.len(),
        output_floats: 1,
        uniforms: BTreeMap::new(),
        textures: BTreeMap::new(),
        chunk_items,
    }
}

#[test]
fn every_item_comes_back_doubled_on_both_routes() {
    let Some(device) = device("every_item_comes_back_doubled_on_both_routes") else {
        return;
    };
    let double = compile(DOUBLE);
    // No multiple of the workgroup's 64, so that the last group is partly out of range.
    let inputs = ramp(10_001);
    let expected: Vec<f32> = inputs.iter().map(|value| value * 2.0).collect();
    for shader in double.both("double") {
        let outputs = run_probe(device, shader.code, shader.entry, &inputs, 1, inputs.len()).unwrap();
        assert_eq!(outputs, expected, "{}", shader.code.route());
    }
}

#[test]
fn outputs_that_nothing_wrote_hold_the_sentinel() {
    let Some(device) = device("outputs_that_nothing_wrote_hold_the_sentinel") else {
        return;
    };
    let odd_left_out = compile(&DOUBLE.replace("if id.x <", "if id.x % 2u == 0u && id.x <"));
    let inputs = ramp(130);
    for shader in odd_left_out.both("double") {
        let outputs = probe(shader, &inputs, None).run(device).unwrap();
        let odd: Vec<usize> = (1..130).step_by(2).collect();
        assert_eq!(unwritten(&outputs), odd, "{}", shader.code.route());
    }
}

#[test]
fn pieces_give_what_the_whole_gives() {
    let Some(device) = device("pieces_give_what_the_whole_gives") else {
        return;
    };
    let double = compile(DOUBLE);
    let inputs = ramp(1000);
    let whole = probe(double.wgsl("double"), &inputs, None).run(device).unwrap();
    for chunk in [1, 64, 333, 999, 1000, 5000] {
        let pieces = probe(double.wgsl("double"), &inputs[..], Some(chunk))
            .run(device)
            .unwrap();
        assert_eq!(bits(&pieces), bits(&whole), "pieces of {chunk}");
    }
}

#[test]
fn more_items_than_a_dispatch_takes_are_split() {
    let Some(device) = device("more_items_than_a_dispatch_takes_are_split") else {
        return;
    };
    let one_a_group = compile(&DOUBLE.replace("@workgroup_size(64)", "@workgroup_size(1)"));
    let items = device.dispatch_limits().workgroups as usize + 77;
    // Exact: all integers here are below 2^24.
    let inputs: Vec<f32> = (0..items).map(|index| (index % 9973) as f32).collect();
    let outputs = probe(one_a_group.wgsl("double"), &inputs, None)
        .run(device)
        .unwrap();
    assert!(
        outputs
            .iter()
            .zip(&inputs)
            .all(|(output, input)| *output == 2.0 * input)
    );
    assert_eq!(outputs.len(), items);
}

#[test]
fn no_items_need_no_dispatch() {
    let Some(device) = device("no_items_need_no_dispatch") else {
        return;
    };
    let double = compile(DOUBLE);
    assert!(
        probe(double.wgsl("double"), &[], None)
            .run(device)
            .unwrap()
            .is_empty()
    );
}

/// Gaps between bindings and between groups, and a buffer that the shader reads and writes.
const GAPS: &str = "
@group(0) @binding(3) var<storage, read> addend: array<f32>;
@group(0) @binding(7) var<storage, read_write> sum: array<f32>;
@group(2) @binding(1) var<uniform> factor: f32;
@compute @workgroup_size(1) fn accumulate(@builtin(global_invocation_id) id: vec3u) {
    sum[id.x] = sum[id.x] + factor * addend[id.x];
}";

#[test]
fn gaps_in_numbering_are_the_same_on_both_routes() {
    let Some(device) = device("gaps_in_numbering_are_the_same_on_both_routes") else {
        return;
    };
    let gaps = compile(GAPS);
    let (addend, sum) = ([1.0_f32, 2.0, 3.0], [10.0_f32, 20.0, 30.0]);
    for shader in gaps.both("accumulate") {
        let mut resources = Resources::default();
        resources
            .buffers
            .insert("addend".into(), BufferData::Bytes(bytemuck::bytes_of(&addend)));
        // One by its name, one by its place.
        resources
            .buffers
            .insert(slot(0, 7), BufferData::Bytes(bytemuck::bytes_of(&sum)));
        resources.uniforms.insert("factor".into(), vec![4.0]);
        let job = ComputeJob {
            name: "gaps",
            shader,
            resources,
            workgroups: [3, 1, 1],
        };
        let output = job.run(device).unwrap();
        assert_eq!(
            output.floats("sum"),
            [14.0, 28.0, 42.0],
            "{}",
            shader.code.route()
        );
        assert_eq!(output.buffers.len(), 1, "what is only read is not read back");
    }
}

const UNIFORMS: &str = "
struct Light { vector: vec4f, radiance: vec3f }
struct Scene { count: vec4u, offset: vec3f, scale: f32, turn: mat4x4f, bend: mat3x2f, lights: array<Light, 2>, signed: i32 }
@group(0) @binding(0) var<uniform> scene: Scene;
@group(0) @binding(1) var<storage, read_write> outputs: array<f32>;
@compute @workgroup_size(1) fn unpack() {
    for (var i = 0u; i < 4u; i++) { outputs[i] = f32(scene.count[i]); }
    for (var i = 0u; i < 3u; i++) { outputs[4u + i] = scene.offset[i]; }
    outputs[7] = scene.scale;
    for (var i = 0u; i < 16u; i++) { outputs[8u + i] = scene.turn[i / 4u][i % 4u]; }
    for (var i = 0u; i < 6u; i++) { outputs[24u + i] = scene.bend[i / 2u][i % 2u]; }
    for (var l = 0u; l < 2u; l++) {
        for (var i = 0u; i < 4u; i++) { outputs[30u + 7u * l + i] = scene.lights[l].vector[i]; }
        for (var i = 0u; i < 3u; i++) { outputs[34u + 7u * l + i] = scene.lights[l].radiance[i]; }
    }
    outputs[44] = f32(scene.signed);
}";

#[test]
fn uniforms_arrive_where_the_shader_reads_them() {
    let Some(device) = device("uniforms_arrive_where_the_shader_reads_them") else {
        return;
    };
    let unpack = compile(UNIFORMS);
    let numbers: Vec<f32> = (0..44).map(|index| index as f32 + 1.0).chain([-5.0]).collect();
    let members = [
        ("scene.count", 0..4),
        ("scene.offset", 4..7),
        ("scene.scale", 7..8),
        ("scene.turn", 8..24),
        ("scene.bend", 24..30),
        ("scene.lights[0].vector", 30..34),
        ("scene.lights[0].radiance", 34..37),
        ("scene.lights[1]", 37..44),
        ("scene.signed", 44..45),
    ];
    // naga's GLSL has the strides of std140, which WGSL's are not for matrices of two rows: a lint names them.
    let shaders = unpack.both("unpack");
    for shader in shaders.into_iter().filter(|shader| shader.code.route() != "glsl") {
        let mut resources = Resources::default();
        for (name, range) in members.clone() {
            resources
                .uniforms
                .insert(name.to_owned(), numbers[range].to_vec());
        }
        resources
            .buffers
            .insert("outputs".into(), BufferData::Output(45 * 4));
        let job = ComputeJob {
            name: "unpack",
            shader,
            resources,
            workgroups: [1, 1, 1],
        };
        assert_eq!(
            job.run(device).unwrap().floats("outputs"),
            numbers,
            "{}",
            shader.code.route()
        );
    }
}

const TEXTURES: &str = "
@group(0) @binding(0) var height_map: texture_2d<f32>;
@group(0) @binding(1) var albedo_map: texture_2d<f32>;
@group(0) @binding(2) var sky: texture_cube<f32>;
@group(0) @binding(3) var surface_sampler: sampler;
@group(0) @binding(4) var<storage, read_write> outputs: array<f32>;
@compute @workgroup_size(1) fn look() {
    outputs[0] = textureLoad(height_map, vec2u(1, 0), 0).r;
    outputs[1] = textureLoad(height_map, vec2u(0, 0), 1).r;
    outputs[2] = f32(textureNumLevels(height_map));
    outputs[3] = textureLoad(albedo_map, vec2u(0, 1), 0).g;
    outputs[4] = textureSampleLevel(height_map, surface_sampler, vec2f(1.0, 0.5), 0.0).r;
    let sides = array<vec3f, 6>(vec3f(1, 0, 0), vec3f(-1, 0, 0), vec3f(0, 1, 0), vec3f(0, -1, 0), vec3f(0, 0, 1), vec3f(0, 0, -1));
    for (var i = 0u; i < 6u; i++) { outputs[5u + i] = textureSampleLevel(sky, surface_sampler, sides[i], 0.0).r; }
}";

#[test]
fn textures_mips_cubes_and_samplers_are_bound() {
    let Some(device) = device("textures_mips_cubes_and_samplers_are_bound") else {
        return;
    };
    let look = compile(TEXTURES);
    let height = TextureData::r32f(2, 2, &[0.5, 8.0, 2.0, 16.0]).with_level(&[32.0_f32]);
    let albedo = TextureData::rgba8(1, 2, &[[0, 0, 0, 0], [9, 255, 9, 9]]);
    let faces: Vec<f32> = (1..=6).map(|face| face as f32).collect();
    let sky = TextureData {
        width: 1,
        height: 1,
        format: TexelFormat::R32Float,
        dimension: TextureDimension::Cube,
        levels: vec![bytemuck::cast_slice(&faces).to_vec()],
    };
    for shader in look.both("look") {
        let mut resources = Resources::default();
        resources.textures.insert("height_map".into(), &height);
        resources.textures.insert("albedo_map".into(), &albedo);
        resources.textures.insert("sky".into(), &sky);
        resources.textures.insert("not_in_this_shader".into(), &sky);
        let nearest = SamplerSettings {
            filter: Filter::Nearest,
            mip_filter: Filter::Nearest,
            ..Default::default()
        };
        resources.samplers.insert("surface_sampler".into(), nearest);
        resources
            .buffers
            .insert("outputs".into(), BufferData::Output(11 * 4));
        let job = ComputeJob {
            name: "look",
            shader,
            resources,
            workgroups: [1, 1, 1],
        };
        // u = 1 wraps to texel 0; v = 0.5 lies on the border to row 1, which it belongs to. Of unorm bytes only 0 and 255 are
        // sure to be exact: lavapipe multiplies by 1 / 255, so that 51 becomes 0.20000002.
        let expected = [8.0, 32.0, 2.0, 1.0, 2.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0];
        assert_eq!(
            job.run(device).unwrap().floats("outputs"),
            expected,
            "{}",
            shader.code.route()
        );
    }
}
