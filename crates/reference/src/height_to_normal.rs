//! `height_to_normal`: a normal map from a height map by central differences, with true wrap, mirror or clamp edges.
//!
//! Source: the second-order difference (h(i+1) − h(i−1)) / 2 per texel. The normal of the elevation s·h over a grid of unit
//! texels is (−s·∂h/∂x, −s·∂h/∂y, 1), normalised; red along u, green along v, blue out of the surface.
//!
//! Units: heights in [0, 1]; `strength` s = elevation of h = 1 in texels.

use bossage_assets::{EdgeMode, HeightField};
use glam::DVec3;

use crate::vector::normalize;

/// The normal at texel (x, y) by central differences, unit, before the codec.
#[must_use]
pub fn central(field: &HeightField, edge: EdgeMode, x: u32, y: u32, strength: f64) -> DVec3 {
    let h = |dx: i64, dy: i64| {
        let (i, j) = (i64::from(x) + dx, i64::from(y) + dy);
        f64::from(field.texel(edge.resolve(i, field.width), edge.resolve(j, field.height)))
    };
    let (slope_x, slope_y) = (0.5 * (h(1, 0) - h(-1, 0)), 0.5 * (h(0, 1) - h(0, -1)));
    normalize(DVec3::new(-strength * slope_x, -strength * slope_y, 1.0))
}

#[cfg(test)]
mod tests {
    use bossage_assets::{EdgeMode, HeightField};
    use glam::DVec3;

    use super::central;

    #[test]
    fn a_ramp_has_its_slope_inside_and_the_edge_mode_at_the_border() {
        let ramp = HeightField::from_fn(4, 4, |x, _| x as f32 * 0.25);
        let diagonal = 0.5_f64.sqrt();
        assert!((central(&ramp, EdgeMode::Wrap, 1, 1, 4.0) - DVec3::new(-diagonal, 0.0, diagonal)).length() < 1e-15);
        // Clamp halves the difference, wrap jumps back by three steps (h(1) − h(3) = −0.5).
        assert_eq!(central(&ramp, EdgeMode::Clamp, 0, 1, 4.0), DVec3::new(-0.5, 0.0, 1.0).normalize());
        assert!(central(&ramp, EdgeMode::Wrap, 0, 1, 4.0).x > 0.0);
    }

    #[test]
    fn second_order_in_the_spacing() {
        let error = |samples: u32| {
            let phase = |x: u32| std::f64::consts::TAU * f64::from(x) / f64::from(samples);
            let field = HeightField::from_fn(samples, 4, |x, _| (0.5 + 0.5 * phase(x).sin()) as f32);
            (0..samples).fold(0.0_f64, |worst, x| {
                let n = central(&field, EdgeMode::Wrap, x, 0, f64::from(samples));
                worst.max((-n.x / n.z - std::f64::consts::PI * phase(x).cos()).abs())
            })
        };
        // sin(φ)/φ = 1 − φ²/6 + …: halving φ quarters the error up to the next term φ⁴/120.
        let ratio = error(16) / error(32);
        assert!((ratio - 4.0).abs() < 0.1, "{ratio}");
    }
}
