//! `steep_parallax`: a linear march of so many layers; the first sample under the surface is the answer.
//!
//! Source: McGuire and McGuire, *Steep parallax mapping* (2005). The ray is sampled at t = 0, 1/n, 2/n, … 1, and stops where
//! h(uv(t)) ≥ 1 − t.
//!
//! Limits: the answer lies up to 1/n behind the hit, in terraces; what is thinner than a step along the ray may be missed.

use glam::DVec2;

use crate::relief_ray::{Ray, step_count};

/// The first of the samples t = 0, 1/layers, … 1 that lies on or under the surface; 1 where none does. Layers as [`step_count`]
/// has them.
#[must_use]
pub fn first_below(ray: &Ray, layers: u32, height: impl Fn(DVec2) -> f64) -> f64 {
    let last = step_count(layers);
    let t = |layer: u32| f64::from(layer) / f64::from(last);
    let below = |layer: &u32| height(ray.at(t(*layer))) >= 1.0 - t(*layer);
    t((0..last).find(below).unwrap_or(last))
}

#[cfg(test)]
mod tests {
    use glam::DVec2;

    use super::first_below;
    use crate::relief_ray::Ray;

    const RAY: Ray = Ray {
        uv_top: DVec2::ZERO,
        delta: DVec2::new(1.0, 0.0),
    };

    #[test]
    fn level_ground_is_met_at_the_next_layer() {
        for (height, t) in [(1.0, 0.0), (0.75, 0.25), (0.74, 0.5), (0.1, 1.0), (0.0, 1.0)] {
            assert_eq!(first_below(&RAY, 4, |_| height), t, "{height}");
        }
        assert_eq!(first_below(&RAY, 0, |_| 0.5), 1.0);
    }

    #[test]
    fn witness_a_thin_wall_is_missed_and_more_layers_find_it() {
        let wall = |uv: DVec2| if (0.30..0.31).contains(&uv.x) { 1.0 } else { 0.25 };
        assert_eq!(first_below(&RAY, 8, wall), 0.75);
        assert_eq!(first_below(&RAY, 128, wall), 39.0 / 128.0);
    }

    #[test]
    fn heights_that_are_not_a_number_end_at_the_floor() {
        assert_eq!(first_below(&RAY, 8, |_| f64::NAN), 1.0);
    }
}
