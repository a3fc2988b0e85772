//! Hand-picked inputs with answers known from geometry or worked out on paper: a third oracle beside the two computed ones.
//!
//! Answers are exact in f64; where a decimal is rounded, it is rounded to more digits than any tolerance sees.

use bossage_shaders::Probe;

use super::Inputs;

/// One input and its outputs.
#[derive(Clone, Copy, Debug)]
pub struct Known {
    function: &'static str,
    /// The arguments.
    pub inputs: &'static [f32],
    /// The answers.
    pub outputs: &'static [f64],
}

/// The known answers of a probe.
#[must_use]
pub fn rows(probe: &Probe) -> Vec<&'static Known> {
    TABLE
        .iter()
        .filter(|row| row.function == probe.function())
        .collect()
}

/// The inputs of the known answers, in the order of [`rows`].
#[must_use]
pub fn generate(probe: &Probe) -> Inputs {
    let mut inputs = Inputs::of(probe);
    for row in rows(probe) {
        inputs.push([row.inputs.to_vec()]);
    }
    inputs
}

const fn known(function: &'static str, inputs: &'static [f32], outputs: &'static [f64]) -> Known {
    Known {
        function,
        inputs,
        outputs,
    }
}

const HALF_ROOT: f64 = std::f64::consts::FRAC_1_SQRT_2;
const IDENTITY: [f32; 9] = [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0];

