//! What the designs read beside the heights.

use bossage_assets::{EdgeMode, cone_map, window_maxima};
use bossage_runner::{TexelFormat, TextureData, TextureDimension};

use crate::maps::Map;

/// Cells along the side of a block of `two_levels`.
pub(crate) const BLOCK: u32 = 8;

pub(crate) fn windows(map: &Map) -> TextureData {
    let windows = window_maxima::bake(&map.field, map.edge);
    TextureData::rgba8(2 * windows.columns, 2 * windows.rows, &windows.texels)
}

/// Height and ratio, to be filtered.
pub(crate) fn cones(map: &Map) -> TextureData {
    let cones = cone_map::bake(&map.field, map.edge).ratios;
    let pairs = map.field.texels.iter().zip(&cones);
    let texels: Vec<[f32; 4]> = pairs.map(|(height, ratio)| [*height, *ratio, 0.0, 0.0]).collect();
    TextureData::rgba32f(map.field.width, map.field.height, &texels)
}

/// The corners of each cell, in 16 bits: exact for maps of 8 and 16 bits.
pub(crate) fn patches(map: &Map) -> TextureData {
    let (width, height) = stored_cells(map);
    let cells = (0..height).flat_map(|y| (0..width).map(move |x| (x, y)));
    let texels = cells.flat_map(|(x, y)| corners(map, x, y));
    let bytes = texels.flat_map(|height| ((f64::from(height) * 65535.0).round() as u16).to_le_bytes());
    TextureData {
        width,
        height,
        format: TexelFormat::Rgba16Unorm,
        dimension: TextureDimension::Plane,
        levels: vec![bytes.collect()],
    }
}

/// The greatest corner of each block of cells.
pub(crate) fn block_tops(map: &Map) -> TextureData {
    let (width, height) = stored_cells(map);
    let (columns, rows) = (width.div_ceil(BLOCK), height.div_ceil(BLOCK));
    let top = |column: u32, row: u32| {
        let cells = (0..BLOCK * BLOCK).map(|k| (BLOCK * column + k % BLOCK, BLOCK * row + k / BLOCK));
        cells.flat_map(|(x, y)| corners(map, x, y)).fold(0.0, f32::max)
    };
    let blocks = (0..rows).flat_map(|row| (0..columns).map(move |column| (column, row)));
    let tops: Vec<f32> = blocks.map(|(column, row)| top(column, row)).collect();
    TextureData::r32f(columns, rows, &tops)
}

/// Edges that do not repeat have cells of their own before and behind.
fn stored_cells(map: &Map) -> (u32, u32) {
    let beyond = u32::from(map.edge != EdgeMode::Wrap);
    (map.field.width + beyond, map.field.height + beyond)
}

/// h00, h10, h01, h11 of a stored cell.
fn corners(map: &Map, x: u32, y: u32) -> [f32; 4] {
    let before = i64::from(map.edge != EdgeMode::Wrap);
    let texel = |dx: i64, dy: i64| {
        let column = map.edge.resolve(i64::from(x) - before + dx, map.field.width);
        let row = map.edge.resolve(i64::from(y) - before + dy, map.field.height);
        map.field.texel(column, row)
    };
    [texel(0, 0), texel(1, 0), texel(0, 1), texel(1, 1)]
}
