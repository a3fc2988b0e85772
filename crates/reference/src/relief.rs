//! `relief`: the march of `steep_parallax`, and bisection between the last sample above and the first below.
//!
//! Source: Policarpo, Oliveira and Comba, *Real-time relief mapping on arbitrary polygonal surfaces* (2005). The bracket is halved so
//! many times, and its lower end (the last sample found under the surface) is the answer.
//!
//! Limits: what is thinner than a step along the ray may be missed, and then no bisection brings it back. Where the bracket
//! holds several crossings, one of them is found.

use glam::DVec2;

use crate::relief_ray::{Ray, step_count};
use crate::steep_parallax::first_below;

/// The end of the bracket that lies under the surface, after `bisections` halvings. Layers as [`step_count`] has them.
#[must_use]
pub fn bisect(ray: &Ray, layers: u32, bisections: u32, height: impl Fn(DVec2) -> f64) -> f64 {
    let mut below = first_below(ray, layers, &height);
    let mut size = 1.0 / f64::from(step_count(layers));
    if below == 0.0 {
        return 0.0;
    }
    for _ in 0..bisections {
        size *= 0.5;
        let middle = below - size;
        if height(ray.at(middle)) >= 1.0 - middle {
            below = middle;
        }
    }
    below
}

#[cfg(test)]
mod tests {
    use glam::DVec2;

    use super::bisect;
    use crate::relief_ray::Ray;

    const RAY: Ray = Ray {
        uv_top: DVec2::ZERO,
        delta: DVec2::new(1.0, 0.0),
    };

    #[test]
    fn the_answer_lies_under_the_surface_within_the_last_bracket() {
        let exact = (5f64.sqrt() - 1.0) / 2.0;
        for bisections in [0, 1, 5, 20] {
            let behind = bisect(&RAY, 16, bisections, |uv| uv.x * uv.x) - exact;
            let bracket = 0.0625 * 0.5f64.powi(bisections as i32);
            assert!((0.0..=bracket).contains(&behind), "{bisections}: {behind}");
        }
        assert_eq!(bisect(&RAY, 16, 5, |_| 1.0), 0.0);
        assert_eq!(bisect(&RAY, 0, 0, |_| 0.5), 1.0);
    }

    #[test]
    fn witness_bisection_does_not_bring_back_a_missed_wall() {
        let wall = |uv: DVec2| if (0.30..0.31).contains(&uv.x) { 1.0 } else { 0.25 };
        assert_eq!(bisect(&RAY, 8, 30, wall), 0.75);
    }
}
