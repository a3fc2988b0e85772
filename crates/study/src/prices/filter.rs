//! `filter`: a height between texels, by the hardware's filter and by arithmetic, error in heights (1 = the whole range).
//!
//! The map is white noise, the roughest that there is, so the error is the filter's worst; places are anywhere. Truth is the bilinear
//! interpolant in f64 of the texels as they are stored, so that storing them in 8 bits is no error here. Hardware keeps 8 bits of
//! the place between texels; an evaluator's filter is the ideal one.
//!
//! `gather` is four loads in one instruction. Which four the hardware takes is its business: within its 8 bits of a texel's centre
//! it may take others than the shader has in mind.

use bossage_assets::EdgeMode;
use bossage_conformance::generate::random::stream;
use bossage_reference::texture::Texture;
use bossage_runner::{AddressMode, Filter, SamplerSettings};
use glam::{DVec4, Vec2};
use rand::RngExt;

use super::frame::{Frame, bytes_of};
use super::heights::Storage;
use super::variant::{self, Variant};
use super::{Context, Error};
use crate::record::Price;

const TEXT: &str = include_str!("kernels/filter.wesl");

/// Texels along a side.
const SIDE: u32 = 256;

/// What a result that is not a number is off by: the whole range.
const WRONG: f64 = 1.0;

const WAYS: [(&str, &str); 3] = [
    ("sampler", "by_sampler"),
    ("four loads", "by_four_loads"),
    ("gather", "by_gather"),
];

fn noise(seed: u64) -> Vec<f64> {
    let mut rng = stream("filter/map", seed);
    (0..SIDE * SIDE).map(|_| rng.random::<f64>()).collect()
}

fn places(seed: u64, count: u32) -> Vec<Vec2> {
    let mut rng = stream("filter/places", seed);
    (0..count)
        .map(|_| Vec2::new(rng.random::<f32>(), rng.random::<f32>()))
        .collect()
}

/// The heights that the stored map has at these places.
fn truth(storage: Storage, map: &[f64], places: &[Vec2]) -> Vec<f64> {
    let texture = Texture {
        width: SIDE,
        height: SIDE,
        texels: map.iter().map(|h| DVec4::splat(storage.kept(*h))).collect(),
    };
    let at = |uv: &Vec2| texture.sample(EdgeMode::Wrap, uv.as_dvec2()).x;
    places.iter().map(at).collect()
}

fn errors(truth: &[f64], found: &[f64]) -> Vec<f64> {
    let error = |(truth, found): (&f64, &f64)| {
        let off = (found - truth).abs();
        if off.is_finite() { off } else { WRONG }
    };
    truth.iter().zip(found).map(error).collect()
}

/// The chart.
pub(super) fn prices(context: &Context<'_>) -> Result<Vec<Price>, Error> {
    measure(context, TEXT)
}

fn measure(context: &Context<'_>, text: &str) -> Result<Vec<Price>, Error> {
    let [_, items] = context.frame();
    let (map, places) = (noise(context.seed), places(context.seed, items));
    let inputs = bytes_of(&places);
    let all: Vec<(Storage, (&str, &str))> = Storage::ALL
        .into_iter()
        .flat_map(|storage| WAYS.map(|way| (storage, way)))
        .collect();
    let frame = |(storage, (_, entry)): &(Storage, (&str, &str))| {
        let sampler = SamplerSettings {
            address: AddressMode::Wrap,
            filter: Filter::Linear,
            mip_filter: Filter::Nearest,
            anisotropy: 1,
        };
        let frame = Frame::new(context, text, entry, items, 4)?.buffer("places", &inputs);
        let texels = storage.texture(&map, SIDE);
        Ok(frame
            .texture("height_map", texels)
            .sampler("height_sampler", sampler))
    };
    let frames = all.iter().map(frame).collect::<Result<Vec<_>, Error>>()?;
    let mut variants = Vec::new();
    for ((storage, (way, _)), frame) in all.into_iter().zip(&frames) {
        let measured = frame.measure(context)?;
        let errors = errors(&truth(storage, &map, &places), &measured.outputs);
        let name = format!("{way} {}", storage.bits());
        variants.push(Variant::new(&name, measured, storage.bytes(), errors));
    }
    variant::prices(context, "filter", "heights", variants)
}

#[cfg(test)]
mod tests;
