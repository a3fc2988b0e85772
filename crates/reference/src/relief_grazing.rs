//! Which hits count where the truth jumps: a ray that grazes a crest has two, and a machine of 24 bits cannot tell which.
//!
//! The rule. A ray in f32 stands for all rays within a few ULPs of it. Its [`Answers`] are the true first hit and those first hits
//! of the rays whose entry point and direction are moved by up to [`FEW_ULPS`] ULPs, along either axis and both ways, that lie more
//! than [`TOLERANCE_TEXELS`] from it. Such a ray is *grazing*. A result is right when it is near one of the answers; what lies
//! between them is wrong.
//!
//! An ULP of a position is that of the greatest coordinate on the ray: the sum uv_top + t·delta is rounded to it.
//!
//! Most rays are told from grazing ones cheaply and safely: moving a ray by a distance changes the height over the surface by at most
//! that distance times the steepest slope around, so a ray that meets the surface lifted and lowered by that much at nearly the
//! same place does not graze (`slopes`). [`Surface::span`] asks the same of a whole box of rays.

use bossage_assets::{EdgeMode, HeightField};
use glam::DVec2;

use crate::relief_ray::Ray;
use crate::relief_truth::cells::sides;
use crate::relief_truth::{Hit, first_hit, first_hit_over};

mod slopes;
mod span;

use slopes::Slopes;
pub use slopes::steepest;
pub use span::Span;

/// By how many f32 ULPs a ray may be moved.
pub const FEW_ULPS: u32 = 4;

/// Hits nearer than this count as the same, in texels.
pub const TOLERANCE_TEXELS: f64 = 0.01;

/// A height field whose slopes are known.
#[derive(Clone, Debug)]
pub struct Surface<'a> {
    field: &'a HeightField,
    edge: EdgeMode,
    slopes: Slopes,
}

/// The hits that count for one ray.
#[derive(Clone, Debug, PartialEq)]
pub struct Answers {
    /// The first hit of the ray itself.
    pub truth: Hit,
    /// The hits of the rays beside it that lie elsewhere; empty unless the ray grazes.
    pub others: Vec<Hit>,
    sides: DVec2,
}

impl Answers {
    /// Whether the truth jumps when the ray moves by [`FEW_ULPS`].
    #[must_use]
    pub fn is_grazing(&self) -> bool {
        !self.others.is_empty()
    }

    /// Texels a tile, along u and v.
    #[must_use]
    pub fn sides(&self) -> DVec2 {
        self.sides
    }

    /// Distance of a result from the true hit of the very ray, in texels.
    #[must_use]
    pub fn distance_texels(&self, uv: DVec2) -> f64 {
        ((uv - self.truth.uv) * self.sides).length()
    }

    /// Distance of a result from the nearest hit that counts, in texels.
    #[must_use]
    pub fn error_texels(&self, uv: DVec2) -> f64 {
        let others = self
            .others
            .iter()
            .map(|hit| ((uv - hit.uv) * self.sides).length());
        others.fold(self.distance_texels(uv), f64::min)
    }
}

impl<'a> Surface<'a> {
    /// Looks at every cell, and at those around it.
    #[must_use]
    pub fn new(field: &'a HeightField, edge: EdgeMode) -> Self {
        Self {
            field,
            edge,
            slopes: Slopes::new(field, edge),
        }
    }

    /// All hits that count for a ray.
    #[must_use]
    pub fn answers(&self, ray: &Ray) -> Answers {
        let mut answers = Answers {
            truth: first_hit(self.field, self.edge, ray),
            others: Vec::new(),
            sides: sides(self.field),
        };
        if !self.may_graze(ray) {
            return answers;
        }
        for moved in beside(ray) {
            let hit = first_hit(self.field, self.edge, &moved);
            if answers.error_texels(hit.uv) > TOLERANCE_TEXELS {
                answers.others.push(hit);
            }
        }
        answers
    }

    /// The least and the greatest t at which a ray that is nowhere further away than `moved`, in UV, can meet the surface.
    fn ends(&self, ray: &Ray, moved: DVec2) -> [f64; 2] {
        let moved_texels = moved * sides(self.field);
        [1.0, -1.0].map(|sign| {
            let lift = |cell| sign * self.slopes.change(cell, moved_texels);
            first_hit_over(self.field, self.edge, ray, lift).t
        })
    }

    /// False only where no ray beside this one meets the surface elsewhere.
    fn may_graze(&self, ray: &Ray) -> bool {
        let (position, direction) = ulps(ray);
        let moved = f64::from(FEW_ULPS) * (position + direction);
        let [first, last] = self.ends(ray, moved);
        let spread_texels = (last - first) * (ray.delta * sides(self.field)).length();
        spread_texels + (moved * sides(self.field)).length() > TOLERANCE_TEXELS
    }
}

