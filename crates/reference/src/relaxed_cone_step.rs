//! `relaxed_cone_step`: wide cones that a ray may leave under the surface, and bisection back.
//!
//! Source: Policarpo and Oliveira, *Relaxed cone stepping for relief mapping* (GPU Gems 3, 2007). A relaxed cone is so wide that a ray
//! in it crosses the surface at most once. The cones are stepped through a fixed number of times; then the way from the entry to
//! that place is bisected.
//!
//! Units as in `cone_step`. Limits: where the surface was not reached, bisection ends at the place the steps ended at, before the hit;
//! where the map is not the widest that is right, a ray may have crossed twice, and the bisection finds one of the crossings.

use glam::DVec2;

use crate::cone_step::{CLOSE_HEIGHT, Sample, advance};
use crate::relief_ray::Ray;

/// t after `steps` cones and `bisections` halvings, and whether the ray is then under the surface or within
/// [`CLOSE_HEIGHT`] of it.
#[must_use]
pub fn step_and_bisect(
    ray: &Ray,
    reach: f64,
    steps: u32,
    bisections: u32,
    sample: impl Fn(DVec2) -> Sample,
) -> (f64, bool) {
    let mut end = 0.0;
    for _ in 0..steps {
        // Under the surface no cone leads on.
        end += advance(end, reach, sample(ray.at(end)));
    }
    let gap = |t: f64| (1.0 - t) - sample(ray.at(t)).height;
    let (mut t, mut half) = (0.5 * end, 0.5 * end);
    for _ in 0..bisections {
        half *= 0.5;
        t += if gap(t) > 0.0 { half } else { -half };
    }
    (t, gap(t) <= CLOSE_HEIGHT)
}

#[cfg(test)]
mod tests {
    use glam::DVec2;

    use super::step_and_bisect;
    use crate::cone_step::Sample;
    use crate::relief_ray::Ray;

    const RAY: Ray = Ray {
        uv_top: DVec2::ZERO,
        delta: DVec2::new(1.0, 0.0),
    };

    /// Ground at ¼ before a ramp that rises to 1 at u = 0.6: the ray is under it from u = 0.5 on; relaxed cones reach the ramp's top.
    fn ramp(uv: DVec2) -> Sample {
        Sample {
            height: (0.5 + 5.0 * (uv.x - 0.5)).clamp(0.25, 1.0),
            ratio: (0.6 - uv.x).max(0.0) / 0.75,
        }
    }

    #[test]
    fn bisection_comes_back_to_the_only_crossing() {
        let (t, met) = step_and_bisect(&RAY, 1.0, 30, 30, ramp);
        assert!(met && (t - 0.5).abs() < 1e-8, "{t}");
    }

    #[test]
    fn too_few_cones_stop_before_the_surface_and_say_so() {
        let (t, met) = step_and_bisect(&RAY, 1.0, 1, 20, ramp);
        assert!(!met && t < 0.5, "{t}");
    }

    #[test]
    fn a_ray_that_enters_under_the_surface_stays_at_the_top() {
        let top = |_| Sample {
            height: 1.0,
            ratio: 1.0,
        };
        assert_eq!(step_and_bisect(&RAY, 1.0, 8, 8, top), (0.0, true));
    }
}
