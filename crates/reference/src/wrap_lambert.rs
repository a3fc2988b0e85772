//! `wrap_lambert`: diffuse light that wraps round to the far side, with ambient light and a cut-out:
//! colour = 0.75 · min(ao·ambient + 0.5 (N·L) + 0.5, 2) · C_L · C_surface, discarded where the surface's alpha is below 0.01.
//!
//! Source: the second article, *Parallax Mapping + Ambient Occlusion*, the end of its fragment shader. Spaces: N and L in one
//! space, L the unit vector toward the light (`negLightDir`). Colours linear.
//!
//! Known faults of the published form:
//! - N is not normalised after decoding and filtering, so a long N lights beyond the model and, on the far side, gives
//!   negative light; an `ao` of −0.6 (see `parallax_slope_ao`) takes light away that was never there;
//! - the factor scales alpha too: an opaque surface leaves with alpha 0.75·(…), anything from 0 to 1.5.
//!
//! Hardened: unit N (a zero N counts as facing neither way), `ao` in [0, 1], the factor not below 0, alpha left alone.

use glam::{DVec3, DVec4};

use crate::surface::Fragment;
use crate::vector::{normalize_or_zero, saturate};

/// Alpha below this is cut out.
pub const ALPHA_CUTOFF: f64 = 0.01;

/// 0.75·min(ao·ambient + 0.5·n·l + 0.5, 2) as published: negative for n·l < −1 − 2·ao·ambient.
#[must_use]
pub fn factor_published(ambient_occlusion: f64, ambient: f64, normal: DVec3, light: DVec3) -> f64 {
    0.75 * (ambient_occlusion * ambient + 0.5 * normal.dot(light) + 0.5).min(2.0)
}

/// The factor, hardened: in [0, 1.5] whatever N, for ambient light that is not negative.
#[must_use]
pub fn factor_hardened(ambient_occlusion: f64, ambient: f64, normal: DVec3, light: DVec3) -> f64 {
    let wrapped = 0.5 * normalize_or_zero(normal).dot(light) + 0.5;
    0.75 * (saturate(ambient_occlusion) * ambient + wrapped).clamp(0.0, 2.0)
}

/// Whether a surface of that alpha is cut out. The cutoff is an f32 in every shader.
#[must_use]
pub fn is_hole(alpha: f64) -> bool {
    alpha < f64::from(ALPHA_CUTOFF as f32)
}

/// As published: colour and alpha times the factor.
#[must_use]
pub fn color_published(factor: f64, light_color: DVec4, surface: DVec4) -> DVec4 {
    factor * light_color * surface
}

/// Hardened: the surface keeps its alpha.
#[must_use]
pub fn color_hardened(factor: f64, light_color: DVec3, surface: DVec4) -> DVec4 {
    (factor * light_color * surface.truncate()).extend(surface.w)
}

/// As published, holes cut out.
#[must_use]
pub fn published(factor: f64, light_color: DVec4, surface: DVec4) -> Fragment {
    if is_hole(surface.w) {
        return Fragment::Discarded;
    }
    Fragment::Color(color_published(factor, light_color, surface))
}

/// Hardened, holes cut out.
#[must_use]
pub fn hardened(factor: f64, light_color: DVec3, surface: DVec4) -> Fragment {
    if is_hole(surface.w) {
        return Fragment::Discarded;
    }
    Fragment::Color(color_hardened(factor, light_color, surface))
}

#[cfg(test)]
mod tests {
    use glam::{DVec3, DVec4};

    use super::{factor_hardened, factor_published, hardened, published};
    use crate::surface::Fragment;

    #[test]
    fn facing_across_and_away() {
        for factor in [factor_published, factor_hardened] {
            assert_eq!(factor(1.0, 0.0, DVec3::Z, DVec3::Z), 0.75);
            assert_eq!(factor(1.0, 0.0, DVec3::Z, DVec3::X), 0.375);
            assert_eq!(factor(1.0, 0.0, DVec3::Z, -DVec3::Z), 0.0);
            assert_eq!(factor(0.5, 0.5, DVec3::Z, DVec3::Z), 0.9375);
            // min(…, 2).
            assert_eq!(factor(1.0, 9.0, DVec3::Z, DVec3::Z), 1.5);
        }
    }

    #[test]
    fn witness_negative_light() {
        // Real maps hold normals up to 1.5 long: 0.75·(0.5 − 0.75) = −0.1875.
        assert_eq!(factor_published(1.0, 0.0, 1.5 * DVec3::Z, -DVec3::Z), -0.1875);
        assert_eq!(factor_hardened(1.0, 0.0, 1.5 * DVec3::Z, -DVec3::Z), 0.0);
        // The occlusion's own fault, ao = −0.6, in ambient light of 0.5 on the far side: 0.75·(−0.3).
        assert!((factor_published(-0.6, 0.5, DVec3::Z, -DVec3::Z) + 0.225).abs() < 1e-16);
        assert_eq!(factor_hardened(-0.6, 0.5, DVec3::Z, -DVec3::Z), 0.0);
    }

    #[test]
    fn hardened_clamps_the_occlusion_and_the_factor_by_themselves() {
        // On the lit side the factor's clamp does not act: only the occlusion's does, at 0 and at 1.
        assert_eq!(factor_hardened(-0.6, 0.5, DVec3::Z, DVec3::Z), 0.75);
        assert_eq!(factor_hardened(2.0, 0.5, DVec3::Z, DVec3::Z), 1.125);
        // A light vector that is too long: only the factor's.
        assert_eq!(factor_hardened(1.0, 0.0, DVec3::Z, -3.0 * DVec3::Z), 0.0);
    }

    #[test]
    fn witness_light_makes_an_opaque_surface_transparent() {
        let opaque = DVec4::new(1.0, 0.5, 0.25, 1.0);
        let dark = factor_published(1.0, 0.0, DVec3::Z, -DVec3::Z);
        assert_eq!(published(dark, DVec4::ONE, opaque), Fragment::Color(DVec4::ZERO));
        assert_eq!(hardened(dark, DVec3::ONE, opaque), Fragment::Color(DVec4::W));
    }

    #[test]
    fn holes_are_cut() {
        let hole = DVec4::new(1.0, 1.0, 1.0, 0.009);
        assert_eq!(published(1.0, DVec4::ONE, hole), Fragment::Discarded);
        assert_eq!(hardened(1.0, DVec3::ONE, hole), Fragment::Discarded);
        let edge = DVec4::new(1.0, 1.0, 1.0, f64::from(0.01_f32));
        assert_ne!(hardened(1.0, DVec3::ONE, edge), Fragment::Discarded);
    }
}
