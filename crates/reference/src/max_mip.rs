//! `max_mip` in codes of heights: how high the surface is over each texel, and over each node of a smaller level.
//!
//! The surface is the bilinear interpolant of the texel centres. Level 0: its greatest value over a texel's closed square, rounded up to
//! a whole code. A smaller level: the greatest of all nodes whose rectangles, as parts of the tile, overlap the node's.
//!
//! Heights here are whole codes; means of up to four of them are exact in float64.

use bossage_assets::EdgeMode;

/// One level of codes.
#[derive(Clone, Debug, PartialEq)]
pub struct Level {
    /// Columns.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// Row by row.
    pub codes: Vec<f64>,
}

impl Level {
    fn code(&self, x: u32, y: u32) -> f64 {
        self.codes[y as usize * self.width as usize + x as usize]
    }

    /// The surface at a place in texels, texel centres at whole numbers.
    fn surface(&self, edge: EdgeMode, x: f64, y: f64) -> f64 {
        let (i, j) = (x.floor(), y.floor());
        let along = |j: f64| {
            let texel = |i: f64| {
                self.code(
                    edge.resolve(i as i64, self.width),
                    edge.resolve(j as i64, self.height),
                )
            };
            texel(i) + (x - i) * (texel(i + 1.0) - texel(i))
        };
        along(j) + (y - j) * (along(j + 1.0) - along(j))
    }

    /// The base of the chain, of the heights of texels: on a quarter of a square, part of one cell, the greatest value is in a corner.
    #[must_use]
    pub fn over_texels(&self, edge: EdgeMode) -> Self {
        let over = |x: u32, y: u32| {
            let offsets = [-0.5, 0.0, 0.5];
            let places = offsets
                .iter()
                .flat_map(|dy| offsets.iter().map(move |dx| (dx, dy)));
            let heights = places.map(|(dx, dy)| self.surface(edge, f64::from(x) + dx, f64::from(y) + dy));
            heights.fold(0.0, f64::max).ceil()
        };
        Self {
            codes: self.places().map(|(x, y)| over(x, y)).collect(),
            ..*self
        }
    }

    /// The next smaller level.
    #[must_use]
    pub fn next(&self) -> Self {
        let (width, height) = ((self.width / 2).max(1), (self.height / 2).max(1));
        // [i/n, (i+1)/n] and [j/m, (j+1)/m] have an inner point in common.
        let overlap = |i: u32, n: u32, j: u32, m: u32| {
            let (i, n, j, m) = (u64::from(i), u64::from(n), u64::from(j), u64::from(m));
            i * m < (j + 1) * n && j * n < (i + 1) * m
        };
        let over = |x: u32, y: u32| {
            let rows = (0..self.height).filter(|j| overlap(y, height, *j, self.height));
            let columns = (0..self.width).filter(|i| overlap(x, width, *i, self.width));
            let columns: Vec<u32> = columns.collect();
            rows.flat_map(|j| columns.iter().map(move |i| (*i, j)))
                .map(|(i, j)| self.code(i, j))
                .fold(0.0, f64::max)
        };
        let next = Self {
            width,
            height,
            codes: Vec::new(),
        };
        Self {
            codes: next.places().map(|(x, y)| over(x, y)).collect(),
            ..next
        }
    }

    fn places(&self) -> impl Iterator<Item = (u32, u32)> + use<> {
        let (width, height) = (self.width, self.height);
        (0..height).flat_map(move |y| (0..width).map(move |x| (x, y)))
    }
}

#[cfg(test)]
mod tests {
    use bossage_assets::EdgeMode;

    use super::Level;

    #[test]
    fn between_two_texels_the_surface_is_as_high_as_their_mean() {
        let row = Level {
            width: 3,
            height: 1,
            codes: vec![10.0, 0.0, 5.0],
        };
        let over = |edge| row.over_texels(edge).codes;
        // Halfway to the left neighbour 5; halfway to the right one 2.5, which takes a third code. Across the seam 7.5.
        assert_eq!(over(EdgeMode::Wrap), [10.0, 5.0, 8.0]);
        assert_eq!(over(EdgeMode::Clamp), [10.0, 5.0, 5.0]);
        assert_eq!(over(EdgeMode::Mirror), [10.0, 5.0, 5.0]);
    }

    #[test]
    fn an_odd_side_shares_its_middle() {
        let row = Level {
            width: 5,
            height: 1,
            codes: vec![1.0, 2.0, 9.0, 3.0, 4.0],
        };
        let next = row.next();
        assert_eq!(
            (next.width, next.height, next.codes.clone()),
            (2, 1, vec![9.0, 9.0])
        );
        assert_eq!(next.next().codes, [9.0]);
    }
}
