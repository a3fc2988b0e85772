//! `blinn_phong`: diffuse and specular reflection of one light, saturate(N·L)·C_d + pow(saturate(N·H), p)·C_s, where
//! H = normalize(L + V).
//!
//! Source: the first article, *Parallax Bump Mapping*, its first listing. Spaces: N, L and V in the same space. L and V
//! are unit vectors toward the light and the eye; N comes from a normal map and need not be unit.
//!
//! Known faults of the published form: L = −V makes H = 0/0; pow(0, 0) is left open by the shading languages.

use glam::DVec3;

use crate::vector::{SMALLEST_NORMAL_F32, normalize, normalize_or_zero, saturate};

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
    let power = highlight_power_published(normal.dot(normalize(light + view)), surface.shininess);
    saturate(normal.dot(light)) * surface.diffuse + power * surface.specular
}

/// Hardened: a zero half vector has no highlight, and a surface that the half vector does not face has none whatever the
/// exponent.
#[must_use]
pub fn hardened(normal: DVec3, light: DVec3, view: DVec3, surface: &Reflectance) -> DVec3 {
    let power = highlight_power(normal.dot(normalize_or_zero(light + view)), surface.shininess);
    saturate(normal.dot(light)) * surface.diffuse + power * surface.specular
}

/// saturate(x)^p, with 0⁰ = NaN.
#[must_use]
pub fn highlight_power_published(x: f64, shininess: f64) -> f64 {
    let base = saturate(x);
    if base == 0.0 && shininess == 0.0 {
        f64::NAN
    } else {
        base.powf(shininess)
    }
}

/// saturate(x)^max(p, 0), and 0 where x is below the smallest normal f32, whatever p: nothing shines that the half vector
/// does not face.
#[must_use]
pub fn highlight_power(x: f64, shininess: f64) -> f64 {
    let base = saturate(x);
    if base < SMALLEST_NORMAL_F32 {
        0.0
    } else {
        base.powf(shininess.max(0.0))
    }
}

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use super::{Reflectance, hardened, published};

    const SHINY: Reflectance = Reflectance {
        diffuse: DVec3::X,
        specular: DVec3::Y,
        shininess: 16.0,
    };

    #[test]
    fn mirror_direction_has_the_full_highlight() {
        assert_eq!(
            published(DVec3::Z, DVec3::Z, DVec3::Z, &SHINY),
            DVec3::new(1.0, 1.0, 0.0)
        );
    }

    #[test]
    fn light_opposite_to_the_eye_is_the_defect_and_its_cure() {
        assert!(published(DVec3::Z, DVec3::X, -DVec3::X, &SHINY).is_nan());
        assert_eq!(hardened(DVec3::Z, DVec3::X, -DVec3::X, &SHINY), DVec3::ZERO);
    }

    #[test]
    fn exponent_zero_on_the_dark_side() {
        let flat = Reflectance {
            shininess: 0.0,
            ..SHINY
        };
        assert!(published(DVec3::Z, -DVec3::Z, -DVec3::Z, &flat).is_nan());
        assert_eq!(hardened(DVec3::Z, -DVec3::Z, -DVec3::Z, &flat), DVec3::ZERO);
    }
}
