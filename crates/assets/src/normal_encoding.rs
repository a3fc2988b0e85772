//! How a file writes normals, and their way into the linear codes that the surface shader reads.
//!
//! The shader decodes a sampled colour by one scale and one bias; that covers [`NormalCodec`]. Other encodings are not linear, or
//! not unsigned, so filtering them before decoding would be wrong or impossible: they are decoded texel by texel here and
//! written in a linear code. What this loses is the rounding to that code's bytes.

use glam::{Vec2, Vec3};

use crate::{
    Error, Image, NormalCodec, NormalMap, codec_octahedral, codec_snorm, codec_two_channel, codec_unorm,
};

/// How a file writes normals.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum NormalEncoding {
    /// Red, green and blue in a linear unsigned code, taken as they are.
    Linear(NormalCodec),
    /// Red, green and blue as signed normalised integers, in the bits of an unsigned image. See [`codec_snorm`].
    Snorm,
    /// x in red and y in green (`codec_unorm`), z put back. See [`codec_two_channel`].
    TwoChannel,
    /// The octahedral point in red and green (`codec_unorm`). See [`codec_octahedral`].
    Octahedral,
}

impl NormalEncoding {
    /// The word used in scene files and on the command line.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            NormalEncoding::Linear(codec) => codec.name(),
            NormalEncoding::Snorm => "snorm",
            NormalEncoding::TwoChannel => "two_channel",
            NormalEncoding::Octahedral => "octahedral",
        }
    }

    /// How many colour channels, alpha not among them, an image needs.
    #[must_use]
    pub fn colors_needed(self) -> u8 {
        match self {
            NormalEncoding::Linear(_) | NormalEncoding::Snorm => 3,
            NormalEncoding::TwoChannel | NormalEncoding::Octahedral => 2,
        }
    }

    /// Takes an image as a normal map in a linear code: its own where it has one, else `target`. Alpha is kept.
    ///
    /// An image of two channels counts as red and green here, not as grey and alpha.
    ///
    /// # Errors
    /// [`Error::CodecChannels`] when the image has too few channels, [`Error::CodecSamples`] for `snorm` in floats,
    /// [`Error::OutOfRange`] for float images outside [0, 1].
    pub fn load(self, image: &Image, target: NormalCodec) -> Result<NormalMap, Error> {
        if image.channels < self.colors_needed() {
            return Err(Error::CodecChannels {
                path: image.path.clone(),
                codec: self.name(),
                needed: self.colors_needed(),
                channels: image.channels,
            });
        }
        if let NormalEncoding::Linear(codec) = self {
            return NormalMap::from_image(image, codec);
        }
        image.require_unit_range("normal map")?;
        let texels = (0..image.texel_count()).map(|t| self.texel(image, t, target));
        Ok(NormalMap {
            width: image.width,
            height: image.height,
            codec: target,
            texels: texels.collect::<Result<_, Error>>()?,
        })
    }

    /// Red, green and blue of a unit normal in bytes; what an encoding does not need is 0. [`NormalEncoding::load`] reads it back.
    #[must_use]
    pub fn encode(self, n: Vec3) -> [u8; 3] {
        match self {
            NormalEncoding::Linear(codec) => n.to_array().map(|c| codec.encode(c)),
            NormalEncoding::Snorm => n.to_array().map(|c| codec_snorm::encode8(c).cast_unsigned()),
            NormalEncoding::TwoChannel => [codec_unorm::encode(n.x), codec_unorm::encode(n.y), 0],
            NormalEncoding::Octahedral => {
                let [x, y] = codec_octahedral::encode(n).to_array().map(codec_unorm::encode);
                [x, y, 0]
            }
        }
    }

    fn texel(self, image: &Image, texel: usize, target: NormalCodec) -> Result<[u8; 4], Error> {
        let first = texel * usize::from(image.channels);
        let unorm = |channel: usize| 2.0 * image.texels.sample(first + channel) - 1.0;
        let n = match self {
            NormalEncoding::TwoChannel => codec_two_channel::decode(Vec2::new(unorm(0), unorm(1))),
            NormalEncoding::Octahedral => codec_octahedral::decode(Vec2::new(unorm(0), unorm(1))),
            NormalEncoding::Snorm => signed(image, first)?,
            NormalEncoding::Linear(codec) => {
                Vec3::from([0, 1, 2].map(|c| codec.decode(image.byte(first + c))))
            }
        };
        let [r, g, b] = n.to_array().map(|component| target.encode(component));
        let alpha = if image.channels == 4 {
            image.byte(first + 3)
        } else {
            255
        };
        Ok([r, g, b, alpha])
    }
}