/// One ULP of the ray's positions and of its direction, per axis, in UV.
fn ulps(ray: &Ray) -> (DVec2, DVec2) {
    let furthest = ray.uv_top.abs().max(ray.at(1.0).abs());
    let per_axis = |v: DVec2| DVec2::new(ulp(v.x), ulp(v.y));
    (per_axis(furthest), per_axis(ray.delta))
}

/// The gap between neighbouring f32 numbers at a magnitude.
fn ulp(x: f64) -> f64 {
    let exponent = if x.abs() < f64::from(f32::MIN_POSITIVE) {
        -126.0
    } else {
        x.abs().log2().floor()
    };
    (exponent - 23.0).exp2()
}

/// Rays within [`FEW_ULPS`] of one, in all directions, near and far.
fn beside(ray: &Ray) -> impl Iterator<Item = Ray> {
    let (ray, (position, direction)) = (*ray, ulps(ray));
    let ways = [-1.0, 0.0, 1.0];
    let offsets = ways.into_iter().flat_map(move |x| ways.map(|y| DVec2::new(x, y)));
    let turns = move || ways.into_iter().flat_map(move |x| ways.map(|y| DVec2::new(x, y)));
    let distances = [1.0, f64::from(FEW_ULPS)];
    offsets.flat_map(move |offset| {
        turns().flat_map(move |turn| {
            distances.map(|ulps| Ray {
                uv_top: ray.uv_top + ulps * offset * position,
                delta: ray.delta + ulps * turn * direction,
            })
        })
    })
}

#[cfg(test)]
mod tests {
    use bossage_assets::{EdgeMode, HeightField};
    use glam::DVec2;

    use super::{FEW_ULPS, Surface, TOLERANCE_TEXELS, ulp};
    use crate::relief_ray::Ray;

    /// A wall one texel wide at column 20 of 64, up to height `top`, over ground of height 1/4.
    fn wall(top: f32) -> HeightField {
        HeightField::from_fn(64, 4, |x, _| if x == 20 { top } else { 0.25 })
    }

    /// Falls from height 1 at u = 0 by one height a tile.
    const RAY: Ray = Ray {
        uv_top: DVec2::new(0.0, 0.5),
        delta: DVec2::new(1.0, 0.0),
    };

    /// The height at which [`RAY`] passes the wall's crest.
    const PASSES: f64 = 1.0 - 20.5 / 64.0;

    #[test]
    fn a_ray_over_the_very_crest_has_two_answers() {
        let field = wall(PASSES as f32);
        let answers = Surface::new(&field, EdgeMode::Clamp).answers(&RAY);
        assert!(answers.is_grazing());
        let crest = DVec2::new(20.5 / 64.0, 0.5);
        let ground = DVec2::new(0.75, 0.5);
        for right in [crest, ground] {
            // The rays beside are moved by 4 ULPs of 2⁻²³ tiles, a few 1e-5 texels on the ground.
            assert!(answers.error_texels(right) <= TOLERANCE_TEXELS, "{right}");
        }
        for wrong in [0.5 * (crest + ground), crest + 0.1, ground - 0.1] {
            assert!(answers.error_texels(wrong) > 1.0, "{wrong}");
        }
    }

    #[test]
    fn a_ray_that_clears_or_strikes_the_crest_has_one() {
        // The ray moves against the wall's flank, 64·0.43 heights a tile, by 4 ULPs of 2⁻²³ and a third of that by its direction:
        // 2e-5 heights at most.
        for gap in [1e-3, 4e-5, -4e-5, -1e-3] {
            let field = wall((PASSES - gap) as f32);
            let answers = Surface::new(&field, EdgeMode::Clamp).answers(&RAY);
            assert!(!answers.is_grazing(), "{gap}");
            let met = if gap > 0.0 { 0.75 } else { 20.5 / 64.0 };
            assert!(answers.error_texels(DVec2::new(met, 0.5)) < 0.1, "{gap}");
        }
    }

    #[test]
    fn the_cheap_test_forgets_no_grazing_ray() {
        // Rays over all gaps around the crest: what the cheap test lets pass must not move.
        for step in -40..=40 {
            let field = wall((PASSES + f64::from(step) * 1e-6) as f32);
            let surface = Surface::new(&field, EdgeMode::Clamp);
            let hits = super::beside(&RAY).map(|ray| super::first_hit(&field, EdgeMode::Clamp, &ray).uv.x);
            let (least, greatest) = hits.fold((f64::INFINITY, 0.0f64), |(l, g), u| (l.min(u), g.max(u)));
            let jumps = (greatest - least) * 64.0 > TOLERANCE_TEXELS;
            assert_eq!(surface.answers(&RAY).is_grazing(), jumps, "{step}");
        }
    }

    #[test]
    fn an_ulp_is_a_gap_of_f32() {
        for x in [1.0f32, 0.75, 3.0e-5, 511.0, 1e-40] {
            assert_eq!(ulp(f64::from(x)), f64::from(x.next_up()) - f64::from(x), "{x}");
        }
        assert_eq!(ulp(0.0), f64::from(f32::from_bits(1)));
        assert_eq!(FEW_ULPS, 4);
    }
}
