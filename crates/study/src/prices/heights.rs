//! Height maps of one content in several formats.

use bossage_runner::{TexelFormat, TextureData};

/// How heights are stored.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Storage {
    Unorm8,
    Unorm16,
    Float32,
}

impl Storage {
    pub(super) const ALL: [Self; 3] = [Self::Unorm8, Self::Unorm16, Self::Float32];

    pub(super) const fn bits(self) -> u32 {
        match self {
            Self::Unorm8 => 8,
            Self::Unorm16 => 16,
            Self::Float32 => 32,
        }
    }

    /// Bytes of a texel.
    pub(super) fn bytes(self) -> f64 {
        f64::from(self.bits()) / 8.0
    }

    /// The greatest integer code.
    pub(super) const fn codes(self) -> Option<f64> {
        match self {
            Self::Unorm8 => Some(255.0),
            Self::Unorm16 => Some(65_535.0),
            Self::Float32 => None,
        }
    }

    /// What is read back of a height in [0, 1].
    pub(super) fn kept(self, height: f64) -> f64 {
        match self.codes() {
            Some(codes) => (height * codes).round() / codes,
            None => f64::from(height as f32),
        }
    }

    /// A square map of those heights.
    pub(super) fn texture(self, heights: &[f64], side: u32) -> TextureData {
        let code = |height: &f64, codes: f64| (height * codes).round();
        let plane = |format, bytes: &[u8]| TextureData::plane(side, side, format, bytes);
        match self {
            Self::Unorm8 => {
                let texels: Vec<u8> = heights.iter().map(|h| code(h, 255.0) as u8).collect();
                plane(TexelFormat::R8Unorm, &texels)
            }
            Self::Unorm16 => {
                let texels: Vec<u16> = heights.iter().map(|h| code(h, 65_535.0) as u16).collect();
                plane(TexelFormat::R16Unorm, bytemuck::cast_slice(&texels))
            }
            Self::Float32 => {
                let texels: Vec<f32> = heights.iter().map(|h| *h as f32).collect();
                plane(TexelFormat::R32Float, bytemuck::cast_slice(&texels))
            }
        }
    }
}
