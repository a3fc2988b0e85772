//! Pictures out, as PNG bytes in memory: 8-bit RGBA and 16-bit grey. Writing files is left to the caller, who knows how to
//! do it without leaving half of one behind.

use ::image::codecs::png::{CompressionType, FilterType, PngEncoder};
use ::image::{ExtendedColorType, ImageEncoder};

use crate::{ColorMap, Error, HeightField, NormalMap};

/// A colour map as PNG.
///
/// # Errors
/// [`Error::TexelCount`] or [`Error::Encode`].
pub fn color_png(map: &ColorMap) -> Result<Vec<u8>, Error> {
    rgba8_png(map.width, map.height, &map.texels)
}

/// A normal map as PNG.
///
/// # Errors
/// [`Error::TexelCount`] or [`Error::Encode`].
pub fn normal_png(map: &NormalMap) -> Result<Vec<u8>, Error> {
    rgba8_png(map.width, map.height, &map.texels)
}

/// A height field as 16-bit grey PNG, each height rounded to the nearest of the 65536 values.
///
/// # Errors
/// [`Error::TexelCount`] or [`Error::Encode`].
pub fn height_png(field: &HeightField) -> Result<Vec<u8>, Error> {
    check_count("height map", field.width, field.height, field.texels.len())?;
    // The encoder takes native-endian samples.
    let bytes: Vec<u8> = field
        .texels
        .iter()
        .flat_map(|&h| ((h * 65535.0 + 0.5) as u16).to_ne_bytes())
        .collect();
    png(field.width, field.height, &bytes, ExtendedColorType::L16)
}

/// RGBA bytes as PNG; opaque pictures are written without their alpha.
///
/// # Errors
/// [`Error::TexelCount`] or [`Error::Encode`].
pub fn rgba8_png(width: u32, height: u32, texels: &[[u8; 4]]) -> Result<Vec<u8>, Error> {
    check_count("picture", width, height, texels.len())?;
    if texels.iter().all(|t| t[3] == 255) {
        let rgb: Vec<u8> = texels.iter().flat_map(|t| [t[0], t[1], t[2]]).collect();
        return png(width, height, &rgb, ExtendedColorType::Rgb8);
    }
    png(
        width,
        height,
        bytemuck::cast_slice(texels),
        ExtendedColorType::Rgba8,
    )
}

fn check_count(what: &'static str, width: u32, height: u32, found: usize) -> Result<(), Error> {
    let expected = width as usize * height as usize;
    if expected == 0 || expected != found {
        return Err(Error::TexelCount {
            what,
            width,
            height,
            expected,
            found,
        });
    }
    Ok(())
}

fn png(width: u32, height: u32, samples: &[u8], color: ExtendedColorType) -> Result<Vec<u8>, Error> {
    let mut bytes = Vec::new();
    PngEncoder::new_with_quality(&mut bytes, CompressionType::Best, FilterType::Adaptive)
        .write_image(samples, width, height, color)
        .map_err(|source| Error::Encode {
            width,
            height,
            source,
        })?;
    Ok(bytes)
}
