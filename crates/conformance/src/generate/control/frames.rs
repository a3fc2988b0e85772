//! Tangent frames: made, combined, transformed.

use super::{Known, known};

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
