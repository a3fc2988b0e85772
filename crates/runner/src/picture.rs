//! Pictures that a job leaves in its targets.

use crate::target::TargetFormat;

/// One target's pixels, row 0 at the top.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Picture {
    /// In pixels.
    pub width: u32,
    /// In pixels.
    pub height: u32,
    /// What they were kept in.
    pub format: TargetFormat,
    /// The pixels. Of a target of bytes: byte / 255, correctly rounded; of integers: floats of their bits ([`f32::to_bits`]).
    pub pixels: Vec<[f32; 4]>,
}

impl Picture {
    /// The pixel at (x, y) from the top left.
    #[must_use]
    pub fn pixel(&self, x: u32, y: u32) -> Option<[f32; 4]> {
        if x >= self.width || y >= self.height {
            return None;
        }
        self.pixels
            .get(y as usize * self.width as usize + x as usize)
            .copied()
    }

    /// For each pixel of a target that was cleared to the sentinel: whether a draw wrote it.
    #[must_use]
    pub fn covered(&self) -> Vec<bool> {
        let is_written = |pixel: &[f32; 4]| !pixel.iter().all(|value| crate::is_unwritten(*value));
        self.pixels.iter().map(is_written).collect()
    }

    /// The bytes that a target of bytes held; `None` for floats and integers.
    #[must_use]
    pub fn codes(&self) -> Option<Vec<[u8; 4]>> {
        match self.format {
            TargetFormat::Rgba32Float | TargetFormat::Rgba32Uint | TargetFormat::Rgba32Sint => None,
            // The nearest whole number of (byte / 255) · 255 is the byte: two roundings of 2⁻²⁴ are far below a half of 255.
            TargetFormat::Rgba8Unorm => {
                let codes = |pixel: &[f32; 4]| pixel.map(|value| (value * 255.0).round() as u8);
                Some(self.pixels.iter().map(codes).collect())
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_byte_comes_back() {
        let bytes: Vec<u8> = (0..=255).collect();
        let picture = Picture {
            width: 64,
            height: 1,
            format: TargetFormat::Rgba8Unorm,
            pixels: TargetFormat::Rgba8Unorm.pixels(&bytes),
        };
        assert_eq!(picture.codes().unwrap().as_flattened(), bytes);
        let floats = Picture {
            format: TargetFormat::Rgba32Float,
            ..picture
        };
        assert_eq!(floats.codes(), None);
    }
}
