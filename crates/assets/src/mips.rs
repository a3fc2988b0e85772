//! Mip chains for any sizes: box filter over the exact footprint.
//!
//! Each level halves the sides, rounding down, to 1x1 (the sizes graphics APIs require). A texel of the smaller level
//! averages the part of the larger level that it covers: for even sides the plain mean of 2x2; for odd sides three texels
//! with the fractional weights of their overlap, so that no texel is dropped and the mean of the whole image is kept.
//! Sums are in f32 in a fixed order; results do not depend on threads.
//!
//! What is averaged: heights as they are; colours in linear light, weighted by alpha so that invisible texels do not bleed;
//! normals decoded, averaged and renormalised (see [`normal_mips`](crate::normal_mips)).

use glam::Vec4;

use crate::color_map::srgb_from_linear;
pub use crate::normal_mips::{NormalMips, chain as normal_chain};
use crate::{ColorMap, HeightField};

/// One level of a chain.
#[derive(Debug, Clone, PartialEq)]
pub struct Level {
    /// Columns.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// Four floats a texel.
    pub texels: Vec<Vec4>,
}

/// The number of levels of a full chain, the base included.
#[must_use]
pub fn level_count(width: u32, height: u32) -> u32 {
    width.max(height).max(1).ilog2() + 1
}

/// The chain of a base level, the base first. A base whose sides do not fit its texels gives an empty chain.
#[must_use]
pub fn chain(base: Level) -> Vec<Level> {
    if base.texels.is_empty() || base.texels.len() != base.width as usize * base.height as usize {
        return Vec::new();
    }
    let count = level_count(base.width, base.height) as usize;
    let mut levels = Vec::with_capacity(count);
    levels.push(base);
    while levels.len() < count {
        levels.push(halve(&levels[levels.len() - 1]));
    }
    levels
}

/// The chain of a height field.
#[must_use]
pub fn height_chain(field: &HeightField) -> Vec<HeightField> {
    let texels = field.texels.iter().map(|&h| Vec4::splat(h)).collect();
    let levels = chain(Level {
        width: field.width,
        height: field.height,
        texels,
    });
    let back = |l: Level| HeightField {
        width: l.width,
        height: l.height,
        texels: l.texels.iter().map(|t| t.x).collect(),
    };
    levels.into_iter().map(back).collect()
}

/// The chain of a colour map.
#[must_use]
pub fn color_chain(map: &ColorMap) -> Vec<ColorMap> {
    let weigh = |[r, g, b, a]: [f32; 4]| Vec4::new(r * a, g * a, b * a, a);
    // Where nothing is visible, the colour is still kept: filtering may reach it.
    let plain = map.to_linear();
    let weighted = chain(Level {
        width: map.width,
        height: map.height,
        texels: plain.iter().copied().map(weigh).collect(),
    });
    let plain = chain(Level {
        width: map.width,
        height: map.height,
        texels: plain.into_iter().map(Vec4::from).collect(),
    });
    let mut levels: Vec<ColorMap> = weighted
        .iter()
        .zip(&plain)
        .map(|(w, p)| encode_colors(w, p))
        .collect();
    if let Some(base) = levels.first_mut() {
        base.texels.clone_from(&map.texels);
    }
    levels
}

fn encode_colors(weighted: &Level, plain: &Level) -> ColorMap {
    let byte = |v: f32| (v * 255.0 + 0.5) as u8;
    let texel = |(w, p): (&Vec4, &Vec4)| {
        let rgb = if w.w > 0.0 {
            w.truncate() / w.w
        } else {
            p.truncate()
        };
        let [r, g, b] = rgb.to_array().map(|light| byte(srgb_from_linear(light)));
        [r, g, b, byte(p.w)]
    };
    let texels = weighted.texels.iter().zip(&plain.texels).map(texel).collect();
    ColorMap {
        width: weighted.width,
        height: weighted.height,
        texels,
    }
}

fn halve(level: &Level) -> Level {
    let (width, height) = ((level.width / 2).max(1), (level.height / 2).max(1));
    let columns = footprints(level.width, width);
    let rows = footprints(level.height, height);
    let source_row = |y: usize| &level.texels[y * level.width as usize..][..level.width as usize];
    let texels = rows.iter().flat_map(|row| {
        columns
            .iter()
            .map(move |column| row.sum(|y| column.sum(|x| source_row(y)[x])))
    });
    Level {
        width,
        height,
        texels: texels.collect(),
    }
}

/// The texels that one texel of the next level covers along one axis, with their shares, which sum to 1.
struct Footprint {
    first: usize,
    shares: Vec<f32>,
}

impl Footprint {
    fn sum(&self, at: impl Fn(usize) -> Vec4) -> Vec4 {
        self.shares
            .iter()
            .enumerate()
            .map(|(k, &share)| at(self.first + k) * share)
            .sum()
    }
}

fn footprints(from: u32, to: u32) -> Vec<Footprint> {
    let (from64, to64) = (u64::from(from), u64::from(to));
    // In units of 1/to of a source texel, all overlaps are whole numbers.
    let footprint = |i: u64| {
        let (start, end) = (i * from64, (i + 1) * from64);
        let (first, last) = (start / to64, end.div_ceil(to64));
        let overlap = |k: u64| (end.min((k + 1) * to64) - start.max(k * to64)) as f32 / from64 as f32;
        Footprint {
            first: first as usize,
            shares: (first..last).map(overlap).collect(),
        }
    };
    (0..to64).map(footprint).collect()
}
