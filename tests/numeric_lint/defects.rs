//! Which defects of the published forms are numerical, and what the lint calls them.
//!
//! A defect is **numerical** where a formula has no value (a quotient by zero, a direction of nothing), or where numbers of a limited
//! format make something else of it (digits lost, beyond the largest number). Every other is a **formula** that says another thing than is
//! meant: real numbers give the same answer, and nothing but a reference tells that it is wrong.

use bossage_bounds::lint::{Finding, Rule};
use bossage_shaders::Probe;

use crate::linted::Linted;
use crate::shows::{
    along_the_normal, any, beside_the_axis, collinear, huge, mirrored, near_minus_z, nearly_along_the_normal,
    on_the_axis, opposite, parallel_edges, tiny,
};

/// One finding that there must be.
pub(crate) struct Named {
    /// The function, or the kernel.
    pub(crate) shader: &'static str,
    pub(crate) rule: Rule,
    /// How the line of the operation begins.
    pub(crate) line: &'static str,
    /// The defect, as the conformance suite calls it.
    pub(crate) case: &'static str,
    /// Asserts that the witness is one of this defect and not of another one at the same line.
    pub(crate) shows: fn(&Linted, &Finding),
}

const fn named(
    shader: &'static str,
    rule: Rule,
    line: &'static str,
    case: &'static str,
    shows: fn(&Linted, &Finding),
) -> Named {
    Named {
        shader,
        rule,
        line,
        case,
        shows,
    }
}

/// Whether a function or kernel belongs to a technique, or to what all of them stand on.
pub(crate) fn of_technique(shader: &str, technique: &str) -> bool {
    match Probe::find(shader) {
        Some(probe) => probe.technique == technique,
        None => shader.starts_with(technique),
    }
}

