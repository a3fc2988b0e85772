//! `max_mip`: for every part of the tile, down to single texels, the greatest height of the surface over it.
//!
//! The surface is the bilinear interpolant of the texel centres. A node of a level of n × m nodes stands for the closed rectangle
//! [i/n, (i+1)/n] × [j/m, (j+1)/m] of the tile, so that levels of any size repeat, mirror and clamp with the texture itself. On
//! level 0 a node is a texel's own square: four quarters of cells, on each of which a bilinear function is greatest in a corner, so
//! the maximum is that of nine values: the texel, the means with its neighbours, the means of four around each corner. A node
//! above is the maximum of all nodes that it overlaps.
//!
//! Guarantee: no point of the surface over a node's rectangle, border included, is higher than the node says; on level 0, and on
//! every level of a side that is a power of two, one is as high (but for rounding up to the next f32). Cost: linear in texels.
//!
//! A chain of texel maxima alone, the classic form, is not enough: between texels the surface over a square reaches up to
//! its neighbours' heights.

use crate::{EdgeMode, HeightField};

pub mod codes;

/// The chain, the level of single texels first, sides halved and rounded down to 1 × 1.
#[must_use]
pub fn bake(field: &HeightField, edge: EdgeMode) -> Vec<HeightField> {
    let mut levels = vec![texels(field, edge)];
    while let Some(last) = levels.last().filter(|last| last.width > 1 || last.height > 1) {
        levels.push(halve(last));
    }
    levels
}

/// The maximum over each texel's own square.
pub(crate) fn texels(field: &HeightField, edge: EdgeMode) -> HeightField {
    let neighbour = |x: u32, y: u32, dx: i64, dy: i64| {
        let x = edge.resolve(i64::from(x) + dx, field.width);
        let y = edge.resolve(i64::from(y) + dy, field.height);
        f64::from(field.texel(x, y))
    };
    let greatest = |x: u32, y: u32| {
        let h = |dx, dy| neighbour(x, y, dx, dy);
        let mut top = h(0, 0);
        for d in [-1, 1] {
            top = top.max((h(0, 0) + h(d, 0)) / 2.0).max((h(0, 0) + h(0, d)) / 2.0);
            for e in [-1, 1] {
                top = top.max((h(0, 0) + h(d, 0) + h(0, e) + h(d, e)) / 4.0);
            }
        }
        round_up(top)
    };
    HeightField::from_fn(field.width, field.height, greatest)
}

/// The smallest f32 that is not below.
fn round_up(value: f64) -> f32 {
    let near = value as f32;
    if f64::from(near) < value {
        near.next_up()
    } else {
        near
    }
}

fn halve(level: &HeightField) -> HeightField {
    let (width, height) = ((level.width / 2).max(1), (level.height / 2).max(1));
    HeightField::from_fn(width, height, |x, y| {
        let (columns, rows) = (
            overlapped(x, level.width, width),
            overlapped(y, level.height, height),
        );
        let below = rows.flat_map(|row| columns.clone().map(move |column| level.texel(column, row)));
        below.fold(0.0, f32::max)
    })
}

/// The nodes of a side of `from` that node `i` of a side of `to` overlaps.
fn overlapped(i: u32, from: u32, to: u32) -> std::ops::Range<u32> {
    let (i, from, to) = (u64::from(i), u64::from(from), u64::from(to));
    let bounds = (i * from / to, ((i + 1) * from).div_ceil(to));
    bounds.0 as u32..bounds.1 as u32
}
