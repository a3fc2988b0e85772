//! The functions of `lib/`.

use super::{IDENTITY, Known, known};

const SMALL: f32 = 1e-25;
const TINY: f32 = 7.888_609e-31;
const HUGE: f32 = 1.267_650_6e30;
const FLAT: [f32; 9] = [1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0];
const FLAT_WITH_X: [f32; 12] = [1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 1.0, 0.0, 0.0];
const FLAT_WITH_Y: [f32; 12] = [1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 1.0, 0.0];

pub(super) const ROWS: &[Known] = &[
    // The saddle 0 1 / 1 0 at (1/4, 1/4): x + y − 2xy = 3/8, slopes 1 − 2y and 1 − 2x.
    known("bilinear", &[0.0, 1.0, 1.0, 0.0, 0.25, 0.25], &[0.375]),
    known(
        "bilinear_gradient",
        &[0.0, 1.0, 1.0, 0.0, 0.25, 0.75],
        &[-0.5, 0.5],
    ),
    known("resolve_edge", &[-1.0, 4.0, 0.0], &[3.0]),
    known("resolve_edge", &[-1.0, 4.0, 1.0], &[0.0]),
    known("resolve_edge", &[4.0, 4.0, 1.0], &[3.0]),
    known("resolve_edge", &[9.0, 4.0, 2.0], &[3.0]),
    // An image without texels has texel 0, whatever the mode.
    known("resolve_edge", &[5.0, 0.0, 0.0], &[0.0]),
    known("resolve_edge", &[-5.0, 0.0, 1.0], &[0.0]),
    known("resolve_edge", &[5.0, 0.0, 2.0], &[0.0]),
    // Another mode clamps.
    known("resolve_edge", &[9.0, 4.0, 3.0], &[3.0]),
    known("resolve_edge", &[-9.0, 4.0, 3.0], &[0.0]),
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
    // A stretch of 2 along x: cof = diag(1, 2, 2), brought to size by ¼ · ½ · ½.
    known(
        "cofactor_direction",
        &[2.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 1.0, 0.0, 1.0],
        &[0.0625, 0.0, 0.125],
    ),
    // An axis 2^200 times as long as another still has its normal.
    known(
        "cofactor_direction",
        &[TINY, 0.0, 0.0, 0.0, HUGE, 0.0, 0.0, 0.0, 1.0, 0.0, 1.0, 0.0],
        &[0.0, 9.860_761_315_262_648e-32, 0.0],
    ),
    // Flattened along y: the plane's normal is what it was, and directions within it are no normals.
    known(
        "cofactor_direction",
        &FLAT_WITH_Y,
        &[0.0, 6.646_139_978_924_58e35, 0.0],
    ),
    known("cofactor_direction", &FLAT_WITH_X, &[0.0, 0.0, 0.0]),
    known(
        "cofactor_direction",
        &[1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0],
        &[0.0, 0.0, 0.0],
    ),
    known("column_factors", &FLAT, &[0.5, 2.658_455_991_569_832e36, 0.5]),
    // Mirrors, however small or large their axes.
    known(
        "mirror_sign",
        &[SMALL, 0.0, 0.0, 0.0, SMALL, 0.0, 0.0, 0.0, -SMALL],
        &[-1.0],
    ),
    known(
        "mirror_sign",
        &[TINY, 0.0, 0.0, 0.0, -HUGE, 0.0, 0.0, 0.0, 1.0],
        &[-1.0],
    ),
    known(
        "mirror_sign",
        &[HUGE, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, -TINY],
        &[-1.0],
    ),
    // No volume, no mirror.
    known("mirror_sign", &FLAT, &[1.0]),
    known("mirror_sign", &IDENTITY, &[1.0]),
    known(
        "mirror_sign",
        &[-1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0],
        &[-1.0],
    ),
    known("largest_component", &[1.0, -3.0, 2.0], &[3.0]),
    known("size_factor", &[1.0], &[0.5]),
    known("size_factor", &[0.999_999_94], &[1.0]),
    known("size_factor", &[0.0], &[8.507_059_173_023_462e37]),
    known("size_factor", &[3.402_823_5e38], &[1.175_494_350_822_287_5e-38]),
    known("sized", &[3.0, -64.0, 64.0, 0.5], &[1.5, -4.0, 4.0]),
    known("to_size", &[3.0, -4.0, 0.5], &[0.375, -0.5, 0.0625]),
    known("to_size", &[0.0, 0.0, 0.0], &[0.0, 0.0, 0.0]),
    known("normalise", &[0.0, 0.0, 0.0], &[0.0, 0.0, 0.0]),
    known("normalise", &[3.0, 0.0, 4.0], &[0.6, 0.0, 0.8]),
    known("normalise", &[0.0, 2e19, 0.0], &[0.0, 1.0, 0.0]),
    known("normalise", &[0.0, 0.0, -1e-23], &[0.0, 0.0, -1.0]),
    known("normalise_published", &[3.0, 0.0, 4.0], &[0.6, 0.0, 0.8]),
    known("elevation", &[1.0, 0.5, -0.25], &[0.25]),
    known("elevation", &[0.5, 0.5, -0.25], &[0.0]),
    known("lambert", &[0.0, 0.0, 1.0, 0.0, 0.0, 1.0], &[1.0]),
    known("lambert", &[0.0, 0.0, 1.0, 0.0, 0.0, -1.0], &[0.0]),
    known("length_of", &[0.0, 3e20, 4e20], &[5e20]),
    known("length_of", &[0.0, 0.0, 0.0], &[0.0]),
];
