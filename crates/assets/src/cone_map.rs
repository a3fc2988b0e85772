//! `cone_map`: over every texel the widest free cone, safe wherever a ray may stand.
//!
//! Source: Dummer, *Cone step mapping* (2006), for the cones; the published bake looks from texel centre to texel centre only, and a
//! shader reads its map between them. Here a cone stands over **every point** of the bilinear surface: with r the filtered ratio at a
//! point p and L the longer side in texels, no point q of the surface, in this tile or any around it, is nearer to p than
//! r · L · (h(q) − h(p)) texels.
//!
//! Why filtering keeps that: a texel's ratio is read only in the four cells around it, and is not above the ratio of any point of
//! these; so at any point the four ratios that are mixed, and their mean, are not above the point's own.
//!
//! How: the inverse of a point's ratio is the steepest way up from it, and for all points of a cell this is bounded from above by the
//! search of `slope_search` over a pyramid of the whole map, which is near-linear in texels on rough maps.
//! Ratios are at most 1 (a longer side a height of 1) and rounded down. Bounds cost width: a 16th that the search lets go, up to a
//! factor (d + 2)/d for what stands d texels away, and within two texels of an edge the cone is as steep as the edge.

use rayon::prelude::*;

use crate::slope_search::{Cells, Rule};
use crate::{EdgeMode, HeightField};

/// A cone over every texel.
#[derive(Debug, Clone, PartialEq)]
pub struct ConeMap {
    /// Columns.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// Radius of the cone in longer sides of the map, a height of 1 over its tip; in (0, 1).
    pub ratios: Vec<f32>,
}

/// The safe cones of a field.
#[must_use]
pub fn bake(field: &HeightField, edge: EdgeMode) -> ConeMap {
    ConeMap::from_slopes(field, edge, Rule::Free)
}

impl ConeMap {
    /// A texel's ratio is the inverse of the greatest slope of the cells around it.
    pub(crate) fn from_slopes(field: &HeightField, edge: EdgeMode, rule: Rule) -> Self {
        let slopes = Cells::new(field, edge, rule).steepest();
        let (width, height) = (field.width as usize, field.height as usize);
        let longer = field.width.max(field.height) as f32;
        // The cell before the first lies across the seam, or is the border going on: what stands there stands nearer to the first.
        let before = |i: usize, n: usize| match (i, edge) {
            (0, EdgeMode::Wrap) => n - 1,
            (0, EdgeMode::Mirror | EdgeMode::Clamp) => 0,
            (i, _) => i - 1,
        };
        let ratio = |texel: usize| {
            let (x, y) = (texel % width, texel / width);
            let (left, above) = (before(x, width), before(y, height));
            let around = [(x, y), (left, y), (x, above), (left, above)];
            let slope = around
                .into_iter()
                .map(|(x, y)| slopes[y * width + x])
                .fold(0.0, f32::max);
            // Two roundings to nearest, and one step down for each.
            (1.0 / (slope * longer)).min(1.0).next_down().next_down()
        };
        Self {
            width: field.width,
            height: field.height,
            ratios: (0..width * height).into_par_iter().map(ratio).collect(),
        }
    }

    /// The ratios as codes of 16 bits, rounded down so that cones stay free: a code c is c/65535. None is 0 up to
    /// [`MAX_SIDE`](crate::MAX_SIDE) texels a side, since no slope is steeper than √2 heights a texel.
    #[must_use]
    pub fn to_unorm16(&self) -> Vec<u16> {
        // The product is exact in f64, which has room for both factors' bits.
        let code = |ratio: &f32| (f64::from(*ratio) * 65535.0) as u16;
        self.ratios.iter().map(code).collect()
    }
}
