//! Cube textures: each face, level and format is where the graphics interfaces' tables say it is.

use bossage_runner::{
    BufferData, ComputeJob, Error, Filter, Machine, Resources, SamplerSettings, Shader, TexelFormat,
    TextureData,
};

use crate::support::{compile, device};

const LOOK: &str = "
@group(0) @binding(0) var<storage, read> inputs: array<vec4f>;
@group(0) @binding(1) var<storage, read_write> outputs: array<f32>;
@group(1) @binding(0) var sky: texture_cube<f32>;
@group(1) @binding(1) var sky_sampler: sampler;
@compute @workgroup_size(64) fn look(@builtin(global_invocation_id) id: vec3u) {
    if id.x >= arrayLength(&outputs) { return; }
    let at = inputs[id.x];
    outputs[id.x] = textureSampleLevel(sky, sky_sampler, at.xyz, at.w).r;
}
";

/// For each face the axes of its middle, of s and of t, as (component, sign): Vulkan's table.
const FACES: [[(usize, f32); 3]; 6] = [
    [(0, 1.0), (2, -1.0), (1, -1.0)],
    [(0, -1.0), (2, 1.0), (1, -1.0)],
    [(1, 1.0), (0, 1.0), (2, 1.0)],
    [(1, -1.0), (0, 1.0), (2, -1.0)],
    [(2, 1.0), (0, 1.0), (1, -1.0)],
    [(2, -1.0), (0, -1.0), (1, -1.0)],
];

/// The direction of a texel's centre, of another length than 1.
fn direction(face: usize, x: usize, y: usize, side: usize) -> [f32; 3] {
    let place = |i: usize| 2.0 * (i as f32 + 0.5) / side as f32 - 1.0;
    let mut direction = [0.0; 3];
    for ((axis, sign), value) in FACES[face].into_iter().zip([1.0, place(x), place(y)]) {
        direction[axis] = 3.0 * sign * value;
    }
    direction
}

/// A number for each texel of each face and level.
fn number(face: usize, level: usize, x: usize, y: usize) -> f32 {
    (1000 * (face + 1) + 100 * level + 10 * y + x) as f32
}

fn face(face: usize, level: usize, side: usize) -> Vec<f32> {
    let texels = (0..side).flat_map(|y| (0..side).map(move |x| (x, y)));
    texels.map(|(x, y)| number(face, level, x, y)).collect()
}

/// A cube of these sides, each texel its number.
fn numbered(sides: &[usize]) -> TextureData {
    let faces =
        |level: usize| -> Vec<Vec<f32>> { (0..6).map(|index| face(index, level, sides[level])).collect() };
    let base = TextureData::cube("sky", sides[0] as u32, TexelFormat::R32Float, &faces(0)).unwrap();
    (1..sides.len()).fold(base, |cube, level| {
        cube.with_cube_level("sky", &faces(level)).unwrap()
    })
}

/// Six faces of one texel each.
fn single<T: bytemuck::NoUninit>(format: TexelFormat, texels: [T; 6]) -> TextureData {
    TextureData::cube("sky", 1, format, &texels.map(|texel| [texel])).unwrap()
}

const NEAREST: SamplerSettings = SamplerSettings {
    address: bossage_runner::AddressMode::Clamp,
    filter: Filter::Nearest,
    mip_filter: Filter::Nearest,
    anisotropy: 1,
};

const LINEAR: SamplerSettings = SamplerSettings {
    filter: Filter::Linear,
    ..NEAREST
};

/// What lookups give: directions and levels in, reds out.
fn look(
    device: &dyn Machine,
    shader: Shader<'_>,
    sky: &TextureData,
    sampler: SamplerSettings,
    at: &[[f32; 4]],
) -> Result<Vec<f32>, Error> {
    answers(device, shader, sky, sampler, (at, at.len()))
}

/// What so many lookups give, of inputs of any kind.
fn answers(
    device: &dyn Machine,
    shader: Shader<'_>,
    sky: &TextureData,
    sampler: SamplerSettings,
    (inputs, count): (&[[f32; 4]], usize),
) -> Result<Vec<f32>, Error> {
    let mut resources = Resources::default();
    resources.textures.insert("sky".into(), sky);
    resources.samplers.insert("sky_sampler".into(), sampler);
    let inputs = BufferData::Bytes(bytemuck::cast_slice(inputs));
    resources.buffers.insert("inputs".into(), inputs);
    let outputs = BufferData::Output(4 * count);
    resources.buffers.insert("outputs".into(), outputs);
    let job = ComputeJob {
        name: "look",
        shader,
        resources,
        workgroups: [count.div_ceil(64) as u32, 1, 1],
    };
    Ok(job.run(device)?.floats("outputs"))
}