/// The findings, by function.
pub(crate) const NAMED: &[Named] = &[
    // The zero vector, and lengths below about 1e-19 and beyond about 1e19.
    named(
        "normalise_published",
        Rule::NormaliseZero,
        "return normalize(v);",
        "tiny_light",
        any,
    ),
    named(
        "normalise_published",
        Rule::Underflow,
        "return normalize(v);",
        "tiny_light",
        tiny,
    ),
    named(
        "normalise_published",
        Rule::Overflow,
        "return normalize(v);",
        "huge_light",
        huge,
    ),
    named(
        "normalise_published",
        Rule::NanOutput,
        "return normalize(v);",
        "tiny_light",
        any,
    ),
    // L = −V.
    named(
        "half_vector_published",
        Rule::VanishingSum,
        "return normalise_published(light_dir + view_dir);",
        "opposite_light",
        opposite,
    ),
    named(
        "half_vector_published",
        Rule::NormaliseZero,
        "return normalize(v);",
        "opposite_light",
        opposite,
    ),
    named(
        "half_vector_published",
        Rule::NanOutput,
        "return normalize(v);",
        "opposite_light",
        opposite,
    ),
    named(
        "blinn_phong_published",
        Rule::NormaliseZero,
        "return normalize(v);",
        "opposite_light",
        any,
    ),
    // pow(0, p).
    named(
        "blinn_phong_published",
        Rule::PowerDomain,
        "return pow(saturate(n_dot_h), shininess);",
        "zero_to_the_zeroth",
        any,
    ),
    named(
        "highlight_power_published",
        Rule::PowerDomain,
        "return pow(saturate(n_dot_h), shininess);",
        "zero_to_the_zeroth",
        any,
    ),
    // The sum of the magnitudes is zero.
    named(
        "codec_octahedral_encode_published",
        Rule::DivisionByZero,
        "let p = direction.xy / ",
        "no_direction",
        any,
    ),
    named(
        "codec_octahedral_encode_published",
        Rule::NanOutput,
        "let p = direction.xy / ",
        "no_direction",
        any,
    ),
    // x² + y² > 1.
    named(
        "codec_two_channel_decode_published",
        Rule::RootDomain,
        "return vec3f(xy, sqrt(",
        "outside_the_circle",
        any,
    ),
    named(
        "codec_two_channel_decode_published",
        Rule::NanOutput,
        "return vec3f(xy, sqrt(",
        "outside_the_circle",
        any,
    ),
    // L = 0, and its length. NaN is clamped to 0.
    named(
        "dot3_published",
        Rule::NormaliseZero,
        "return normalize(v);",
        "zero_light",
        any,
    ),
    named(
        "dot3_published",
        Rule::Overflow,
        "return normalize(v);",
        "zero_light",
        any,
    ),
    named(
        "light_to_colour_published",
        Rule::NormaliseZero,
        "return normalize(v);",
        "zero_light",
        any,
    ),
    named(
        "light_to_colour_published",
        Rule::Overflow,
        "return normalize(v);",
        "zero_light",
        any,
    ),
    named(
        "light_to_colour_published",
        Rule::NanOutput,
        "return normalize(v);",
        "zero_light",
        any,
    ),
    // N ∝ (−1, 1, 1): the helper axis is parallel to the normal; and beside it.
    named(
        "frame_from_normal_unit_published",
        Rule::VanishingSum,
        "let tangent = cross(normal, across);",
        "axis_parallel",
        on_the_axis,
    ),
    named(
        "frame_from_normal_unit_published",
        Rule::NormaliseZero,
        "return normalize(v);",
        "axis_parallel",
        on_the_axis,
    ),
    named(
        "frame_from_normal_unit_published",
        Rule::NanOutput,
        "return normalize(v);",
        "axis_parallel",
        on_the_axis,
    ),
    named(
        "frame_from_normal_unit_published",
        Rule::Cancellation,
        "let tangent = cross(normal, across);",
        "axis_near",
        beside_the_axis,
    ),
    // 1 + n.z near −z.
    named(
        "frame_frisvad_published",
        Rule::Cancellation,
        "let a = 1.0 / (1.0 + normal.z);",
        "frisvad_near_minus_z",
        near_minus_z,
    ),
    // A triangle without texture area, one whose texture area is rounding, one without area.
    named(
        "frame_from_uv_triangle_published",
        Rule::DivisionByZero,
        "let inverse_area = 1.0 / ",
        "no_texture_area",
        any,
    ),
    named(
        "frame_from_uv_triangle_published",
        Rule::VanishingSum,
        "let inverse_area = 1.0 / ",
        "no_texture_area",
        any,
    ),
    named(
        "frame_from_uv_triangle_published",
        Rule::NanOutput,
        "let tangent = ",
        "no_texture_area",
        any,
    ),
    named(
        "frame_from_uv_triangle_published",
        Rule::Cancellation,
        "let inverse_area = 1.0 / ",
        "quantised_texture",
        collinear,
    ),
    named(
        "frame_from_uv_triangle_published",
        Rule::NormaliseZero,
        "return normalize(v);",
        "no_area",
        any,
    ),
    named(
        "frame_from_uv_triangle_published",
        Rule::VanishingSum,
        "return TriangleFrame(normalise_published(cross(p, q))",
        "no_area",
        parallel_edges,
    ),
    named(
        "frame_from_uv_triangle_published",
        Rule::NanOutput,
        "return normalize(v);",
        "no_area",
        any,
    ),
    // Summed over the triangles of a vertex: opposite tangents, a tangent along the normal, and what is normalised of them.
    named(
        "frame_from_uv_vertices_published",
        Rule::VanishingSum,
        "sum.tangent += frames[",
        "mirrored_neighbours",
        mirrored,
    ),
    named(
        "frame_from_uv_vertices_published",
        Rule::VanishingSum,
        "let tangent = tangent_sum - normal * dot(normal, tangent_sum);",
        "tangent_along_normal",
        along_the_normal,
    ),
    named(
        "frame_from_uv_vertices_published",
        Rule::Cancellation,
        "let tangent = tangent_sum - normal * dot(normal, tangent_sum);",
        "tangent_along_normal",
        nearly_along_the_normal,
    ),
    named(
        "frame_from_uv_vertices_published",
        Rule::NormaliseZero,
        "return normalize(v);",
        "mirrored_neighbours",
        any,
    ),
    named(
        "frame_from_uv_vertices_published",
        Rule::NanOutput,
        "return normalize(v);",
        "mirrored_neighbours",
        any,
    ),
    // V.z = 0, and what the quotient comes to on the way there.
    named(
        "parallax_offset_published",
        Rule::DivisionByZero,
        "return uv + z * view_dir_ts.xy / view_dir_ts.z;",
        "flat_view",
        any,
    ),
    named(
        "parallax_offset_published",
        Rule::NanOutput,
        "return uv + z * view_dir_ts.xy / view_dir_ts.z;",
        "flat_view",
        any,
    ),
    named(
        "parallax_offset_published",
        Rule::DivisionByZero,
        "return uv + z * view_dir_ts.xy / view_dir_ts.z;",
        "grazing_view",
        any,
    ),
];

