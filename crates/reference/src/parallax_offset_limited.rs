//! `parallax_offset_limited`: uv' = uv + z(h) · V.xy, the shift bounded by the elevation.
//!
//! Source: the first article, *Parallax Bump Mapping*, its second formula (its last listing adds a 3-vector to a
//! 2-vector; `.xy` is meant). Spaces and units as in [`crate::parallax_offset`]. It under-shifts by the factor V.z; that is its
//! price, not a fault that could be cured without becoming the other technique, so there is one form.

use glam::{DVec2, DVec3};

use crate::parallax_offset::elevation;

/// The formula.
#[must_use]
pub fn offset(uv: DVec2, view_ts: DVec3, height: f64, scale: f64, bias: f64) -> DVec2 {
    uv + elevation(height, scale, bias) * view_ts.truncate()
}

#[cfg(test)]
mod tests {
    use glam::{DVec2, DVec3};

    use super::offset;

    #[test]
    fn never_more_than_the_elevation() {
        for degrees in 0..=90 {
            let (sin, cos) = f64::from(degrees).to_radians().sin_cos();
            let shift = offset(DVec2::ZERO, DVec3::new(sin, 0.0, cos), 1.0, 0.04, -0.02);
            // z(1) = 0.02 with two roundings of 2^-53 relative to 0.04.
            assert!(shift.length() <= 0.02 + 1e-17);
        }
    }
}
