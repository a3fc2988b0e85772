//! Pixels → PNG. Linear light is encoded as sRGB here, by the float64 formulas, never by a driver.

use bossage_reference::srgb;
use image::{ExtendedColorType, ImageEncoder, codecs::png::PngEncoder};

use crate::error::{Error, Result};

/// A PNG of red, green, blue, alpha bytes, row by row.
pub(crate) fn png_rgba8(width: u32, height: u32, bytes: &[u8]) -> Result<Vec<u8>> {
    png(width, height, bytes, ExtendedColorType::Rgba8)
}

/// A PNG of samples of this kind, in native byte order.
pub(crate) fn png(width: u32, height: u32, bytes: &[u8], kind: ExtendedColorType) -> Result<Vec<u8>> {
    let mut out = Vec::new();
    PngEncoder::new(&mut out)
        .write_image(bytes, width, height, kind)
        .map_err(Error::Png)?;
    Ok(out)
}

/// A picture in linear light; alpha is not kept.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Linear {
    pub(crate) width: u32,
    pub(crate) height: u32,
    pub(crate) pixels: Vec<[f32; 3]>,
}

impl Linear {
    /// The picture as an sRGB PNG. A pixel that is not a number is drawn in magenta: it must be seen.
    pub(crate) fn png(&self) -> Result<Vec<u8>> {
        let bytes: Vec<u8> = self.pixels.iter().flat_map(|pixel| encode(*pixel)).collect();
        png(self.width, self.height, &bytes, ExtendedColorType::Rgb8)
    }

    /// The pictures side by side, with a gap of some white pixels. All must be of one height.
    pub(crate) fn beside(pictures: &[Self]) -> Self {
        const GAP: usize = 4;
        let height = pictures.iter().map(|picture| picture.height).min().unwrap_or(0);
        let mut pixels = Vec::new();
        for y in 0..height as usize {
            for (index, picture) in pictures.iter().enumerate() {
                let width = picture.width as usize;
                pixels.extend(std::iter::repeat_n([1.0; 3], if index == 0 { 0 } else { GAP }));
                pixels.extend_from_slice(&picture.pixels[y * width..(y + 1) * width]);
            }
        }
        let width = pixels.len().checked_div(height as usize).unwrap_or(0) as u32;
        Self {
            width,
            height,
            pixels,
        }
    }
}

fn encode(pixel: [f32; 3]) -> [u8; 3] {
    if pixel.iter().any(|value| value.is_nan()) {
        return [255, 0, 255];
    }
    pixel.map(|value| srgb::encode_byte(f64::from(value)))
}

/// How two pictures differ.
#[derive(Clone, Debug)]
pub(crate) struct Difference {
    /// |a − b|, amplified.
    pub(crate) picture: Linear,
    /// The factor: the largest difference becomes white.
    pub(crate) amplification: f32,
    /// The largest difference of a channel, in linear light.
    pub(crate) max: f32,
    /// The mean over pixels and channels.
    pub(crate) mean: f64,
}

/// The difference of two pictures of one size.
pub(crate) fn difference(a: &Linear, b: &Linear) -> Difference {
    let between = |(a, b): (&[f32; 3], &[f32; 3])| [0, 1, 2].map(|channel| (a[channel] - b[channel]).abs());
    let pixels: Vec<[f32; 3]> = a.pixels.iter().zip(&b.pixels).map(between).collect();
    let max = pixels.as_flattened().iter().copied().fold(0.0, f32::max);
    let sum: f64 = pixels.as_flattened().iter().map(|value| f64::from(*value)).sum();
    let mean = sum / (pixels.as_flattened().len().max(1) as f64);
    let amplification = if max > 0.0 { 1.0 / max } else { 1.0 };
    let amplified = pixels
        .iter()
        .map(|pixel| pixel.map(|value| value * amplification))
        .collect();
    let picture = Linear {
        width: a.width,
        height: a.height,
        pixels: amplified,
    };
    Difference {
        picture,
        amplification,
        max,
        mean,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn picture(pixels: &[[f32; 3]]) -> Linear {
        Linear {
            width: pixels.len() as u32,
            height: 1,
            pixels: pixels.to_vec(),
        }
    }

    #[test]
    fn pngs_hold_the_srgb_bytes_of_linear_light() {
        // 0.5 in linear light is byte 188 (0.7354 · 255 = 187.5…) by the standard's formula; NaN must be seen.
        let png = picture(&[[0.0, 0.5, 1.0], [2.0, -1.0, f32::INFINITY], [f32::NAN, 0.0, 0.0]])
            .png()
            .unwrap();
        let read = image::load_from_memory(&png).unwrap().to_rgb8();
        let pixels: Vec<[u8; 3]> = read.pixels().map(|pixel| pixel.0).collect();
        assert_eq!(pixels, [[0, 188, 255], [255, 0, 255], [255, 0, 255]]);
    }

    #[test]
    fn a_difference_is_amplified_to_white() {
        let difference = difference(
            &picture(&[[0.5; 3], [0.0; 3]]),
            &picture(&[[0.25, 0.5, 0.5], [0.0; 3]]),
        );
        assert_eq!((difference.max, difference.amplification), (0.25, 4.0));
        assert_eq!(difference.picture.pixels, [[1.0, 0.0, 0.0], [0.0; 3]]);
        assert_eq!(difference.mean, 0.25 / 6.0);
        let none = super::difference(&picture(&[[0.5; 3]]), &picture(&[[0.5; 3]]));
        assert_eq!((none.max, none.picture.pixels), (0.0, vec![[0.0; 3]]));
    }

    #[test]
    fn pictures_stand_side_by_side() {
        let both = Linear::beside(&[picture(&[[0.0; 3]]), picture(&[[0.5; 3], [0.25; 3]])]);
        assert_eq!((both.width, both.height), (1 + 4 + 2, 1));
        assert_eq!(both.pixels[0], [0.0; 3]);
        assert_eq!(both.pixels[1], [1.0; 3]);
        assert_eq!(both.pixels[6], [0.25; 3]);
    }
}