/// Three samples as signed normalised integers of the image's own width.
fn signed(image: &Image, first: usize) -> Result<Vec3, Error> {
    use crate::Texels;
    match &image.texels {
        Texels::Unorm8(v) => Ok(Vec3::from(
            [0, 1, 2].map(|c| codec_snorm::decode8(v[first + c] as i8)),
        )),
        Texels::Unorm16(v) => Ok(Vec3::from(
            [0, 1, 2].map(|c| codec_snorm::decode16(v[first + c] as i16)),
        )),
        Texels::Float32(_) => Err(Error::CodecSamples {
            path: image.path.clone(),
            codec: NormalEncoding::Snorm.name(),
        }),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Texels;

    fn image(channels: u8, bytes: Vec<u8>) -> Image {
        Image {
            width: 1,
            height: 1,
            channels,
            texels: Texels::Unorm8(bytes),
            path: "wall.png".into(),
        }
    }

    #[test]
    fn every_encoding_of_one_normal_gives_the_same_map() {
        let n = Vec3::new(0.6, 0.0, 0.8);
        let unorm = n.to_array().map(codec_unorm::encode);
        let signed = n.to_array().map(|c| codec_snorm::encode8(c) as u8);
        let folded = codec_octahedral::encode(n).to_array().map(codec_unorm::encode);
        let maps = [
            NormalEncoding::Linear(NormalCodec::Unorm).load(&image(3, unorm.to_vec()), NormalCodec::Unorm),
            NormalEncoding::Snorm.load(&image(3, signed.to_vec()), NormalCodec::Unorm),
            NormalEncoding::TwoChannel.load(&image(2, unorm[..2].to_vec()), NormalCodec::Unorm),
            NormalEncoding::Octahedral.load(&image(2, folded.to_vec()), NormalCodec::Unorm),
        ];
        for map in maps {
            // Half a step of 1/127 in two codes in a row, the octahedron's stretched by √3.
            let error = (map.unwrap().decode(0, 0) - n).abs().max_element();
            assert!(error <= (1.0 + 3f32.sqrt()) * 0.5 / 127.0, "{error}");
        }
    }

    #[test]
    fn what_is_encoded_is_read_back() {
        let encodings = [
            NormalEncoding::Linear(NormalCodec::Biased),
            NormalEncoding::Snorm,
            NormalEncoding::TwoChannel,
            NormalEncoding::Octahedral,
        ];
        for n in [Vec3::Z, Vec3::new(0.6, 0.0, 0.8), Vec3::new(-0.48, 0.64, 0.6)] {
            for encoding in encodings {
                let bytes = encoding.encode(n).to_vec();
                let map = encoding.load(&image(3, bytes), NormalCodec::Biased).unwrap();
                // Half a step of 1/127 in the encoding and in the map, on a component that the encoding stretches by at most √3 (the
                // octahedron) or x/z + y/z (z put back): below 2.
                let error = (map.decode(0, 0) - n).abs().max_element();
                assert!(error <= 3.0 * 0.5 / 127.0, "{encoding:?} {n}: {error}");
            }
        }
    }

    #[test]
    fn alpha_is_kept() {
        let map = NormalEncoding::TwoChannel.load(&image(4, vec![128, 128, 9, 77]), NormalCodec::Biased);
        assert_eq!(map.unwrap().texels[0][3], 77);
    }

    #[test]
    fn channels_and_samples_that_do_not_fit_are_named() {
        let error = NormalEncoding::Octahedral
            .load(&image(1, vec![9]), NormalCodec::Unorm)
            .unwrap_err();
        assert_eq!(
            error.to_string(),
            "wall.png: the normal codec `octahedral` needs 2 colour channels; this image has 1 channel(s)"
        );
        let error = NormalEncoding::Snorm
            .load(&image(2, vec![9, 9]), NormalCodec::Unorm)
            .unwrap_err();
        assert!(error.to_string().contains("needs 3 colour channels"));
        let floats = Image {
            texels: Texels::Float32(vec![0.5; 3]),
            ..image(3, vec![])
        };
        let error = NormalEncoding::Snorm
            .load(&floats, NormalCodec::Unorm)
            .unwrap_err();
        assert!(error.to_string().contains("wall.png") && error.to_string().contains("integer"));
    }
}
