//! The parts of searches along a view ray.

use super::{HALF_ROOT, Known, known};

pub(super) const ROWS: &[Known] = &[
    // A layer of 1/2 that hangs below the polygon, seen at 45°: it is entered at the polygon, and crossed by 1/2 away from the eye.
    known(
        "relief_ray",
        &[0.25, 0.5, HALF_ROOT as f32, 0.0, HALF_ROOT as f32, 0.5, -0.5, 1.0],
        &[0.25, 0.5, -0.5, 0.0, 0.0],
    ),
    // Half above: entered 1/4 nearer to the eye. Tiles twice as wide as high: along v all counts twice.
    known(
        "relief_ray",
        &[0.0, 0.0, 0.0, HALF_ROOT as f32, HALF_ROOT as f32, 0.5, -0.25, 2.0],
        &[0.0, 0.5, 0.0, -1.0, 0.0],
    ),
    // From the side and from below: as flat as it gets, 20 thicknesses, and said so.
    known(
        "relief_ray",
        &[0.0, 0.0, 1.0, 0.0, 0.0, 0.5, -0.5, 1.0],
        &[0.0, 0.0, -10.0, 0.0, 1.0],
    ),
    known(
        "relief_ray",
        &[0.0, 0.0, 0.0, 0.0, -1.0, 0.5, 0.0, 1.0],
        &[0.0, 0.0, 0.0, 0.0, 1.0],
    ),
    known("is_finite", &[0.0, -1.0, f32::MAX], &[1.0]),
    known("step_count", &[0.0], &[1.0]),
    known("step_count", &[64.0], &[64.0]),
    known("step_count", &[5000.0], &[4096.0]),
    // Four texels along x, half a texel along y.
    known("relief_level", &[0.25, 0.0, 0.0, 0.03125, 16.0, 16.0], &[2.0]),
    known("relief_level", &[0.0, 0.0, 0.0, 0.0, 16.0, 16.0], &[0.0]),
    known("secant_share", &[-0.25, 0.75], &[0.25]),
    known("secant_share", &[-0.25, 0.0], &[1.0]),
    // The floor.
    known("secant_share", &[-0.25, -0.125], &[1.0]),
    known("march_gap", &[0.75, 0.5], &[0.25]),
    known("march_gap", &[0.25, 0.5], &[-0.25]),
    known("lower_end", &[0.75, 0.5, 0.125], &[0.5]),
    known("lower_end", &[0.75, 0.5, 0.0], &[0.5]),
    known("lower_end", &[0.75, 0.5, -0.125], &[0.75]),
    // Three quarters of a tile of 4 texels along v are 3 of 8 texels: the longer side is along u.
    known("cone_reach", &[0.0, 0.75, 8.0, 4.0], &[0.375]),
    known("cone_reach", &[0.375, -0.5, 8.0, 8.0], &[0.625]),
    known("cone_reach", &[0.0, 0.0, 8.0, 4.0], &[0.0]),
    known("cone_advance", &[0.5, 0.25, 0.75], &[0.125]),
    known("cone_advance", &[0.5, 0.25, 0.0], &[0.5]),
    known("cone_advance", &[0.5, 0.0, 0.75], &[0.0]),
    known("cone_advance", &[0.0, 0.25, 0.75], &[0.0]),
    known("toward_surface", &[0.25, 0.5], &[0.25]),
    known("toward_surface", &[0.25, -0.5], &[-0.25]),
    known("toward_surface", &[0.25, 0.0], &[-0.25]),
    known("iterative_step", &[0.75, 0.25, 0.5], &[0.25]),
    known("iterative_step", &[-0.25, 0.25, 0.5], &[-0.25]),
    // L at 45° over a layer of 1/2; a light in the surface counts as one at 0.05.
    known(
        "light_rise",
        &[HALF_ROOT as f32, 0.0, HALF_ROOT as f32, 0.5, 0.0, 1.0],
        &[0.5, 0.0],
    ),
    known("light_rise", &[0.0, 1.0, 0.0, 0.5, 0.0, 2.0], &[0.0, 20.0]),
    known("seen_share", &[1.0, 0.25], &[0.5]),
    known("seen_share", &[1.125, 0.25], &[0.25]),
    known("seen_share", &[-1.0, 0.25], &[1.0]),
    known("seen_share", &[9.0, 0.25], &[0.0]),
    // Level ground is brightened: −0.88 of the last sample.
    known(
        "soft_shadow_sample_published",
        &[0.5, 0.5, 0.875, 1.0, 1.0],
        &[-0.875],
    ),
    // 1.875 · 0.6 + 0.4 with the listing's numbers, which are those of f32; and its 0.4 alone.
    known("soft_shadow_light_published", &[-0.875], &[1.525_000_050_663_948]),
    known("soft_shadow_light_published", &[1.0], &[0.400_000_005_960_464_5]),
    // Half-way down a layer of 1/4 that hangs below the polygon, on tiles two units wide, seen at (0.6, 0, 0.8).
    known(
        "relief_place",
        &[1.0, 2.0, 0.0, 0.6, 0.0, 0.8, 0.8, 0.5, 0.0, 0.25, -0.25, 1.0, 2.0],
        &[0.8125, 2.0, -0.25],
    ),
    // From the side: as for V.z = 0.05.
    known(
        "relief_place",
        &[0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.5, 1.0, 0.25, -0.25, 1.0, 1.0],
        &[-2.5, 0.0, 0.0],
    ),
    known(
        "relief_place",
        &[1.0, 2.0, 3.0, 0.6, 0.0, 0.8, 0.8, 0.5, 3.0, 0.25, -0.25, 1.0, 2.0],
        &[1.0, 2.0, 3.0],
    ),
    // z = 1/2 − z, w = 2 − z at z = 1/4.
    known(
        "pixel_depth",
        &[5.0, 6.0, 0.25, 0.0, 0.0, -1.0, 0.5, 0.0, 0.0, -1.0, 2.0],
        &[1.0 / 7.0],
    ),
    known(
        "pixel_depth",
        &[5.0, 6.0, 0.25, 0.0, 0.0, -1.0, 0.5, 0.0, 0.0, 1.0, -0.25],
        &[1.0],
    ),
    // Level ground at 1/4 below a ray at the height 3/4.
    known(
        "patch_along",
        &[0.25, 0.25, 0.25, 0.25, 0.5, 0.5, 3.0, 4.0, 0.25],
        &[-0.5, 1.0, 0.0],
    ),
    // The saddle 0 1 / 1 0 from its first corner: 2 s + 1 along x and y, and −2 s² of the twist.
    known(
        "patch_along",
        &[0.0, 1.0, 1.0, 0.0, 0.0, 0.0, 1.0, 1.0, 0.0],
        &[-1.0, 3.0, -2.0],
    ),
    known(
        "patch_along",
        &[0.0, 1.0, 0.0, 1.0, 0.5, 0.25, 2.0, 1.0, 0.5],
        &[0.0, 3.0, 0.0],
    ),
    // A ray that starts on its way up a slope of one, half a height under the corner that it nears: 1/4 over it at the end.
    known(
        "patch_along",
        &[0.0, 1.0, 0.0, 1.0, 0.5, 0.0, 1.0, 0.0, 0.25],
        &[-0.25, 2.0, 0.0],
    ),
    // −1/4 + s.
    known("is_met", &[-0.25, 1.0, 0.0, 1.0], &[1.0]),
    known("is_met", &[-0.25, 1.0, 0.0, 0.25], &[1.0]),
    known("is_met", &[-0.25, 1.0, 0.0, 0.125], &[0.0]),
    // −3/16 + s − s²: over the surface between 1/4 and 3/4, and not at either end.
    known("is_met", &[-0.1875, 1.0, -1.0, 1.0], &[1.0]),
    known("is_met", &[-0.1875, 1.0, -1.0, 0.125], &[0.0]),
    // Its summit lies beyond the end, or under the ray.
    known("is_met", &[-0.25, 0.5, -0.25, 0.5], &[0.0]),
    known("is_met", &[-0.5, 1.0, -1.0, 1.0], &[0.0]),
    known("is_met", &[0.0, -1.0, 0.0, 1.0], &[1.0]),
    known("is_met", &[-0.5, -0.5, -1.0, 1.0], &[0.0]),
    known("first_root", &[-0.25, 1.0, 0.0, 1.0], &[0.25]),
    known("first_root", &[-0.25, 1.0, 0.0, 0.125], &[0.125]),
    // −1/4 + s²: a half, from ground that begins level.
    known("first_root", &[-0.25, 0.0, 1.0, 1.0], &[0.5]),
    // −3/16 − s/2 + s²: falls away first, and comes back at 3/4.
    known("first_root", &[-0.1875, -0.5, 1.0, 1.0], &[0.75]),
    known("first_root", &[-0.1875, -0.5, 1.0, 0.625], &[0.625]),
    // −3/16 + s − s²: the first of 1/4 and 3/4.
    known("first_root", &[-0.1875, 1.0, -1.0, 1.0], &[0.25]),
    // Never, and not at 4/5 either, where a discriminant that is cut off at 0 would put it.
    known("first_root", &[-0.5, 1.25, -1.0, 1.0], &[1.0]),
    known("first_root", &[-0.5, -0.5, -1.0, 1.0], &[1.0]),
    known("first_root", &[-0.5, 0.0, 0.0, 1.0], &[1.0]),
    // On or above the surface already.
    known("first_root", &[0.0, -1.0, 0.0, 1.0], &[0.0]),
    known("first_root", &[0.5, 1.0, 1.0, 0.0], &[0.0]),
];
