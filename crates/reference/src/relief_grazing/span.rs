//! Where the hits of a whole box of rays lie, and whether they lie in one piece: the question of an evaluator that knows a ray's
//! entry and direction as intervals.
//!
//! A ray of the box is nowhere further from the one in the middle than entry and direction add up to. So it meets nothing before the
//! middle meets the surface lifted by what the slopes around make of that distance, and has met it where the middle meets it lowered.
//!
//! Between these two ends the hit may still jump, where the box holds rays over a crest and rays into it. It does not where every ray
//! of the box sinks into the surface all the way from end to end: then each meets it once, and the hit moves with the ray.

use glam::{DVec2, I64Vec2};

use super::slopes::stays_around;
use super::{FEW_ULPS, Surface, TOLERANCE_TEXELS, ulps};
use crate::relief_ray::Ray;
use crate::relief_truth::cells::{Patch, Walk, sides};

/// Where the answers to a box of rays lie.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Span {
    /// The least uv, not wrapped.
    pub low: DVec2,
    /// The greatest uv.
    pub high: DVec2,
    /// Whether the hit surely moves steadily from any ray of the box to any other: none of them grazes.
    pub in_one_piece: bool,
}

impl Surface<'_> {
    /// Where all answers lie to all rays that enter and travel within so much of this one per axis, in UV, each within the tolerance.
    #[must_use]
    pub fn span(&self, ray: &Ray, entry: DVec2, travel: DVec2) -> Span {
        let (position, direction) = ulps(ray);
        // Twice, since a ray of the box may lie beyond the next power of two.
        let ulps = 2.0 * f64::from(FEW_ULPS);
        let moved = entry + travel + ulps * (position + direction);
        let ends = self.ends(ray, moved);
        let [first, last] = ends.map(|t| ray.at(t));
        let margin = moved + TOLERANCE_TEXELS / sides(self.field);
        Span {
            low: first.min(last) - margin,
            high: first.max(last) + margin,
            in_one_piece: self.sink(ray, ends, moved, travel + ulps * direction),
        }
    }

    /// Whether all rays that are within `moved` of this one, of directions within `travel`, sink into the surface from end to end.
    fn sink(&self, ray: &Ray, [first, last]: [f64; 2], moved: DVec2, travel: DVec2) -> bool {
        let moved_texels = moved * sides(self.field);
        if !stays_around(moved_texels) {
            return false;
        }
        let mut walk = Walk::new(self.field, ray, last);
        loop {
            if walk.exit() >= first {
                // Where rays of the box may be while this one is in the cell, in texels.
                let [enter, leave] = [walk.t.max(first), walk.exit()].map(|t| walk.origin + t * walk.delta);
                let cells = [
                    (enter.min(leave) - moved_texels).floor().as_i64vec2(),
                    (enter.max(leave) + moved_texels).floor().as_i64vec2(),
                ];
                // A ray sinks by 1 in a unit of t, and the surface below it must not sink as fast.
                if self.least_rise(cells, ray.delta, travel) <= -1.0 {
                    return false;
                }
            }
            if walk.is_last() {
                return true;
            }
            walk.advance();
        }
    }

    /// The least rise of the surface in a unit of t, in cells from one corner to the other, along any direction within `travel` of `delta`.
    fn least_rise(&self, [low, high]: [I64Vec2; 2], delta: DVec2, travel: DVec2) -> f64 {
        let directions = [delta - travel, delta + travel].map(|end| end * sides(self.field));
        let cells = (low.y..=high.y).flat_map(|j| (low.x..=high.x).map(move |i| [i, j]));
        let rise = |cell| {
            let slopes = Patch::new(self.field, self.edge, cell).slopes();
            let along = |axis: usize| {
                let rises = slopes[axis].map(|slope| directions.map(|direction| slope * direction[axis]));
                rises.into_iter().flatten().fold(f64::INFINITY, f64::min)
            };
            along(0) + along(1)
        };
        cells.map(rise).fold(f64::INFINITY, f64::min)
    }
}

#[cfg(test)]
mod tests {
    use bossage_assets::{EdgeMode, HeightField};
    use glam::DVec2;

    use super::super::Surface;
    use super::Span;
    use crate::relief_ray::Ray;
    use crate::relief_truth::first_hit;

    /// A wall one texel wide at column 20 of 64, up to height `top`, over ground of height 1/4 with low waves.
    fn wall(top: f32) -> HeightField {
        let ground = |x: u32| 0.25 + 0.01 * (0.7 * x as f32).sin();
        HeightField::from_fn(64, 4, |x, _| if x == 20 { top } else { ground(x) })
    }

