//! Texel formats: bytes to numbers and back.

use crate::domain::point::float_from_bits;
use crate::kind::{IntType, Kind};
use crate::width::{Width, exp2i, exponent_of};
use naga::StorageFormat;

/// How the channels of a texel are encoded.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Encoding {
    Unorm(u32),
    Snorm(u32),
    Float(Width),
    Int(IntType),
    /// 10, 10, 10 and 2 bits.
    Rgb10a2 {
        normalised: bool,
    },
    /// 11, 11 and 10 bits of unsigned floats.
    Rg11b10,
}

macro_rules! formats {
    ($($name:ident, $channels:literal, $encoding:expr;)*) => {
        /// A texel format; names as in WebGPU.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
        #[expect(missing_docs, reason = "names are those of WebGPU")]
        pub enum TexelFormat { $($name,)* }

        impl TexelFormat {
            /// Number of channels.
            pub fn channels(self) -> usize {
                match self { $(Self::$name => $channels,)* }
            }

            pub(crate) fn encoding(self) -> Encoding {
                match self { $(Self::$name => $encoding,)* }
            }
        }
    };
}

const fn int(signed: bool, bits: u32) -> Encoding {
    Encoding::Int(IntType { signed, bits })
}

formats! {
    R8Unorm, 1, Encoding::Unorm(8); R8Snorm, 1, Encoding::Snorm(8); R8Uint, 1, int(false, 8); R8Sint, 1, int(true, 8);
    R16Unorm, 1, Encoding::Unorm(16); R16Snorm, 1, Encoding::Snorm(16);
    R16Uint, 1, int(false, 16); R16Sint, 1, int(true, 16); R16Float, 1, Encoding::Float(Width::F16);
    Rg8Unorm, 2, Encoding::Unorm(8); Rg8Snorm, 2, Encoding::Snorm(8); Rg8Uint, 2, int(false, 8); Rg8Sint, 2, int(true, 8);
    R32Uint, 1, int(false, 32); R32Sint, 1, int(true, 32); R32Float, 1, Encoding::Float(Width::F32);
    R64Uint, 1, int(false, 64);
    Rg16Unorm, 2, Encoding::Unorm(16); Rg16Snorm, 2, Encoding::Snorm(16);
    Rg16Uint, 2, int(false, 16); Rg16Sint, 2, int(true, 16); Rg16Float, 2, Encoding::Float(Width::F16);
    Rgba8Unorm, 4, Encoding::Unorm(8); Rgba8Snorm, 4, Encoding::Snorm(8); Rgba8Uint, 4, int(false, 8); Rgba8Sint, 4, int(true, 8);
    Bgra8Unorm, 4, Encoding::Unorm(8);
    Rgb10a2Uint, 4, Encoding::Rgb10a2 { normalised: false }; Rgb10a2Unorm, 4, Encoding::Rgb10a2 { normalised: true };
    Rg11b10Ufloat, 3, Encoding::Rg11b10;
    Rg32Uint, 2, int(false, 32); Rg32Sint, 2, int(true, 32); Rg32Float, 2, Encoding::Float(Width::F32);
    Rgba16Unorm, 4, Encoding::Unorm(16); Rgba16Snorm, 4, Encoding::Snorm(16);
    Rgba16Uint, 4, int(false, 16); Rgba16Sint, 4, int(true, 16); Rgba16Float, 4, Encoding::Float(Width::F16);
    Rgba32Uint, 4, int(false, 32); Rgba32Sint, 4, int(true, 32); Rgba32Float, 4, Encoding::Float(Width::F32);
    Depth16Unorm, 1, Encoding::Unorm(16); Depth32Float, 1, Encoding::Float(Width::F32);
}

impl TexelFormat {
    /// Bytes of a texel.
    pub fn bytes(self) -> usize {
        match self.encoding() {
            Encoding::Rgb10a2 { .. } | Encoding::Rg11b10 => 4,
            Encoding::Unorm(bits) | Encoding::Snorm(bits) => self.channels() * bits as usize / 8,
            Encoding::Float(w) => self.channels() * Kind::Float(w).bytes(),
            Encoding::Int(t) => self.channels() * t.bits as usize / 8,
        }
    }

