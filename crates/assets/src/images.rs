//! Image files in: PNG (8 and 16 bit), JPEG, TGA, BMP, TIFF, OpenEXR and Radiance HDR, at the precision they hold (floats of 64 bits
//! become 32).
//!
//! Invariants of an [`Image`] from [`load_image`]: both sides in `1..=MAX_SIDE`; `texels` holds
//! `width * height * channels` values; float values are finite. Row 0 is the first row of the file, which lies at
//! v near 0 everywhere in this project. Samples are handed on as stored: no colour space is applied here
//! (see [`crate::ColorMap`] for that).
//!
//! The header is read, and the limits checked, before any texel is decoded: a file of 100 bytes that claims
//! 60000x60000 texels costs nothing.

use std::fmt;
use std::path::{Path, PathBuf};

use ::image::{ColorType, DynamicImage, ImageDecoder, ImageFormat, ImageReader, Limits};

use crate::Error;

mod grey_float;

/// Longest side of an image that is read, in texels: what WebGPU devices with raised limits hold as a texture.
pub const MAX_SIDE: u32 = 16_384;

/// Most bytes that one image may take when decoded: 1 GiB, which is `MAX_SIDE` squared at 8-bit RGBA.
pub const MAX_DECODED_BYTES: u64 = 1 << 30;

/// The samples of an image at the precision of its file, row by row, the channels of a texel side by side.
#[derive(Debug, Clone, PartialEq)]
pub enum Texels {
    /// 8 bits a sample: byte b stands for b/255.
    Unorm8(Vec<u8>),
    /// 16 bits a sample: v stands for v/65535.
    Unorm16(Vec<u16>),
    /// Floats, finite.
    Float32(Vec<f32>),
}

impl Texels {
    /// How many samples there are.
    #[must_use]
    pub fn len(&self) -> usize {
        match self {
            Texels::Unorm8(v) => v.len(),
            Texels::Unorm16(v) => v.len(),
            Texels::Float32(v) => v.len(),
        }
    }

    /// Whether there are none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Sample `i` as a float: integers divided by their maximum, floats as they are.
    #[must_use]
    pub fn sample(&self, i: usize) -> f32 {
        match self {
            Texels::Unorm8(v) => f32::from(v[i]) / 255.0,
            Texels::Unorm16(v) => f32::from(v[i]) / 65535.0,
            Texels::Float32(v) => v[i],
        }
    }
}

/// A decoded image file.
#[derive(Debug, Clone, PartialEq)]
pub struct Image {
    /// Columns.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// 1 grey, 2 grey and alpha, 3 red green blue, 4 with alpha.
    pub channels: u8,
    /// The samples.
    pub texels: Texels,
    /// Where it came from, for messages. Images made by code may say anything here.
    pub path: PathBuf,
}

/// One number out of a texel.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum Channel {
    /// Red; the grey value of a grey image.
    #[default]
    Red,
    /// Green; the grey value of a grey image.
    Green,
    /// Blue; the grey value of a grey image.
    Blue,
    /// Alpha; an error for images that have none.
    Alpha,
    /// 0.2126 R + 0.7152 G + 0.0722 B (the weights of Rec. 709) of the samples as stored; the grey value of a grey image.
    Luminance,
}

impl Channel {
    /// The word used in scene files and on the command line.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Channel::Red => "red",
            Channel::Green => "green",
            Channel::Blue => "blue",
            Channel::Alpha => "alpha",
            Channel::Luminance => "luminance",
        }
    }
}

impl fmt::Display for Channel {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

impl Image {
    /// Whether there is an alpha channel.
    #[must_use]
    pub fn has_alpha(&self) -> bool {
        matches!(self.channels, 2 | 4)
    }

    /// `width * height`.
    #[must_use]
    pub fn texel_count(&self) -> usize {
        self.width as usize * self.height as usize
    }

    /// Column, row and channel of sample `i`.
    pub(crate) fn place(&self, i: usize) -> (u32, u32, u8) {
        let channels = usize::from(self.channels).max(1);
        let (texel, width) = (i / channels, (self.width as usize).max(1));
        (
            (texel % width) as u32,
            (texel / width) as u32,
            (i % channels) as u8,
        )
    }

