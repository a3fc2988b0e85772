//! `parallax_slope_ao`: a shift of the texture coordinates and an occlusion of ambient light, both from the slope of the
//! normal map: f₁ = 1 − (n·N)², f₂ = max(n·V, 0), Δ = f₁·f₂·s·h, uv' = uv − (Δ, Δ), ao = 1 − max(k·Δ, 0).
//!
//! Source: the second article, *Parallax Mapping + Ambient Occlusion*: s = 0.04, k = 40. Spaces: n (the map's normal), N and V in
//! world space; V as published is minus the camera's viewing direction, the same for all pixels. h in [0, 1], uv in tiles.
//!
//! Known faults of the published form:
//! - the shift runs along the texture's diagonal wherever the eye is: see `parallax_slope_ao_directed` for the cure;
//! - f₁·f₂·h reaches 1 (n across N and toward the eye), so ao reaches 1 − 40·0.04 = −0.6: negative ambient light;
//! - n as decoded is not a unit vector: |n| > 1 makes f₁ negative, which turns the shift round, |n| < 1 makes flat ground
//!   look sloped;
//! - one V for all pixels: at the side of a wide picture it is off by half of the field of view.
//!
//! Hardened: unit n and N (a zero vector has no slope: no shift, no occlusion), V per pixel, ao in [0, 1].

use glam::{DVec2, DVec3};

use crate::vector::{normalize_or_zero, saturate};

/// s as published.
pub const OFFSET_SCALE: f64 = 0.04;

/// k as published.
pub const OCCLUSION_SCALE: f64 = 40.0;

/// What the technique gives.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Shift {
    /// The shifted texture coordinates.
    pub uv: DVec2,
    /// The share of ambient light that arrives.
    pub ambient_occlusion: f64,
}

/// Δ as published, for n and N as they are.
#[must_use]
pub fn delta_published(map_normal: DVec3, normal: DVec3, view: DVec3, height: f64, scale: f64) -> f64 {
    let along = map_normal.dot(normal);
    (1.0 - along * along) * map_normal.dot(view).max(0.0) * scale * height
}

/// Δ, hardened: in [0, scale·height]. f₁ is written as |n × N|², which is 1 − (n·N)² for unit vectors without the
/// cancellation, and never negative. A zero vector gives 0.
#[must_use]
pub fn delta_hardened(map_normal: DVec3, normal: DVec3, view: DVec3, height: f64, scale: f64) -> f64 {
    let (n, up) = (normalize_or_zero(map_normal), normalize_or_zero(normal));
    n.cross(up).length_squared() * n.dot(view).max(0.0) * scale * height
}

/// As published.
#[must_use]
pub fn published(uv: DVec2, delta: f64, occlusion_scale: f64) -> Shift {
    Shift {
        uv: uv - DVec2::splat(delta),
        ambient_occlusion: 1.0 - (occlusion_scale * delta).max(0.0),
    }
}

/// Hardened: the occlusion stays in [0, 1].
#[must_use]
pub fn hardened(uv: DVec2, delta: f64, occlusion_scale: f64) -> Shift {
    Shift {
        uv: uv - DVec2::splat(delta),
        ambient_occlusion: occlusion(delta, occlusion_scale),
    }
}

/// 1 − k·Δ, in [0, 1].
#[must_use]
pub fn occlusion(delta: f64, occlusion_scale: f64) -> f64 {
    saturate(1.0 - occlusion_scale * delta)
}

#[cfg(test)]
mod tests {
    use glam::{DVec2, DVec3};

    use super::{OCCLUSION_SCALE, OFFSET_SCALE, delta_hardened, delta_published, hardened, published};
    use crate::sphere::fibonacci;

    const UV: DVec2 = DVec2::new(0.5, 0.25);

    #[test]
    fn flat_ground_is_left_alone() {
        for delta in [delta_published, delta_hardened] {
            assert_eq!(delta(DVec3::Z, DVec3::Z, DVec3::Z, 1.0, OFFSET_SCALE), 0.0);
        }
    }

