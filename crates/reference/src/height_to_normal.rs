//! `height_to_normal`: a normal map from a height map by central differences, with true wrap, mirror or clamp edges.
//!
//! Source: the second-order difference (h(i+1) − h(i−1)) / 2 per texel. The normal of the elevation s·h over a grid of unit
//! texels is (−s·∂h/∂x, −s·∂h/∂y, 1), normalised; red along u, green along v, blue out of the surface.
//!
//! Units: heights in [0, 1]; `slope` is the slope that a height difference of 1 between the two neighbours stands for, along
//! u and along v: for an elevation z = scale · h over a tile of `side` texels it is scale · side / 2.

use bossage_assets::{EdgeMode, HeightField};
use glam::{DVec2, DVec3};

use crate::vector::normalize;

/// The normal from the four neighbours' heights, unit: left and right along u, before and after along v.
#[must_use]
pub fn normal(left: f64, right: f64, before: f64, after: f64, slope: DVec2) -> DVec3 {
    normalize(DVec3::new(
        -slope.x * (right - left),
        -slope.y * (after - before),
        1.0,
    ))
}

/// The normal at texel (x, y) by central differences, unit, before the codec.
#[must_use]
pub fn central(field: &HeightField, edge: EdgeMode, x: u32, y: u32, slope: DVec2) -> DVec3 {
    let h = |dx: i64, dy: i64| {
        let (i, j) = (i64::from(x) + dx, i64::from(y) + dy);
        f64::from(field.texel(edge.resolve(i, field.width), edge.resolve(j, field.height)))
    };
    normal(h(-1, 0), h(1, 0), h(0, -1), h(0, 1), slope)
}

#[cfg(test)]
mod tests {
    use bossage_assets::{EdgeMode, HeightField};
    use glam::{DVec2, DVec3};

    use super::central;

    #[test]
    fn a_ramp_has_its_slope_inside_and_the_edge_mode_at_the_border() {
        let ramp = HeightField::from_fn(4, 4, |x, _| x as f32 * 0.25);
        let (diagonal, slope) = (0.5_f64.sqrt(), DVec2::splat(2.0));
        // Slope 2 · 0.5 = 1: the normal is (−1, 0, 1)/√2. One division and one square root: 2 units of 2^-53.
        assert!(
            (central(&ramp, EdgeMode::Wrap, 1, 1, slope) - DVec3::new(-diagonal, 0.0, diagonal)).length()
                < 1e-15
        );
        // Clamp halves the difference, wrap jumps back by two steps.
        let clamped = central(&ramp, EdgeMode::Clamp, 0, 1, slope);
        assert!((clamped - DVec3::new(-0.5, 0.0, 1.0).normalize()).length() < 1e-15);
        assert!(central(&ramp, EdgeMode::Wrap, 0, 1, slope).x > 0.0);
    }

    #[test]
    fn second_order_in_the_spacing() {
        let error = |samples: u32| {
            let phase = |x: u32| std::f64::consts::TAU * f64::from(x) / f64::from(samples);
            let field = HeightField::from_fn(samples, 4, |x, _| (0.5 + 0.5 * phase(x).sin()) as f32);
            (0..samples).fold(0.0_f64, |worst, x| {
                let n = central(
                    &field,
                    EdgeMode::Wrap,
                    x,
                    0,
                    DVec2::splat(0.5 * f64::from(samples)),
                );
                worst.max((-n.x / n.z - std::f64::consts::PI * phase(x).cos()).abs())
            })
        };
        // sin(φ)/φ = 1 − φ²/6 + …: halving φ quarters the error up to the next term φ⁴/120.
        let ratio = error(16) / error(32);
        assert!((ratio - 4.0).abs() < 0.1, "{ratio}");
    }
}