#[test]
fn every_texel_of_every_face_and_level_is_in_its_place() {
    let Some(device) = device("every_texel_of_every_face_and_level_is_in_its_place") else {
        return;
    };
    let compiled = compile(LOOK);
    let sides = [4, 2, 1];
    let sky = numbered(&sides);
    let mut at = Vec::new();
    let mut expected = Vec::new();
    for (level, side) in sides.into_iter().enumerate() {
        for (index, y, x) in (0..6 * side * side).map(|i| (i / (side * side), i / side % side, i % side)) {
            let [dx, dy, dz] = direction(index, x, y, side);
            at.push([dx, dy, dz, level as f32]);
            expected.push(number(index, level, x, y));
        }
    }
    for shader in compiled.both("look") {
        let route = shader.code.route();
        assert_eq!(
            look(device, shader, &sky, NEAREST, &at).unwrap(),
            expected,
            "{route}"
        );
        // At texel centres a linear filter gives the texel as well.
        assert_eq!(
            look(device, shader, &sky, LINEAR, &at).unwrap(),
            expected,
            "{route}"
        );
        // Two faces swapped are seen.
        let mut swapped = sky.clone();
        let face_bytes = swapped.levels[0].len() / 6;
        swapped.levels[0].rotate_left(face_bytes);
        assert_ne!(
            look(device, shader, &swapped, NEAREST, &at).unwrap(),
            expected,
            "{route}"
        );
    }
}

#[test]
fn filtering_goes_on_across_the_edges_of_faces() {
    let Some(device) = device("filtering_goes_on_across_the_edges_of_faces") else {
        return;
    };
    let compiled = compile(LOOK);
    // One texel a face: half-way along the edge of two faces both have weight ½.
    let sky = single(TexelFormat::R32Float, [1.0_f32, 2.0, 4.0, 8.0, 16.0, 32.0]);
    let at = [
        [1.0, 0.0, 1.0, 0.0],
        [-1.0, 1.0, 0.0, 0.0],
        [0.0, -1.0, -1.0, 0.0],
        [1.0, 0.0, -1.0, 0.0],
    ];
    for shader in compiled.both("look") {
        assert_eq!(
            look(device, shader, &sky, LINEAR, &at).unwrap(),
            [8.5, 3.0, 20.0, 16.5],
            "{}",
            shader.code.route()
        );
    }
}

#[test]
fn each_format_is_read_in_its_own_steps() {
    let Some(device) = device("each_format_is_read_in_its_own_steps") else {
        return;
    };
    let compiled = compile(LOOK);
    let at: Vec<[f32; 4]> = (0..6)
        .map(|index| direction(index, 0, 0, 1))
        .map(|[x, y, z]| [x, y, z, 0.0])
        .collect();
    let codes = [0_u16, 65535, 1, 12345, 32768, 40000];
    let sixteen = single(TexelFormat::Rgba16Unorm, codes.map(|code| [code; 4]));
    let eight = single(TexelFormat::Rgba8Unorm, codes.map(|code| [(code / 257) as u8; 4]));
    let four = single(TexelFormat::Rgba32Float, codes.map(|code| [f32::from(code); 4]));
    for shader in compiled.both("look") {
        let read = |sky: &TextureData| look(device, shader, sky, NEAREST, &at).unwrap();
        let nearest = |values: Vec<f32>, steps: f32| -> Vec<u16> {
            // A reader may be a few roundings off: far less than the hundredth of a step that is let through.
            let scaled = values.iter().map(|value| value * steps);
            scaled
                .map(|code| {
                    assert!((code - code.round()).abs() < 0.01, "{code} is no code");
                    code.round() as u16
                })
                .collect()
        };
        assert_eq!(nearest(read(&sixteen), 65535.0), codes);
        assert_eq!(nearest(read(&eight), 255.0), codes.map(|code| code / 257));
        assert_eq!(read(&four), codes.map(f32::from));
    }
}

