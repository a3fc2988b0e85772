//! Texel formats: each component is read in the steps of its format, and what a format lacks is 0, alpha 1.

use bossage_runner::{BufferData, ComputeJob, Resources, TexelFormat, TextureData};

use crate::support::{compile, device};

const READ: &str = "
@group(0) @binding(0) var texels: texture_2d<f32>;
@group(0) @binding(1) var<storage, read_write> outputs: array<vec4f>;
@compute @workgroup_size(2) fn read(@builtin(global_invocation_id) id: vec3u) {
    if id.x >= arrayLength(&outputs) { return; }
    outputs[id.x] = textureLoad(texels, vec2u(id.x, 0u), 0);
}
";

/// Two texels of a format and what they are read as: steps of the format, then the size of one.
type Known = (TexelFormat, Vec<u8>, [[i32; 4]; 2], f64);

/// Each format.
fn formats() -> Vec<Known> {
    let words = |words: &[u16]| bytemuck::cast_slice(words).to_vec();
    let signed = |words: &[i16]| bytemuck::cast_slice(words).to_vec();
    vec![
        (
            TexelFormat::R8Unorm,
            vec![3, 254],
            [[3, 0, 0, 255], [254, 0, 0, 255]],
            255.0,
        ),
        (
            TexelFormat::R16Unorm,
            words(&[3, 65_534]),
            [[3, 0, 0, 65_535], [65_534, 0, 0, 65_535]],
            65_535.0,
        ),
        (
            TexelFormat::Rg8Unorm,
            vec![1, 2, 3, 255],
            [[1, 2, 0, 255], [3, 255, 0, 255]],
            255.0,
        ),
        (
            TexelFormat::Rg8Snorm,
            [1_i8, -2, -127, -128].map(|code| code as u8).to_vec(),
            [[1, -2, 0, 127], [-127, -127, 0, 127]],
            127.0,
        ),
        (
            TexelFormat::Rg16Unorm,
            words(&[1, 2, 30_000, 65_535]),
            [[1, 2, 0, 65_535], [30_000, 65_535, 0, 65_535]],
            65_535.0,
        ),
        (
            TexelFormat::Rg16Snorm,
            signed(&[1, -2, -32_767, -32_768]),
            [[1, -2, 0, 32_767], [-32_767, -32_767, 0, 32_767]],
            32_767.0,
        ),
        (
            TexelFormat::Rgba8Snorm,
            [1_i8, -2, 3, -4, 127, -127, 0, -128]
                .map(|code| code as u8)
                .to_vec(),
            [[1, -2, 3, -4], [127, -127, 0, -127]],
            127.0,
        ),
        (
            TexelFormat::Rgba16Snorm,
            signed(&[1, -2, 3, -4, 32_767, -32_767, 0, -32_768]),
            [[1, -2, 3, -4], [32_767, -32_767, 0, -32_767]],
            32_767.0,
        ),
    ]
}

#[test]
fn each_component_is_read_in_its_steps_and_what_is_not_there_is_zero() {
    let Some(device) = device("each_component_is_read_in_its_steps_and_what_is_not_there_is_zero") else {
        return;
    };
    let compiled = compile(READ);
    for (format, bytes, expected, steps) in formats() {
        let texels = TextureData::plane(2, 1, format, &bytes);
        assert_eq!(bytes.len(), 2 * format.texel_bytes(), "{format:?}");
        for shader in compiled.both("read") {
            let mut resources = Resources::default();
            resources.textures.insert("texels".into(), &texels);
            resources.buffers.insert("outputs".into(), BufferData::Output(32));
            let job = ComputeJob {
                name: "read",
                shader,
                resources,
                workgroups: [1, 1, 1],
            };
            let found = job.run(device).unwrap().floats("outputs");
            for (found, expected) in found.iter().zip(expected.as_flattened()) {
                let (found, expected) = (f64::from(*found) * steps, f64::from(*expected));
                // A reader may be a few roundings off: far less than the hundredth of a step that is let through.
                assert!(
                    (found - expected).abs() < 0.01,
                    "{format:?}: {found} for {expected}"
                );
            }
        }
    }
}

#[test]
fn a_plane_whose_bytes_are_of_another_format_is_refused() {
    let plane = TextureData::plane(2, 1, TexelFormat::Rg8Snorm, &[0; 3]);
    let message = plane.validate("texels").unwrap_err().to_string();
    assert!(message.contains("3 bytes instead of 4"), "{message}");
}
