//! Shading the perturbed normal.

use super::{HALF_ROOT, Known, known};

pub(super) const ROWS: &[Known] = &[
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
    // Normals that are not unit count as unit, exponents below 0 as 0; the smallest normal float has its power.
    known("highlight_power", &[2.0, 3.0], &[1.0]),
    known("highlight_power", &[0.5, -1.0], &[1.0]),
    known(
        "highlight_power",
        &[f32::MIN_POSITIVE, 0.5],
        &[1.084_202_172_485_504_4e-19],
    ),
    known("highlight_power_published", &[2.0, 3.0], &[1.0]),
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
    // A target of bytes keeps no more than 1 and no less than 0.
    known("quantise_unorm8", &[1.5, -0.5, 0.25], &[1.0, 0.0, 64.0 / 255.0]),
    // I = 1/2 is kept as 128/255, and that times 1/4 as 32/255.
    known(
        "dot3_two_pass",
        &[0.5, 0.5, 1.0, 0.75, 0.5, 0.75, 1.0, 0.25, 0.0],
        &[128.0 / 255.0, 32.0 / 255.0, 0.0],
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
    // A light three times too long, from behind: no light, not less.
    known(
        "wrap_lambert_factor",
        &[1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, -3.0],
        &[0.0],
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
