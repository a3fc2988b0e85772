//! Colour maps: 8-bit RGBA as files hold it, and linear light as shading needs it.
//!
//! Colour files are written in sRGB: the byte is not proportional to light. Decoding uses the two-part function of
//! IEC 61966-2-1 (c/12.92 up to 0.04045, ((c + 0.055)/1.055)^2.4 above), evaluated in f64 for the 256 bytes and rounded to
//! f32 once. Alpha is never sRGB: byte b is b/255. Float files (OpenEXR, HDR) hold linear light and are encoded on the way
//! in, so that a map always means the same thing.

use std::sync::OnceLock;

use crate::{Error, Image, Texels};

/// A colour map, row-major, row 0 at v near 0.
#[derive(Debug, Clone, PartialEq)]
pub struct ColorMap {
    /// Columns.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// Red, green, blue in sRGB and alpha of every texel.
    pub texels: Vec<[u8; 4]>,
}

impl ColorMap {
    /// Takes an image as colours. Grey is spread, missing alpha is 255, 16 bits are rounded to 8; floats, which are linear
    /// light, are encoded.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for float images outside [0, 1]: a surface reflects at most what it receives.
    pub fn from_image(image: &Image) -> Result<Self, Error> {
        image.require_unit_range("colour map")?;
        let mut encoded;
        let mut source = image;
        if let Texels::Float32(values) = &image.texels {
            encoded = image.clone();
            encoded.texels = Texels::Float32(
                values
                    .iter()
                    .enumerate()
                    .map(|(i, &v)| encode_sample(image, i, v))
                    .collect(),
            );
            source = &encoded;
        }
        Ok(ColorMap {
            width: image.width,
            height: image.height,
            texels: source.to_rgba8(),
        })
    }

    /// A map of one texel.
    #[must_use]
    pub fn constant(rgba: [u8; 4]) -> Self {
        ColorMap {
            width: 1,
            height: 1,
            texels: vec![rgba],
        }
    }

    /// All texels in linear light, alpha as it is.
    #[must_use]
    pub fn to_linear(&self) -> Vec<[f32; 4]> {
        self.texels.iter().map(|&texel| linear(texel)).collect()
    }

    /// A texel in linear light.
    ///
    /// # Panics
    /// When `x` or `y` lies outside; use [`crate::EdgeMode::resolve`] first.
    #[must_use]
    pub fn texel_linear(&self, x: u32, y: u32) -> [f32; 4] {
        assert!(
            x < self.width && y < self.height,
            "texel ({x}, {y}) of {}x{}",
            self.width,
            self.height
        );
        linear(self.texels[y as usize * self.width as usize + x as usize])
    }

    /// Lowest and highest alpha byte: (255, 255) for an opaque map, and for one without texels.
    #[must_use]
    pub fn alpha_range(&self) -> (u8, u8) {
        let alphas = || self.texels.iter().map(|t| t[3]);
        (alphas().min().unwrap_or(255), alphas().max().unwrap_or(255))
    }

    /// Whether no texel lets anything through.
    #[must_use]
    pub fn is_opaque(&self) -> bool {
        self.alpha_range().0 == 255
    }

    /// Whether all texels are the same.
    #[must_use]
    pub fn is_constant(&self) -> bool {
        self.texels.windows(2).all(|pair| pair[0] == pair[1])
    }
}

fn encode_sample(image: &Image, i: usize, v: f32) -> f32 {
    let (_, _, channel) = image.place(i);
    let is_alpha = image.has_alpha() && channel + 1 == image.channels;
    if is_alpha { v } else { srgb_from_linear(v) }
}

/// The light of an sRGB byte, 0 to 1.
#[must_use]
pub fn linear_from_srgb_byte(byte: u8) -> f32 {
    static TABLE: OnceLock<[f32; 256]> = OnceLock::new();
    TABLE.get_or_init(|| std::array::from_fn(|b| linear_from_srgb(b as f64 / 255.0) as f32))
        [usize::from(byte)]
}

/// The light of an sRGB value in [0, 1], in f64.
#[must_use]
pub fn linear_from_srgb(c: f64) -> f64 {
    if c <= 0.04045 {
        c / 12.92
    } else {
        ((c + 0.055) / 1.055).powf(2.4)
    }
}

/// The sRGB value of light in [0, 1]; computed in f64, rounded once.
#[must_use]
pub fn srgb_from_linear(light: f32) -> f32 {
    let c = f64::from(light);
    let encoded = if c <= 0.003_130_8 {
        12.92 * c
    } else {
        1.055 * c.powf(1.0 / 2.4) - 0.055
    };
    encoded as f32
}

fn linear([r, g, b, a]: [u8; 4]) -> [f32; 4] {
    [
        linear_from_srgb_byte(r),
        linear_from_srgb_byte(g),
        linear_from_srgb_byte(b),
        f32::from(a) / 255.0,
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_ends_and_the_middle() {
        assert_eq!(linear_from_srgb_byte(0), 0.0);
        assert_eq!(linear_from_srgb_byte(255), 1.0);
        // 188 is the byte nearest to half the light: its neighbours bracket 0.5.
        assert!(linear_from_srgb_byte(187) < 0.5 && linear_from_srgb_byte(188) > 0.5);
        // The byte on the linear part: 10/255/12.92.
        assert_eq!(linear_from_srgb_byte(10), (10.0 / 255.0 / 12.92) as f32);
    }

    #[test]
    fn bytes_survive_the_way_to_light_and_back() {
        for byte in 0..=255u8 {
            let back = srgb_from_linear(linear_from_srgb_byte(byte)) * 255.0 + 0.5;
            assert_eq!(back as u8, byte);
        }
    }

    #[test]
    fn alpha_is_kept_linear() {
        let map = ColorMap::constant([188, 0, 255, 128]);
        let [r, g, b, a] = map.texel_linear(0, 0);
        assert_eq!((g, b, a), (0.0, 1.0, 128.0 / 255.0));
        assert!(r > 0.5 && r < 0.51);
        assert!(!map.is_opaque() && map.is_constant());
    }

    #[test]
    fn float_colours_are_encoded_and_their_alpha_is_not() {
        let light = linear_from_srgb_byte(100);
        let texels = Texels::Float32(vec![light, light, 1.0, 0.5]);
        let image = Image {
            width: 1,
            height: 1,
            channels: 4,
            texels,
            path: "sky.exr".into(),
        };
        assert_eq!(
            ColorMap::from_image(&image).unwrap().texels,
            [[100, 100, 255, 128]]
        );
        let bright = Image {
            texels: Texels::Float32(vec![0.0, 0.0, 7.5, 1.0]),
            ..image
        };
        let message = ColorMap::from_image(&bright).unwrap_err().to_string();
        assert!(
            message.contains("sky.exr") && message.contains("(0, 0) channel 2 is 7.5"),
            "{message}"
        );
    }
}