    /// Rays of a box around one: its corners, its middle, and places between.
    fn of_box(ray: &Ray, entry: DVec2, travel: DVec2) -> impl Iterator<Item = Ray> {
        let ways = [-1.0, -0.3, 0.0, 0.6, 1.0];
        let two = move || ways.into_iter().flat_map(move |x| ways.map(|y| DVec2::new(x, y)));
        let ray = *ray;
        two().flat_map(move |a| {
            two().map(move |b| Ray {
                uv_top: ray.uv_top + a * entry,
                delta: ray.delta + b * travel,
            })
        })
    }

    /// The rays of a box whose answers lie outside of a span.
    fn outside(surface: &Surface<'_>, ray: &Ray, entry: DVec2, travel: DVec2, span: &Span) -> usize {
        let beyond = |ray: &Ray| {
            let uv = surface.answers(ray).truth.uv;
            uv.cmplt(span.low).any() || uv.cmpgt(span.high).any()
        };
        of_box(ray, entry, travel).filter(beyond).count()
    }

    #[test]
    fn a_span_holds_the_hits_of_every_ray_of_its_box_and_that_of_a_smaller_box_does_not() {
        let (mut apart, mut missed) = (0, 0);
        for (top, edge) in [
            (0.9, EdgeMode::Wrap),
            (0.5, EdgeMode::Mirror),
            (1.0, EdgeMode::Clamp),
        ] {
            let field = wall(top);
            let surface = Surface::new(&field, edge);
            for step in 0..24 {
                let ray = Ray {
                    uv_top: DVec2::new(0.013 * f64::from(step), 0.4),
                    delta: DVec2::new(0.35, 0.02 * f64::from(step % 5)),
                };
                let (entry, travel) = (DVec2::new(0.004, 0.002), DVec2::new(0.003, 0.001));
                let span = surface.span(&ray, entry, travel);
                assert_eq!(
                    outside(&surface, &ray, entry, travel, &span),
                    0,
                    "{ray:?} {span:?}"
                );
                let smaller = surface.span(&ray, 0.25 * entry, 0.25 * travel);
                missed += outside(&surface, &ray, entry, travel, &smaller);
                apart += usize::from(!span.in_one_piece);
            }
        }
        assert!(missed > 0, "smaller boxes hold all");
        assert!(apart > 0, "no box of rays grazes the wall");
    }

    /// The greatest distance, in texels, between the hits of neighbours among so many rays from one corner of the box to the other.
    fn greatest_jump(surface: &Surface<'_>, ray: &Ray, entry: DVec2, travel: DVec2, steps: u32) -> f64 {
        let hit = |step: u32| {
            let way = 2.0 * f64::from(step) / f64::from(steps) - 1.0;
            let ray = Ray {
                uv_top: ray.uv_top + way * entry,
                delta: ray.delta + way * travel,
            };
            first_hit(surface.field, surface.edge, &ray).uv * DVec2::new(64.0, 4.0)
        };
        (0..steps)
            .map(|step| hit(step).distance(hit(step + 1)))
            .fold(0.0, f64::max)
    }

    #[test]
    fn hits_in_one_piece_move_steadily_and_others_jump() {
        let (mut steady, mut jumps) = (0, 0);
        for step in 0..100 {
            let field = wall(0.9);
            let surface = Surface::new(&field, EdgeMode::Wrap);
            let ray = Ray {
                // Step 50 passes the wall at its crest: 0.0353 + 0.25 + 0.35·0.1 is the middle of column 20.
                uv_top: DVec2::new(0.0353 + 0.005 * f64::from(step), 0.4),
                delta: DVec2::new(0.35, 0.02),
            };
            let (entry, travel) = (DVec2::new(0.001, 0.002), DVec2::new(0.0005, 0.001));
            let [coarse, fine] = [16, 4096].map(|steps| greatest_jump(&surface, &ray, entry, travel, steps));
            // 256 times as many rays: a steady hit moves about 1/256 as far from one to the next, a jump stays.
            if surface.span(&ray, entry, travel).in_one_piece {
                steady += 1;
                assert!(fine <= coarse / 16.0 + 1e-9, "{step}: {coarse} {fine}");
            } else {
                jumps += usize::from(fine > 1.0);
            }
        }
        assert!(steady > 50, "only {steady} of 100 boxes hold hits in one piece");
        assert!(jumps > 0, "no box of rays grazes the wall");
    }
}
