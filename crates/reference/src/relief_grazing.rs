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
//! that distance times the steepest slope of the map, so a ray that meets the surface lifted and lowered by that much at nearly the
//! same place does not graze.

use bossage_assets::{EdgeMode, HeightField};
use glam::DVec2;

use crate::relief_ray::Ray;
use crate::relief_truth::cells::sides;
use crate::relief_truth::{Hit, first_hit, first_hit_lifted};

/// By how many f32 ULPs a ray may be moved.
pub const FEW_ULPS: u32 = 4;

/// Hits nearer than this count as the same, in texels.
pub const TOLERANCE_TEXELS: f64 = 0.01;

/// A height field whose steepest slopes are known.
#[derive(Clone, Debug)]
pub struct Surface<'a> {
    field: &'a HeightField,
    edge: EdgeMode,
    /// The greatest difference between neighbouring texels along each axis.
    steepest: DVec2,
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

/// Where the answers to a box of rays lie.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Span {
    /// The least uv, not wrapped.
    pub low: DVec2,
    /// The greatest uv.
    pub high: DVec2,
    /// How far the first and the last hit along the ray in the middle are apart, in texels: much, where a ray of the box may graze.
    pub texels: f64,
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
    /// Looks at every texel once.
    #[must_use]
    pub fn new(field: &'a HeightField, edge: EdgeMode) -> Self {
        let (w, h) = (i64::from(field.width), i64::from(field.height));
        let texel = |x: i64, y: i64| {
            f64::from(field.texel(edge.resolve(x, field.width), edge.resolve(y, field.height)))
        };
        // One texel beyond the border on either side: there is the step over the seam.
        let steps = (-1..=h).flat_map(|y| (-1..=w).map(move |x| (x, y)));
        let step = |(x, y): (i64, i64)| {
            DVec2::new(
                (texel(x + 1, y) - texel(x, y)).abs(),
                (texel(x, y + 1) - texel(x, y)).abs(),
            )
        };
        Self {
            field,
            edge,
            steepest: steps.map(step).fold(DVec2::ZERO, DVec2::max),
        }
    }

    /// The greatest difference between neighbouring texels along each axis.
    #[must_use]
    pub fn steepest(&self) -> DVec2 {
        self.steepest
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

    /// Where all answers lie to all rays that enter and travel within so much of this one per axis, in UV, each within the tolerance.
    ///
    /// A ray of the box is nowhere further from this one than both add up to, so its surface is within what the steepest slope makes
    /// of that: it meets nothing before this ray meets the surface lifted by as much, and has met it where this one meets it lowered.
    #[must_use]
    pub fn span(&self, ray: &Ray, entry: DVec2, travel: DVec2) -> Span {
        let (position, direction) = ulps(ray);
        // Twice, since a ray of the box may lie beyond the next power of two.
        let moved = entry + travel + 2.0 * f64::from(FEW_ULPS) * (position + direction);
        let [first, last] = self.ends(ray, moved).map(|t| ray.at(t));
        let margin = moved + TOLERANCE_TEXELS / sides(self.field);
        Span {
            low: first.min(last) - margin,
            high: first.max(last) + margin,
            texels: ((last - first) * sides(self.field)).length(),
        }
    }

    /// The least and the greatest t at which a ray that is nowhere further away than `moved`, in UV, can meet the surface.
    fn ends(&self, ray: &Ray, moved: DVec2) -> [f64; 2] {
        let lift = (moved * sides(self.field)).dot(self.steepest);
        [lift, -lift].map(|lift| first_hit_lifted(self.field, self.edge, ray, lift).t)
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
    fn outside(surface: &Surface<'_>, ray: &Ray, entry: DVec2, travel: DVec2, span: &super::Span) -> usize {
        let beyond = |ray: &Ray| {
            let uv = surface.answers(ray).truth.uv;
            uv.cmplt(span.low).any() || uv.cmpgt(span.high).any()
        };
        of_box(ray, entry, travel).filter(beyond).count()
    }

    #[test]
    fn a_span_holds_the_hits_of_every_ray_of_its_box_and_that_of_a_smaller_box_does_not() {
        let (mut wide, mut missed) = (0, 0);
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
                wide += usize::from(span.texels > 5.0);
            }
        }
        assert!(missed > 0, "smaller boxes hold all");
        assert!(wide > 0, "no box of rays grazes the wall");
    }
}
