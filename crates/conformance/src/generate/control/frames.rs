//! Tangent frames: made, combined, transformed.

use super::{HALF_ROOT, Known, known};

/// Texture coordinates whose difference is 6·2⁻²³ and whose sum is 3/1.005: just told from rounding.
const NOISE_ABOVE: f32 = 1.492_537_6;
const NOISE_BELOW: f32 = 1.492_536_9;
/// 2⁻³³, 2⁻⁹³ and 2⁻¹⁰⁰, and the area of two edges of the first.
const P33: f32 = 1.164_153_2e-10;
const P93: f32 = 1.009_742e-28;
const P100: f32 = 7.888_609e-31;
const AREA66: f64 = 1.355_252_715_606_880_5e-20;

pub(super) const ROWS: &[Known] = &[
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
    // The last z before the constant frame, 2⁻²³ above −1: a = 2²³, 1 − x² a = −1.
    known(
        "frame_frisvad_published",
        &[0.000_488_281_25, 0.0, -0.999_999_9],
        &[-1.0, 0.0, -0.000_488_281_25, 0.0, 1.0, -0.0],
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
    // Texture edges (s₁, 1) and (s₂, 1) with s₁ − s₂ = 6·2⁻²³, which is ½ % more than the noise of their products, 2⁻²² (s₁ + s₂):
    // a share. T = (P − Q) and B = s₁ Q − s₂ P, turned by the sign of the area and made unit, s₁ and s₂ being equal to 5e-7.
    known(
        "frame_from_uv_triangle",
        &[1.0, 0.0, 0.0, 0.0, 1.0, 0.0, NOISE_ABOVE, 1.0, NOISE_BELOW, 1.0],
        &[
            0.0,
            0.0,
            1.0,
            HALF_ROOT,
            -HALF_ROOT,
            0.0,
            -0.707_106_611_756_190_2,
            0.707_106_950_616_864_3,
            0.0,
            1.0,
        ],
    ),
    // The same with products of both signs, larger on either side, and less than the noise: no share.
    known(
        "frame_from_uv_triangle",
        &[1.0, 0.0, 0.0, 0.0, 1.0, 0.0, -1.5, 1.0, -1.500_000_5, 1.0],
        &[0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0],
    ),
    known(
        "frame_from_uv_triangle",
        &[1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 1.500_000_5, 1.0, 1.5, 1.0],
        &[0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0],
    ),
    // T is too short to have a direction, or B is: 2⁻¹³³, while the other one and both areas are not. No share.
    known(
        "frame_from_uv_triangle",
        &[P33, 0.0, 0.0, 0.0, P33, 0.0, 1.0, 0.0, 0.0, P100],
        &[0.0, 0.0, AREA66, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0],
    ),
    known(
        "frame_from_uv_triangle",
        &[P33, 0.0, 0.0, 0.0, P33, 0.0, P100, 0.0, 0.0, 1.0],
        &[0.0, 0.0, AREA66, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0],
    ),
    // 2⁻¹²⁶ is just long enough.
    known(
        "frame_from_uv_triangle",
        &[P33, 0.0, 0.0, 0.0, P33, 0.0, 1.0, 0.0, 0.0, P93],
        &[0.0, 0.0, AREA66, AREA66, 0.0, 0.0, 0.0, AREA66, 0.0, AREA66],
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
    // Mirrored along x, the image of B = y is y.
    known(
        "bitangent_transform",
        &[
            -1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 1.0, 1.0, 0.0, 0.0, 1.0,
        ],
        &[0.0, 1.0, 0.0],
    ),
    known(
        "bitangent_transform_published",
        &[
            2.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 1.0, 1.0, 0.0, 0.0, -1.0,
        ],
        &[0.0, -2.0, 0.0],
    ),
    known(
        "tangent_transform",
        &[3.0, 0.0, 4.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 1.0, 0.0, 0.0],
        &[0.6, 0.0, 0.8],
    ),
];
