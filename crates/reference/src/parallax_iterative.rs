//! `parallax_iterative`: (u, v, z) += (z(h) − z) · n.z · V, so many times.
//!
//! Source: Premecz, *Iterative parallax mapping with slope information* (2006). V is the unit view vector in tangent space, n.z the
//! third component of the unit normal at the place, z the elevation over the polygon, which starts at 0 on the polygon.
//!
//! Elevations here are shares of the layer's thickness, so that a tile that is not square needs no second elevation:
//! e(h) = h + bias/scale, and a step of elevation moves uv by scale along u and by scale · v_factor along v.
//!
//! Limits. There is no division by V.z, so no view is special, and a view from below is answered by the same formula. Convergence is
//! not promised: over steep slopes it may circle or settle behind the first hit. A layer without thickness shifts nothing.

use glam::{DVec2, DVec3};

use crate::relief_ray::{HitRecord, Layer, Status};

/// What is read at a place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sample {
    /// Height in [0, 1].
    pub height: f64,
    /// Third component of the unit normal.
    pub normal_z: f64,
}

/// The place after `iterations` steps; t is the depth at which the steps ended.
#[must_use]
pub fn shift(
    uv: DVec2,
    view_ts: DVec3,
    layer: &Layer,
    iterations: u32,
    sample: impl Fn(DVec2) -> Sample,
) -> HitRecord {
    let still = |status| HitRecord { uv, t: 0.0, status };
    if !(uv.is_finite() && view_ts.is_finite()) {
        return still(Status::NonFinite);
    }
    if layer.scale == 0.0 {
        return still(Status::Hit);
    }
    let lowest = layer.bias / layer.scale;
    let travel = layer.scale * layer.per_axis() * view_ts.truncate();
    let (mut at, mut elevation) = (uv, 0.0);
    for _ in 0..iterations {
        let Sample { height, normal_z } = sample(at);
        let step = (height + lowest - elevation) * normal_z;
        at += step * travel;
        elevation += step * view_ts.z;
    }
    HitRecord {
        uv: at,
        t: 1.0 + lowest - elevation,
        status: Status::Hit,
    }
}

#[cfg(test)]
mod tests {
    use glam::{DVec2, DVec3};

    use super::{Sample, shift};
    use crate::relief_ray::{Layer, Status};

    const VIEW: DVec3 = DVec3::new(0.6, 0.0, 0.8);

    #[test]
    fn one_step_is_the_limited_offset_over_level_ground() {
        let layer = Layer {
            scale: 0.04,
            bias: -0.02,
            v_factor: 1.0,
        };
        let ground = |_| Sample {
            height: 0.75,
            normal_z: 1.0,
        };
        let moved = shift(DVec2::ZERO, VIEW, &layer, 1, ground);
        let limited = crate::parallax_offset_limited::offset(DVec2::ZERO, VIEW, 0.75, 0.04, -0.02);
        // Two orders of three products each.
        assert!((moved.uv - limited).length() < 1e-17);
    }

    #[test]
    fn steps_converge_to_the_hit_over_a_slope() {
        // h = u, scale 1, bias −1: z = u − 1; the ray through (u₀, 0) along −V: u = u₀ + 0.6 s, z = 0.8 s meets it at s = −5 (1 − u₀).
        let layer = Layer::below(1.0);
        let slope = |uv: DVec2| Sample {
            height: uv.x,
            normal_z: 0.5f64.sqrt(),
        };
        let start = DVec2::new(0.9, 0.0);
        let met = shift(start, VIEW, &layer, 400, slope);
        // Each step multiplies the gap by 1 − (0.8 − 0.6)/√2 = 0.86: after 400 nothing is left but rounding, 2⁻⁵⁴ a step, by which the
        // steps leave the ray, and the ray meets the slope at an angle that makes it five times as much.
        let rounding = 400.0 * 5.0 * 2f64.powi(-54);
        assert!((met.uv.x - 0.6).abs() < rounding && (met.t - 0.4).abs() < rounding);
        assert_eq!(met.status, Status::Hit);
        // The control: two steps are not there yet.
        assert!((shift(start, VIEW, &layer, 2, slope).uv.x - 0.6).abs() > 0.1);
    }

    #[test]
    fn witness_before_a_wall_the_steps_circle() {
        // A wall stands in the way of the ray, which meets its side at u = 0.08.
        let wall = |uv: DVec2| Sample {
            height: if (0.06..0.08).contains(&uv.x) { 1.0 } else { 0.5 },
            normal_z: 1.0,
        };
        let layer = Layer {
            scale: 0.2,
            bias: 0.0,
            v_factor: 1.0,
        };
        let after = |steps| shift(DVec2::ZERO, VIEW, &layer, steps, wall).uv.x;
        // On the ray z = u/0.75: on the ground beside the wall a step is 0.06 − 0.8 u, never less than 0.004 there; on it, 0.055.
        for steps in 20..100 {
            assert!((after(steps + 1) - after(steps)).abs() > 0.0039, "{steps}");
        }
    }

    #[test]
    fn every_view_has_an_answer() {
        let ground = |_| Sample {
            height: 0.5,
            normal_z: 1.0,
        };
        let layer = Layer::below(0.05);
        for view in [DVec3::X, -DVec3::Z, DVec3::ZERO] {
            assert!(shift(DVec2::ZERO, view, &layer, 8, ground).uv.is_finite());
        }
        let lost = shift(DVec2::ZERO, DVec3::NAN, &layer, 8, ground);
        assert_eq!((lost.uv, lost.status), (DVec2::ZERO, Status::NonFinite));
        let thin = shift(DVec2::ONE, VIEW, &Layer::below(0.0), 8, ground);
        assert_eq!(thin.uv, DVec2::ONE);
    }
}
