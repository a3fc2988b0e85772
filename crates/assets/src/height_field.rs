//! A height field: one height in [0, 1] a texel, 1 = highest, row-major, row 0 at v near 0.
//!
//! The elevation over the polygon is z(h) = scale·h + bias (see the relief techniques); here there are only heights.
//! Invariants of a field built through the constructors: both sides at least 1, `texels.len() == width * height`, every
//! height finite and in [0, 1].

use crate::{Channel, Error, Image, Texels};

/// Heights on a grid of texels.
#[derive(Debug, Clone, PartialEq)]
pub struct HeightField {
    /// Columns.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// Heights in [0, 1], row by row.
    pub texels: Vec<f32>,
}

impl HeightField {
    /// A field from its heights.
    ///
    /// # Errors
    /// [`Error::TexelCount`] when the list does not fit the sides or a side is zero; [`Error::NonFinite`] or
    /// [`Error::OutOfRange`] naming the first texel that is not in [0, 1].
    pub fn new(width: u32, height: u32, texels: Vec<f32>) -> Result<Self, Error> {
        let expected = width as usize * height as usize;
        if expected == 0 || texels.len() != expected {
            return Err(Error::TexelCount {
                what: "height field",
                width,
                height,
                expected,
                found: texels.len(),
            });
        }
        let image = Image {
            width,
            height,
            channels: 1,
            texels: Texels::Float32(texels),
            path: "height field".into(),
        };
        crate::images::require_finite(&image)?;
        image.require_unit_range("height map")?;
        let Texels::Float32(texels) = image.texels else {
            unreachable!("built as floats five lines above")
        };
        Ok(HeightField {
            width,
            height,
            texels,
        })
    }

    /// The field of a function of column and row. Values are clamped to [0, 1]; NaN becomes 0. A side of 0 becomes 1.
    #[must_use]
    pub fn from_fn(width: u32, height: u32, height_at: impl Fn(u32, u32) -> f32) -> Self {
        let (width, height) = (width.max(1), height.max(1));
        let clamp = |h: f32| if h.is_nan() { 0.0 } else { h.clamp(0.0, 1.0) };
        let texels = (0..height).flat_map(|y| (0..width).map(move |x| (x, y)));
        HeightField {
            width,
            height,
            texels: texels.map(|(x, y)| clamp(height_at(x, y))).collect(),
        }
    }

    /// One channel of an image as heights: bytes b become b/255, 16-bit values v become v/65535, floats must be in [0, 1].
    ///
    /// # Errors
    /// [`Error::MissingChannel`], or [`Error::OutOfRange`] for float images that hold other values (see
    /// [`HeightField::from_image_rescaled`]).
    pub fn from_image(image: &Image, channel: Channel) -> Result<Self, Error> {
        image.require_unit_range("height map")?;
        Ok(HeightField {
            width: image.width,
            height: image.height,
            texels: image.channel(channel)?,
        })
    }

    /// One channel of an image, its lowest value becoming 0 and its highest 1; also answers those two. For float images in
    /// metres. A constant image becomes 0 everywhere.
    ///
    /// # Errors
    /// [`Error::MissingChannel`].
    pub fn from_image_rescaled(image: &Image, channel: Channel) -> Result<(Self, (f32, f32)), Error> {
        let mut field = HeightField {
            width: image.width,
            height: image.height,
            texels: image.channel(channel)?,
        };
        let (low, high) = field.range();
        // In f64, so that high - low of huge floats does not overflow.
        let span = f64::from(high) - f64::from(low);
        let rescale = |h: f32| {
            if span > 0.0 {
                ((f64::from(h) - f64::from(low)) / span) as f32
            } else {
                0.0
            }
        };
        field.texels.iter_mut().for_each(|h| *h = rescale(*h));
        Ok((field, (low, high)))
    }

    /// The height of a texel. Coordinates outside are an error of the caller.
    ///
    /// # Panics
    /// When `x` or `y` lies outside; use [`crate::EdgeMode::resolve`] first.
    #[must_use]
    pub fn texel(&self, x: u32, y: u32) -> f32 {
        assert!(
            x < self.width && y < self.height,
            "texel ({x}, {y}) of {}x{}",
            self.width,
            self.height
        );
        self.texels[y as usize * self.width as usize + x as usize]
    }

    /// Lowest and highest height.
    #[must_use]
    pub fn range(&self) -> (f32, f32) {
        let widen = |(low, high): (f32, f32), &h: &f32| (low.min(h), high.max(h));
        let (low, high) = self.texels.iter().fold((f32::INFINITY, f32::NEG_INFINITY), widen);
        if low <= high { (low, high) } else { (0.0, 0.0) }
    }

    /// Whether every texel has the same height, so that there is no relief.
    #[must_use]
    pub fn is_flat(&self) -> bool {
        let (low, high) = self.range();
        low == high
    }

    /// The heights as 8-bit values, rounded to the nearest: `trunc(h·255 + 0.5)`. Exact for fields from 8-bit images.
    #[must_use]
    pub fn to_bytes(&self) -> Vec<u8> {
        self.texels.iter().map(|&h| height_byte(h)).collect()
    }

    /// The heights as codes of 16 bits, rounded up: the least code c whose value, c/65535 in f32, is not below. So maxima stay
    /// maxima, and heights of 8- and 16-bit images are kept as they are.
    #[must_use]
    pub fn to_unorm16_up(&self) -> Vec<u16> {
        self.texels.iter().map(|&h| height_code_up(h)).collect()
    }
}

/// A height as a code of 16 bits that is not below it.
fn height_code_up(h: f32) -> u16 {
    let nearest = (h * 65535.0 + 0.5) as u16;
    if f32::from(nearest) / 65535.0 < h {
        nearest.saturating_add(1)
    } else {
        nearest
    }
}

/// A height as a byte. Operation order, the same in the shaders: multiply by 255, add 0.5, convert by truncation.
#[inline]
#[must_use]
pub fn height_byte(h: f32) -> u8 {
    (h * 255.0 + 0.5) as u8
}
