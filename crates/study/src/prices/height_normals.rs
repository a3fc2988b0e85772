//! `height_normals`: what bits of the height cost the normal, in degrees.
//!
//! Normals come from central differences of heights in 8, 16 and 32 bits; truth is the same difference in f64 of heights that were
//! never rounded. Waves of 16 texels, and gentle ones of 64: the gentler, the more texels share a code.

use bossage_reference::height_to_normal;
use glam::{DVec2, DVec3};

use super::derivative::frame_of;
use super::directions::errors_deg;
use super::heights::Storage;
use super::variant::{self, Variant};
use super::waves::Waves;
use super::{Context, Error};
use crate::record::Price;

/// Lengths of the waves, texels.
const LENGTHS: [u32; 2] = [16, 64];

/// The normals by central differences of unrounded heights.
fn truth(surface: &Waves) -> Vec<DVec3> {
    let (texels, side) = (surface.texels(), surface.side);
    let at = |x: u32, y: u32| texels[((y % side) * side + x % side) as usize];
    let slope = DVec2::splat(surface.scale * f64::from(side) / 2.0);
    let normal = |at_texel: u32| {
        let (x, y) = (at_texel % side, at_texel / side);
        let before = side - 1;
        height_to_normal::normal(
            at(x + before, y),
            at(x + 1, y),
            at(x, y + before),
            at(x, y + 1),
            slope,
        )
    };
    (0..side * side).map(normal).collect()
}

/// The chart.
pub(super) fn prices(context: &Context<'_>) -> Result<Vec<Price>, Error> {
    let [side, _] = context.frame();
    let surfaces = LENGTHS.map(|length| (length, Waves::new(context.seed, side, length)));
    let mut frames = Vec::new();
    for (length, surface) in &surfaces {
        for storage in Storage::ALL {
            let name = format!("{} bits, waves of {length} texels", storage.bits());
            let frame = frame_of(context, "central_at_texels", surface, storage)?;
            frames.push((name, surface, storage, frame));
        }
    }
    let mut variants = Vec::new();
    for (name, surface, storage, frame) in &frames {
        let measured = frame.measure(context)?;
        let errors = errors_deg(&truth(surface), &measured.outputs, 3);
        variants.push(Variant::new(name, measured, storage.bytes(), errors));
    }
    variant::prices(context, "height_normals", "degrees", variants)
}

#[cfg(test)]
mod tests;
