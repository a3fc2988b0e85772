//! `max_mip` in codes of 16 bits, which files and 16-bit textures hold: a code c is a height of c/65535.
//!
//! The surface is that of [`HeightField::to_unorm16_up`], which for 8- and 16-bit images is the image's own. All is whole numbers,
//! means rounded up, so that the compute kernel (`shaders/entry/max_mip.wesl`) gives the same codes on every implementation.
//!
//! Guarantee: as in [`max_mip`](crate::max_mip); on level 0 a code is less than 1 above the greatest height.

use crate::{EdgeMode, HeightField};

/// One level.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct MaxCodes {
    /// Columns.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// The greatest heights in 65535ths, rounded up, row by row.
    pub codes: Vec<u16>,
}

/// The chain, the level of single texels first, sides halved and rounded down to 1 × 1.
#[must_use]
pub fn bake(field: &HeightField, edge: EdgeMode) -> Vec<MaxCodes> {
    let heights = MaxCodes {
        width: field.width,
        height: field.height,
        codes: field.to_unorm16_up(),
    };
    let mut levels = vec![heights.texels(edge)];
    while let Some(last) = levels.last().filter(|last| last.width > 1 || last.height > 1) {
        levels.push(last.halve());
    }
    levels
}

impl MaxCodes {
    fn from_fn(width: u32, height: u32, code: impl Fn(u32, u32) -> u32) -> Self {
        let texels = (0..height).flat_map(|y| (0..width).map(move |x| (x, y)));
        Self {
            width,
            height,
            codes: texels.map(|(x, y)| code(x, y) as u16).collect(),
        }
    }

    fn code(&self, x: u32, y: u32) -> u32 {
        u32::from(self.codes[y as usize * self.width as usize + x as usize])
    }

    /// The greatest heights over each texel's own square, of the heights of texels.
    fn texels(&self, edge: EdgeMode) -> Self {
        Self::from_fn(self.width, self.height, |x, y| {
            let h = |dx: i64, dy: i64| {
                let x = edge.resolve(i64::from(x) + dx, self.width);
                let y = edge.resolve(i64::from(y) + dy, self.height);
                self.code(x, y)
            };
            let here = h(0, 0);
            let mut top = here;
            for d in [-1, 1] {
                top = top
                    .max((here + h(d, 0)).div_ceil(2))
                    .max((here + h(0, d)).div_ceil(2));
                for e in [-1, 1] {
                    top = top.max((here + h(d, 0) + h(0, e) + h(d, e)).div_ceil(4));
                }
            }
            top
        })
    }

    fn halve(&self) -> Self {
        let (width, height) = ((self.width / 2).max(1), (self.height / 2).max(1));
        Self::from_fn(width, height, |x, y| {
            let columns = super::overlapped(x, self.width, width);
            let rows = super::overlapped(y, self.height, height);
            let below = rows.flat_map(|row| columns.clone().map(move |column| self.code(column, row)));
            below.max().unwrap_or(0)
        })
    }
}