    /// Whether depth references are clamped to [0, 1] before they are compared.
    pub(crate) fn clamps_reference(self) -> bool {
        self == Self::Depth16Unorm
    }

    /// The channels of the texel at the start of the bytes; missing ones are 0, 0, 0, 1.
    pub(crate) fn decode(self, bytes: &[u8]) -> [f64; 4] {
        let mut out = [0.0, 0.0, 0.0, 1.0];
        let size = self.bytes() / self.channels();
        match self.encoding() {
            Encoding::Rgb10a2 { normalised } => return rgb10a2(word(&bytes[..4]), normalised),
            Encoding::Rg11b10 => return rg11b10(word(&bytes[..4])),
            encoding @ (Encoding::Unorm(_) | Encoding::Snorm(_) | Encoding::Float(_) | Encoding::Int(_)) => {
                for (to, part) in out.iter_mut().zip(bytes.chunks_exact(size)).take(self.channels()) {
                    *to = decode_channel(encoding, word(part));
                }
            }
        }
        if self == Self::Bgra8Unorm {
            out.swap(0, 2);
        }
        out
    }

    /// A channel value as the format stores it, rounded that way.
    pub(crate) fn quantize(self, channel: usize, x: f64, rounding: Rounding) -> f64 {
        match self.encoding() {
            Encoding::Unorm(bits) => unorm(x, bits, rounding),
            Encoding::Snorm(bits) => snorm(x, bits, rounding),
            Encoding::Float(w) => rounding.to_format(w, x),
            Encoding::Int(t) => x.clamp(t.min() as f64, t.max() as f64),
            Encoding::Rgb10a2 { normalised: true } => unorm(x, if channel == 3 { 2 } else { 10 }, rounding),
            Encoding::Rgb10a2 { normalised: false } => x.clamp(0.0, if channel == 3 { 3.0 } else { 1023.0 }),
            Encoding::Rg11b10 => small_float(x, if channel == 2 { 5 } else { 6 }, rounding),
        }
    }

    /// How far a filter that works in the precision of the texels may be off along one axis: by a step of 1/255 where it rounds a
    /// byte once, by two of 1/65535 where it truncates two 16-bit products. Other formats are filtered in floats.
    pub(crate) fn filter_step(self) -> f64 {
        match self.encoding() {
            Encoding::Unorm(8) => 1.0 / 255.0,
            Encoding::Unorm(16) => 2.0 / 65535.0,
            Encoding::Unorm(_)
            | Encoding::Snorm(_)
            | Encoding::Float(_)
            | Encoding::Int(_)
            | Encoding::Rgb10a2 { .. }
            | Encoding::Rg11b10 => 0.0,
        }
    }

    /// The format of a storage texture.
    pub fn of_storage(format: StorageFormat) -> Self {
        match format {
            StorageFormat::R8Unorm => Self::R8Unorm,
            StorageFormat::R8Snorm => Self::R8Snorm,
            StorageFormat::R8Uint => Self::R8Uint,
            StorageFormat::R8Sint => Self::R8Sint,
            StorageFormat::R16Uint => Self::R16Uint,
            StorageFormat::R16Sint => Self::R16Sint,
            StorageFormat::R16Float => Self::R16Float,
            StorageFormat::Rg8Unorm => Self::Rg8Unorm,
            StorageFormat::Rg8Snorm => Self::Rg8Snorm,
            StorageFormat::Rg8Uint => Self::Rg8Uint,
            StorageFormat::Rg8Sint => Self::Rg8Sint,
            StorageFormat::R32Uint => Self::R32Uint,
            StorageFormat::R32Sint => Self::R32Sint,
            StorageFormat::R32Float => Self::R32Float,
            StorageFormat::Rg16Uint => Self::Rg16Uint,
            StorageFormat::Rg16Sint => Self::Rg16Sint,
            StorageFormat::Rg16Float => Self::Rg16Float,
            StorageFormat::Rgba8Unorm => Self::Rgba8Unorm,
            StorageFormat::Rgba8Snorm => Self::Rgba8Snorm,
            StorageFormat::Rgba8Uint => Self::Rgba8Uint,
            StorageFormat::Rgba8Sint => Self::Rgba8Sint,
            StorageFormat::Bgra8Unorm => Self::Bgra8Unorm,
            StorageFormat::Rgb10a2Uint => Self::Rgb10a2Uint,
            StorageFormat::Rgb10a2Unorm => Self::Rgb10a2Unorm,
            StorageFormat::Rg11b10Ufloat => Self::Rg11b10Ufloat,
            StorageFormat::R64Uint => Self::R64Uint,
            StorageFormat::Rg32Uint => Self::Rg32Uint,
            StorageFormat::Rg32Sint => Self::Rg32Sint,
            StorageFormat::Rg32Float => Self::Rg32Float,
            StorageFormat::Rgba16Uint => Self::Rgba16Uint,
            StorageFormat::Rgba16Sint => Self::Rgba16Sint,
            StorageFormat::Rgba16Float => Self::Rgba16Float,
            StorageFormat::Rgba32Uint => Self::Rgba32Uint,
            StorageFormat::Rgba32Sint => Self::Rgba32Sint,
            StorageFormat::Rgba32Float => Self::Rgba32Float,
            StorageFormat::R16Unorm => Self::R16Unorm,
            StorageFormat::R16Snorm => Self::R16Snorm,
            StorageFormat::Rg16Unorm => Self::Rg16Unorm,
            StorageFormat::Rg16Snorm => Self::Rg16Snorm,
            StorageFormat::Rgba16Unorm => Self::Rgba16Unorm,
            StorageFormat::Rgba16Snorm => Self::Rgba16Snorm,
        }
    }

