//! `codec`: what a normal loses in a texel of so many bytes, in degrees, and what decoding it costs.
//!
//! Inputs are directions spread evenly over the half z ≥ 0. Encoding is that of `bossage-assets`; decoding is a kernel that loads
//! the texel, applies the library's decoder and makes a unit vector of it (`kernels/codec.wesl`). `float 32` is the price of
//! storing them as they are.

use bossage_assets::{codec_biased, codec_octahedral, codec_snorm, codec_unorm};
use bossage_runner::{TexelFormat, TextureData};
use glam::{DVec3, Vec2, Vec3};

use super::directions::{errors_deg, hemisphere};
use super::frame::Frame;
use super::variant::{self, Variant};
use super::{Context, Error};
use crate::record::Price;

const TEXT: &str = include_str!("kernels/codec.wesl");

/// A way to store a normal.
#[derive(Clone, Copy)]
struct Codec {
    name: &'static str,
    format: TexelFormat,
    /// The entry that decodes.
    entry: &'static str,
    /// A texel's bytes.
    encode: fn(Vec3) -> Vec<u8>,
}

impl Codec {
    const fn new(
        name: &'static str,
        format: TexelFormat,
        entry: &'static str,
        encode: fn(Vec3) -> Vec<u8>,
    ) -> Self {
        Self {
            name,
            format,
            entry,
            encode,
        }
    }
}

const CODECS: [Codec; 11] = [
    Codec::new("unorm 8", TexelFormat::Rgba8Unorm, "decode_unorm", |n| {
        rgb(n, codec_unorm::encode, u8::MAX)
    }),
    Codec::new("unorm 16", TexelFormat::Rgba16Unorm, "decode_unorm", |n| {
        rgb(n, unorm16, u16::MAX)
    }),
    Codec::new(
        "biased 8 published",
        TexelFormat::Rgba8Unorm,
        "decode_biased",
        |n| rgb(n, codec_biased::encode_published, u8::MAX),
    ),
    Codec::new("biased 8", TexelFormat::Rgba8Unorm, "decode_biased", |n| {
        rgb(n, codec_biased::encode, u8::MAX)
    }),
    Codec::new("snorm 8", TexelFormat::Rgba8Snorm, "decode_plain", |n| {
        rgb(n, codec_snorm::encode8, i8::MAX)
    }),
    Codec::new("snorm 16", TexelFormat::Rgba16Snorm, "decode_plain", |n| {
        rgb(n, codec_snorm::encode16, i16::MAX)
    }),
    Codec::new(
        "two channels 8",
        TexelFormat::Rg8Snorm,
        "decode_two_channel",
        |n| rg(n.truncate(), codec_snorm::encode8),
    ),
    Codec::new(
        "two channels 16",
        TexelFormat::Rg16Snorm,
        "decode_two_channel",
        |n| rg(n.truncate(), codec_snorm::encode16),
    ),
    Codec::new("octahedral 8", TexelFormat::Rg8Snorm, "decode_octahedral", |n| {
        rg(codec_octahedral::encode(n), codec_snorm::encode8)
    }),
    Codec::new(
        "octahedral 16",
        TexelFormat::Rg16Snorm,
        "decode_octahedral",
        |n| rg(codec_octahedral::encode(n), codec_snorm::encode16),
    ),
    Codec::new("float 32", TexelFormat::Rgba32Float, "decode_plain", |n| {
        rgb(n, |c| c, 1.0)
    }),
];

/// Three channels and full alpha.
fn rgb<T: bytemuck::NoUninit>(n: Vec3, code: fn(f32) -> T, one: T) -> Vec<u8> {
    bytemuck::cast_slice(&[code(n.x), code(n.y), code(n.z), one]).to_vec()
}

/// Two channels.
fn rg<T: bytemuck::NoUninit>(p: Vec2, code: fn(f32) -> T) -> Vec<u8> {
    bytemuck::cast_slice(&[code(p.x), code(p.y)]).to_vec()
}

/// The nearest 16-bit code of a component in [−1, 1].
fn unorm16(n: f32) -> u16 {
    ((0.5 * f64::from(n) + 0.5) * 65535.0).round() as u16
}

impl Codec {
    fn texture(&self, normals: &[DVec3], side: u32) -> TextureData {
        let texels = normals.iter().flat_map(|n| (self.encode)(n.as_vec3()));
        TextureData::plane(side, side, self.format, &texels.collect::<Vec<_>>())
    }

    /// The decoder over one frame of texels.
    fn frame(&self, context: &Context<'_>, normals: &[DVec3]) -> Result<Frame, Error> {
        let [side, items] = context.frame();
        let frame = Frame::new(context, TEXT, self.entry, items, 12)?;
        Ok(frame.texture("texels", self.texture(normals, side)))
    }
}

/// The chart.
pub(super) fn prices(context: &Context<'_>) -> Result<Vec<Price>, Error> {
    measure(context, &CODECS)
}

fn measure(context: &Context<'_>, codecs: &[Codec]) -> Result<Vec<Price>, Error> {
    let [_, items] = context.frame();
    let normals = hemisphere("codec", context.seed, items);
    let frame = |codec: &Codec| codec.frame(context, &normals);
    let frames = codecs.iter().map(frame).collect::<Result<Vec<_>, _>>()?;
    let mut variants = Vec::new();
    for (codec, frame) in codecs.iter().zip(&frames) {
        let measured = frame.measure(context)?;
        let errors = errors_deg(&normals, &measured.outputs, 3);
        let bytes = codec.format.texel_bytes() as f64;
        variants.push(Variant::new(codec.name, measured, bytes, errors));
    }
    variant::prices(context, "codec", "degrees", variants)
}

#[cfg(test)]
mod tests;
