//! How steep a surface is around each of its cells, and so by how much its height may change from a place of a cell to another.

use bossage_assets::{EdgeMode, HeightField};
use glam::DVec2;

use crate::relief_truth::cells::Patch;

/// The greatest difference between neighbouring texels along each axis, in heights a texel.
#[must_use]
pub fn steepest(field: &HeightField, edge: EdgeMode) -> DVec2 {
    let cells = (-1..i64::from(field.height))
        .flat_map(|j| (-1..i64::from(field.width)).map(move |i| steepest_in(field, edge, [i, j])));
    cells.fold(DVec2::ZERO, DVec2::max)
}

/// Of one cell: a bilinear patch is steepest along its edges.
fn steepest_in(field: &HeightField, edge: EdgeMode, cell: [i64; 2]) -> DVec2 {
    let patch = Patch::new(field, edge, cell);
    let [x, y] = patch.slopes();
    DVec2::new(x[0].abs().max(x[1].abs()), y[0].abs().max(y[1].abs()))
}

/// The steepest slopes of a field, around each cell and of all.
#[derive(Clone, Debug)]
pub(super) struct Slopes {
    edge: EdgeMode,
    /// Cells along each axis: one more than texels, since there is one beyond either border.
    cells: [usize; 2],
    /// For each cell, row by row from cell (−1, −1), the steepest of it and of the eight around it.
    around: Vec<DVec2>,
    steepest: DVec2,
}

impl Slopes {
    pub(super) fn new(field: &HeightField, edge: EdgeMode) -> Self {
        let cells = [field.width as usize + 1, field.height as usize + 1];
        let numbers = |count: usize| (0..count as i64).map(|number| number - 1);
        let own =
            numbers(cells[1]).flat_map(|j| numbers(cells[0]).map(move |i| steepest_in(field, edge, [i, j])));
        let mut slopes = Self {
            edge,
            cells,
            around: own.collect(),
            steepest: DVec2::ZERO,
        };
        slopes.steepest = slopes.around.iter().copied().fold(DVec2::ZERO, DVec2::max);
        // Along one axis after the other: the greatest of three by three.
        for axis in 0..2 {
            slopes.around = slopes.widened(axis);
        }
        slopes
    }

    /// The greatest of each cell and the one before and behind it along an axis.
    fn widened(&self, axis: usize) -> Vec<DVec2> {
        let [columns, rows] = self.cells.map(|count| count as i64);
        let cells = (-1..rows - 1).flat_map(|j| (-1..columns - 1).map(move |i| [i, j]));
        let three = |cell: [i64; 2]| {
            let beside = |step: i64| {
                let mut cell = cell;
                cell[axis] += step;
                self.around[self.index(cell)]
            };
            beside(-1).max(beside(0)).max(beside(1))
        };
        cells.map(three).collect()
    }

    fn index(&self, [i, j]: [i64; 2]) -> usize {
        let [column, row] = [self.resolve(i, self.cells[0]), self.resolve(j, self.cells[1])];
        row * self.cells[0] + column
    }

    /// Which cell of the tile stands for one anywhere, counted from the one beyond the border.
    fn resolve(&self, cell: i64, count: usize) -> usize {
        let texels = count as i64 - 1;
        let within = match self.edge {
            EdgeMode::Wrap => cell.rem_euclid(texels),
            EdgeMode::Clamp => cell.clamp(-1, texels - 1),
            EdgeMode::Mirror => {
                let turned = cell.rem_euclid(2 * texels);
                // Cell i lies between texels i and i + 1, so its mirror image has the number 2n − 2 − i.
                turned.min(2 * texels - 2 - turned)
            }
        };
        (within + 1) as usize
    }

    /// By how much the height may change over a way of so many texels along each axis that begins in this cell.
    ///
    /// A way of a texel at most stays in the cells around. Any other may go over the steepest of all.
    pub(super) fn change(&self, cell: [i64; 2], way_texels: DVec2) -> f64 {
        let slope = if stays_around(way_texels) {
            self.around[self.index(cell)]
        } else {
            self.steepest
        };
        way_texels.dot(slope)
    }
}

/// Whether a way that begins in a cell ends in it or in one of the eight around it.
pub(super) fn stays_around(way_texels: DVec2) -> bool {
    way_texels.max_element() <= 1.0
}

#[cfg(test)]
mod tests {
    use bossage_assets::{EdgeMode, HeightField};
    use glam::DVec2;

    use super::{Slopes, steepest, steepest_in};

    const EDGES: [EdgeMode; 3] = [EdgeMode::Wrap, EdgeMode::Mirror, EdgeMode::Clamp];

    fn rough(width: u32, height: u32) -> HeightField {
        HeightField::from_fn(width, height, |x, y| {
            ((x * 7919 + y * 104_729) % 97) as f32 / 96.0
        })
    }

    #[test]
    fn the_slopes_around_a_cell_are_the_steepest_of_nine_wherever_it_lies() {
        for (width, height) in [(1, 1), (1, 5), (4, 3), (7, 6)] {
            let field = rough(width, height);
            for edge in EDGES {
                let slopes = Slopes::new(&field, edge);
                for (i, j) in (-17..17).flat_map(|j| (-17..17).map(move |i| (i, j))) {
                    let nine = (-1..2).flat_map(|y| (-1..2).map(move |x| [i + x, j + y]));
                    let expected = nine
                        .map(|cell| steepest_in(&field, edge, cell))
                        .fold(DVec2::ZERO, DVec2::max);
                    let found = slopes.around[slopes.index([i, j])];
                    // Beyond a border that goes on, all cells count as the one beside the tile.
                    let beyond = edge == EdgeMode::Clamp
                        && !((-1..i64::from(width)).contains(&i) && (-1..i64::from(height)).contains(&j));
                    assert!(
                        found == expected || (beyond && found.cmpge(expected).all()),
                        "{edge:?} {width}×{height} ({i}, {j}): {found} {expected}"
                    );
                }
            }
        }
    }

    #[test]
    fn a_long_way_goes_over_the_steepest_of_all() {
        let field = HeightField::from_fn(16, 16, |x, y| if (x, y) == (3, 3) { 1.0 } else { 0.0 });
        let slopes = Slopes::new(&field, EdgeMode::Wrap);
        assert_eq!(slopes.change([10, 10], DVec2::splat(0.5)), 0.0);
        assert_eq!(slopes.change([4, 4], DVec2::new(0.5, 0.25)), 0.75);
        assert_eq!(slopes.change([10, 10], DVec2::new(8.0, 0.0)), 8.0);
        assert_eq!(steepest(&field, EdgeMode::Wrap), DVec2::ONE);
    }
}
