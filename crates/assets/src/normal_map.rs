//! Normal maps: bytes, and the code in which they are written.
//!
//! Red is the component along T (+u), green along B (+v, the direction of growing rows), blue along N. Alpha, where a map
//! has it, holds the height. Maps drawn for "green up" have the opposite green: load them, then [`NormalMap::flip_green`].
//!
//! Texels are kept as the file has them. Real maps hold vectors of length 0.11 to 1.5, and nothing here hides that;
//! [`NormalMap::decode`] gives what the texture unit and the linear decode of the shader give, without normalising.

use glam::Vec3;

use crate::{Error, Image, codec_biased, codec_unorm};

/// How a component in [−1, 1] is written as a byte.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum NormalCodec {
    /// `n = 2·byte/255 − 1`: what nearly all maps in the wild use. See [`codec_unorm`].
    #[default]
    Unorm,
    /// `n = (byte − 128)/127`: holds 0 exactly. See [`codec_biased`].
    Biased,
}

impl NormalCodec {
    /// The word used in scene files and on the command line.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            NormalCodec::Unorm => "unorm",
            NormalCodec::Biased => "biased",
        }
    }

    /// One component to a byte, hardened form.
    #[inline]
    #[must_use]
    pub fn encode(self, n: f32) -> u8 {
        match self {
            NormalCodec::Unorm => codec_unorm::encode(n),
            NormalCodec::Biased => codec_biased::encode(n),
        }
    }

    /// One byte to a component, hardened form.
    #[inline]
    #[must_use]
    pub fn decode(self, byte: u8) -> f32 {
        match self {
            NormalCodec::Unorm => codec_unorm::decode(byte),
            NormalCodec::Biased => codec_biased::decode(byte),
        }
    }

    /// Scale and bias of the linear decode `n = scale·c + bias` of a sampled colour c in [0, 1], as shaders want it.
    /// Without the clamp of byte 0: filtering comes before decoding there.
    #[must_use]
    pub fn scale_bias(self) -> [f32; 2] {
        match self {
            NormalCodec::Unorm => [2.0, -1.0],
            NormalCodec::Biased => [255.0 / 127.0, -128.0 / 127.0],
        }
    }
}

/// A normal map, row-major, row 0 at v near 0.
#[derive(Debug, Clone, PartialEq)]
pub struct NormalMap {
    /// Columns.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// The code of red, green and blue.
    pub codec: NormalCodec,
    /// Red, green, blue and alpha (the height, or 255) of every texel.
    pub texels: Vec<[u8; 4]>,
}

impl NormalMap {
    /// Takes an image as a normal map. 16-bit and float samples are rounded to the nearest byte.
    ///
    /// # Errors
    /// [`Error::NotANormalMap`] for grey images; [`Error::OutOfRange`] for float images outside [0, 1].
    pub fn from_image(image: &Image, codec: NormalCodec) -> Result<Self, Error> {
        if image.channels < 3 {
            return Err(Error::NotANormalMap {
                path: image.path.clone(),
                channels: image.channels,
            });
        }
        image.require_unit_range("normal map")?;
        Ok(NormalMap {
            width: image.width,
            height: image.height,
            codec,
            texels: image.to_rgba8(),
        })
    }

    /// A map of one normal everywhere.
    #[must_use]
    pub fn constant(width: u32, height: u32, codec: NormalCodec, normal: Vec3) -> Self {
        let [r, g, b] = normal.to_array().map(|n| codec.encode(n));
        NormalMap {
            width,
            height,
            codec,
            texels: vec![[r, g, b, 255]; width as usize * height as usize],
        }
    }

    /// The vector of a texel as decoded, not normalised.
    ///
    /// # Panics
    /// When `x` or `y` lies outside; use [`crate::EdgeMode::resolve`] first.
    #[must_use]
    pub fn decode(&self, x: u32, y: u32) -> Vec3 {
        assert!(
            x < self.width && y < self.height,
            "texel ({x}, {y}) of {}x{}",
            self.width,
            self.height
        );
        let [r, g, b, _] = self.texels[y as usize * self.width as usize + x as usize];
        Vec3::from([r, g, b].map(|byte| self.codec.decode(byte)))
    }

    /// Whether all texels hold the same normal (alpha aside): then the map says nothing that a constant does not.
    #[must_use]
    pub fn is_constant(&self) -> bool {
        let rgb = |t: &[u8; 4]| [t[0], t[1], t[2]];
        self.texels.windows(2).all(|pair| rgb(&pair[0]) == rgb(&pair[1]))
    }

    /// Shortest and longest decoded vector: how far the map is from unit length. (0, 0) for a map without texels.
    #[must_use]
    pub fn length_range(&self) -> (f32, f32) {
        let length =
            |t: &[u8; 4]| Vec3::from([t[0], t[1], t[2]].map(|byte| self.codec.decode(byte))).length();
        let widen = |(low, high): (f32, f32), l: f32| (low.min(l), high.max(l));
        let (low, high) = self.texels.iter().map(length).fold((f32::INFINITY, 0.0), widen);
        if low.is_finite() { (low, high) } else { (0.0, 0.0) }
    }

    /// Turns the green of every texel round: from "green up" to "green along growing rows", and back. Exact within the code,
    /// except that byte 0 of [`NormalCodec::Biased`], which is no code, turns into 255.
    pub fn flip_green(&mut self) {
        let codec = self.codec;
        let flip = |byte: u8| match codec {
            NormalCodec::Unorm => 255 - byte,
            NormalCodec::Biased => (256 - i32::from(byte)).min(255) as u8,
        };
        self.texels.iter_mut().for_each(|t| t[1] = flip(t[1]));
    }
}
