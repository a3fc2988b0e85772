//! Height fields: their normals, their levels, and relief.

use super::{HALF_ROOT, Known, known};

pub(super) const ROWS: &[Known] = &[
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
    // A ramp has its slope, whatever the order: 8·(1/4) − 1/2 = 3/2. A step between the two texels beside is 8 of 12.
    known(
        "height_to_normal_fourth_order",
        &[0.0, 0.125, 0.375, 0.5, 0.5, 0.5, 0.5, 0.5, 0.5, 0.5],
        &[-0.6, 0.0, 0.8],
    ),
    known(
        "height_to_normal_fourth_order",
        &[0.5, 0.5, 0.5, 0.5, 0.25, 0.25, 0.375, 0.25, 1.0, 1.0],
        &[0.0, -HALF_ROOT, HALF_ROOT],
    ),
    known("mip_shares", &[0.0, 1.0], &[1.0, 0.0, 0.0]),
    known("mip_shares", &[3.0, 8.0], &[0.5, 0.5, 0.0]),
    // 5 texels over 2: (1, 1, 1/2) and (1/2, 1, 1), times 2/5.
    known("mip_shares", &[0.0, 5.0], &[0.4, 0.4, 0.2]),
    known("mip_shares", &[1.0, 5.0], &[0.2, 0.4, 0.4]),
    known("normal_mips", &[0.375, 0.0, 0.5], &[0.6, 0.0, 0.8]),
    known("normal_mips", &[0.0, 0.0, 0.0], &[0.0, 0.0, 1.0]),
    // The shortest average that has a direction.
    known("normal_mips", &[f32::MIN_POSITIVE, 0.0, 0.0], &[1.0, 0.0, 0.0]),
    known("normal_mips_published", &[0.375, 0.0, 0.5], &[0.375, 0.0, 0.5]),
    known("normal_mips_bytes", &[0.0, 0.0, 0.5, 0.0], &[128.0, 128.0, 255.0]),
    known("normal_mips_bytes", &[-0.25, 0.0, 0.0, 1.0], &[1.0, 128.0, 128.0]),
    known("normal_mips_decode", &[0.0, 51.0, 255.0, 0.0], &[-1.0, -0.6, 1.0]),
    known("normal_mips_decode", &[0.0, 128.0, 255.0, 1.0], &[-1.0, 0.0, 1.0]),
    known("normal_mips_length", &[0.375, 0.0, 0.5], &[0.625]),
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
];
