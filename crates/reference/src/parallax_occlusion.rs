//! `parallax_occlusion`: the march of `steep_parallax`, and one secant step between the last sample above and the first below.
//!
//! Source: Brawley and Tatarchuk, *Parallax occlusion mapping* (2004); Tatarchuk (2006). With f(t) = h(uv(t)) − (1 − t) at two
//! neighbouring samples, f₀ < 0 ≤ f₁, the answer is where the straight line between them is 0.
//!
//! Limits: what is thinner than a step along the ray may be missed; within a step the surface is taken for straight.

use glam::DVec2;

use crate::relief_ray::{Ray, step_count};
use crate::steep_parallax::first_below;

/// Where the secant meets the ray; 0 where the ray enters under the surface. Layers as [`step_count`] has them.
#[must_use]
pub fn secant(ray: &Ray, layers: u32, height: impl Fn(DVec2) -> f64) -> f64 {
    let below = first_below(ray, layers, &height);
    if below == 0.0 {
        return 0.0;
    }
    let step = 1.0 / f64::from(step_count(layers));
    let above = below - step;
    let f = |t: f64| height(ray.at(t)) - (1.0 - t);
    let (f0, f1) = (f(above), f(below));
    // The floor closes the layer, so f₁ counts as at least 0; f₀ is below 0, or `above` would have been the answer.
    let share = -f0 / (f1.max(0.0) - f0);
    (above + step * share).clamp(0.0, 1.0)
}

#[cfg(test)]
mod tests {
    use glam::DVec2;

    use super::secant;
    use crate::relief_ray::Ray;

    const RAY: Ray = Ray {
        uv_top: DVec2::ZERO,
        delta: DVec2::new(1.0, 0.0),
    };

    #[test]
    fn straight_slopes_are_met_exactly() {
        // h = u/2 = t/2 meets 1 − t at 2/3, whatever the layers.
        for layers in [0, 1, 3, 16, 100] {
            let t = secant(&RAY, layers, |uv| 0.5 * uv.x);
            assert!((t - 2.0 / 3.0).abs() < 1e-15, "{layers}: {t}");
        }
        assert_eq!(secant(&RAY, 8, |_| 1.0), 0.0);
        assert_eq!(secant(&RAY, 8, |_| 0.0), 1.0);
    }

    #[test]
    fn the_error_over_a_curve_is_of_second_order() {
        // h = u²: t² = 1 − t, t = (√5 − 1)/2.
        let exact = (5f64.sqrt() - 1.0) / 2.0;
        let error = |layers| (secant(&RAY, layers, |uv| uv.x * uv.x) - exact).abs();
        // |error| ≤ (step²/4)·|h''|/2 over a slope of at least 1: step²/4.
        for layers in [4u32, 16, 64] {
            assert!(error(layers) <= 0.25 / f64::from(layers * layers), "{layers}");
        }
        assert!(error(4) > 1e-4, "and there is one");
    }

    #[test]
    fn witness_a_thin_wall_is_missed() {
        let wall = |uv: DVec2| if (0.30..0.31).contains(&uv.x) { 1.0 } else { 0.25 };
        assert_eq!(secant(&RAY, 8, wall), 0.75);
    }

    #[test]
    fn heights_that_are_not_a_number_stay_within_the_layer() {
        let t = secant(&RAY, 8, |_| f64::NAN);
        assert!(t.is_nan() || (0.0..=1.0).contains(&t));
    }
}
