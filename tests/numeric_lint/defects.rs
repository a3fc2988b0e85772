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

type Row = (Rule, &'static str, &'static str, fn(&Linted, &Finding));

/// All findings.
pub(crate) fn named() -> impl Iterator<Item = Named> {
    let rows = |&(shader, rows): &(&'static str, &'static [Row])| {
        rows.iter().map(move |&(rule, line, case, shows)| Named {
            shader,
            rule,
            line,
            case,
            shows,
        })
    };
    FINDINGS.iter().flat_map(rows)
}

/// Whether a function or kernel belongs to a technique, or to what all of them stand on.
pub(crate) fn of_technique(shader: &str, technique: &str) -> bool {
    match Probe::find(shader) {
        Some(probe) => probe.technique == technique,
        None => shader.starts_with(technique),
    }
}

// Lines that several defects are named at.
const NORMALIZE: &str = "return normalize(v);";
const POWER: &str = "return pow(saturate(n_dot_h), shininess);";
const OCTAHEDRON: &str = "let p = direction.xy / ";
const ROOT: &str = "return vec3f(xy, sqrt(";
const ACROSS: &str = "let tangent = cross(normal, across);";
const AREA: &str = "let inverse_area = 1.0 / ";
const REJECTED: &str = "let tangent = tangent_sum - normal * dot(normal, tangent_sum);";
const ELEVATION: &str = "return uv + z * view_dir_ts.xy / view_dir_ts.z;";

/// The findings, by function: rule, how the line begins, the defect, and what its witness shows.
const FINDINGS: &[(&str, &[Row])] = &[
    // The zero vector, and lengths below about 1e-19 and beyond about 1e19.
    (
        "normalise_published",
        &[
            (Rule::NormaliseZero, NORMALIZE, "tiny_light", any),
            (Rule::Underflow, NORMALIZE, "tiny_light", tiny),
            (Rule::Overflow, NORMALIZE, "huge_light", huge),
            (Rule::NanOutput, NORMALIZE, "tiny_light", any),
        ],
    ),
    // L = −V.
    (
        "half_vector_published",
        &[
            (
                Rule::VanishingSum,
                "return normalise_published(light_dir + view_dir);",
                "opposite_light",
                opposite,
            ),
            (Rule::NormaliseZero, NORMALIZE, "opposite_light", opposite),
            (Rule::NanOutput, NORMALIZE, "opposite_light", opposite),
        ],
    ),
    (
        "blinn_phong_published",
        &[
            (Rule::NormaliseZero, NORMALIZE, "opposite_light", any),
            // pow(0, p).
            (Rule::PowerDomain, POWER, "zero_to_the_zeroth", any),
        ],
    ),
    (
        "highlight_power_published",
        &[(Rule::PowerDomain, POWER, "zero_to_the_zeroth", any)],
    ),
    // The sum of the magnitudes is zero.
    (
        "codec_octahedral_encode_published",
        &[
            (Rule::DivisionByZero, OCTAHEDRON, "no_direction", any),
            (Rule::NanOutput, OCTAHEDRON, "no_direction", any),
        ],
    ),
    // x² + y² > 1.
    (
        "codec_two_channel_decode_published",
        &[
            (Rule::RootDomain, ROOT, "outside_the_circle", any),
            (Rule::NanOutput, ROOT, "outside_the_circle", any),
        ],
    ),
    // L = 0, and its length. NaN is clamped to 0.
    (
        "dot3_published",
        &[
            (Rule::NormaliseZero, NORMALIZE, "zero_light", any),
            (Rule::Overflow, NORMALIZE, "zero_light", any),
        ],
    ),
    (
        "light_to_colour_published",
        &[
            (Rule::NormaliseZero, NORMALIZE, "zero_light", any),
            (Rule::Overflow, NORMALIZE, "zero_light", any),
            (Rule::NanOutput, NORMALIZE, "zero_light", any),
        ],
    ),
    // N ∝ (−1, 1, 1): the helper axis is parallel to the normal; and beside it.
    (
        "frame_from_normal_unit_published",
        &[
            (Rule::VanishingSum, ACROSS, "axis_parallel", on_the_axis),
            (Rule::NormaliseZero, NORMALIZE, "axis_parallel", on_the_axis),
            (Rule::NanOutput, NORMALIZE, "axis_parallel", on_the_axis),
            (Rule::Cancellation, ACROSS, "axis_near", beside_the_axis),
        ],
    ),
    // 1 + n.z near −z.
    (
        "frame_frisvad_published",
        &[(
            Rule::Cancellation,
            "let a = 1.0 / (1.0 + normal.z);",
            "frisvad_near_minus_z",
            near_minus_z,
        )],
    ),
    // A triangle without texture area, one whose texture area is rounding, one without area.
    (
        "frame_from_uv_triangle_published",
        &[
            (Rule::DivisionByZero, AREA, "no_texture_area", any),
            (Rule::VanishingSum, AREA, "no_texture_area", any),
            (Rule::NanOutput, "let tangent = ", "no_texture_area", any),
            (Rule::Cancellation, AREA, "quantised_texture", collinear),
            (Rule::NormaliseZero, NORMALIZE, "no_area", any),
            (
                Rule::VanishingSum,
                "return TriangleFrame(normalise_published(cross(p, q))",
                "no_area",
                parallel_edges,
            ),
            (Rule::NanOutput, NORMALIZE, "no_area", any),
        ],
    ),
    // Summed over the triangles of a vertex: opposite tangents, a tangent along the normal, and what is normalised of them.
    (
        "frame_from_uv_vertices_published",
        &[
            (
                Rule::VanishingSum,
                "sum.tangent += frames[",
                "mirrored_neighbours",
                mirrored,
            ),
            (
                Rule::VanishingSum,
                REJECTED,
                "tangent_along_normal",
                along_the_normal,
            ),
            (
                Rule::Cancellation,
                REJECTED,
                "tangent_along_normal",
                nearly_along_the_normal,
            ),
            (Rule::NormaliseZero, NORMALIZE, "mirrored_neighbours", any),
            (Rule::NanOutput, NORMALIZE, "mirrored_neighbours", any),
        ],
    ),
    // V.z = 0, and what the quotient comes to on the way there.
    (
        "parallax_offset_published",
        &[
            (Rule::DivisionByZero, ELEVATION, "flat_view", any),
            (Rule::NanOutput, ELEVATION, "flat_view", any),
            (Rule::DivisionByZero, ELEVATION, "grazing_view", any),
        ],
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
