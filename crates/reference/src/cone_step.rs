//! `cone_step`: from place to place by the free cone over each.
//!
//! Source: Dummer, *Cone step mapping* (2006). Over every texel stands a cone, tip at the surface, that holds nothing of the surface:
//! all places nearer than ratio · (z − h), measured across, are free. A ray that is g = (1 − t) − h above the tip leaves the cone
//! after ratio · g / (ratio + reach), in t, where reach is the ray's travel across while it crosses the layer.
//!
//! Units: distances across are counted in longer sides of the map, so that a cone is round in texels: a ratio of 1 is one longer
//! side a height of 1. [`reach`] makes a ray's travel fit.
//!
//! Limits. The answer always lies before the hit or at it when the map is safe for every place a ray may stand at; the published map is
//! safe for texel centres only, and filtering mixes cones and heights: what stands between texels may be cut. Steps shrink toward
//! the surface and never end by themselves: the cap counts, and the gap that is left is the error.

use glam::DVec2;

use crate::relief_ray::Ray;

/// Heights by which a ray may stay above the surface and count as having met it.
pub const CLOSE_HEIGHT: f64 = 1.0 / 1024.0;

/// What is read at a place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sample {
    /// Height in [0, 1].
    pub height: f64,
    /// Radius of the cone, in longer sides of the map, a height of 1 over its tip.
    pub ratio: f64,
}

/// The ray's travel across, in longer sides of a map of so many texels.
#[must_use]
pub fn reach(ray: &Ray, sides: DVec2) -> f64 {
    (ray.delta * sides).length() / sides.max_element()
}

/// t after `steps` steps, and whether the ray is then within [`CLOSE_HEIGHT`] of the surface. A ray that meets a surface stays there.
#[must_use]
pub fn step(ray: &Ray, reach: f64, steps: u32, sample: impl Fn(DVec2) -> Sample) -> (f64, bool) {
    let mut t = 0.0;
    for _ in 0..steps {
        t += advance(t, reach, sample(ray.at(t)));
    }
    let gap = (1.0 - t) - sample(ray.at(t)).height;
    (t, gap <= CLOSE_HEIGHT)
}

/// How far one cone lets the ray go on, in t.
pub(crate) fn advance(t: f64, reach: f64, Sample { height, ratio }: Sample) -> f64 {
    let gap = (1.0 - t - height).max(0.0);
    // Straight down, reach 0: the cone's height. A cone without width lets nothing but that through.
    if reach == 0.0 {
        gap
    } else {
        ratio * gap / (ratio + reach)
    }
}

#[cfg(test)]
mod tests {
    use glam::DVec2;

    use super::{Sample, reach, step};
    use crate::relief_ray::Ray;

    const RAY: Ray = Ray {
        uv_top: DVec2::ZERO,
        delta: DVec2::new(1.0, 0.0),
    };

    fn level(ratio: f64) -> impl Fn(DVec2) -> Sample {
        move |_| Sample { height: 0.5, ratio }
    }

    #[test]
    fn gaps_over_level_ground_shrink_by_the_same_factor() {
        // gap ← gap · reach / (ratio + reach): with ratio = reach = 1 it is halved.
        for steps in 0..12 {
            let (t, met) = step(&RAY, 1.0, steps, level(1.0));
            assert_eq!(0.5 - t, 0.5 * 0.5f64.powi(steps as i32));
            assert_eq!(met, steps >= 9, "{steps}: 2⁻¹⁰ is close enough");
        }
    }

    #[test]
    fn a_cone_without_width_stays_and_says_so() {
        assert_eq!(step(&RAY, 1.0, 100, level(0.0)), (0.0, false));
    }

    #[test]
    fn straight_down_one_step_is_enough() {
        let down = Ray {
            delta: DVec2::ZERO,
            ..RAY
        };
        assert_eq!(step(&down, 0.0, 1, level(0.0)), (0.5, true));
    }

    #[test]
    fn a_safe_cone_is_never_left_through_a_wall() {
        // A wall of height 1 from u = 0.5 on: the cone over the ground at u, height ¼, has ratio (0.5 − u)/(1 − ¼).
        let wall = |uv: DVec2| {
            if uv.x < 0.5 {
                Sample {
                    height: 0.25,
                    ratio: (0.5 - uv.x) / 0.75,
                }
            } else {
                Sample {
                    height: 1.0,
                    ratio: 1.0,
                }
            }
        };
        let (t, _) = step(&RAY, 1.0, 1000, wall);
        assert!(t <= 0.5, "{t}");
        // The control: a cone of ratio 4 at u = 0 lets the ray on by 4·¾/5 = 0.6.
        let wide = |uv: DVec2| Sample {
            ratio: 4.0,
            ..wall(uv)
        };
        assert!(step(&RAY, 1.0, 1000, wide).0 > 0.5);
    }

    #[test]
    fn reach_counts_longer_sides() {
        assert_eq!(reach(&RAY, DVec2::new(64.0, 128.0)), 0.5);
        assert_eq!(reach(&RAY, DVec2::new(128.0, 64.0)), 1.0);
    }
}
