//! Cube maps, and the normalisation cube map.

use super::{Known, known};

pub(super) const ROWS: &[Known] = &[
    // The table of the specifications: a direction a little off each major axis.
    known("cube_place", &[1.0, 0.5, 0.25], &[0.0, 0.375, 0.25]),
    known("cube_place", &[-1.0, 0.5, 0.25], &[1.0, 0.625, 0.25]),
    known("cube_place", &[0.5, 1.0, 0.25], &[2.0, 0.75, 0.625]),
    known("cube_place", &[0.5, -1.0, 0.25], &[3.0, 0.75, 0.375]),
    known("cube_place", &[0.5, 0.25, 1.0], &[4.0, 0.75, 0.375]),
    known("cube_place", &[0.5, 0.25, -1.0], &[5.0, 0.25, 0.375]),
    known("cube_place", &[0.0, 0.0, 0.0], &[4.0, 0.5, 0.5]),
    // Equally large: y goes before x, z before y.
    known("cube_place", &[1.0, 1.0, 0.5], &[2.0, 1.0, 0.75]),
    known("cube_place", &[-1.0, -1.0, -1.0], &[5.0, 1.0, 1.0]),
    // Too short to have a direction.
    known("cube_place", &[1e-40, -1e-40, 0.0], &[4.0, 0.5, 0.5]),
    known("cube_st", &[1.0, -1.0, 2.0], &[0.75, 0.25]),
    known("cube_point", &[0.0, 0.5, 0.25], &[1.0, -0.25, -0.5]),
    known("cube_point", &[3.0, 0.5, 0.25], &[0.5, -1.0, -0.25]),
    known("cube_point", &[5.0, 0.5, 0.25], &[-0.5, -0.25, -1.0]),
    known(
        "cube_footprint",
        &[0.5, 0.0, 4.0],
        &[1.0, 0.0, 2.0, 0.0, 0.5, 0.5],
    ),
    // 1023/1024 has ten digits, 1025/2048 has eleven.
    known(
        "upper_bits",
        &[1023.0 / 1024.0, 1025.0 / 2048.0],
        &[1023.0 / 1024.0, 0.5],
    ),
    // Two thirds of the way across 16,383 texels: 10921.5 and what 24 digits of 2/3 are off by.
    known(
        "cube_footprint",
        &[0.666_666_7, 0.0, 16_383.0],
        &[10_921.0, 0.0, 10_922.0, 0.0, 0.500_325_500_965_118_4, 0.5],
    ),
    // Beyond the face on either side: the texels at its border.
    known(
        "cube_footprint",
        &[1.5, -0.5, 4.0],
        &[3.0, 0.0, 3.0, 0.0, 0.5, 0.5],
    ),
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
        "normalisation_cube_map_code",
        &[0.0, 0.0, 0.0, 1.0, 255.0],
        &[255.0, 128.0, 128.0],
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
];
