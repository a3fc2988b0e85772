//! `window_maxima`: how far a view ray may run over each block of texels and the blocks ahead of it without meeting the surface. What the
//! technique `exact` reads.
//!
//! The tile is divided into blocks of [`BLOCK`]² texels, the last of a side going on beyond the border by the edge mode. A texel of the map says
//! for one block and one quadrant of directions, for windows of 1, 2, 4 and 8 blocks a side ([`REACHES`]) that begin with this block
//! and lie ahead: 1 − the greatest height of the bilinear surface over the window, the depth that a ray may sink to over it. So one
//! read tells a ray above the block the furthest of four ways to go on, as far as it stays in its quadrant, which a straight ray does.
//!
//! The map is an image of 2·columns by 2·rows texels, four quadrants beside and below each other: in its right half rays move along
//! +u, in its lower half along +v ([`WindowMaxima::texel`]). 8 bits suffice, since a depth that is rounded down costs a step at most.
//!
//! Guarantee: no point of the surface over the closed window is higher than 1 − depth − [`SLACK`]; the depth is not less than need be
//! by more than a 255th and the slack. Cost: linear in texels; the map has about as many texels as the field.

use crate::{EdgeMode, HeightField, max_mip};

/// Texels along the side of a block.
pub const BLOCK: u32 = 2;

/// Blocks along the sides of the windows, in the order of the channels.
pub const REACHES: [u32; 4] = [1, 2, 4, 8];

/// By how much more than its maximum a window counts as high, in heights: more than a ray's place and a stored depth are off by in f32.
pub const SLACK: f64 = 1.0 / 65536.0;

/// The depths, as an image of 8 bits and four channels.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct WindowMaxima {
    /// Blocks along u.
    pub columns: u32,
    /// Blocks along v.
    pub rows: u32,
    /// 2·columns by 2·rows texels, row by row: for each of [`REACHES`] the depth in 255ths.
    pub texels: Vec<[u8; 4]>,
}

impl WindowMaxima {
    /// The depths of the windows that begin with a block and lie ahead of a ray moving along (+u, +v) where `forward` says so.
    ///
    /// # Panics
    /// When there is no such block.
    #[must_use]
    pub fn texel(&self, column: u32, row: u32, forward: [bool; 2]) -> [u8; 4] {
        assert!(
            column < self.columns && row < self.rows,
            "block ({column}, {row}) of {}x{}",
            self.columns,
            self.rows
        );
        let x = column + if forward[0] { self.columns } else { 0 };
        let y = row + if forward[1] { self.rows } else { 0 };
        self.texels[y as usize * 2 * self.columns as usize + x as usize]
    }
}

/// The map of a field beyond whose border the surface goes on by `edge`.
#[must_use]
pub fn bake(field: &HeightField, edge: EdgeMode) -> WindowMaxima {
    let (columns, rows) = (field.width.div_ceil(BLOCK), field.height.div_ceil(BLOCK));
    let blocks = Blocks::new(&max_mip::texels(field, edge), edge, columns, rows);
    let windows = REACHES.map(|reach| blocks.windows(reach as usize));
    let places = (0..2 * rows).flat_map(|y| (0..2 * columns).map(move |x| (x, y)));
    let texel = |(x, y): (u32, u32)| {
        let place = [0, 1, 2, 3].map(|level| {
            // A window behind a block begins so many blocks before it.
            let first = |i: u32, blocks: u32| {
                let behind = if i < blocks { REACHES[level] - 1 } else { 0 };
                (MARGIN + i % blocks - behind) as usize
            };
            windows[level].at(first(x, columns), first(y, rows))
        });
        place.map(depth)
    };
    WindowMaxima {
        columns,
        rows,
        texels: places.map(texel).collect(),
    }
}

/// The greatest depth in 255ths at which a ray is above a height, with the slack.
fn depth(height: f32) -> u8 {
    let free = (1.0 - f64::from(height) - SLACK) * 255.0;
    // A multiple of 1/255 is not exact in f64; the slack is much more than what is lost.
    free.floor().clamp(0.0, 255.0) as u8
}

/// Blocks beyond the border on every side, as many as the largest window has besides its first.
const MARGIN: u32 = 7;

/// The greatest height over each block, or over each window of blocks by its first, with the margin around.
struct Blocks {
    width: usize,
    heights: Vec<f32>,
}

impl Blocks {
    /// Of the greatest heights over texels.
    fn new(texels: &HeightField, edge: EdgeMode, columns: u32, rows: u32) -> Self {
        // Rows of texels first, then blocks of such rows: each texel is looked at twice at most.
        let along = |blocks: u32| (0..blocks + 2 * MARGIN).map(|block| i64::from(block) - i64::from(MARGIN));
        let inside = |block: i64, side: u32| {
            (0..i64::from(BLOCK)).map(move |k| edge.resolve(block * i64::from(BLOCK) + k, side))
        };
        let row_maxima = |y: u32| -> Vec<f32> {
            let over = |block| {
                inside(block, texels.width)
                    .map(|x| texels.texel(x, y))
                    .fold(0.0, f32::max)
            };
            along(columns).map(over).collect()
        };
        let lines: Vec<Vec<f32>> = (0..texels.height).map(row_maxima).collect();
        let width = (columns + 2 * MARGIN) as usize;
        let over = |block: i64, x: usize| {
            inside(block, texels.height)
                .map(|y| lines[y as usize][x])
                .fold(0.0, f32::max)
        };
        let heights = along(rows).flat_map(|block| (0..width).map(move |x| (block, x)));
        Self {
            width,
            heights: heights.map(|(block, x)| over(block, x)).collect(),
        }
    }

    /// The maxima over windows of so many blocks a side. A window that would reach beyond the margin ends there.
    fn windows(&self, reach: usize) -> Self {
        let rows = self.heights.chunks(self.width);
        let wide: Vec<f32> = rows.flat_map(|row| sliding(row, reach)).collect();
        let columns: Vec<Vec<f32>> = (0..self.width)
            .map(|x| {
                let column: Vec<f32> = wide.iter().skip(x).step_by(self.width).copied().collect();
                sliding(&column, reach)
            })
            .collect();
        let height = self.heights.len() / self.width;
        let places = (0..height).flat_map(|y| (0..self.width).map(move |x| (x, y)));
        Self {
            width: self.width,
            heights: places.map(|(x, y)| columns[x][y]).collect(),
        }
    }

    fn at(&self, x: usize, y: usize) -> f32 {
        self.heights[y * self.width + x]
    }
}

/// The greatest of `reach` values in a row, by the first; by doubling, in log₂(reach) passes.
fn sliding(values: &[f32], reach: usize) -> Vec<f32> {
    let mut greatest = values.to_vec();
    let mut done = 1;
    while done < reach {
        let step = done.min(reach - done);
        for i in 0..greatest.len().saturating_sub(step) {
            greatest[i] = greatest[i].max(greatest[i + step]);
        }
        done += step;
    }
    greatest
}