    /// One channel of every texel as floats, row by row. Integers become 0 to 1, floats stay as they are.
    ///
    /// # Errors
    /// [`Error::MissingChannel`] for alpha of an image without alpha.
    pub fn channel(&self, channel: Channel) -> Result<Vec<f32>, Error> {
        let stride = usize::from(self.channels);
        let grey = stride <= 2;
        let at = match channel {
            Channel::Alpha if !self.has_alpha() => {
                return Err(Error::MissingChannel {
                    path: self.path.clone(),
                    channel,
                    channels: self.channels,
                });
            }
            Channel::Alpha => stride - 1,
            Channel::Red => 0,
            Channel::Green => usize::from(!grey),
            Channel::Blue => 2 * usize::from(!grey),
            Channel::Luminance if grey => 0,
            Channel::Luminance => return Ok(self.luminance(stride)),
        };
        Ok((0..self.texel_count())
            .map(|i| self.texels.sample(i * stride + at))
            .collect())
    }

    fn luminance(&self, stride: usize) -> Vec<f32> {
        let sample = |i: usize| self.texels.sample(i);
        let weigh = |i: usize| 0.2126 * sample(i) + 0.7152 * sample(i + 1) + 0.0722 * sample(i + 2);
        (0..self.texel_count()).map(|i| weigh(i * stride)).collect()
    }

    /// The first sample outside 0 to 1, as the error that a `usage` makes of it.
    pub(crate) fn require_unit_range(&self, usage: &'static str) -> Result<(), Error> {
        let Texels::Float32(values) = &self.texels else {
            return Ok(());
        };
        let Some(i) = values.iter().position(|v| !(0.0..=1.0).contains(v)) else {
            return Ok(());
        };
        let (x, y, channel) = self.place(i);
        Err(Error::OutOfRange {
            path: self.path.clone(),
            x,
            y,
            channel,
            value: values[i],
            usage,
        })
    }

    /// The image as 8-bit RGBA: grey is spread over red, green and blue, missing alpha is 255, 16 bits and floats are
    /// rounded to the nearest of the 256 values.
    pub(crate) fn to_rgba8(&self) -> Vec<[u8; 4]> {
        let stride = usize::from(self.channels);
        let byte = |i: usize| self.byte(i);
        (0..self.texel_count())
            .map(|t| t * stride)
            .map(|i| match stride {
                1 => [byte(i), byte(i), byte(i), 255],
                2 => [byte(i), byte(i), byte(i), byte(i + 1)],
                3 => [byte(i), byte(i + 1), byte(i + 2), 255],
                _ => [byte(i), byte(i + 1), byte(i + 2), byte(i + 3)],
            })
            .collect()
    }

