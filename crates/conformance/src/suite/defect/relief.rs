//! Defects of height fields, their normals and levels, and of relief.

use super::property::{a_share, ensure, level, not_negative, unit, within_a_tile};
use super::{Defect, Evidence};

pub(super) const ROWS: &[Defect] = &[
    Defect {
        name: "first_order",
        published: "height_to_normal_forward_published",
        hardened: Some("height_to_normal"),
        // The bottom of a trough: both neighbours one step higher, on either side.
        witness: &[0.0, 1.0, 1.0, 1.0],
        cured_witness: Some(&[1.0, 1.0, 1.0, 1.0, 0.5, 0.5]),
        property: |out| {
            ensure(out[2] == 1.0, || {
                format!("the bottom of a trough has the normal {out:?}")
            })
        },
        evidence: Evidence::Output,
        about: "one-sided differences are of first order: the bottom of a trough slopes",
        cure: "central differences: level, and of second order",
    },
    Defect {
        name: "axes_swapped",
        published: "height_to_normal_forward_published",
        hardened: Some("height_to_normal_forward"),
        // A rise to the next column, none to the next row.
        witness: &[0.0, 0.0, 1.0, 1.0],
        cured_witness: Some(&[0.0, 1.0, 0.0, 1.0, 1.0]),
        property: |out| {
            ensure(out[0] < 0.0 && out[1] == 0.0, || {
                format!("a slope along u gives ({}, {})", out[0], out[1])
            })
        },
        evidence: Evidence::Output,
        about: "the first axis is the row: a slope along u lands in green",
        cure: "red along u, green along v",
    },
    Defect {
        name: "average_not_unit",
        published: "normal_mips_published",
        hardened: Some("normal_mips"),
        witness: &[0.0, 0.0, 0.6],
        cured_witness: None,
        property: unit,
        evidence: Evidence::Output,
        about: "the average of normals that differ is shorter than 1, and is written as it is",
        cure: "normalised; the length is at hand beside it",
    },
    Defect {
        name: "flat_view",
        published: "parallax_offset_published",
        hardened: Some("parallax_offset"),
        witness: &[0.5, 0.5, 0.02, 1.0, 0.0, 0.0],
        cured_witness: None,
        property: within_a_tile,
        evidence: Evidence::Output,
        about: "at V.z = 0 the shift is infinite",
        cure: "V.z counts as 0.05: at most 20 elevations",
    },
    Defect {
        name: "grazing_view",
        published: "parallax_offset_published",
        hardened: Some("parallax_offset"),
        witness: &[0.5, 0.5, 0.02, 1.0, 0.0, 1e-4],
        cured_witness: None,
        property: within_a_tile,
        evidence: Evidence::Output,
        about: "the shift grows without bound as V.z goes to 0: here 200 tiles",
        cure: "V.z counts as 0.05: at most 20 elevations",
    },
    Defect {
        name: "view_from_below",
        published: "parallax_offset_published",
        hardened: Some("parallax_offset"),
        witness: &[0.5, 0.5, 0.02, 0.8, 0.0, -0.6],
        cured_witness: None,
        property: |out| {
            ensure(out[0] >= 0.5, || {
                format!("a view along +u shifts to {}, along −u", out[0])
            })
        },
        evidence: Evidence::Output,
        about: "for V.z < 0 the shift turns round",
        cure: "V.z counts as 0.05: the shift keeps its direction",
    },
    Defect {
        name: "too_short",
        published: "parallax_offset_limited",
        hardened: Some("parallax_offset"),
        witness: &[0.5, 0.5, 0.02, 0.866_025_4, 0.0, 0.5],
        cured_witness: None,
        property: |out| {
            let due = 0.02 * 0.866_025_4 / 0.5;
            ensure((out[0] - 0.5 - due).abs() < 1e-5, || {
                format!("at 60° the shift is {} of {due}", out[0] - 0.5)
            })
        },
        evidence: Evidence::Output,
        about: "left out, the division by V.z halves the shift at 60°: the price of the bound",
        cure: "parallax_offset divides by V.z",
    },
    Defect {
        name: "diagonal",
        published: "parallax_slope_ao",
        hardened: Some("parallax_slope_ao_directed"),
        witness: &[0.5, 0.5, 0.02],
        cured_witness: Some(&[0.5, 0.5, 0.6, 0.0, 0.8, 0.02]),
        property: |out| {
            ensure(out[1] == 0.5, || {
                format!("an eye along +u shifts the texture to {out:?}")
            })
        },
        evidence: Evidence::Output,
        about: "the shift runs along the diagonal of the texture wherever the eye is",
        cure: "the shift follows V.xy",
    },
    Defect {
        name: "long_normal",
        published: "parallax_slope_ao_delta_published",
        hardened: Some("parallax_slope_ao_delta"),
        witness: &[0.0, 0.0, 1.2, 0.0, 0.0, 1.0, 0.0, 0.0, 1.0, 1.0, 0.04],
        cured_witness: None,
        property: level,
        evidence: Evidence::Output,
        about: "|n| > 1 makes f₁ negative: level ground is shifted backward",
        cure: "unit n: level ground stays",
    },
    Defect {
        name: "short_normal",
        published: "parallax_slope_ao_delta_published",
        hardened: Some("parallax_slope_ao_delta"),
        witness: &[0.0, 0.0, 0.5, 0.0, 0.0, 1.0, 0.0, 0.0, 1.0, 1.0, 0.04],
        cured_witness: None,
        property: level,
        evidence: Evidence::Output,
        about: "|n| < 1 makes level ground slope",
        cure: "unit n: level ground stays",
    },
    Defect {
        name: "negative_occlusion",
        published: "slope_occlusion_published",
        hardened: Some("slope_occlusion"),
        witness: &[0.04, 40.0],
        cured_witness: None,
        property: not_negative,
        evidence: Evidence::Output,
        about: "the occlusion falls to −0.6",
        cure: "clamped to [0, 1]",
    },
    Defect {
        name: "bright_ground",
        published: "soft_shadow_light_published",
        hardened: Some("seen_share"),
        // Level ground: the greatest of the seven is −0.88 · 1. Its horizon is 0.
        witness: &[-0.88],
        cured_witness: Some(&[0.0, 0.25]),
        property: a_share,
        evidence: Evidence::Output,
        about: "a shadow below 0 is not cut: level ground is brightened to 1.53",
        cure: "the share of the light over the horizon, at most 1",
    },
    Defect {
        name: "darker_than_black",
        published: "soft_shadow_light_published",
        hardened: Some("seen_share"),
        // A wall as high as the layer at the first sample: (1 − 0.22) · 12. Its horizon is 1 / 0.22.
        witness: &[9.36],
        cured_witness: Some(&[4.545_454_5, 0.25]),
        property: a_share,
        evidence: Evidence::Output,
        about: "a weighted shadow goes beyond 1: the foot of a wall is lit by −4.6",
        cure: "the share of the light over the horizon, at least 0",
    },
];