    #[test]
    fn known_answer() {
        // n = (0.6, 0, 0.8): f₁ = 0.36, f₂ = 0.8 from straight above, h = 0.5: Δ = 0.00576, ao = 1 − 0.2304.
        let n = DVec3::new(0.6, 0.0, 0.8);
        for delta in [delta_published, delta_hardened] {
            let shift = published(
                UV,
                delta(n, DVec3::Z, DVec3::Z, 0.5, OFFSET_SCALE),
                OCCLUSION_SCALE,
            );
            // Some ten roundings of 2^-53 relative; k magnifies.
            assert!((shift.uv - (UV - 0.00576)).length() < 1e-16 + 1e-16);
            assert!((shift.ambient_occlusion - 0.7696).abs() < 1e-15);
        }
    }

    #[test]
    fn witness_occlusion_goes_below_zero() {
        // A wall's normal, seen head on along it: n ⟂ N, n = V, h = 1.
        let delta = delta_published(DVec3::X, DVec3::Z, DVec3::X, 1.0, OFFSET_SCALE);
        assert!((published(UV, delta, OCCLUSION_SCALE).ambient_occlusion + 0.6).abs() < 1e-15);
        assert_eq!(hardened(UV, delta, OCCLUSION_SCALE).ambient_occlusion, 0.0);
    }

    #[test]
    fn witness_long_normals_turn_the_shift_round() {
        // |n| = 1.2 along N: f₁ = 1 − 1.44 = −0.44, f₂ = 1.2, Δ = −0.02112 at h = 1: flat ground moves by half its scale.
        let delta = delta_published(1.2 * DVec3::Z, DVec3::Z, DVec3::Z, 1.0, OFFSET_SCALE);
        assert!((delta + 0.02112).abs() < 1e-16);
        assert_eq!(
            delta_hardened(1.2 * DVec3::Z, DVec3::Z, DVec3::Z, 1.0, OFFSET_SCALE),
            0.0
        );
        // |n| = 0.5, as mip maps make them: flat ground counts as sloped, f₁ = 0.75.
        assert_eq!(
            delta_published(0.5 * DVec3::Z, DVec3::Z, DVec3::Z, 1.0, 1.0),
            0.375
        );
    }

    #[test]
    fn witness_the_shift_does_not_follow_the_eye() {
        // Eight views round the normal: the published shift stays on the diagonal for all of them.
        let n = DVec3::new(0.3, 0.2, 0.9).normalize();
        for i in 0..8 {
            let (sin, cos) = (f64::from(i) * std::f64::consts::FRAC_PI_4).sin_cos();
            let delta = delta_published(
                n,
                DVec3::Z,
                DVec3::new(0.6 * cos, 0.6 * sin, 0.8),
                1.0,
                OFFSET_SCALE,
            );
            let moved = published(UV, delta, OCCLUSION_SCALE).uv - UV;
            assert!(moved.x == moved.y || (moved.x - moved.y).abs() < 1e-16);
            assert!(moved.x < 0.0, "always toward −u and −v");
        }
    }

    #[test]
    fn hardened_stays_within_its_bounds_whatever_the_lengths() {
        for (i, n) in fibonacci(1000).enumerate() {
            let view = DVec3::new(0.36, 0.48, 0.8);
            let delta = delta_hardened(n * (0.1 + 0.01 * i as f64), DVec3::Z, view, 1.0, OFFSET_SCALE);
            assert!((0.0..=OFFSET_SCALE).contains(&delta));
            assert!((0.0..=1.0).contains(&hardened(UV, delta, OCCLUSION_SCALE).ambient_occlusion));
        }
        assert_eq!(
            delta_hardened(DVec3::ZERO, DVec3::Z, DVec3::Z, 1.0, OFFSET_SCALE),
            0.0
        );
    }
}
