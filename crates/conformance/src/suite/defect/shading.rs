//! Defects of shading the perturbed normal.

use super::property::{ensure, finite, not_negative, unit};
use super::{Defect, Evidence};

pub(super) const ROWS: &[Defect] = &[
    Defect {
        name: "opposite_light",
        published: "half_vector_published",
        hardened: Some("half_vector"),
        witness: &[1.0, 0.0, 0.0, -1.0, 0.0, 0.0],
        cured_witness: None,
        property: finite,
        evidence: Evidence::Output,
        about: "L = −V makes the half vector 0/0",
        cure: "no half vector: zero",
    },
    Defect {
        name: "opposite_light",
        published: "blinn_phong_published",
        hardened: Some("blinn_phong"),
        witness: &[
            0.6, 0.0, 0.8, 1.0, 0.0, 0.0, -1.0, 0.0, 0.0, 0.5, 0.5, 0.5, 1.0, 1.0, 1.0, 16.0,
        ],
        cured_witness: None,
        property: |out| {
            let diffuse = 0.3;
            ensure(out.iter().all(|c| (c - diffuse).abs() < 1e-5), || {
                format!("without a half vector only the diffuse 0.3 is due, not {out:?}")
            })
        },
        evidence: Evidence::Rules,
        about: "L = −V makes the highlight pow(NaN, p): the diffuse colour may be lost or a full highlight appear",
        cure: "no highlight, the diffuse term stays",
    },
    Defect {
        name: "zero_to_the_zeroth",
        published: "highlight_power_published",
        hardened: Some("highlight_power"),
        witness: &[0.0, 0.0],
        cured_witness: None,
        property: |out| {
            ensure(out[0] == 0.0, || {
                format!(
                    "a surface that the half vector does not face shines with {}",
                    out[0]
                )
            })
        },
        evidence: Evidence::Rules,
        about: "pow(0, 0) is left open by the language",
        cure: "no highlight where N·H ≤ 0",
    },
    Defect {
        name: "zero_light",
        published: "dot3_published",
        hardened: Some("dot3"),
        witness: &[0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 1.0, 1.0],
        cured_witness: None,
        property: |out| {
            ensure(out.iter().all(|c| *c == 0.0), || {
                format!("no light gives {out:?}")
            })
        },
        evidence: Evidence::Rules,
        about: "L = 0 is normalised to 0/0",
        cure: "no direction, no light",
    },
    Defect {
        name: "zero_light",
        published: "light_to_colour_published",
        hardened: Some("light_to_colour"),
        witness: &[0.0, 0.0, 0.0],
        cured_witness: None,
        property: finite,
        evidence: Evidence::Output,
        about: "L = 0 is normalised to 0/0 before it becomes a colour",
        cure: "the colour of no direction, (½, ½, ½)",
    },
    Defect {
        name: "short_normal",
        published: "environment_bump_published",
        hardened: Some("environment_bump"),
        witness: &[0.6, 0.0, 0.8, 0.0, 0.0, 0.5],
        cured_witness: None,
        property: |out| {
            ensure(out[2] > 0.0, || {
                format!("the view is mirrored to {out:?}, into the surface")
            })
        },
        evidence: Evidence::Output,
        about: "a filtered normal of length 1/2 mirrors the view into the surface",
        cure: "unit N: mirrored outward",
    },
    Defect {
        name: "long_normal",
        published: "environment_bump_published",
        hardened: Some("environment_bump"),
        witness: &[0.6, 0.0, 0.8, 0.0, 0.0, 1.5],
        cured_witness: None,
        property: unit,
        evidence: Evidence::Output,
        about: "a normal that is too long makes no mirror: the reflected vector is as long as 2.9",
        cure: "unit N: a mirror keeps the length",
    },
    Defect {
        name: "negative_light",
        published: "wrap_lambert_factor_published",
        hardened: Some("wrap_lambert_factor"),
        witness: &[1.0, 0.0, 0.0, 0.0, 1.5, 0.0, 0.0, -1.0],
        cured_witness: None,
        property: not_negative,
        evidence: Evidence::Output,
        about: "a long normal gives negative light on the far side",
        cure: "unit N: the factor is not below 0",
    },
    Defect {
        name: "negative_ambient",
        published: "wrap_lambert_factor_published",
        hardened: Some("wrap_lambert_factor"),
        witness: &[-0.6, 0.5, 0.0, 0.0, 1.0, 0.0, 0.0, -1.0],
        cured_witness: None,
        property: not_negative,
        evidence: Evidence::Output,
        about: "an occlusion of −0.6 takes away light that was never there",
        cure: "occlusion and factor clamped at 0",
    },
    Defect {
        name: "transparent_light",
        published: "wrap_lambert_published",
        hardened: Some("wrap_lambert"),
        witness: &[0.0, 1.0, 1.0, 1.0, 1.0, 1.0, 0.5, 0.25, 1.0],
        cured_witness: Some(&[0.0, 1.0, 1.0, 1.0, 1.0, 0.5, 0.25, 1.0]),
        property: |out| {
            ensure(out[3] == 1.0, || {
                format!("an opaque surface leaves with alpha {}", out[3])
            })
        },
        evidence: Evidence::Output,
        about: "the light scales alpha: an opaque surface in the dark is transparent",
        cure: "alpha is the surface's",
    },
];
