//! The rays of a study: where they cross the polygon, and from where they come.
//!
//! Seeded rays have one angle from the normal, places spread evenly over a tile and azimuths over the whole circle, so that no direction of a map is
//! favoured. They are the same on every map. They are rounded to f32 before anything else, since that is what a shader gets: truth is that of
//! the rounded ray.

use bossage_conformance::generate::random::stream;
use glam::{DVec2, DVec3, Vec2, Vec3};
use rand::RngExt;

/// A view ray where it crosses the polygon.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ViewRay {
    /// There, in UV.
    pub uv: Vec2,
    /// To the eye in tangent space; a unit vector but for rounding.
    pub view_ts: Vec3,
}

impl ViewRay {
    /// The very numbers, in f64.
    #[must_use]
    pub fn exact(&self) -> (DVec2, DVec3) {
        (self.uv.as_dvec2(), self.view_ts.as_dvec3())
    }

    /// Angle from the normal, degrees.
    #[must_use]
    pub fn view_deg(&self) -> f64 {
        let (_, view) = self.exact();
        view.truncate().length().atan2(view.z).to_degrees()
    }
}

/// `count` rays at an angle from the normal, degrees. A longer list begins with a shorter one's rays.
#[must_use]
pub fn seeded(view_deg: f64, count: usize, seed: u64) -> Vec<ViewRay> {
    let mut rng = stream(&format!("study rays {view_deg}"), seed);
    let (sin, cos) = view_deg.to_radians().sin_cos();
    let mut unit = || rng.random::<f64>();
    (0..count)
        .map(|_| {
            let (u, v, turn) = (unit(), unit(), unit());
            let (y, x) = (turn * std::f64::consts::TAU).sin_cos();
            ViewRay {
                uv: DVec2::new(u, v).as_vec2(),
                view_ts: DVec3::new(sin * x, sin * y, cos).as_vec3(),
            }
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::seeded;

    #[test]
    fn rays_have_their_angle_and_go_all_ways() {
        for view_deg in [0.0, 30.0, 60.0, 75.0, 85.0] {
            let rays = seeded(view_deg, 4096, 1);
            let mut quadrants = [0; 4];
            for ray in &rays {
                // Three roundings of f32 to nearest on a unit vector: 3·2⁻²⁵ radians, 5e-6 degrees.
                assert!((ray.view_deg() - view_deg).abs() < 1e-5, "{ray:?}");
                assert!((0.0..=1.0).contains(&ray.uv.x) && (0.0..=1.0).contains(&ray.uv.y));
                quadrants[usize::from(ray.view_ts.x > 0.0) + 2 * usize::from(ray.view_ts.y > 0.0)] += 1;
            }
            // A quarter each: 1024 with a standard deviation of 28, of which these are 5.
            if view_deg > 0.0 {
                assert!(
                    quadrants.iter().all(|count| (884..=1164).contains(count)),
                    "{quadrants:?}"
                );
            }
        }
    }

    #[test]
    fn the_same_seed_gives_the_same_rays_and_another_gives_others() {
        assert_eq!(seeded(60.0, 64, 1), seeded(60.0, 64, 1));
        assert_eq!(seeded(60.0, 64, 1)[..16], seeded(60.0, 16, 1));
        assert_ne!(seeded(60.0, 64, 1), seeded(60.0, 64, 2));
        assert_ne!(seeded(60.0, 64, 1)[0].uv, seeded(75.0, 64, 1)[0].uv);
    }
}
