//! `height_to_normal_fourth_order`: a normal map from a height map by differences of fourth order, with true wrap, mirror or clamp
//! edges.
//!
//! Source: Fornberg, *Generation of Finite Difference Formulas on Arbitrarily Spaced Grids*, Math. Comp. 51 (1988), table 1: the
//! weights 1/12, −2/3, 0, 2/3, −1/12. By Taylor's series what they leave is −h⁽⁵⁾/30 and higher derivatives.
//!
//! Units: heights in [0, 1]; `slope` as the shader takes it: for an elevation z = scale · h over a tile of `side` texels it is
//! scale · side / 12.

use bossage_assets::{EdgeMode, HeightField};
use glam::{DVec2, DVec3};

use crate::vector::normalize;

/// The normal from the heights around, unit: two texels and one before, one and two behind, along u and along v.
#[must_use]
pub fn normal(along_u: [f64; 4], along_v: [f64; 4], slope: DVec2) -> DVec3 {
    let twelve_times = |[two_before, before, behind, two_behind]: [f64; 4]| {
        (two_before - two_behind) + 8.0 * (behind - before)
    };
    normalize(DVec3::new(
        -slope.x * twelve_times(along_u),
        -slope.y * twelve_times(along_v),
        1.0,
    ))
}

/// The normal at texel (x, y), unit, before the codec.
#[must_use]
pub fn fourth_order(field: &HeightField, edge: EdgeMode, x: u32, y: u32, slope: DVec2) -> DVec3 {
    let h = |dx: i64, dy: i64| {
        let (i, j) = (i64::from(x) + dx, i64::from(y) + dy);
        f64::from(field.texel(edge.resolve(i, field.width), edge.resolve(j, field.height)))
    };
    let steps = [-2, -1, 1, 2];
    normal(steps.map(|dx| h(dx, 0)), steps.map(|dy| h(0, dy)), slope)
}

#[cfg(test)]
mod tests {
    use bossage_assets::{EdgeMode, HeightField};
    use glam::{DVec2, DVec3};

    use super::{fourth_order, normal};

    #[test]
    fn polynomials_up_to_the_fourth_power_are_exact() {
        // h = x⁴/4 + x at x = 1 has the slope 2; along v h = y² has 2 too. Texels lie 1 apart.
        let quartic = [-1.0, 0.0, 2.0, 3.0].map(|x: f64| x.powi(4) / 4.0 + x);
        let square = [-1.0, 0.0, 2.0, 3.0].map(|y: f64| y * y);
        let found = normal(quartic, square, DVec2::splat(1.0 / 12.0));
        assert!((found - DVec3::new(-2.0, -2.0, 1.0).normalize()).length() < 1e-15);
        // The fifth power is not: −h⁽⁵⁾/30 = −4 is left of the slope 5.
        let fifth = [-1.0, 0.0, 2.0, 3.0].map(|x: f64| x.powi(5));
        let found = normal(fifth, [0.0; 4], DVec2::splat(1.0 / 12.0));
        assert!((-found.x / found.z - 1.0).abs() < 1e-14);
    }

    #[test]
    fn edges_follow_the_mode() {
        let ramp = HeightField::from_fn(8, 8, |x, _| x as f32 / 8.0);
        let slope = DVec2::splat(8.0 / 12.0);
        let at = |edge, x| fourth_order(&ramp, edge, x, 3, slope);
        assert!((at(EdgeMode::Wrap, 4) - DVec3::new(-1.0, 0.0, 1.0).normalize()).length() < 1e-15);
        // Clamped at the first texel: (8·(1/8) − 2/8)·8/12 = 1/2.
        assert!((at(EdgeMode::Clamp, 0) - DVec3::new(-0.5, 0.0, 1.0).normalize()).length() < 1e-15);
        assert!(at(EdgeMode::Wrap, 0).x > 0.0);
    }

    #[test]
    fn fourth_order_in_the_spacing() {
        let error = |samples: u32| {
            let phase = |x: f64| std::f64::consts::TAU * x / f64::from(samples);
            let h = |x: f64| 0.5 + 0.5 * phase(x).sin();
            (0..samples).map(f64::from).fold(0.0_f64, |worst, x| {
                let along = [-2.0, -1.0, 1.0, 2.0].map(|step| h(x + step));
                let n = normal(along, [0.5; 4], DVec2::splat(f64::from(samples) / 12.0));
                worst.max((-n.x / n.z - std::f64::consts::PI * phase(x).cos()).abs())
            })
        };
        // (8 sin φ − sin 2φ)/(6φ) = 1 − φ⁴/30 + φ⁶/252 …: halving φ leaves a sixteenth up to the next term.
        let ratio = error(16) / error(32);
        assert!((ratio - 16.0).abs() < 0.3, "{ratio}");
    }
}
