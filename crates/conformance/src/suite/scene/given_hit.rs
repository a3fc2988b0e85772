//! The acceptance intervals of a surface with `exact`, around its walk.
//!
//! A walk has no useful interval: it goes from border to border of blocks of texels, where each next block is undecided. What it finds is judged by
//! itself (`suite::relief::exact`): within 0.01 texel of the true hit of a ray within 4 ULP of its own. So the surface is evaluated as
//! a variant of the same module to which the hit is given, twice: first for the interval of the ray that the walk is handed, then with
//! all hits given that the rays of this interval may have.
//!
//! The colour is then that of any hit of any such ray. Where these do not lie in one piece, as where some of the rays graze a crest, the
//! outputs join several results, and count as undecided.

use bossage_assets::{EdgeMode, HeightField};
use bossage_bounds::{Flags, Interval};
use bossage_reference::relief_grazing::{Span, Surface, steepest};
use bossage_reference::relief_ray::Ray;
use bossage_reference::relief_truth::height_at;
use glam::DVec2;
use rayon::prelude::*;

use crate::bound::Bound;
use crate::oracle::stages::{Inputs, Outputs, Stage};
use crate::suite::relief::off_surface;

/// The inputs of the variant.
const HIT: &str = "hit_uv";
const DEPTH: &str = "hit_t";

/// Where it writes its ray.
const RAY: u32 = 1;

/// The intervals, and of which invocations the hits may lie in several pieces.
pub(super) fn intervals(
    stage: &Stage<'_>,
    inputs: &Inputs,
    heights: &HeightField,
    edge: EdgeMode,
) -> Result<(Outputs, Vec<bool>), String> {
    let anywhere = [Interval::unknown(Flags::UNDECIDED); 2];
    let any_depth = [Interval::unknown(Flags::UNDECIDED)];
    let nowhere = inputs
        .clone()
        .with_intervals(HIT, (0..inputs.count()).map(|_| anywhere))
        .with_intervals(DEPTH, (0..inputs.count()).map(|_| any_depth));
    let rays = stage.fragments(&nowhere)?;
    let rays = (0..inputs.count()).map(|at| rays.location::<4>(RAY, at));
    let rays = rays.collect::<Result<Vec<_>, _>>()?;
    let surface = Surface::new(heights, edge);
    let spans: Vec<Option<Span>> = rays.par_iter().map(|ray| span(&surface, ray)).collect();
    let hits = spans.iter().map(|span| {
        span.map_or(anywhere, |span| {
            [0, 1].map(|axis| Interval::new(span.low[axis], span.high[axis]))
        })
    });
    let steepest = steepest(heights, edge);
    let depths = spans.par_iter().map(|span| {
        span.as_ref().map_or(any_depth, |span| {
            let [low, high] = depths(steepest, heights, edge, span);
            [Interval::new(low, high)]
        })
    });
    let depths: Vec<[Interval; 1]> = depths.collect();
    let given = inputs
        .clone()
        .with_intervals(HIT, hits)
        .with_intervals(DEPTH, depths.into_iter());
    let outputs = stage.fragments(&given)?;
    let in_pieces = |span: &Option<Span>| span.is_some_and(|span| !span.in_one_piece);
    Ok((outputs, spans.iter().map(in_pieces).collect()))
}

/// Where the hits of the rays of a box lie; none where the ray is open.
fn span(surface: &Surface<'_>, ray: &[Bound; 4]) -> Option<Span> {
    if !ray.iter().all(Bound::is_decided) {
        return None;
    }
    let low = ray.each_ref().map(Bound::low);
    let high = ray.each_ref().map(Bound::high);
    let two = |numbers: [f64; 4], first: usize| DVec2::new(numbers[first], numbers[first + 1]);
    let middle = |first| 0.5 * (two(low, first) + two(high, first));
    let ray = Ray {
        uv_top: middle(0),
        delta: middle(2),
    };
    // To the further end, whatever the rounding of the middle.
    let reach = |first: usize, middle: DVec2| (two(high, first) - middle).max(middle - two(low, first));
    Some(surface.span(&ray, reach(0, ray.uv_top), reach(2, ray.delta)))
}

/// Between which t the records of hits within a span lie. A hit is on the surface, at the height 1 − t: no further from that in the
/// middle of the span than the steepest slope makes of the way there, and a record as far off the surface as it may be.
fn depths(steepest: DVec2, heights: &HeightField, edge: EdgeMode, span: &Span) -> [f64; 2] {
    let sides = DVec2::new(f64::from(heights.width), f64::from(heights.height));
    let middle = 0.5 * (span.low + span.high);
    let way = (0.5 * (span.high - span.low) * sides).dot(steepest);
    let off = way + off_surface(steepest);
    let t = 1.0 - height_at(heights, edge, middle);
    [t - off, t + off].map(|t| t.clamp(0.0, 1.0))
}