/// The table, in the order of the library.
pub const TABLE: &[Known] = &[
    known("resolve_edge", &[-1.0, 4.0, 0.0], &[3.0]),
    known("resolve_edge", &[-1.0, 4.0, 1.0], &[0.0]),
    known("resolve_edge", &[4.0, 4.0, 1.0], &[3.0]),
    known("resolve_edge", &[9.0, 4.0, 2.0], &[3.0]),
    known("euclidean_remainder", &[-7.0, 4.0], &[1.0]),
    // N = z, T = x: B = y, turned round by the handedness.
    known(
        "bitangent",
        &[0.0, 0.0, 1.0, 1.0, 0.0, 0.0, 1.0],
        &[0.0, 1.0, 0.0],
    ),
    known(
        "bitangent",
        &[0.0, 0.0, 1.0, 1.0, 0.0, 0.0, -1.0],
        &[0.0, -1.0, 0.0],
    ),
    // Interpolants are not normalised: twice the normal is twice the bitangent.
    known(
        "bitangent",
        &[0.0, 0.0, 2.0, 1.0, 0.0, 0.0, 1.0],
        &[0.0, 2.0, 0.0],
    ),
    known("tangent_from_normal", &[0.0, 0.0, 1.0], &[1.0, 0.0, 0.0]),
    known("tangent_from_normal", &[0.0, 0.0, -1.0], &[1.0, 0.0, 0.0]),
    // A stretch of 2 along x: cof = diag(1, 2, 2), scaled by min(s) / (s₀ s₁ s₂) = 1/2.
    known(
        "cofactor_direction",
        &[2.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 1.0, 0.0, 1.0],
        &[0.5, 0.0, 1.0],
    ),
    known("mirror_sign", &IDENTITY, &[1.0]),
    known(
        "mirror_sign",
        &[-1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0],
        &[-1.0],
    ),
    known("largest_component", &[1.0, -3.0, 2.0], &[3.0]),
    known("normalise", &[0.0, 0.0, 0.0], &[0.0, 0.0, 0.0]),
    known("normalise", &[3.0, 0.0, 4.0], &[0.6, 0.0, 0.8]),
    known("normalise", &[0.0, 2e19, 0.0], &[0.0, 1.0, 0.0]),
    known("normalise", &[0.0, 0.0, -1e-23], &[0.0, 0.0, -1.0]),
    known("normalise_published", &[3.0, 0.0, 4.0], &[0.6, 0.0, 0.8]),
    known("elevation", &[1.0, 0.5, -0.25], &[0.25]),
    known("elevation", &[0.5, 0.5, -0.25], &[0.0]),
    known("lambert", &[0.0, 0.0, 1.0, 0.0, 0.0, 1.0], &[1.0]),
    known("lambert", &[0.0, 0.0, 1.0, 0.0, 0.0, -1.0], &[0.0]),
    known(
        "half_vector",
        &[1.0, 0.0, 0.0, 0.0, 0.0, 1.0],
        &[HALF_ROOT, 0.0, HALF_ROOT],
    ),
    // Light opposite to the eye: no half vector.
    known("half_vector", &[1.0, 0.0, 0.0, -1.0, 0.0, 0.0], &[0.0, 0.0, 0.0]),
    known(
        "half_vector_published",
        &[1.0, 0.0, 0.0, 0.0, 0.0, 1.0],
        &[HALF_ROOT, 0.0, HALF_ROOT],
    ),
    known("highlight_power", &[0.5, 3.0], &[0.125]),
    known("highlight_power", &[0.0, 1.0], &[0.0]),
    known("highlight_power", &[1.0, 4096.0], &[1.0]),
    known("highlight_power_published", &[0.5, 3.0], &[0.125]),
    // Light, eye and normal agree: full diffuse and full highlight.
    known(
        "blinn_phong",
        &[
            0.0, 0.0, 1.0, 0.0, 0.0, 1.0, 0.0, 0.0, 1.0, 0.5, 0.25, 0.0, 0.0, 0.5, 1.0, 32.0,
        ],
        &[0.5, 0.75, 1.0],
    ),
    // Light opposite to the eye, across the surface: nothing.
    known(
        "blinn_phong",
        &[
            0.0, 0.0, 1.0, 1.0, 0.0, 0.0, -1.0, 0.0, 0.0, 0.5, 0.25, 0.0, 0.0, 0.5, 1.0, 32.0,
        ],
        &[0.0, 0.0, 0.0],
    ),
    known(
        "blinn_phong_published",
        &[
            0.0, 0.0, 1.0, 0.0, 0.0, 1.0, 0.0, 0.0, 1.0, 0.5, 0.25, 0.0, 0.0, 0.5, 1.0, 32.0,
        ],
        &[0.5, 0.75, 1.0],
    ),
    known("codec_biased_encode", &[-1.0, 0.0, 1.0], &[1.0, 128.0, 255.0]),
    // 0.7/127 lies nearer to 129 than to 128; truncation falls to 128.
    known(
        "codec_biased_encode",
        &[0.005_511_811, -0.005_511_811, 0.5],
        &[129.0, 127.0, 192.0],
    ),
    known(
        "codec_biased_encode_published",
        &[-1.0, 0.0, 1.0],
        &[1.0, 128.0, 255.0],
    ),
    known(
        "codec_biased_encode_published",
        &[0.005_511_811, -0.005_511_811, 0.5],
        &[128.0, 127.0, 191.0],
    ),
    known("codec_biased_decode", &[0.0, 128.0, 255.0], &[-1.0, 0.0, 1.0]),
    known(
        "codec_biased_decode_published",
        &[0.0, 128.0, 255.0],
        &[-128.0 / 127.0, 0.0, 1.0],
    ),
    known("codec_unorm_encode", &[-1.0, 0.0, 1.0], &[0.0, 0.5, 1.0]),
    known("codec_unorm_decode", &[0.0, 0.5, 1.0], &[-1.0, 0.0, 1.0]),
    known("codec_unorm_encode_byte", &[-1.0, 0.0, 1.0], &[0.0, 128.0, 255.0]),
    known(
        "dot3",
        &[0.0, 0.0, 1.0, 0.0, 0.0, 5.0, 1.0, 0.5, 0.25],
        &[1.0, 0.5, 0.25],
    ),
    known(
        "dot3",
        &[0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.5, 0.25],
        &[0.0, 0.0, 0.0],
    ),
    known(
        "dot3",
        &[0.0, 0.0, 1.0, 3.0, 0.0, 4.0, 1.0, 1.0, 0.0],
        &[0.8, 0.8, 0.0],
    ),
    known(
        "dot3_published",
        &[0.0, 0.0, 1.0, 3.0, 0.0, 4.0, 1.0, 1.0, 0.0],
        &[0.8, 0.8, 0.0],
    ),
    known("dot3_combiner", &[0.5, 0.5, 1.0, 0.5, 0.5, 1.0], &[1.0]),
    // The unit triangle with the unit texture: T = x, B = y, twice the area 1.
    known(
        "frame_from_uv_triangle",
        &[1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 1.0, 0.0, 0.0, 1.0],
        &[0.0, 0.0, 1.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 1.0],
    ),
    // No texture area: no share.
    known(
        "frame_from_uv_triangle",
        &[1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 1.0, 1.0, 2.0, 2.0],
        &[0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0],
    ),
    // The texture twice as dense along u halves T.
    known(
        "frame_from_uv_triangle_published",
        &[1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 2.0, 0.0, 0.0, 1.0],
        &[0.0, 0.0, 1.0, 0.5, 0.0, 0.0, 0.0, 1.0, 0.0, 1.0],
    ),
    known(
        "frame_from_uv_vertex",
        &[0.0, 0.0, 1.0, 2.0, 0.0, 3.0, 0.0, 1.0, 0.0, 2.0],
        &[1.0, 0.0, 0.0, 1.0],
    ),
    known(
        "frame_from_uv_vertex",
        &[0.0, 0.0, 1.0, 2.0, 0.0, 3.0, 0.0, -1.0, 0.0, 2.0],
        &[1.0, 0.0, 0.0, -1.0],
    ),
    // T parallel to N: the tangent comes from the normal alone.
    known(
        "frame_from_uv_vertex",
        &[0.0, 0.0, 1.0, 0.0, 0.0, 3.0, 0.0, -1.0, 0.0, 2.0],
        &[1.0, 0.0, 0.0, 1.0],
    ),
    known(
        "frame_from_uv_vertex_published",
        &[0.0, 0.0, 1.0, 2.0, 0.0, 3.0, 0.0, 1.0, 0.0],
        &[2.0, 0.0, 0.0, 1.0],
    ),
    known(
        "handedness_of",
        &[0.0, 0.0, 1.0, 1.0, 0.0, 0.0, 0.0, -2.0, 0.0],
        &[-1.0],
    ),
    known("length_of", &[0.0, 3e20, 4e20], &[5e20]),
    known("length_of", &[0.0, 0.0, 0.0], &[0.0]),
    known(
        "frame_mikktspace",
        &[0.0, 0.0, 1.0, 1.0, 0.0, 0.0, -1.0, 0.25, 0.5, 0.75],
        &[0.25, -0.5, 0.75],
    ),
    known(
        "combine_frame",
        &[1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.25, 0.5, 0.75],
        &[0.25, 0.5, 0.75],
    ),
    // A rise along u leans the normal back along −u, and only there.
    known(
        "height_to_normal",
        &[0.0, 1.0, 0.5, 0.5, 1.0, 1.0],
        &[-HALF_ROOT, 0.0, HALF_ROOT],
    ),
    known(
        "height_to_normal",
        &[0.5, 0.5, 0.0, 1.0, 1.0, 1.0],
        &[0.0, -HALF_ROOT, HALF_ROOT],
    ),
    known(
        "height_to_normal",
        &[0.0, 0.75, 0.5, 0.5, 1.0, 1.0],
        &[-0.6, 0.0, 0.8],
    ),
    known(
        "height_to_normal_forward",
        &[0.0, 1.0, 0.0, 1.0, 1.0],
        &[-HALF_ROOT, 0.0, HALF_ROOT],
    ),
    // As published the step to the next row lands in red.
    known(
        "height_to_normal_forward_published",
        &[0.0, 1.0, 0.0, 1.0],
        &[-HALF_ROOT, 0.0, HALF_ROOT],
    ),
    known(
        "light_to_tangent",
        &[1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 1.0, 2.0, 3.0],
        &[1.0, 2.0, 3.0],
    ),
    known(
        "light_to_tangent_world_space",
        &[0.0, 0.0, 1.0, 1.0, 0.0, 0.0, -1.0, 1.0, 2.0, 3.0],
        &[1.0, -2.0, 3.0],
    ),
    // A light at (1, 2, 3) seen from (1, 0, 0) in an object moved by (0, 0, 1): its place there is (1, 2, 2).
    known(
        "light_to_tangent_object_space",
        &[
            0.0, 0.0, 1.0, 1.0, 0.0, 0.0, 1.0, 1.0, 0.0, 0.0, 1.0, 2.0, 3.0, //
            1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, -1.0, 1.0,
        ],
        &[0.0, 2.0, 2.0],
    ),
    // Stretched by 2 along x: the normal (1, 0, 1)/√2 leans to (1, 0, 2)/√5.
    known(
        "normal_transform",
        &[2.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 1.0, 0.0, 1.0],
        &[0.447_213_595_499_957_9, 0.0, 0.894_427_190_999_915_9],
    ),
    // A reflection leaves the outward normal of its mirror plane's edge-on face outward.
    known(
        "normal_transform",
        &[-1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 1.0],
        &[0.0, 0.0, 1.0],
    ),
    known(
        "normal_transform_published",
        &[2.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 1.0, 0.0, 1.0],
        &[2.0, 0.0, 1.0],
    ),
    known(
        "tangent_transform",
        &[3.0, 0.0, 4.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 1.0, 0.0, 0.0],
        &[0.6, 0.0, 0.8],
    ),
    // V at 45°: the shift is the elevation.
    known(
        "parallax_offset",
        &[0.25, 0.5, 0.5, HALF_ROOT as f32, 0.0, HALF_ROOT as f32],
        &[0.75, 0.5],
    ),
    // V in the surface: V.z counts as 0.05.
    known("parallax_offset", &[0.0, 0.0, 0.05, 1.0, 0.0, 0.0], &[1.0, 0.0]),
    known(
        "parallax_offset_published",
        &[0.25, 0.5, 0.5, HALF_ROOT as f32, 0.0, HALF_ROOT as f32],
        &[0.75, 0.5],
    ),
    known(
        "parallax_offset_limited",
        &[0.25, 0.5, 0.5, 0.5, 0.0, 0.75],
        &[0.5, 0.5],
    ),
];

#[cfg(test)]
mod tests {
    use bossage_shaders::{PROBES, TECHNIQUES};

    use super::TABLE;

    #[test]
    fn every_row_fits_its_probe() {
        for row in TABLE {
            let probe = PROBES.iter().find(|probe| probe.function() == row.function);
            let probe =
                probe.unwrap_or_else(|| panic!("known answers for `{}`, which is no probe", row.function));
            assert_eq!(
                (row.inputs.len(), row.outputs.len()),
                (probe.input_floats, probe.output_floats),
                "{}",
                probe.id
            );
        }
    }

    #[test]
    fn every_technique_has_a_known_answer() {
        for technique in TECHNIQUES {
            let has = |row: &super::Known| {
                PROBES
                    .iter()
                    .any(|probe| probe.technique == technique.id && probe.function() == row.function)
            };
            assert!(TABLE.iter().any(has), "{}", technique.id);
        }
    }
}