/// The defects that are no matter of numbers: technique, case, why.
pub(crate) const FORMULAS: &[(&str, &str, &str)] = &[
    (
        "codec_biased",
        "byte_zero",
        "128 of 127 steps: the code itself says −1.0079",
    ),
    (
        "codec_biased",
        "truncation",
        "a step taken downward; right to the bit, and twice as far off as another step",
    ),
    (
        "codec_octahedral",
        "meridian",
        "the sign of zero is 0 by definition; the answer is exact",
    ),
    ("codec_octahedral", "sign_of_zero", "as before"),
    (
        "codec_unorm",
        "code_mixed",
        "two codes that are not each other's inverse",
    ),
    ("codec_unorm", "no_zero", "no byte stands for 0: the format's"),
    (
        "environment_bump",
        "long_normal",
        "a mirror for unit normals only, evaluated well for others",
    ),
    ("environment_bump", "short_normal", "as before"),
    (
        "frame_from_normal",
        "axes_not_unit",
        "the length is that of the formula",
    ),
    (
        "frame_from_normal",
        "left_handed",
        "the other order of a cross product",
    ),
    ("frame_from_uv", "tangent_not_unit", "never normalised"),
    ("height_to_normal_forward", "axes_swapped", "rows for columns"),
    (
        "height_to_normal_forward",
        "first_order",
        "an approximation, evaluated well",
    ),
    ("normal_mips", "average_not_unit", "the average is what it is"),
    (
        "normal_transform",
        "mirrored_object",
        "a sign that the formula has not",
    ),
    (
        "normal_transform",
        "non_uniform_scale",
        "another matrix than is meant",
    ),
    ("normal_transform", "normal_not_unit", "never normalised"),
    (
        "parallax_offset",
        "view_from_below",
        "the formula's answer for V.z < 0 is finite and exact",
    ),
    ("parallax_offset_limited", "too_short", "a division left out"),
    (
        "parallax_slope_ao",
        "diagonal",
        "a direction that the formula has not",
    ),
    (
        "parallax_slope_ao",
        "long_normal",
        "1 − (n·N)² for |n| > 1, evaluated well",
    ),
    ("parallax_slope_ao", "negative_occlusion", "1 − 40 · 0.04"),
    (
        "parallax_slope_ao",
        "short_normal",
        "1 − (n·N)² for |n| < 1, evaluated well",
    ),
    ("soft_shadow", "bright_ground", "0.6 · (1 + 0.88) + 0.4"),
    ("soft_shadow", "darker_than_black", "0.6 · (1 − 9.36) + 0.4"),
    (
        "wrap_lambert",
        "negative_ambient",
        "a product with a negative occlusion",
    ),
    ("wrap_lambert", "negative_light", "0.5 − 0.5 · 1.5"),
    (
        "wrap_lambert",
        "transparent_light",
        "a product of four components instead of three",
    ),
];