    /// Sample `i` as the nearest of the 256 values.
    pub(crate) fn byte(&self, i: usize) -> u8 {
        match &self.texels {
            Texels::Unorm8(v) => v[i],
            // Round to nearest of v·255/65535 = v/257; ties cannot occur, 257 being odd.
            Texels::Unorm16(v) => ((u32::from(v[i]) + 128) / 257) as u8,
            Texels::Float32(v) => (v[i].clamp(0.0, 1.0) * 255.0 + 0.5) as u8,
        }
    }
}

/// Reads an image file.
///
/// The format is told by the file's first bytes, else by its extension (TGA has no signature).
///
/// # Errors
/// A missing, empty, truncated, damaged, zero-sized, too large or non-finite file, each by its own variant of [`Error`],
/// with the path.
pub fn load_image(path: &Path) -> Result<Image, Error> {
    let bytes = read(path)?;
    decode(path, &bytes)
}

fn read(path: &Path) -> Result<Vec<u8>, Error> {
    let bytes = std::fs::read(path).map_err(|source| Error::Read {
        path: path.into(),
        source,
    })?;
    if bytes.is_empty() {
        return Err(Error::EmptyFile { path: path.into() });
    }
    Ok(bytes)
}

/// Decodes the bytes of an image file; `path` serves for messages and, for TGA, the extension.
///
/// # Errors
/// As [`load_image`], but for reading.
pub fn decode(path: &Path, bytes: &[u8]) -> Result<Image, Error> {
    let format = format_of(path, bytes).ok_or_else(|| Error::UnknownFormat { path: path.into() })?;
    if let Some((width, height)) = sides_in_header(format, bytes) {
        check_sides(path, width, height, 0)?;
    }
    if let Some(image) = grey_float::decode(path, bytes, format)? {
        require_finite(&image)?;
        return Ok(image);
    }
    let failed = |source| failed(path, format, source);
    let mut reader = ImageReader::with_format(std::io::Cursor::new(bytes), format);
    reader.limits(limits());
    let decoder = reader.into_decoder().map_err(failed)?;
    let (width, height) = decoder.dimensions();
    check_sides(path, width, height, decoder.total_bytes())?;
    let decoded = DynamicImage::from_decoder(decoder).map_err(failed)?;
    let image = into_image(path, decoded);
    require_finite(&image)?;
    Ok(image)
}

fn failed(path: &Path, format: ImageFormat, source: ::image::ImageError) -> Error {
    Error::Decode {
        path: path.into(),
        format: format!("{format:?}").to_uppercase(),
        source,
    }
}

fn format_of(path: &Path, bytes: &[u8]) -> Option<ImageFormat> {
    ::image::guess_format(bytes)
        .ok()
        .or_else(|| ImageFormat::from_path(path).ok())
        .filter(|format| format.reading_enabled())
}

/// Width and height where the format keeps them at a fixed place, so that a zero is reported as such and not as a
/// decoder's complaint.
fn sides_in_header(format: ImageFormat, bytes: &[u8]) -> Option<(u32, u32)> {
    let be32 = |at: usize| Some(u32::from_be_bytes(bytes.get(at..at + 4)?.try_into().ok()?));
    let le16 = |at: usize| {
        Some(u32::from(u16::from_le_bytes(
            bytes.get(at..at + 2)?.try_into().ok()?,
        )))
    };
    let le32 = |at: usize| Some(i32::from_le_bytes(bytes.get(at..at + 4)?.try_into().ok()?).unsigned_abs());
    match format {
        ImageFormat::Png => Some((be32(16)?, be32(20)?)),
        ImageFormat::Tga => Some((le16(12)?, le16(14)?)),
        ImageFormat::Bmp => Some((le32(18)?, le32(22)?)),
        _ => None,
    }
}

fn check_sides(path: &Path, width: u32, height: u32, bytes: u64) -> Result<(), Error> {
    let path = || path.to_path_buf();
    if width == 0 || height == 0 {
        return Err(Error::ZeroSized {
            path: path(),
            width,
            height,
        });
    }
    if width > MAX_SIDE || height > MAX_SIDE || bytes > MAX_DECODED_BYTES {
        let bytes = bytes.max(u64::from(width) * u64::from(height));
        return Err(Error::TooLarge {
            path: path(),
            width,
            height,
            bytes,
        });
    }
    Ok(())
}

fn limits() -> Limits {
    let mut limits = Limits::default();
    limits.max_image_width = None;
    limits.max_image_height = None;
    // The decoders' own working memory comes on top of the picture.
    limits.max_alloc = Some(2 * MAX_DECODED_BYTES);
    limits
}

fn into_image(path: &Path, decoded: DynamicImage) -> Image {
    let (width, height) = (decoded.width(), decoded.height());
    let color = decoded.color();
    let channels = color.channel_count();
    let texels = match color {
        ColorType::L8 | ColorType::La8 | ColorType::Rgb8 | ColorType::Rgba8 => {
            Texels::Unorm8(decoded.into_bytes())
        }
        ColorType::L16 | ColorType::La16 | ColorType::Rgb16 | ColorType::Rgba16 => {
            Texels::Unorm16(samples16(decoded))
        }
        _ if channels == 3 => Texels::Float32(decoded.into_rgb32f().into_raw()),
        _ => Texels::Float32(decoded.into_rgba32f().into_raw()),
    };
    let channels = u8::try_from(texels.len() / (width as usize * height as usize)).unwrap_or(channels);
    Image {
        width,
        height,
        channels,
        texels,
        path: path.into(),
    }
}

fn samples16(decoded: DynamicImage) -> Vec<u16> {
    match decoded {
        DynamicImage::ImageLuma16(b) => b.into_raw(),
        DynamicImage::ImageLumaA16(b) => b.into_raw(),
        DynamicImage::ImageRgb16(b) => b.into_raw(),
        other => other.into_rgba16().into_raw(),
    }
}

pub(crate) fn require_finite(image: &Image) -> Result<(), Error> {
    let Texels::Float32(values) = &image.texels else {
        return Ok(());
    };
    let Some(i) = values.iter().position(|v| !v.is_finite()) else {
        return Ok(());
    };
    let (x, y, channel) = image.place(i);
    Err(Error::NonFinite {
        path: image.path.clone(),
        x,
        y,
        channel,
        value: values[i],
    })
}
