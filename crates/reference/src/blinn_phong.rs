//! `blinn_phong`: diffuse and specular reflection of one light, saturate(N·L)·C_d + pow(saturate(N·H), p)·C_s, where
//! H = normalize(L + V).
//!
//! Source: the first article, *Parallax Bump Mapping*, its first listing. Spaces: N, L and V in the same space. L and V
//! are unit vectors toward the light and the eye; N comes from a normal map and need not be unit.
//!
//! Known faults of the published form: L = −V makes H = 0/0; pow(0, 0) is left open by the shading languages.

use glam::DVec3;

use crate::vector::{normalize, normalize_or_zero, saturate};

/// The colours and the exponent of the formula.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reflectance {
    /// C_d, linear.
    pub diffuse: DVec3,
    /// C_s, linear.
    pub specular: DVec3,
    /// p ≥ 0.
    pub shininess: f64,
}

/// As published. L = −V gives NaN; pow(0, 0) is NaN here because the languages define `pow` by exp2(p · log2 x).
#[must_use]
pub fn published(normal: DVec3, light: DVec3, view: DVec3, surface: &Reflectance) -> DVec3 {
    let half_vector = normalize(light + view);
    let highlight = saturate(normal.dot(half_vector));
    let power = if highlight == 0.0 && surface.shininess == 0.0 { f64::NAN } else { highlight.powf(surface.shininess) };
    saturate(normal.dot(light)) * surface.diffuse + power * surface.specular
}

/// Hardened: a zero half vector has no highlight, and a surface that the half vector does not face has none whatever the
/// exponent.
#[must_use]
pub fn hardened(normal: DVec3, light: DVec3, view: DVec3, surface: &Reflectance) -> DVec3 {
    let half_vector = normalize_or_zero(light + view);
    let highlight = saturate(normal.dot(half_vector));
    saturate(normal.dot(light)) * surface.diffuse + highlight_power(highlight, surface.shininess) * surface.specular
}

/// x^p for x in [0, 1] with the convention that nothing shines at x = 0, also for p = 0.
#[must_use]
pub fn highlight_power(x: f64, shininess: f64) -> f64 {
    if x > 0.0 { x.powf(shininess) } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use super::{Reflectance, hardened, published};

    const SHINY: Reflectance = Reflectance { diffuse: DVec3::X, specular: DVec3::Y, shininess: 16.0 };

    #[test]
    fn mirror_direction_has_the_full_highlight() {
        assert_eq!(published(DVec3::Z, DVec3::Z, DVec3::Z, &SHINY), DVec3::new(1.0, 1.0, 0.0));
    }

    #[test]
    fn light_opposite_to_the_eye_is_the_defect_and_its_cure() {
        assert!(published(DVec3::Z, DVec3::X, -DVec3::X, &SHINY).is_nan());
        assert_eq!(hardened(DVec3::Z, DVec3::X, -DVec3::X, &SHINY), DVec3::ZERO);
    }

    #[test]
    fn exponent_zero_on_the_dark_side() {
        let flat = Reflectance { shininess: 0.0, ..SHINY };
        assert!(published(DVec3::Z, -DVec3::Z, -DVec3::Z, &flat).is_nan());
        assert_eq!(hardened(DVec3::Z, -DVec3::Z, -DVec3::Z, &flat), DVec3::ZERO);
    }
}
