//! The few vector functions that the formulas share, with their behaviour at the edges written down.

use glam::DVec3;

/// Clamps to [0, 1]; NaN stays NaN (the shading languages leave it open, the reference must not hide it).
#[must_use]
pub fn saturate(x: f64) -> f64 {
    if x.is_nan() { x } else { x.clamp(0.0, 1.0) }
}

/// v / |v|, and NaN for the zero vector, as the formula says. The length is taken after scaling by the largest component,
/// so every finite float64 vector other than zero has a direction.
#[must_use]
pub fn normalize(v: DVec3) -> DVec3 {
    let largest = v.abs().max_element();
    if largest == 0.0 || !v.is_finite() {
        return DVec3::NAN;
    }
    let scaled = v / largest;
    scaled / scaled.length()
}

/// The smallest normal f32. What is smaller may be taken for zero by any f32 machine, so the hardened forms agree to do so.
pub const SMALLEST_NORMAL_F32: f64 = f32::MIN_POSITIVE as f64;

/// v / |v|, and zero for a vector whose largest component is below the smallest normal f32: it has no direction that an
/// f32 machine could be held to.
#[must_use]
pub fn normalize_or_zero(v: DVec3) -> DVec3 {
    if v.abs().max_element() < SMALLEST_NORMAL_F32 {
        DVec3::ZERO
    } else {
        normalize(v)
    }
}

/// +1 for positive numbers and both zeros, −1 for negative ones: unlike the `sign` of the shading languages it is never 0.
#[must_use]
pub fn sign_not_zero(x: f64) -> f64 {
    if x < 0.0 { -1.0 } else { 1.0 }
}

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use super::{normalize, normalize_or_zero, saturate, sign_not_zero};

    #[test]
    fn directions_survive_any_scale() {
        for scale in [1e-300, 1e-45, 1.0, 3e38, 1e300] {
            // Two divisions, a square root and a three-term dot product: below 8 units of 2^-53.
            assert!(
                (normalize(scale * DVec3::new(1.0, 2.0, 2.0)) * 3.0 - DVec3::new(1.0, 2.0, 2.0)).length()
                    < 4e-15
            );
        }
    }

    #[test]
    fn edges() {
        assert!(normalize(DVec3::ZERO).is_nan());
        assert_eq!(normalize_or_zero(DVec3::ZERO), DVec3::ZERO);
        assert_eq!(normalize_or_zero(1e-40 * DVec3::X), DVec3::ZERO);
        assert_eq!(normalize_or_zero(2e-38 * DVec3::X), DVec3::X);
        assert!(saturate(f64::NAN).is_nan());
        assert_eq!(sign_not_zero(-0.0), 1.0);
    }
}