    /// The kind of scalar that a shader reads from the format.
    pub fn kind(self) -> Kind {
        match self.encoding() {
            Encoding::Int(t) if t.bits == 64 => Kind::Int(t),
            Encoding::Int(t) => Kind::Int(IntType {
                signed: t.signed,
                bits: 32,
            }),
            Encoding::Rgb10a2 { normalised: false } => Kind::Int(IntType::U32),
            Encoding::Unorm(_)
            | Encoding::Snorm(_)
            | Encoding::Float(_)
            | Encoding::Rgb10a2 { normalised: true }
            | Encoding::Rg11b10 => Kind::Float(Width::F32),
        }
    }
}

/// The kind of a storage texture's cells.
pub(crate) fn storage_kind(format: StorageFormat) -> Kind {
    TexelFormat::of_storage(format).kind()
}

fn word(bytes: &[u8]) -> u64 {
    bytes.iter().rev().fold(0, |w, &b| w << 8 | u64::from(b))
}

fn decode_channel(encoding: Encoding, bits: u64) -> f64 {
    match encoding {
        Encoding::Unorm(n) => bits as f64 / ((1u64 << n) - 1) as f64,
        Encoding::Snorm(n) => {
            let x = IntType {
                signed: true,
                bits: n,
            }
            .wrap(i128::from(bits));
            (x as f64 / ((1u64 << (n - 1)) - 1) as f64).max(-1.0)
        }
        Encoding::Float(w) => float_from_bits(w, bits),
        Encoding::Int(t) => t.wrap(i128::from(bits)) as f64,
        Encoding::Rgb10a2 { .. } | Encoding::Rg11b10 => bits as f64,
    }
}

fn rgb10a2(word: u64, normalised: bool) -> [f64; 4] {
    let parts = [word & 1023, word >> 10 & 1023, word >> 20 & 1023, word >> 30 & 3].map(|x| x as f64);
    if normalised {
        [
            parts[0] / 1023.0,
            parts[1] / 1023.0,
            parts[2] / 1023.0,
            parts[3] / 3.0,
        ]
    } else {
        parts
    }
}

/// Unsigned floats of 11 and 10 bits are halves without sign and with a shorter significand.
fn rg11b10(word: u64) -> [f64; 4] {
    let half = |bits: u64| float_from_bits(Width::F16, bits);
    [
        half((word & 0x7ff) << 4),
        half((word >> 11 & 0x7ff) << 4),
        half((word >> 22 & 0x3ff) << 5),
        1.0,
    ]
}

/// An unsigned float with five bits of exponent and so many of fraction; negative numbers become zero.
fn small_float(x: f64, fraction_bits: i32, rounding: Rounding) -> f64 {
    if x.is_nan() || x <= 0.0 || x == f64::INFINITY {
        return x.max(0.0);
    }
    let step = exp2i(exponent_of(x).max(-14) - fraction_bits);
    let rounded = rounding.to_integer(x / step) * step;
    if rounded < exp2i(16) {
        rounded
    } else {
        f64::INFINITY
    }
}

