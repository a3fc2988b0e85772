//! Floats of one channel, as terrain and sculpting tools write heights: TIFF and OpenEXR files that the image crate, which
//! knows floats by three and by four only, does not read. Their own decoders do.

use std::io::Cursor;
use std::path::Path;

use ::image::error::{DecodingError, ImageFormatHint};
use ::image::{ImageError, ImageFormat};
use exr::prelude::{ReadChannels, ReadLayers};
use tiff::decoder::{Decoder, DecodingResult, Limits};
use tiff::tags::{SampleFormat, Tag};

use super::{Image, MAX_DECODED_BYTES, Texels, check_sides, failed};
use crate::Error;

/// The image, if the file holds floats of one channel.
pub(super) fn decode(path: &Path, bytes: &[u8], format: ImageFormat) -> Result<Option<Image>, Error> {
    match format {
        ImageFormat::Tiff => tiff(path, bytes),
        ImageFormat::OpenExr => exr(path, bytes),
        _ => Ok(None),
    }
}

fn image(path: &Path, [width, height]: [u32; 2], values: Vec<f32>) -> Image {
    Image {
        width,
        height,
        channels: 1,
        texels: Texels::Float32(values),
        path: path.into(),
    }
}

fn refused<E>(path: &Path, format: ImageFormat, source: E) -> Error
where
    E: Into<Box<dyn std::error::Error + Send + Sync>>,
{
    let hint = ImageFormatHint::Exact(format);
    failed(
        path,
        format,
        ImageError::Decoding(DecodingError::new(hint, source)),
    )
}

/// 16, 32 and 64 bits; the last are rounded to the nearest of 32.
fn tiff(path: &Path, bytes: &[u8]) -> Result<Option<Image>, Error> {
    // What cannot be opened here is told by the decoder of all other kinds.
    let Ok(mut decoder) = Decoder::new(Cursor::new(bytes)) else {
        return Ok(None);
    };
    let Some(bytes_a_texel) = grey_float_bytes(&mut decoder) else {
        return Ok(None);
    };
    let refuse = |source| refused(path, ImageFormat::Tiff, source);
    let (width, height) = decoder.dimensions().map_err(refuse)?;
    check_sides(
        path,
        width,
        height,
        bytes_a_texel * u64::from(width) * u64::from(height),
    )?;
    let mut limits = Limits::default();
    limits.decoding_buffer_size = MAX_DECODED_BYTES as usize;
    let values = match decoder.with_limits(limits).read_image().map_err(refuse)? {
        DecodingResult::F16(values) => values.into_iter().map(f32::from).collect(),
        DecodingResult::F32(values) => values,
        DecodingResult::F64(values) => values.into_iter().map(|value| value as f32).collect(),
        _ => return Ok(None),
    };
    Ok(Some(image(path, [width, height], values)))
}

/// How many bytes a texel takes, where it is one float.
fn grey_float_bytes(decoder: &mut Decoder<Cursor<&[u8]>>) -> Option<u64> {
    let tiff::ColorType::Gray(bits) = decoder.colortype().ok()? else {
        return None;
    };
    let kinds = decoder.find_tag_unsigned_vec::<u16>(Tag::SampleFormat).ok()??;
    let floats = kinds.iter().all(|&kind| kind == SampleFormat::IEEEFP.to_u16());
    floats.then_some(u64::from(bits) / 8)
}

/// The one channel of a file, whatever its name, at its largest level, on the display window as everything is.
fn exr(path: &Path, bytes: &[u8]) -> Result<Option<Image>, Error> {
    let Ok(meta) = exr::meta::MetaData::read_from_buffered(Cursor::new(bytes), false) else {
        return Ok(None);
    };
    let [header] = meta.headers.as_slice() else {
        return Ok(None);
    };
    if header.deep || header.channels.list.len() != 1 {
        return Ok(None);
    }
    let window = header.shared_attributes.display_window;
    let [width, height] =
        [window.size.width(), window.size.height()].map(|side| u32::try_from(side).unwrap_or(u32::MAX));
    check_sides(path, width, height, 4 * u64::from(width) * u64::from(height))?;
    let (columns, rows) = (header.layer_size.width(), header.layer_size.height());
    check_sides(
        path,
        columns as u32,
        rows as u32,
        4 * columns as u64 * rows as u64,
    )?;
    let read = exr::prelude::read().no_deep_data().largest_resolution_level();
    let read = read.all_channels().first_valid_layer().all_attributes();
    let refuse = |source| refused(path, ImageFormat::OpenExr, source);
    let layer = read.from_buffered(Cursor::new(bytes)).map_err(refuse)?.layer_data;
    let Some(channel) = layer.channel_data.list.first() else {
        return Ok(None);
    };
    let mut values = vec![0.0; width as usize * height as usize];
    let corner = layer.attributes.layer_position - window.position;
    for (at, value) in channel.sample_data.values_as_f32().enumerate() {
        let x = corner.x() + (at % columns) as i32;
        let y = corner.y() + (at / columns) as i32;
        if let (Ok(x), Ok(y)) = (u32::try_from(x), u32::try_from(y))
            && x < width
            && y < height
        {
            values[y as usize * width as usize + x as usize] = value;
        }
    }
    Ok(Some(image(path, [width, height], values)))
}
