//! `cone_map` and `relaxed_cone_map`: how steep ways up from a place of the surface are, by looking at the surface place by place.
//!
//! Source: Dummer 2006 for free cones, Policarpo and Oliveira 2007 for those that a ray crosses once. Over a place p with the slope s of
//! the steepest way up, in heights a texel, the widest cone that holds none of the surface has a radius of 1/s texels a height. Of
//! a relaxed cone only ways count that end where the surface falls away from p.
//!
//! Places are samples, so a slope is a bound from below; the surface is the bilinear interpolant of the texel centres, which lie at
//! whole numbers. [`boxes`] is a bound from above, by the boxes that cells lie in.

use bossage_assets::{EdgeMode, HeightField};
use glam::DVec2;

/// A sample of the surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Place {
    /// Where, in texels.
    pub at: DVec2,
    /// Its height.
    pub height: f64,
    /// The gradient of its patch, in heights a texel.
    pub gradient: DVec2,
}

/// The heights at the corners of the cell that begins at texel (i, j), which may lie beyond the border: h00, h10, h01, h11.
fn corners(field: &HeightField, edge: EdgeMode, i: i64, j: i64) -> [f64; 4] {
    let texel = |di: i64, dj: i64| {
        let (x, y) = (
            edge.resolve(i + di, field.width),
            edge.resolve(j + dj, field.height),
        );
        f64::from(field.texel(x, y))
    };
    [texel(0, 0), texel(1, 0), texel(0, 1), texel(1, 1)]
}

/// The surface at a place.
#[must_use]
pub fn place(field: &HeightField, edge: EdgeMode, at: DVec2) -> Place {
    let (cell, f) = (at.floor(), at - at.floor());
    let [h00, h10, h01, h11] = corners(field, edge, cell.x as i64, cell.y as i64);
    let (above, below) = (h00 + f.x * (h10 - h00), h01 + f.x * (h11 - h01));
    Place {
        at,
        height: above + f.y * (below - above),
        gradient: DVec2::new(
            (h10 - h00) + f.y * ((h11 - h01) - (h10 - h00)),
            (h01 - h00) + f.x * ((h11 - h10) - (h01 - h00)),
        ),
    }
}

/// Samples of the tile and of those around it, `parts` a texel along each axis, the first `first` of a texel from its centre.
#[must_use]
pub fn surroundings(field: &HeightField, edge: EdgeMode, parts: u32, first: f64) -> Vec<Place> {
    let along = |side: u32| {
        let (side, parts) = (i64::from(side), i64::from(parts));
        (-side * parts..2 * side * parts).map(move |k| first + k as f64 / parts as f64)
    };
    let places = along(field.height).flat_map(|y| along(field.width).map(move |x| DVec2::new(x, y)));
    places.map(|at| place(field, edge, at)).collect()
}

/// The slope of the steepest way up from a place to any of the samples; 0 where none is higher.
#[must_use]
pub fn steepest(from: Place, samples: &[Place]) -> f64 {
    samples.iter().fold(0.0, |most, to| slope(from, to).max(most))
}

/// The same, of ways that end where the surface falls away from the place.
#[must_use]
pub fn steepest_falling(from: Place, samples: &[Place]) -> f64 {
    let falls = |to: &&Place| to.gradient.dot(to.at - from.at) < 0.0;
    samples
        .iter()
        .filter(falls)
        .fold(0.0, |most, to| slope(from, to).max(most))
}

fn slope(from: Place, to: &Place) -> f64 {
    let rise = to.height - from.height;
    if rise > 0.0 {
        rise / to.at.distance(from.at)
    } else {
        0.0
    }
}

/// A slope that no way up from a cell exceeds, for each cell: to cells that it does not touch by highest over lowest height and the
/// distance of the cells, else by the greatest gradient around.
#[must_use]
pub fn boxes(field: &HeightField, edge: EdgeMode) -> Vec<f64> {
    let (w, h) = (i64::from(field.width), i64::from(field.height));
    let cells = (-h..2 * h).flat_map(|j| (-w..2 * w).map(move |i| (i, j)));
    let tops: Vec<(i64, i64, f64)> = cells
        .map(|(i, j)| {
            let top = corners(field, edge, i, j).into_iter().fold(0.0, f64::max);
            (i, j, top)
        })
        .collect();
    let gap = |a: i64, b: i64| ((a - b).abs() - 1).max(0) as f64;
    let bound = |(i, j): (i64, i64)| {
        let lowest = corners(field, edge, i, j).into_iter().fold(1.0, f64::min);
        let far = tops.iter().map(|(x, y, top)| {
            let distance = gap(*x, i).hypot(gap(*y, j));
            if distance > 0.0 {
                (top - lowest) / distance
            } else {
                0.0
            }
        });
        far.fold(greatest_gradient(field, edge, i, j), f64::max)
    };
    (0..h)
        .flat_map(|j| (0..w).map(move |i| (i, j)))
        .map(bound)
        .collect()
}

/// Of a cell and the eight around it, each component by itself.
fn greatest_gradient(field: &HeightField, edge: EdgeMode, i: i64, j: i64) -> f64 {
    let mut most = DVec2::ZERO;
    for (di, dj) in (-1..=1).flat_map(|dj| (-1..=1).map(move |di| (di, dj))) {
        let [h00, h10, h01, h11] = corners(field, edge, i + di, j + dj);
        most = most.max(DVec2::new(h10 - h00, h01 - h00).abs());
        most = most.max(DVec2::new(h11 - h01, h11 - h10).abs());
    }
    most.length()
}

#[cfg(test)]
mod tests {
    use bossage_assets::{EdgeMode, HeightField};
    use glam::DVec2;

    use super::{boxes, place, steepest, steepest_falling, surroundings};

    #[test]
    fn a_spike_is_seen_from_its_distance_and_falls_on_its_far_side_only() {
        let spike = HeightField::from_fn(16, 1, |x, _| if x == 8 { 1.0 } else { 0.0 });
        let (edge, at) = (EdgeMode::Clamp, DVec2::new(3.0, 0.0));
        let from = place(&spike, edge, at);
        let free = steepest(from, &surroundings(&spike, edge, 3, 0.0));
        assert!((free - 1.0 / 5.0).abs() < 1e-12, "{free}");
        // The first sample behind the crest is a sixth of a texel on, and that much lower; no sample lies on the row itself.
        let falling = steepest_falling(from, &surroundings(&spike, edge, 3, 1.0 / 6.0));
        let distance = DVec2::new(5.0 + 1.0 / 6.0, 1.0 / 6.0).length();
        assert!((falling - (5.0 / 6.0) / distance).abs() < 1e-12, "{falling}");
        // By boxes: the cell from 3 to 4 is 3 texels away from the one from 7 to 8, the one at 2 4 of them.
        let by_boxes = boxes(&spike, edge);
        assert_eq!((by_boxes[3], by_boxes[2]), (1.0 / 3.0, 1.0 / 4.0));
    }

    #[test]
    fn across_the_seam_only_a_tile_that_repeats_is_seen() {
        let first = HeightField::from_fn(8, 1, |x, _| if x == 0 { 1.0 } else { 0.0 });
        let slope = |edge| {
            let from = place(&first, edge, DVec2::new(6.0, 0.0));
            steepest(from, &surroundings(&first, edge, 2, 0.0))
        };
        assert_eq!(slope(EdgeMode::Wrap), 1.0 / 2.0);
        assert_eq!(slope(EdgeMode::Clamp), 1.0 / 6.0);
    }
}
