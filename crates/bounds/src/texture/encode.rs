//! Texels as bytes and as scalars.

use super::format::{Encoding, Rounding, TexelFormat};
use crate::bindings::Scalar;
use crate::domain::Domain;
use crate::domain::point::float_to_bits;
use crate::kind::Kind;
use crate::width::Width;

impl TexelFormat {
    /// The bytes of a texel with these channels, each rounded to the nearest that the format has; channels that it lacks are left out.
    #[must_use]
    pub fn encode(self, channels: [f64; 4]) -> Vec<u8> {
        let stored: Vec<f64> = (0..self.channels())
            .map(|channel| self.quantize(channel, channels[channel], Rounding::Nearest))
            .collect();
        match self.encoding() {
            Encoding::Rgb10a2 { normalised } => rgb10a2(&stored, normalised).to_le_bytes().to_vec(),
            Encoding::Rg11b10 => rg11b10(&stored).to_le_bytes().to_vec(),
            encoding @ (Encoding::Unorm(_) | Encoding::Snorm(_) | Encoding::Float(_) | Encoding::Int(_)) => {
                let size = self.bytes() / self.channels();
                let mut words: Vec<u64> = stored.iter().map(|x| bits(encoding, *x)).collect();
                if self == Self::Bgra8Unorm {
                    words.swap(0, 2);
                }
                words
                    .iter()
                    .flat_map(|word| word.to_le_bytes()[..size].to_vec())
                    .collect()
            }
        }
    }

    /// The texels in these bytes as scalars, four a texel: channels that the format lacks are 0, the fourth 1.
    #[must_use]
    pub fn scalars<D: Domain>(self, bytes: &[u8]) -> Vec<Scalar<D>> {
        let scalar = |x: f64| match self.kind() {
            Kind::Float(_) | Kind::Bool => Scalar::Float(D::to_float(D::real(Width::F32, x, x))),
            Kind::Int(_) => Scalar::Int(x as i128, x as i128),
        };
        let texels = bytes.chunks_exact(self.bytes());
        texels.flat_map(|texel| self.decode(texel).map(scalar)).collect()
    }

    /// The bytes of texels whose scalars, four a texel, a machine has written.
    #[must_use]
    pub fn bytes_of(self, scalars: &[Scalar<crate::F32>]) -> Vec<u8> {
        let number = |scalar: &Scalar<crate::F32>| match *scalar {
            Scalar::Float(x) => x,
            Scalar::Int(lo, _) => lo as f64,
            Scalar::Bool(truth) => f64::from(u8::from(truth == crate::Truth::True)),
        };
        let texels = scalars.as_chunks::<4>().0.iter();
        texels
            .flat_map(|texel| self.encode(texel.each_ref().map(number)))
            .collect()
    }
}

/// The bits of a number that the encoding has.
fn bits(encoding: Encoding, x: f64) -> u64 {
    match encoding {
        Encoding::Unorm(n) => (x * ((1u64 << n) - 1) as f64).round() as u64,
        Encoding::Snorm(n) => (x * ((1u64 << (n - 1)) - 1) as f64).round() as i64 as u64,
        Encoding::Float(w) => float_to_bits(w, x),
        Encoding::Int(t) if t.signed => x as i64 as u64,
        Encoding::Int(_) | Encoding::Rgb10a2 { .. } | Encoding::Rg11b10 => x as u64,
    }
}

fn rgb10a2(stored: &[f64], normalised: bool) -> u32 {
    let word = |channel: usize| match (normalised, channel) {
        (false, _) => stored[channel] as u32,
        (true, 3) => (stored[channel] * 3.0).round() as u32,
        (true, _) => (stored[channel] * 1023.0).round() as u32,
    };
    word(0) | word(1) << 10 | word(2) << 20 | word(3) << 30
}

/// The bits of a half without its sign and its last ones.
fn rg11b10(stored: &[f64]) -> u32 {
    let half = |channel: usize| float_to_bits(Width::F16, stored[channel]) as u32;
    (half(0) >> 4 & 0x7ff) | (half(1) >> 4 & 0x7ff) << 11 | (half(2) >> 5 & 0x3ff) << 22
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_encoded_decodes_to_the_nearest_that_the_format_has() {
        use TexelFormat as T;
        let formats = [
            T::R8Unorm,
            T::Rgba8Snorm,
            T::Rg16Unorm,
            T::Rgba16Snorm,
            T::Rgba16Float,
            T::Rgba8Uint,
            T::Rgba16Sint,
            T::Rg32Float,
            T::Rgba32Uint,
            T::R32Sint,
            T::Bgra8Unorm,
            T::Rgb10a2Uint,
            T::Rgb10a2Unorm,
            T::Rg11b10Ufloat,
            T::Depth16Unorm,
            T::Depth32Float,
        ];
        for format in formats {
            for channels in [
                [0.0, 1.0, 0.3, 0.7],
                [-1.0, -0.4, 2.0, 100.0],
                [3.0, 250.0, 7.0, 1.0],
            ] {
                let bytes = format.encode(channels);
                assert_eq!(bytes.len(), format.bytes(), "{format:?}");
                let decoded = format.decode(&bytes);
                for (channel, x) in channels.iter().enumerate().take(format.channels()) {
                    let nearest = match (format.kind(), format.quantize(channel, *x, Rounding::Nearest)) {
                        (Kind::Int(_), x) => x.trunc(),
                        (_, x) => x,
                    };
                    assert_eq!(decoded[channel], nearest, "{format:?} of {channels:?}");
                }
                let scalars = format.scalars::<crate::F32>(&bytes);
                assert_eq!(format.bytes_of(&scalars), bytes, "{format:?}");
            }
        }
    }
}
