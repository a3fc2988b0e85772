//! Texels of jobs as four words each: floats as their bits, integers as they are.

use bossage_runner::{TexelFormat, TextureData};

/// How the channels of a format are kept.
#[derive(Clone, Copy)]
enum Channel {
    Unorm8,
    Snorm8,
    Unorm16,
    Snorm16,
    Float16,
    Float32,
    Uint8,
    Sint8,
    Uint16,
    Sint16,
    Word,
}

/// A level's texels: red, green, blue, alpha; what the format lacks is 0, and alpha 1.
pub(crate) fn words(data: &TextureData, level: &[u8]) -> Vec<u32> {
    let bytes = data.format.texel_bytes();
    let texels = level.chunks_exact(bytes);
    texels.flat_map(|texel| colour(data.format, texel)).collect()
}

fn colour(format: TexelFormat, texel: &[u8]) -> [u32; 4] {
    let channel = channel(format);
    let one = match format.sample_type() {
        "f32" => 1.0_f32.to_bits(),
        _ => 1,
    };
    let mut colour = [0, 0, 0, one];
    for (to, bytes) in colour.iter_mut().zip(texel.chunks_exact(size(channel))) {
        *to = word(channel, bytes);
    }
    if format == TexelFormat::Bgra8Unorm {
        colour.swap(0, 2);
    }
    colour
}

fn channel(format: TexelFormat) -> Channel {
    match format {
        TexelFormat::R8Unorm | TexelFormat::Rg8Unorm | TexelFormat::Rgba8Unorm | TexelFormat::Bgra8Unorm => {
            Channel::Unorm8
        }
        TexelFormat::Rg8Snorm | TexelFormat::Rgba8Snorm => Channel::Snorm8,
        TexelFormat::R16Unorm
        | TexelFormat::Rg16Unorm
        | TexelFormat::Rgba16Unorm
        | TexelFormat::Depth16Unorm => Channel::Unorm16,
        TexelFormat::Rg16Snorm | TexelFormat::Rgba16Snorm => Channel::Snorm16,
        TexelFormat::Rgba16Float => Channel::Float16,
        TexelFormat::R32Float | TexelFormat::Rg32Float | TexelFormat::Rgba32Float => Channel::Float32,
        TexelFormat::Rgba8Uint => Channel::Uint8,
        TexelFormat::Rgba8Sint => Channel::Sint8,
        TexelFormat::Rgba16Uint => Channel::Uint16,
        TexelFormat::Rgba16Sint => Channel::Sint16,
        TexelFormat::R32Uint
        | TexelFormat::R32Sint
        | TexelFormat::Rg32Uint
        | TexelFormat::Rg32Sint
        | TexelFormat::Rgba32Uint
        | TexelFormat::Rgba32Sint => Channel::Word,
    }
}

fn size(channel: Channel) -> usize {
    match channel {
        Channel::Unorm8 | Channel::Snorm8 | Channel::Uint8 | Channel::Sint8 => 1,
        Channel::Unorm16 | Channel::Snorm16 | Channel::Float16 | Channel::Uint16 | Channel::Sint16 => 2,
        Channel::Float32 | Channel::Word => 4,
    }
}

fn word(channel: Channel, bytes: &[u8]) -> u32 {
    let bits = bytes
        .iter()
        .rev()
        .fold(0, |bits, byte| bits << 8 | u32::from(*byte));
    let (short, byte) = (bits as u16, bits as u8);
    let float = |value: f64| (value as f32).to_bits();
    match channel {
        Channel::Unorm8 => float(f64::from(byte) / 255.0),
        Channel::Snorm8 => float((f64::from(byte.cast_signed()) / 127.0).max(-1.0)),
        Channel::Unorm16 => float(f64::from(short) / 65535.0),
        Channel::Snorm16 => float((f64::from(short.cast_signed()) / 32767.0).max(-1.0)),
        Channel::Float16 => half::f16::from_bits(short).to_f32().to_bits(),
        Channel::Sint8 => i32::from(byte.cast_signed()).cast_unsigned(),
        Channel::Sint16 => i32::from(short.cast_signed()).cast_unsigned(),
        Channel::Uint8 | Channel::Uint16 | Channel::Float32 | Channel::Word => bits,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn floats(format: TexelFormat, texel: &[u8]) -> [f32; 4] {
        colour(format, texel).map(f32::from_bits)
    }

    #[test]
    fn every_kind_of_format_is_read() {
        assert_eq!(floats(TexelFormat::Rg8Unorm, &[255, 0]), [1.0, 0.0, 0.0, 1.0]);
        assert_eq!(
            floats(TexelFormat::Rg8Snorm, &[0x80, 0x7f]),
            [-1.0, 1.0, 0.0, 1.0]
        );
        assert_eq!(floats(TexelFormat::R16Unorm, &[0xff, 0xff])[0], 1.0);
        assert_eq!(
            floats(TexelFormat::Rg16Snorm, &[0, 0x80, 0xff, 0x7f])[..2],
            [-1.0, 1.0]
        );
        assert_eq!(
            floats(TexelFormat::Bgra8Unorm, &[255, 0, 0, 255]),
            [0.0, 0.0, 1.0, 1.0]
        );
        assert_eq!(
            floats(TexelFormat::Rgba16Float, &[0, 0x3c, 0, 0xc0, 0, 0, 0, 0x38]),
            [1.0, -2.0, 0.0, 0.5]
        );
        let bytes: Vec<u8> = [0.5_f32, -2.0, 3.0, 4.0]
            .iter()
            .flat_map(|x| x.to_le_bytes())
            .collect();
        assert_eq!(floats(TexelFormat::Rgba32Float, &bytes), [0.5, -2.0, 3.0, 4.0]);
        assert_eq!(
            colour(TexelFormat::Rgba8Sint, &[0xff, 1, 2, 3]),
            [u32::MAX, 1, 2, 3]
        );
        assert_eq!(
            colour(TexelFormat::Rg32Uint, &[7, 0, 0, 0, 0, 1, 0, 0]),
            [7, 256, 0, 1]
        );
    }
}