#[test]
fn cubes_that_do_not_fit_are_refused() {
    let faces = |count: usize, last: usize| -> Vec<Vec<f32>> {
        (0..count)
            .map(|index| vec![0.0; if index + 1 == count { last } else { 4 }])
            .collect()
    };
    let cube = |faces: &[Vec<f32>]| TextureData::cube("sky", 2, TexelFormat::R32Float, faces);
    assert!(cube(&faces(6, 4)).is_ok());
    let message = |faces: &[Vec<f32>]| cube(faces).unwrap_err().to_string();
    assert_eq!(
        message(&faces(5, 4)),
        "texture `sky`: level 0: a cube has six faces (+x, −x, +y, −y, +z, −z); 5 are given"
    );
    assert_eq!(
        message(&faces(6, 9)),
        "texture `sky`: level 0: face −z has 36 bytes; 2 x 2 texels are 16"
    );
    assert!(message(&faces(7, 4)).ends_with("7 are given"));
    let level = cube(&faces(6, 4)).unwrap().with_cube_level("sky", &faces(6, 4));
    assert_eq!(
        level.unwrap_err().to_string(),
        "texture `sky`: level 1: face +x has 16 bytes; 1 x 1 texels are 4"
    );
}

#[test]
fn a_plane_for_a_cube_is_refused() {
    let Some(device) = device("a_plane_for_a_cube_is_refused") else {
        return;
    };
    let compiled = compile(LOOK);
    let shader = compiled.wgsl("look");
    let at = [[1.0, 0.0, 0.0, 0.0]];
    let plane = TextureData::r32f(1, 1, &[1.0]);
    let error = look(device, shader, &plane, NEAREST, &at).unwrap_err();
    assert!(matches!(error, Error::WrongResource { .. }), "{error}");
    let oblong = TextureData {
        height: 2,
        ..single(TexelFormat::R32Float, [0.0_f32; 6])
    };
    let error = look(device, shader, &oblong, NEAREST, &at).unwrap_err();
    assert!(error.to_string().contains("square"), "{error}");
    let mut many = single(TexelFormat::R32Float, [0.0_f32; 6]);
    many.levels.push(vec![0; 24]);
    let error = look(device, shader, &many, NEAREST, &at).unwrap_err();
    assert!(error.to_string().contains("levels"), "{error}");
}

/// As [`LOOK`], with the level from a gradient along x and along y instead.
const GRADIENTS: &str = "
@group(0) @binding(0) var<storage, read> inputs: array<vec4f>;
@group(0) @binding(1) var<storage, read_write> outputs: array<f32>;
@group(1) @binding(0) var sky: texture_cube<f32>;
@group(1) @binding(1) var sky_sampler: sampler;
@compute @workgroup_size(64) fn look(@builtin(global_invocation_id) id: vec3u) {
    if id.x >= arrayLength(&outputs) { return; }
    let at = inputs[2u * id.x].xyz;
    let dx = inputs[2u * id.x + 1u].xyz;
    outputs[id.x] = textureSampleGrad(sky, sky_sampler, at, dx, vec3f(0.0)).r;
}
";

#[test]
fn a_gradient_along_a_face_chooses_its_level() {
    let Some(device) = device("a_gradient_along_a_face_chooses_its_level") else {
        return;
    };
    let compiled = compile(GRADIENTS);
    let sides = [4, 2, 1];
    let sky = numbered(&sides);
    let mut at = Vec::new();
    let mut expected = Vec::new();
    for (level, side) in sides.into_iter().enumerate() {
        for face in 0..6 {
            let [x, y, z] = direction(face, 0, 0, side);
            // The middle axis of a direction is 3 long, and a face 2 wide: so it moves on by 2 to the power of the level in texels.
            let mut along = [0.0; 4];
            along[FACES[face][1].0] = 3.0 * 2.0 / sides[0] as f32 * (1 << level) as f32;
            at.extend([[x, y, z, 0.0], along]);
            expected.push(number(face, level, 0, 0));
        }
    }
    for shader in compiled.both("look") {
        let found = answers(device, shader, &sky, NEAREST, (&at, expected.len())).unwrap();
        assert_eq!(found, expected, "{}", shader.code.route());
    }
}
