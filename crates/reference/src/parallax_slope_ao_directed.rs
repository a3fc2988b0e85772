//! `parallax_slope_ao_directed`: `parallax_slope_ao` with the shift along the view's projection onto the surface,
//! uv' = uv + Δ·V_ts.xy, instead of the texture's diagonal. Δ and the occlusion are those of the hardened form.
//!
//! Source: the second article for Δ; the direction is that of the first article's limited offset, uv + z(h)·V.xy: what lies
//! higher is seen shifted, so the texture is read nearer to the eye. The sign is opposite to the second article's: there the
//! shift is a subtraction along (1, 1) and has no relation to the eye.
//!
//! Spaces: V in tangent space, unit, toward the eye. From straight above there is no shift.

use glam::{DVec2, DVec3};

use crate::parallax_slope_ao::{Shift, occlusion};

/// The shift along the view, and the occlusion in [0, 1].
#[must_use]
pub fn shift(uv: DVec2, view_ts: DVec3, delta: f64, occlusion_scale: f64) -> Shift {
    Shift {
        uv: uv + delta * view_ts.truncate(),
        ambient_occlusion: occlusion(delta, occlusion_scale),
    }
}

#[cfg(test)]
mod tests {
    use glam::{DVec2, DVec3};

    use super::shift;

    #[test]
    fn the_shift_follows_the_eye() {
        for i in 0..8 {
            let (sin, cos) = (f64::from(i) * std::f64::consts::FRAC_PI_4).sin_cos();
            let view = DVec3::new(0.6 * cos, 0.6 * sin, 0.8);
            let moved = shift(DVec2::ZERO, view, 0.04, 40.0).uv;
            assert!(
                (moved - 0.024 * DVec2::new(cos, sin)).length() < 1e-17 + 1e-17,
                "{i}"
            );
        }
    }

    #[test]
    fn from_straight_above_nothing_moves_and_the_occlusion_stays() {
        let straight = shift(DVec2::splat(0.5), DVec3::Z, 0.01, 40.0);
        assert_eq!(
            (straight.uv, straight.ambient_occlusion),
            (DVec2::splat(0.5), 0.6)
        );
    }
}
