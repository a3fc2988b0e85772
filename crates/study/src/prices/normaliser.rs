//! `normaliser`: a normalisation cube map by size and depth against `normalise`, in degrees.
//!
//! Inputs are directions spread evenly over the sphere, of lengths 2⁻¹⁰ to 2¹⁰. The map is read by the machine's own linear
//! sampler and decoded, and not made a unit vector again: that is what it is there for. Its error is that of the filter between
//! texel centres, 1/N² of a radian inside of a face of N texels, and that of the codes.

use std::sync::Arc;

use bossage_assets::Texels;
use bossage_assets::normalisation_cube_map::{Depth, NormalisationCubeMap};
use bossage_runner::{AddressMode, Filter, SamplerSettings, TexelFormat, TextureData};
use glam::DVec3;

use super::directions::{errors_deg, sphere};
use super::frame::{Frame, bytes_of};
use super::variant::{self, Variant};
use super::{Context, Error};
use crate::record::Price;

const TEXT: &str = include_str!("kernels/normaliser.wesl");

/// Texels a side: the article's 32 among them.
const SIZES: [u32; 5] = [16, 32, 64, 128, 256];

/// A way to make a unit vector.
enum Normaliser {
    Arithmetic { name: &'static str, entry: &'static str },
    Cube { size: u32, depth: Depth },
}

fn normalisers() -> Vec<Normaliser> {
    let arithmetic = [
        ("normalise", "by_arithmetic"),
        ("normalise published", "by_arithmetic_published"),
    ]
    .map(|(name, entry)| Normaliser::Arithmetic { name, entry });
    let cubes = [Depth::Eight, Depth::Sixteen]
        .into_iter()
        .flat_map(|depth| SIZES.map(|size| Normaliser::Cube { size, depth }));
    arithmetic.into_iter().chain(cubes).collect()
}

impl Normaliser {
    fn name(&self) -> String {
        match self {
            Self::Arithmetic { name, .. } => (*name).to_owned(),
            Self::Cube { size, depth } => format!("cube map {size} {}", bits(*depth)),
        }
    }

    fn entry(&self) -> &'static str {
        match self {
            Self::Arithmetic { entry, .. } => entry,
            Self::Cube { .. } => "by_cube_map",
        }
    }

    /// Bytes of a texel.
    fn bytes(&self) -> f64 {
        match self {
            Self::Arithmetic { .. } => 0.0,
            Self::Cube { depth, .. } => f64::from(bits(*depth)) / 2.0,
        }
    }

    fn frame(&self, context: &Context<'_>, directions: &Arc<[u8]>) -> Result<Frame, Error> {
        let [_, items] = context.frame();
        let frame = Frame::new(context, TEXT, self.entry(), items, 16)?.buffer("directions", directions);
        match self {
            Self::Arithmetic { .. } => Ok(frame),
            Self::Cube { size, depth } => Ok(with_map(frame, cube(*size, *depth)?)),
        }
    }
}

fn with_map(frame: Frame, map: TextureData) -> Frame {
    let sampler = SamplerSettings {
        address: AddressMode::Clamp,
        filter: Filter::Linear,
        mip_filter: Filter::Nearest,
        anisotropy: 1,
    };
    frame
        .texture("normalisation_map", map)
        .sampler("surface_sampler", sampler)
}

fn bits(depth: Depth) -> u32 {
    match depth {
        Depth::Eight => 8,
        Depth::Sixteen => 16,
    }
}

fn cube(size: u32, depth: Depth) -> Result<TextureData, Error> {
    let map = NormalisationCubeMap::generate(size, depth)?;
    let faces = map.faces.each_ref().map(|face| match face {
        Texels::Unorm8(codes) => bytemuck::cast_slice::<_, u8>(codes),
        Texels::Unorm16(codes) => bytemuck::cast_slice(codes),
        Texels::Float32(values) => bytemuck::cast_slice(values),
    });
    let format = match depth {
        Depth::Eight => TexelFormat::Rgba8Unorm,
        Depth::Sixteen => TexelFormat::Rgba16Unorm,
    };
    Ok(TextureData::cube("normalisation_map", size, format, &faces)?)
}

/// Vectors of those directions in f32, of lengths that are powers of two, so that they turn nothing.
fn vectors(directions: &[DVec3]) -> Vec<[f32; 4]> {
    let of = |(index, direction): (usize, &DVec3)| {
        let length = 2f64.powi(index as i32 % 21 - 10);
        (length * direction).extend(0.0).as_vec4().to_array()
    };
    directions.iter().enumerate().map(of).collect()
}

fn direction(&[x, y, z, _]: &[f32; 4]) -> DVec3 {
    DVec3::from_array([x, y, z].map(f64::from))
}

/// The chart.
pub(super) fn prices(context: &Context<'_>) -> Result<Vec<Price>, Error> {
    let [_, items] = context.frame();
    let inputs = vectors(&sphere("normaliser", context.seed, items));
    // Truth is that of the vectors as they are handed over.
    let truth: Vec<DVec3> = inputs.iter().map(direction).collect();
    let directions = bytes_of(&inputs);
    let normalisers = normalisers();
    let frame = |normaliser: &Normaliser| normaliser.frame(context, &directions);
    let frames = normalisers.iter().map(frame).collect::<Result<Vec<_>, _>>()?;
    let mut variants = Vec::new();
    for (normaliser, frame) in normalisers.iter().zip(&frames) {
        let measured = frame.measure(context)?;
        let errors = errors_deg(&truth, &measured.outputs, 4);
        variants.push(Variant::new(
            &normaliser.name(),
            measured,
            normaliser.bytes(),
            errors,
        ));
    }
    variant::prices(context, "normaliser", "degrees", variants)
}

#[cfg(test)]
mod tests;
