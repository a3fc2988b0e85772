//! `height_to_normal_forward`: the bake of the article on height and normal maps, as published, faults and all.
//!
//! For texel (column j, row i) with height byte H₁, the heights below (row i+1) H₂ and to the right (column j+1) H₃, and
//! the height scale s: n = normalize((1, 0, s·H₂ − s·H₁) × (0, 1, s·H₃ − s·H₁)).
//!
//! Its faults, kept:
//! - the first axis is the **row**: red holds the vertical slope, green the horizontal one;
//! - neighbours are found by linear index: the last column's right neighbour is the first texel of the next row, and past
//!   the end there is texel 0 (the flat border, next, covers this up: [`unmasked_normal`] shows it);
//! - all border texels are (0, 0, 1), said to make the map tile: it makes a flat seam;
//! - one-sided differences: the error falls only with the first power of the sampling distance;
//! - `codec_biased` with truncation, and 8-bit heights.
//!
//! The hardened form (axes in order, true neighbours, rounding to nearest) is
//! [`Kernel::Forward`](crate::height_to_normal::Kernel::Forward) of the general bake.
//!
//! Operation order in f32, the same in the compute kernel (every line one rounding after another, nothing contracted):
//! ```text
//! H = trunc(h*255 + 0.5)                 (as a float)
//! a = s*H2 - s*H1        b = s*H3 - s*H1
//! q = (a*a + b*b) + 1    r = 1 / sqrt(q)
//! red = trunc(127*(-a*r) + 128)   green = trunc(127*(-b*r) + 128)   blue = trunc(127*r + 128)   alpha = H1
//! ```

use glam::Vec3;
use rayon::prelude::*;

use crate::truncate::to_byte_range;
use crate::{HeightField, NormalCodec, NormalMap};

/// Bakes as published. `texture_height_scale` is s: texels of elevation per step of the height byte.
#[must_use]
pub fn bake(field: &HeightField, texture_height_scale: f32) -> NormalMap {
    let heights = field.to_bytes();
    let (width, height) = (field.width as usize, field.height as usize);
    let mut texels = vec![[0; 4]; heights.len()];
    texels
        .par_chunks_mut(width.max(1))
        .enumerate()
        .for_each(|(i, row)| {
            let mid = &heights[i * width..][..width];
            row.iter_mut().zip(mid).for_each(|(out, &h)| *out = flat(h));
            if i > 0 && i + 1 < height {
                interior(
                    row,
                    mid,
                    &heights[(i + 1) * width..][..width],
                    texture_height_scale,
                );
            }
        });
    NormalMap {
        width: field.width,
        height: field.height,
        codec: NormalCodec::Biased,
        texels,
    }
}

/// The published normal of a texel **before** the border is overwritten: the only way to see the wrong neighbour.
///
/// # Panics
/// When `x` or `y` lies outside.
#[must_use]
pub fn unmasked_normal(field: &HeightField, x: u32, y: u32, texture_height_scale: f32) -> Vec3 {
    assert!(
        x < field.width && y < field.height,
        "texel ({x}, {y}) of {}x{}",
        field.width,
        field.height
    );
    let width = field.width as usize;
    let index = y as usize * width + x as usize;
    let byte = |i: usize| crate::height_byte(field.texels[if i < field.texels.len() { i } else { 0 }]);
    normal(
        byte(index),
        byte(index + width),
        byte(index + 1),
        texture_height_scale,
    )
}

fn interior(row: &mut [[u8; 4]], mid: &[u8], below: &[u8], s: f32) {
    let width = row.len();
    if width < 3 {
        return;
    }
    let neighbours = mid[1..].windows(2).zip(&below[1..]);
    for (out, (pair, &h2)) in row[1..width - 1].iter_mut().zip(neighbours) {
        *out = encode(normal(pair[0], h2, pair[1], s), pair[0]);
    }
}

#[inline(always)]
fn normal(h1: u8, h2: u8, h3: u8, s: f32) -> Vec3 {
    let z1 = s * f32::from(h1);
    let a = s * f32::from(h2) - z1;
    let b = s * f32::from(h3) - z1;
    let q = (a * a + b * b) + 1.0;
    let r = 1.0 / q.sqrt();
    Vec3::new(-a * r, -b * r, r)
}

/// [`encode_published`](crate::codec_biased::encode_published) for components in [−1, 1], three at once.
#[inline(always)]
fn encode(n: Vec3, height: u8) -> [u8; 4] {
    let [red, green, blue] = n.to_array().map(|c| to_byte_range(127.0 * c + 128.0));
    (red | green << 8 | blue << 16 | u32::from(height) << 24).to_le_bytes()
}

fn flat(height: u8) -> [u8; 4] {
    encode(Vec3::Z, height)
}
