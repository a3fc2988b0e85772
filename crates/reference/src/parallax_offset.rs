//! `parallax_offset`: uv' = uv + z(h) · V.xy / V.z with the elevation z(h) = scale · h + bias.
//!
//! Source: the first article, *Parallax Bump Mapping*. Space: V in tangent space, unit, toward the eye; elevation and uv in
//! UV units (1 = one tile of the texture); h in [0, 1].
//!
//! Known fault of the published form: the shift grows without bound as V.z → 0, is 0/0 or ±∞ at V.z = 0, and turns round
//! for V.z < 0.

use glam::{DVec2, DVec3};

/// z(h) in UV units: the elevation of the surface over the polygon.
#[must_use]
pub fn elevation(height: f64, scale: f64, bias: f64) -> f64 {
    scale * height + bias
}

/// As published.
#[must_use]
pub fn published(uv: DVec2, view_ts: DVec3, height: f64, scale: f64, bias: f64) -> DVec2 {
    uv + elevation(height, scale, bias) * view_ts.truncate() / view_ts.z
}

/// The smallest V.z that the hardened form divides by: the shift stops growing at about 87° from the normal.
pub const MIN_VIEW_Z: f64 = 0.05;

/// Hardened: V.z is not let below [`MIN_VIEW_Z`], so the shift is at most 20 |z(h)| and never turns round.
#[must_use]
pub fn hardened(uv: DVec2, view_ts: DVec3, height: f64, scale: f64, bias: f64) -> DVec2 {
    uv + elevation(height, scale, bias) * view_ts.truncate() / view_ts.z.max(MIN_VIEW_Z)
}

#[cfg(test)]
mod tests {
    use glam::{DVec2, DVec3};

    use super::published;

    #[test]
    fn no_shift_from_straight_above() {
        let uv = DVec2::new(0.25, 0.75);
        assert_eq!(published(uv, DVec3::Z, 1.0, 0.04, -0.02), uv);
    }

    #[test]
    fn shift_is_the_elevation_at_45_degrees() {
        let view = DVec3::new(1.0, 0.0, 1.0) / 2f64.sqrt();
        // z(1) = 0.5 exactly, V.x / V.z = 1 exactly.
        assert_eq!(
            published(DVec2::ZERO, view, 1.0, 0.75, -0.25),
            DVec2::new(0.5, 0.0)
        );
    }

    #[test]
    fn grazing_view_is_the_defect() {
        assert!(!published(DVec2::ZERO, DVec3::X, 1.0, 0.04, -0.02).is_finite());
    }
}
