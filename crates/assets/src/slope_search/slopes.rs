//! Ranges of slopes of some cells: within them lie all gradients of their patches.
//!
//! Inside a cell ∂h/∂x is linear in y and ∂h/∂y linear in x, so each takes its least and greatest value on the cell's edges.

use rayon::prelude::*;

use crate::EdgeMode;

/// Least and greatest ∂h/∂x, and ∂h/∂y, in heights a texel.
pub(super) type Slopes = [[f32; 2]; 2];

/// The greatest length of a gradient.
pub(super) fn greatest(slopes: &Slopes) -> f32 {
    let [x, y] = slopes.map(|[least, greatest]| greatest.max(-least));
    (x * x + y * y).sqrt()
}

/// The greatest length of a difference of two gradients.
pub(super) fn difference(slopes: &Slopes) -> f32 {
    let [x, y] = slopes.map(|[least, greatest]| greatest - least);
    (x * x + y * y).sqrt()
}

/// The ranges that hold both.
pub(super) fn hull(a: &Slopes, b: &Slopes) -> Slopes {
    [0, 1].map(|axis| [a[axis][0].min(b[axis][0]), a[axis][1].max(b[axis][1])])
}

/// The hull of all cells within `radius` of each, along both axes.
pub(super) fn within(mut slopes: Vec<Slopes>, sides: [u32; 2], edge: EdgeMode, radius: u32) -> Vec<Slopes> {
    let mut reached = 0;
    while reached < radius {
        // A square and its copies beside it, which may touch but must not leave a gap.
        let step = (2 * reached + 1).min(radius - reached);
        slopes = widen(&slopes, sides, edge, step);
        reached += step;
    }
    slopes
}

/// The hull of the nine cells `step` apart around each cell.
fn widen(slopes: &[Slopes], sides: [u32; 2], edge: EdgeMode, step: u32) -> Vec<Slopes> {
    let width = sides[0] as usize;
    let along = |slopes: &[Slopes], axis: usize| -> Vec<Slopes> {
        let stride = if axis == 0 { 1 } else { width };
        let cell = |index: usize| {
            let place = if axis == 0 { index % width } else { index / width };
            let first = index - place * stride;
            [-1, 1].iter().fold(slopes[index], |all, way| {
                let (neighbour, turned) = neighbour(place as i64 + way * i64::from(step), sides[axis], edge);
                let mut there = slopes[first + neighbour * stride];
                if turned {
                    there[axis] = [-there[axis][1], -there[axis][0]];
                }
                hull(&all, &there)
            })
        };
        (0..slopes.len()).into_par_iter().map(cell).collect()
    };
    along(&along(slopes, 0), 1)
}

/// The cell that stands at a place that may lie outside, and whether it is turned round there. A border that goes on is level across,
/// which the hull of a cell and its mirror image holds as well.
fn neighbour(place: i64, side: u32, edge: EdgeMode) -> (usize, bool) {
    let last = i64::from(side) - 1;
    let inside = match edge {
        EdgeMode::Wrap => return (place.rem_euclid(i64::from(side)) as usize, false),
        EdgeMode::Mirror | EdgeMode::Clamp if place < 0 => -2 - place,
        EdgeMode::Mirror | EdgeMode::Clamp if place > last => 2 * last - place,
        EdgeMode::Mirror | EdgeMode::Clamp => return (place as usize, false),
    };
    (inside.clamp(0, last) as usize, true)
}
