//! `derivative`: normals of a height map by forward, central and fourth-order differences, in degrees.
//!
//! The surface is a sum of waves, so its normal is known; heights are floats, so that nothing but the difference errs. Waves of 8 to 64
//! texels are equally steep: with the length the error of the orders falls by 2, 4 and 16.

use glam::DVec3;

use super::directions::errors_deg;
use super::frame::{Frame, bytes_of};
use super::heights::Storage;
use super::variant::{self, Variant};
use super::waves::Waves;
use super::{Context, Error};
use crate::record::Price;

pub(super) const TEXT: &str = include_str!("kernels/derivative.wesl");

/// Lengths of the waves, texels.
const LENGTHS: [u32; 4] = [8, 16, 32, 64];

const ORDERS: [(&str, &str); 3] = [
    ("forward", "forward_at_texels"),
    ("central", "central_at_texels"),
    ("fourth order", "fourth_order_at_texels"),
];

/// A kernel over the texels of a surface that is stored in that way.
pub(super) fn frame_of(
    context: &Context<'_>,
    entry: &str,
    surface: &Waves,
    storage: Storage,
) -> Result<Frame, Error> {
    let side = surface.side;
    let scale = surface.scale * f64::from(side);
    let frame = Frame::new(context, TEXT, entry, side * side, 12)?;
    Ok(frame
        .texture("height_map", storage.texture(&surface.texels(), side))
        .buffer("settings", &bytes_of(&[scale as f32])))
}

/// The chart.
pub(super) fn prices(context: &Context<'_>) -> Result<Vec<Price>, Error> {
    let [side, _] = context.frame();
    let surfaces = LENGTHS.map(|length| (length, Waves::new(context.seed, side, length)));
    let mut frames = Vec::new();
    for (length, surface) in &surfaces {
        for (order, entry) in ORDERS {
            let name = format!("{order}, waves of {length} texels");
            let frame = frame_of(context, entry, surface, Storage::Float32)?;
            frames.push((name, surface, frame));
        }
    }
    let mut variants = Vec::new();
    for (name, surface, frame) in &frames {
        let measured = frame.measure(context)?;
        let truth: Vec<DVec3> = surface.centres().map(|uv| surface.normal(uv)).collect();
        let errors = errors_deg(&truth, &measured.outputs, 3);
        variants.push(Variant::new(name, measured, Storage::Float32.bytes(), errors));
    }
    variant::prices(context, "derivative", "degrees", variants)
}

#[cfg(test)]
mod tests;