fn unorm(x: f64, bits: u32, rounding: Rounding) -> f64 {
    let most = ((1u64 << bits) - 1) as f64;
    rounding.to_integer(x.clamp(0.0, 1.0) * most) / most
}

fn snorm(x: f64, bits: u32, rounding: Rounding) -> f64 {
    let most = ((1u64 << (bits - 1)) - 1) as f64;
    rounding.to_integer(x.clamp(-1.0, 1.0) * most) / most
}

/// Where a conversion to a format goes. Vulkan lets it return either of the two numbers around the exact one (*Conversion from
/// Floating-Point to Normalized Fixed-Point*, and the same for floats of fewer bits); a perfect machine takes the nearest.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Rounding {
    Nearest,
    Down,
    Up,
}

impl Rounding {
    fn to_integer(self, x: f64) -> f64 {
        match self {
            Self::Nearest => x.round_ties_even(),
            Self::Down => x.floor(),
            Self::Up => x.ceil(),
        }
    }

    fn to_format(self, w: Width, x: f64) -> f64 {
        match self {
            Self::Nearest => w.round(x),
            Self::Down => w.round_down(x, 0.0),
            Self::Up => w.round_up(x, 0.0),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn decoding_fills_missing_channels() {
        assert_eq!(TexelFormat::Rg8Unorm.decode(&[255, 0]), [1.0, 0.0, 0.0, 1.0]);
        assert_eq!(TexelFormat::R8Snorm.decode(&[0x80])[0], -1.0);
        assert_eq!(
            TexelFormat::Bgra8Unorm.decode(&[255, 0, 0, 255]),
            [0.0, 0.0, 1.0, 1.0]
        );
        assert_eq!(TexelFormat::R16Float.decode(&0x3c00u16.to_le_bytes())[0], 1.0);
        assert_eq!(
            TexelFormat::Rgb10a2Uint.decode(&0xffff_ffffu32.to_le_bytes()),
            [1023.0, 1023.0, 1023.0, 3.0]
        );
        assert_eq!(TexelFormat::R32Sint.decode(&(-5i32).to_le_bytes())[0], -5.0);
    }

    #[test]
    fn quantizing_is_idempotent() {
        for x in [0.0, 0.1, 0.5, 0.999, 1.0] {
            for f in [
                TexelFormat::Rgba8Unorm,
                TexelFormat::Rgba8Snorm,
                TexelFormat::Rgba16Float,
                TexelFormat::Rg11b10Ufloat,
            ] {
                let q = f.quantize(0, x, Rounding::Nearest);
                assert_eq!(f.quantize(0, q, Rounding::Nearest), q, "{f:?} {x}");
            }
        }
    }

    /// Either neighbour may be stored; what the format has is stored as it is.
    #[test]
    fn roundings_go_to_the_two_neighbours() {
        for (format, x, below, above) in [
            (TexelFormat::Rgba8Unorm, 0.3, 76.0 / 255.0, 77.0 / 255.0),
            (TexelFormat::Rgba8Snorm, -0.6, -77.0 / 127.0, -76.0 / 127.0),
            (TexelFormat::Rg11b10Ufloat, 0.3, 0.296875, 0.30078125),
            (TexelFormat::R16Float, 2049.0, 2048.0, 2050.0),
            (TexelFormat::Rg11b10Ufloat, 70_000.0, f64::INFINITY, f64::INFINITY),
            (TexelFormat::Rg11b10Ufloat, -1.0, 0.0, 0.0),
            (TexelFormat::Rg11b10Ufloat, 1.5, 1.5, 1.5),
            (TexelFormat::Rgba8Unorm, 2.0, 1.0, 1.0),
        ] {
            let to = |rounding| format.quantize(0, x, rounding);
            assert_eq!(
                (to(Rounding::Down), to(Rounding::Up)),
                (below, above),
                "{format:?} of {x}"
            );
            let nearest = to(Rounding::Nearest);
            assert!(
                nearest == below || nearest == above,
                "{format:?} of {x}: {nearest}"
            );
        }
    }
}
