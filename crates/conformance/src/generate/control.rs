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
    // The saddle 0 1 / 1 0 at (1/4, 1/4): x + y − 2xy = 3/8, slopes 1 − 2y and 1 − 2x.
    known("bilinear", &[0.0, 1.0, 1.0, 0.0, 0.25, 0.25], &[0.375]),
    known(
        "bilinear_gradient",
        &[0.0, 1.0, 1.0, 0.0, 0.25, 0.75],
        &[-0.5, 0.5],
    ),
    // The table of the specifications: a direction a little off each major axis.
    known("cube_place", &[1.0, 0.5, 0.25], &[0.0, 0.375, 0.25]),
    known("cube_place", &[-1.0, 0.5, 0.25], &[1.0, 0.625, 0.25]),
    known("cube_place", &[0.5, 1.0, 0.25], &[2.0, 0.75, 0.625]),
    known("cube_place", &[0.5, -1.0, 0.25], &[3.0, 0.75, 0.375]),
    known("cube_place", &[0.5, 0.25, 1.0], &[4.0, 0.75, 0.375]),
    known("cube_place", &[0.5, 0.25, -1.0], &[5.0, 0.25, 0.375]),
    known("cube_place", &[0.0, 0.0, 0.0], &[4.0, 0.5, 0.5]),
    known("cube_st", &[1.0, -1.0, 2.0], &[0.75, 0.25]),
    known("cube_point", &[0.0, 0.5, 0.25], &[1.0, -0.25, -0.5]),
    known("cube_point", &[3.0, 0.5, 0.25], &[0.5, -1.0, -0.25]),
    known("cube_point", &[5.0, 0.5, 0.25], &[-0.5, -0.25, -1.0]),
    known(
        "cube_footprint",
        &[0.5, 0.0, 4.0],
        &[1.0, 0.0, 2.0, 0.0, 0.5, 0.5],
    ),
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
    known("codec_octahedral_encode", &[0.0, 0.0, 5.0], &[0.0, 0.0]),
    known("codec_octahedral_encode", &[0.0, -1e-30, 0.0], &[0.0, -1.0]),
    known("codec_octahedral_encode", &[0.0, 0.0, -1.0], &[1.0, 1.0]),
    known("codec_octahedral_encode", &[0.0, 0.0, 0.0], &[0.0, 0.0]),
    // (1, 2, −1)/4 lies in the lower half: folded over the edge to (1 − 1/2, 1 − 1/4).
    known("codec_octahedral_encode", &[1.0, 2.0, -1.0], &[0.5, 0.75]),
    known(
        "codec_octahedral_encode_published",
        &[1.0, 2.0, -1.0],
        &[0.5, 0.75],
    ),
    known("codec_octahedral_decode", &[0.0, 0.0], &[0.0, 0.0, 1.0]),
    known("codec_octahedral_decode", &[-1.0, 1.0], &[0.0, 0.0, -1.0]),
    known(
        "codec_octahedral_decode",
        &[0.5, 0.5],
        &[HALF_ROOT, HALF_ROOT, 0.0],
    ),
    known("octahedral_fold", &[0.25, -0.5], &[0.5, -0.75]),
    known(
        "codec_snorm_encode",
        &[-1.0, 0.0, 1.0, 127.0],
        &[-127.0, 0.0, 127.0],
    ),
    // Ties go away from zero: 16383.5 and −16383.5.
    known(
        "codec_snorm_encode",
        &[0.5, -0.5, 0.25, 32_767.0],
        &[16_384.0, -16_384.0, 8192.0],
    ),
    known(
        "codec_snorm_decode",
        &[-128.0, 0.0, 127.0, 127.0],
        &[-1.0, 0.0, 1.0],
    ),
    known(
        "codec_snorm_decode",
        &[-32_768.0, -32_767.0, 32_767.0, 32_767.0],
        &[-1.0, -1.0, 1.0],
    ),
    known(
        "codec_two_channel_encode",
        &[0.6, 0.0, 0.8],
        &[0.600_000_023_841_857_9, 0.0],
    ),
    known("codec_two_channel_decode", &[0.0, 0.0], &[0.0, 0.0, 1.0]),
    // Nothing left for z, and less than nothing.
    known("codec_two_channel_decode", &[1.0, 0.0], &[1.0, 0.0, 0.0]),
    known("codec_two_channel_decode", &[0.75, -1.0], &[0.75, -1.0, 0.0]),
    known(
        "codec_two_channel_decode_published",
        &[0.0, 0.0],
        &[0.0, 0.0, 1.0],
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
    // The colour of (0.5, 0, 1).
    known(
        "dot3_cube",
        &[0.0, 0.0, 0.5, 0.75, 0.5, 1.0, 1.0, 0.5, 0.25],
        &[0.5, 0.25, 0.125],
    ),
    known("dot3_combiner", &[0.5, 0.5, 1.0, 0.5, 0.5, 1.0], &[1.0]),
    known(
        "dot3_single_pass",
        &[0.5, 0.5, 1.0, 0.75, 0.5, 0.75, 1.0, 0.5, 0.25],
        &[0.5, 0.25, 0.125],
    ),
    known("light_to_colour", &[3.0, 0.0, 4.0], &[0.8, 0.5, 0.9]),
    known("light_to_colour", &[0.0, 0.0, 0.0], &[0.5, 0.5, 0.5]),
    known("light_to_colour_published", &[3.0, 0.0, 4.0], &[0.8, 0.5, 0.9]),
    known(
        "dot3_first_pass",
        &[0.5, 0.5, 1.0, 0.75, 0.5, 0.75],
        &[0.5, 0.5, 0.5],
    ),
    known(
        "dot3_second_pass",
        &[0.5, 0.5, 0.5, 1.0, 0.5, 0.25],
        &[0.5, 0.25, 0.125],
    ),
    known("quantise_unorm8", &[0.0, 1.0, 0.25], &[0.0, 1.0, 64.0 / 255.0]),
    // I = 1/2 is kept as 128/255, and that times 1/4 as 32/255.
    known(
        "dot3_two_pass",
        &[0.5, 0.5, 1.0, 0.75, 0.5, 0.75, 1.0, 0.25, 0.0],
        &[128.0 / 255.0, 32.0 / 255.0, 0.0],
    ),
    // Level ground half way up, 4 units a tile: 1/2 · 1/2 − 1/8 = 1/8 tile, 1/2 unit.
    known(
        "displacement",
        &[1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.5, 0.5, -0.125, 4.0],
        &[1.0, 0.0, 0.5],
    ),
    known(
        "displacement_slope",
        &[0.25, 0.75, 0.5, 0.25, 2.0, 4.0],
        &[1.0, -1.0],
    ),
    known(
        "displacement_normal",
        &[0.0, 0.0, 1.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.75, 0.0],
        &[-0.6, 0.0, 0.8],
    ),
    // Mirrored along u: the rise is toward −x, and the normal outward still.
    known(
        "displacement_normal",
        &[0.0, 0.0, 1.0, -1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.75, 0.0],
        &[0.6, 0.0, 0.8],
    ),
    known(
        "emboss_uv",
        &[0.5, 0.25, 0.6, 0.0, 0.8, 0.5],
        &[0.800_000_011_920_929, 0.25],
    ),
    known("emboss_difference", &[0.75, 0.5], &[0.25]),
    known("emboss", &[0.5, 0.75, 0.5], &[0.75]),
    known("emboss", &[0.25, 0.0, 1.0], &[0.0]),
    // Seen along the normal, back again; seen edge on, straight on.
    known(
        "environment_bump",
        &[0.0, 0.0, 1.0, 0.0, 0.0, 0.5],
        &[0.0, 0.0, 1.0],
    ),
    known(
        "environment_bump",
        &[1.0, 0.0, 0.0, 0.0, 0.0, 1.0],
        &[-1.0, 0.0, 0.0],
    ),
    known(
        "environment_bump",
        &[0.0, 0.0, 1.0, 0.0, 0.0, 0.0],
        &[0.0, 0.0, -1.0],
    ),
    known(
        "environment_bump_published",
        &[0.0, 0.0, 1.0, 0.0, 0.0, 1.0],
        &[0.0, 0.0, 1.0],
    ),
    known(
        "frame_from_normal",
        &[0.0, 0.0, 1.0],
        &[1.0, 0.0, 0.0, 0.0, 1.0, 0.0],
    ),
    known(
        "frame_from_normal",
        &[0.0, 0.0, -1.0],
        &[1.0, 0.0, 0.0, 0.0, -1.0, 0.0],
    ),
    known(
        "frame_from_normal",
        &[1.0, 0.0, 0.0],
        &[0.0, 0.0, -1.0, 0.0, 1.0, 0.0],
    ),
    // A = (0, −1, 0), T = z × A = x, B = T × N = −y.
    known(
        "frame_from_normal_published",
        &[0.0, 0.0, 1.0],
        &[1.0, 0.0, 0.0, 0.0, -1.0, 0.0],
    ),
    known(
        "frame_from_normal_unit_published",
        &[0.0, 0.0, 1.0],
        &[1.0, 0.0, 0.0, 0.0, -1.0, 0.0],
    ),
    known(
        "frame_hughes_moller_published",
        &[1.0, 0.0, 0.0],
        &[0.0, 0.0, -1.0, 0.0, 1.0, 0.0],
    ),
    known(
        "frame_frisvad_published",
        &[0.0, 0.0, 1.0],
        &[1.0, 0.0, 0.0, 0.0, 1.0, 0.0],
    ),
    known(
        "frame_frisvad_published",
        &[0.0, 0.0, -1.0],
        &[0.0, -1.0, 0.0, -1.0, 0.0, 0.0],
    ),
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
    known("mip_shares", &[0.0, 1.0], &[1.0, 0.0, 0.0]),
    known("mip_shares", &[3.0, 8.0], &[0.5, 0.5, 0.0]),
    // 5 texels over 2: (1, 1, 1/2) and (1/2, 1, 1), times 2/5.
    known("mip_shares", &[0.0, 5.0], &[0.4, 0.4, 0.2]),
    known("mip_shares", &[1.0, 5.0], &[0.2, 0.4, 0.4]),
    known("normal_mips", &[0.375, 0.0, 0.5], &[0.6, 0.0, 0.8]),
    known("normal_mips", &[0.0, 0.0, 0.0], &[0.0, 0.0, 1.0]),
    known("normal_mips_published", &[0.375, 0.0, 0.5], &[0.375, 0.0, 0.5]),
    known("normal_mips_length", &[0.375, 0.0, 0.5], &[0.625]),
    // One texel a face: the face's own direction. Two: the first of +Z looks along (−1, 1, 2).
    known("normalisation_cube_map", &[3.0, 0.0, 0.0, 1.0], &[0.0, -1.0, 0.0]),
    known(
        "normalisation_cube_map",
        &[4.0, 0.0, 0.0, 2.0],
        &[
            -0.408_248_290_463_863,
            0.408_248_290_463_863,
            0.816_496_580_927_726,
        ],
    ),
    known(
        "normalisation_cube_map_encode",
        &[-1.0, 0.0, 1.0, 255.0],
        &[0.0, 128.0, 255.0],
    ),
    known(
        "normalisation_cube_map_encode",
        &[-1.0, 0.0, 1.0, 65_535.0],
        &[0.0, 32_768.0, 65_535.0],
    ),
    known(
        "normalisation_cube_map_decode",
        &[0.0, 51.0, 255.0, 255.0],
        &[-1.0, -0.6, 1.0],
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
    // A slope of (0.6, 0, 0.8) from straight above at half height: 0.36 · 0.8 · 0.04 · 0.5.
    known(
        "parallax_slope_ao_delta",
        &[0.6, 0.0, 0.8, 0.0, 0.0, 1.0, 0.0, 0.0, 1.0, 0.5, 0.5],
        &[0.072],
    ),
    known(
        "parallax_slope_ao_delta",
        &[0.0, 0.0, 1.5, 0.0, 0.0, 1.0, 0.0, 0.0, 1.0, 1.0, 0.5],
        &[0.0],
    ),
    known(
        "parallax_slope_ao_delta_published",
        &[0.0, 0.0, 0.5, 0.0, 0.0, 1.0, 0.0, 0.0, 1.0, 1.0, 1.0],
        &[0.375],
    ),
    known("slope_occlusion", &[0.0625, 8.0], &[0.5]),
    known("slope_occlusion", &[1.0, 1.5], &[0.0]),
    known("slope_occlusion_published", &[1.0, 1.5], &[-0.5]),
    known("parallax_slope_ao", &[0.5, 0.25, 0.125], &[0.375, 0.125]),
    known(
        "parallax_slope_ao_directed",
        &[0.5, 0.25, 0.5, 0.0, 0.75, 0.5],
        &[0.75, 0.25],
    ),
    known(
        "wrap_lambert_factor",
        &[1.0, 0.0, 0.0, 0.0, 3.0, 0.0, 0.0, 1.0],
        &[0.75],
    ),
    known(
        "wrap_lambert_factor",
        &[1.0, 0.0, 0.0, 0.0, 1.5, 0.0, 0.0, -1.0],
        &[0.0],
    ),
    known(
        "wrap_lambert_factor",
        &[-0.5, 0.5, 0.0, 0.0, 1.0, 1.0, 0.0, 0.0],
        &[0.375],
    ),
    known(
        "wrap_lambert_factor_published",
        &[0.5, 0.5, 0.0, 0.0, 1.0, 0.0, 0.0, 1.0],
        &[0.9375],
    ),
    known(
        "wrap_lambert_factor_published",
        &[1.0, 9.0, 0.0, 0.0, 1.0, 0.0, 0.0, 1.0],
        &[1.5],
    ),
    known(
        "wrap_lambert",
        &[0.5, 1.0, 1.0, 2.0, 1.0, 0.5, 0.25, 0.75],
        &[0.5, 0.25, 0.25, 0.75],
    ),
    known(
        "wrap_lambert_published",
        &[0.5, 1.0, 1.0, 2.0, 1.0, 1.0, 0.5, 0.25, 0.75],
        &[0.5, 0.25, 0.25, 0.375],
    ),
    known("wrap_lambert_is_hole", &[0.009], &[1.0]),
    known("wrap_lambert_is_hole", &[0.01], &[0.0]),
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
