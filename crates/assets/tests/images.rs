//! Image files in: what is read, and what each kind of bad file is told.

use std::path::{Path, PathBuf};

use bossage_assets::{
    Channel, ColorMap, Error, HeightField, Image, MAX_SIDE, NormalCodec, NormalMap, Texels, decode, encode,
    load_image,
};
use image::{DynamicImage, ImageFormat};

fn encoded(image: DynamicImage, format: ImageFormat) -> Vec<u8> {
    let mut bytes = std::io::Cursor::new(Vec::new());
    image.write_to(&mut bytes, format).unwrap();
    bytes.into_inner()
}

fn grey16(width: u32, height: u32, value: impl Fn(u32, u32) -> u16) -> DynamicImage {
    image::ImageBuffer::from_fn(width, height, |x, y| image::Luma([value(x, y)])).into()
}

fn rgba8(width: u32, height: u32) -> DynamicImage {
    image::RgbaImage::from_fn(width, height, |x, y| image::Rgba([x as u8, y as u8, 7, 200])).into()
}

fn rgb_float(values: [f32; 3]) -> Vec<u8> {
    let mut picture = image::Rgb32FImage::from_pixel(3, 2, image::Rgb([0.25, 0.5, 0.75]));
    picture.put_pixel(2, 1, image::Rgb(values));
    encoded(picture.into(), ImageFormat::OpenExr)
}

/// Greys of 3×2 texels: i / 8 but for one.
fn greys(value: f32) -> [f32; 6] {
    [0.0, 0.125, 0.25, 0.375, 0.5, value]
}

fn grey_tiff<C: tiff::encoder::colortype::ColorType>(values: &[C::Inner]) -> Vec<u8>
where
    [C::Inner]: tiff::encoder::TiffValue,
{
    let mut bytes = std::io::Cursor::new(Vec::new());
    let mut encoder = tiff::encoder::TiffEncoder::new(&mut bytes).unwrap();
    encoder.write_image::<C>(3, 2, values).unwrap();
    bytes.into_inner()
}

/// One channel on a display window of 3×2 texels.
fn grey_exr(
    name: &str,
    samples: exr::prelude::FlatSamples,
    size: (usize, usize),
    corner: (i32, i32),
) -> Vec<u8> {
    use exr::prelude::*;
    let channels = AnyChannels::sort([AnyChannel::new(name, samples)].into_iter().collect());
    let mut layer = Layer::new(
        size,
        LayerAttributes::named("heights"),
        Encoding::FAST_LOSSLESS,
        channels,
    );
    layer.attributes.layer_position = Vec2::from(corner);
    let window = IntegerBounds::from_dimensions((3, 2));
    let picture = Image::empty(ImageAttributes::new(window)).with_layer(layer);
    let mut bytes = std::io::Cursor::new(Vec::new());
    picture.write().to_buffered(&mut bytes).unwrap();
    bytes.into_inner()
}

fn examples() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples/textures")
}

fn message(error: &Error) -> String {
    let mut text = error.to_string();
    let mut source = std::error::Error::source(error);
    while let Some(inner) = source {
        text += &format!(": {inner}");
        source = inner.source();
    }
    text
}

#[test]
fn sixteen_bits_are_kept() {
    let bytes = encoded(grey16(3, 2, |x, y| (x * 1000 + y) as u16), ImageFormat::Png);
    let image = decode(Path::new("h.png"), &bytes).unwrap();
    assert_eq!((image.width, image.height, image.channels), (3, 2, 1));
    assert_eq!(image.texels, Texels::Unorm16(vec![0, 1000, 2000, 1, 1001, 2001]));
    let field = HeightField::from_image(&image, Channel::Red).unwrap();
    assert_eq!(field.texel(2, 1), 2001.0 / 65535.0);
}

#[test]
fn every_format_is_read() {
    let lossless = [
        ImageFormat::Png,
        ImageFormat::Tga,
        ImageFormat::Bmp,
        ImageFormat::Tiff,
    ];
    for format in lossless {
        let name = format!("picture.{}", format.extensions_str()[0]);
        let image = decode(Path::new(&name), &encoded(rgba8(5, 4), format)).unwrap();
        assert_eq!(
            (image.width, image.height, image.channels),
            (5, 4, 4),
            "{format:?}"
        );
        let alpha = image.channel(Channel::Alpha).unwrap();
        assert!(alpha.iter().all(|&a| a == 200.0 / 255.0), "{format:?}");
        let green = image.channel(Channel::Green).unwrap();
        assert_eq!(green[15], 3.0 / 255.0, "{format:?}: row 3 comes fourth");
    }
    let rgb = DynamicImage::from(rgba8(8, 8).into_rgb8());
    let jpeg = decode(Path::new("p.jpg"), &encoded(rgb, ImageFormat::Jpeg)).unwrap();
    assert_eq!((jpeg.width, jpeg.channels), (8, 3));
    for format in [ImageFormat::Hdr, ImageFormat::OpenExr] {
        let picture = image::Rgb32FImage::from_pixel(4, 4, image::Rgb([0.5, 0.25, 1.0]));
        let image = decode(Path::new("p"), &encoded(picture.into(), format)).unwrap();
        // Powers of two are exact in both formats.
        assert!(
            matches!(&image.texels, Texels::Float32(v) if v[..3] == [0.5, 0.25, 1.0]),
            "{format:?}"
        );
    }
}

#[test]
fn what_we_write_we_read_back() {
    let field = HeightField::from_fn(7, 5, |x, y| (x * 5 + y) as f32 / 65535.0);
    let image = decode(Path::new("h.png"), &encode::height_png(&field).unwrap()).unwrap();
    assert_eq!(HeightField::from_image(&image, Channel::Red).unwrap(), field);
    let map = ColorMap {
        width: 2,
        height: 1,
        texels: vec![[1, 2, 3, 4], [5, 6, 7, 255]],
    };
    let image = decode(Path::new("c.png"), &encode::color_png(&map).unwrap()).unwrap();
    assert_eq!(ColorMap::from_image(&image).unwrap(), map);
    let opaque = ColorMap::constant([9, 8, 7, 255]);
    let image = decode(Path::new("o.png"), &encode::color_png(&opaque).unwrap()).unwrap();
    assert_eq!(
        (image.channels, ColorMap::from_image(&image).unwrap()),
        (3, opaque)
    );
}

#[test]
fn a_missing_file_is_named_and_the_reason_kept() {
    let error = load_image(Path::new("no/such/wall.png")).unwrap_err();
    assert!(matches!(error, Error::Read { .. }));
    let text = message(&error);
    assert!(
        text.contains("no/such/wall.png") && text.contains("No such file"),
        "{text}"
    );
}

#[test]
fn an_empty_file_is_said_to_be_empty() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("empty.png");
    std::fs::write(&path, b"").unwrap();
    assert!(matches!(load_image(&path), Err(Error::EmptyFile { path: p }) if p == path));
}

#[test]
fn a_truncated_file_is_refused_wherever_it_ends() {
    for (format, name) in [
        (ImageFormat::Png, "a.png"),
        (ImageFormat::Bmp, "a.bmp"),
        (ImageFormat::Tga, "a.tga"),
    ] {
        let whole = encoded(rgba8(64, 64), format);
        assert!(
            decode(Path::new(name), &whole).is_ok(),
            "the control: {name} whole"
        );
        // TGA and PNG may end in bytes that carry no texels; up to half there is surely something missing.
        for end in (1..whole.len() / 2).step_by(7) {
            let error = decode(Path::new(name), &whole[..end]).unwrap_err();
            assert!(
                matches!(error, Error::Decode { .. } | Error::ZeroSized { .. }),
                "{name} cut at {end}: {error}"
            );
            assert!(error.to_string().contains(name));
        }
    }
}

#[test]
fn text_is_not_an_image_whatever_its_name() {
    let text = b"height = 4\n".as_slice();
    assert!(matches!(
        decode(Path::new("a.txt"), text),
        Err(Error::UnknownFormat { .. })
    ));
    assert!(matches!(
        decode(Path::new("a.png"), text),
        Err(Error::Decode { .. })
    ));
    // A format that exists, but that this build does not read.
    let message = decode(Path::new("a.webp"), b"RIFF\x10\0\0\0WEBPVP8 \0\0\0\0")
        .unwrap_err()
        .to_string();
    assert!(message.contains("use PNG, JPEG"), "{message}");
}

#[test]
fn a_wrong_extension_does_no_harm() {
    let bytes = encoded(rgba8(4, 4), ImageFormat::Png);
    assert!(decode(Path::new("really_a.jpg"), &bytes).is_ok());
}

/// A PNG header that claims a size, correct down to its checksum, and nothing after it.
fn png_header(width: u32, height: u32) -> Vec<u8> {
    let mut chunk = b"IHDR".to_vec();
    chunk.extend(width.to_be_bytes());
    chunk.extend(height.to_be_bytes());
    chunk.extend([8, 6, 0, 0, 0]);
    let crc = chunk.iter().fold(!0u32, |crc, &byte| {
        (0..8).fold(crc ^ u32::from(byte), |c, _| {
            if c & 1 == 1 {
                (c >> 1) ^ 0xedb8_8320
            } else {
                c >> 1
            }
        })
    });
    let mut bytes = b"\x89PNG\r\n\x1a\n\0\0\0\x0d".to_vec();
    bytes.extend(chunk);
    bytes.extend((!crc).to_be_bytes());
    bytes
}

#[test]
fn zero_sized_images_are_named_as_such() {
    for (width, height) in [(0, 4), (4, 0)] {
        let error = decode(Path::new("z.png"), &png_header(width, height)).unwrap_err();
        assert!(matches!(error, Error::ZeroSized { width: w, height: h, .. } if (w, h) == (width, height)));
    }
    let mut tga = encoded(rgba8(4, 4), ImageFormat::Tga);
    tga[12] = 0;
    assert!(matches!(
        decode(Path::new("z.tga"), &tga),
        Err(Error::ZeroSized { .. })
    ));
    let mut bmp = encoded(rgba8(4, 4), ImageFormat::Bmp);
    bmp[22] = 0;
    assert!(matches!(
        decode(Path::new("z.bmp"), &bmp),
        Err(Error::ZeroSized { .. })
    ));
}

#[test]
fn huge_images_are_refused_from_the_header_and_the_limit_is_stated() {
    for (width, height) in [
        (60_000, 60_000),
        (MAX_SIDE + 1, 1),
        (u32::MAX >> 1, u32::MAX >> 1),
    ] {
        let error = decode(Path::new("huge.png"), &png_header(width, height)).unwrap_err();
        assert!(matches!(error, Error::TooLarge { .. }), "{error}");
        let text = error.to_string();
        assert!(
            text.contains("16384") && text.contains(&width.to_string()),
            "{text}"
        );
    }
    // The control: the largest allowed header is not refused for its size.
    let error = decode(Path::new("big.png"), &png_header(MAX_SIDE, 1)).unwrap_err();
    assert!(matches!(error, Error::Decode { .. }), "{error}");
}

#[test]
fn sixteen_bit_colour_at_the_longest_side_is_beyond_the_byte_limit() {
    let mut header = png_header(MAX_SIDE, MAX_SIDE);
    header[24] = 16;
    let crc = header[12..29].iter().fold(!0u32, |crc, &byte| {
        (0..8).fold(crc ^ u32::from(byte), |c, _| {
            if c & 1 == 1 {
                (c >> 1) ^ 0xedb8_8320
            } else {
                c >> 1
            }
        })
    });
    header[29..33].copy_from_slice(&(!crc).to_be_bytes());
    // The decoder must see the start of picture data before it knows the size of a texel.
    header.extend(b"\0\0\0\0IDAT\x35\xaf\x06\x1e");
    let error = decode(Path::new("deep.png"), &header).unwrap_err();
    assert!(
        matches!(error, Error::TooLarge { bytes, .. } if bytes == 1 << 31),
        "{error}"
    );
}

#[test]
fn the_first_bad_float_is_named_with_its_texel() {
    for bad in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
        let error = decode(Path::new("sky.exr"), &rgb_float([0.0, bad, 0.0])).unwrap_err();
        let Error::NonFinite { x, y, channel, .. } = error else {
            panic!("{error}")
        };
        assert_eq!((x, y, channel), (2, 1, 1));
    }
    assert!(
        decode(Path::new("sky.exr"), &rgb_float([0.0, 9.0, -1.0])).is_ok(),
        "finite is fine as an image"
    );
}

#[test]
fn one_channel_of_floats_is_read_as_it_is() {
    use exr::prelude::{FlatSamples, f16};
    use tiff::encoder::colortype::{Gray32Float, Gray64Float};
    let values = greys(0.1);
    let halves = values.map(f16::from_f32).to_vec();
    let files = [
        ("dem.tif", grey_tiff::<Gray32Float>(&values)),
        (
            "dem.tif",
            grey_tiff::<Gray64Float>(&[0.0, 0.125, 0.25, 0.375, 0.5, 0.1]),
        ),
        (
            "dem.exr",
            grey_exr("Y", FlatSamples::F32(values.to_vec()), (3, 2), (0, 0)),
        ),
        (
            "dem.exr",
            grey_exr("height", FlatSamples::F32(values.to_vec()), (3, 2), (0, 0)),
        ),
        ("dem.exr", grey_exr("Z", FlatSamples::F16(halves), (3, 2), (0, 0))),
    ];
    for (at, (name, bytes)) in files.iter().enumerate() {
        let image = decode(Path::new(name), bytes).unwrap();
        assert_eq!((image.width, image.height, image.channels), (3, 2, 1), "{at}");
        let last = if at == 4 { f16::from_f32(0.1).to_f32() } else { 0.1 };
        assert_eq!(image.texels, Texels::Float32(greys(last).to_vec()), "{at}");
        assert!(HeightField::from_image(&image, Channel::Red).is_ok());
    }
}

#[test]
fn a_part_of_the_display_window_lies_where_it_says() {
    let part = exr::prelude::FlatSamples::F32(vec![0.5, 0.75]);
    let image = decode(Path::new("part.exr"), &grey_exr("Y", part, (1, 2), (2, -1))).unwrap();
    // The row above the window is lost, as a viewer loses it.
    assert_eq!(image.texels, Texels::Float32(vec![0.0, 0.0, 0.75, 0.0, 0.0, 0.0]));
}

#[test]
fn bad_files_of_one_channel_are_told_as_others_are() {
    use tiff::encoder::colortype::{Gray32, Gray32Float};
    let bad = grey_tiff::<Gray32Float>(&greys(f32::NAN));
    let error = decode(Path::new("dem.tif"), &bad).unwrap_err();
    assert!(
        matches!(
            error,
            Error::NonFinite {
                x: 2,
                y: 1,
                channel: 0,
                ..
            }
        ),
        "{error}"
    );
    let good = grey_tiff::<Gray32Float>(&greys(0.5));
    let samples = exr::prelude::FlatSamples::F32(greys(0.5).to_vec());
    for (name, bytes) in [
        ("cut.tif", good),
        ("cut.exr", grey_exr("Y", samples, (3, 2), (0, 0))),
    ] {
        for length in 8..bytes.len() {
            // Some bytes at the end are padding; whatever is cut, there is an answer and no panic.
            if let Err(error) = decode(Path::new(name), &bytes[..length]) {
                assert!(message(&error).contains(name), "{error}");
            }
        }
        assert!(decode(Path::new(name), &bytes[..bytes.len() / 2]).is_err());
    }
    // Whole numbers of 32 bits have no top that stands for 1.
    let whole = grey_tiff::<Gray32>(&[0, 1, 2, 3, 4, 5]);
    assert!(matches!(
        decode(Path::new("dem.tif"), &whole),
        Err(Error::Decode { .. })
    ));
}

#[test]
fn heights_outside_zero_to_one_are_refused_or_rescaled_when_asked() {
    let image = decode(Path::new("dem.exr"), &rgb_float([836.0, 0.0, 0.0])).unwrap();
    let error = HeightField::from_image(&image, Channel::Red)
        .unwrap_err()
        .to_string();
    assert!(
        error.contains("dem.exr") && error.contains("(2, 1)") && error.contains("836"),
        "{error}"
    );
    let (field, range) = HeightField::from_image_rescaled(&image, Channel::Red).unwrap();
    assert_eq!((range, field.range()), ((0.25, 836.0), (0.0, 1.0)));
    assert_eq!(field.texel(2, 1), 1.0);
}

#[test]
fn a_channel_that_is_not_there_is_named() {
    let image = decode(
        Path::new("g.png"),
        &encoded(grey16(2, 2, |_, _| 9), ImageFormat::Png),
    )
    .unwrap();
    let error = HeightField::from_image(&image, Channel::Alpha)
        .unwrap_err()
        .to_string();
    assert!(
        error.contains("g.png") && error.contains("no alpha channel"),
        "{error}"
    );
    for channel in [Channel::Red, Channel::Green, Channel::Blue, Channel::Luminance] {
        assert_eq!(image.channel(channel).unwrap(), [9.0 / 65535.0; 4], "{channel}");
    }
    assert!(matches!(
        NormalMap::from_image(&image, NormalCodec::Unorm),
        Err(Error::NotANormalMap { channels: 1, .. })
    ));
}

#[test]
fn channels_are_taken_apart() {
    let texels = Texels::Unorm8(vec![255, 0, 0, 10, 0, 255, 51, 20]);
    let image = Image {
        width: 2,
        height: 1,
        channels: 4,
        texels,
        path: "c.png".into(),
    };
    let of = |channel| image.channel(channel).unwrap();
    assert_eq!(of(Channel::Red), [1.0, 0.0]);
    assert_eq!(of(Channel::Blue), [0.0, 0.2]);
    assert_eq!(of(Channel::Alpha), [10.0 / 255.0, 20.0 / 255.0]);
    assert_eq!(of(Channel::Luminance), [0.2126, 0.7152 + 0.0722 * 0.2]);
}

#[test]
fn sixteen_bits_become_the_nearest_eight() {
    // 65535·b/255 = 257·b exactly; halfway up lies 257·b + 128.5, so 128 rounds down and 129 up.
    let texels = Texels::Unorm16(vec![257 * 77, 257 * 77 + 128, 257 * 77 + 129]);
    let image = Image {
        width: 1,
        height: 1,
        channels: 3,
        texels,
        path: "n.png".into(),
    };
    let map = NormalMap::from_image(&image, NormalCodec::Unorm).unwrap();
    assert_eq!(map.texels, [[77, 77, 78, 255]]);
}

#[test]
fn height_fields_from_code_are_checked() {
    assert!(matches!(
        HeightField::new(2, 2, vec![0.0; 3]),
        Err(Error::TexelCount {
            expected: 4,
            found: 3,
            ..
        })
    ));
    assert!(matches!(
        HeightField::new(0, 2, vec![]),
        Err(Error::TexelCount { .. })
    ));
    assert!(matches!(
        HeightField::new(1, 2, vec![0.0, f32::NAN]),
        Err(Error::NonFinite { y: 1, .. })
    ));
    assert!(matches!(
        HeightField::new(1, 2, vec![-0.1, 0.0]),
        Err(Error::OutOfRange { y: 0, .. })
    ));
    let field = HeightField::from_fn(2, 1, |x, _| if x == 0 { f32::NAN } else { 7.0 });
    assert_eq!(field.texels, [0.0, 1.0]);
}

#[test]
fn normal_maps_know_their_lengths_and_turn_their_green() {
    let mut map = NormalMap::constant(3, 2, NormalCodec::Biased, glam::Vec3::new(0.0, 1.0, 0.0));
    assert!(map.is_constant());
    assert_eq!(map.length_range(), (1.0, 1.0));
    map.flip_green();
    assert_eq!(map.decode(2, 1), glam::Vec3::new(0.0, -1.0, 0.0));
    map.texels[4] = [128, 128, 128, 0];
    assert!(!map.is_constant());
    assert_eq!(map.length_range(), (0.0, 1.0));
    for byte in 0..=255u8 {
        let mut unorm = NormalMap {
            width: 1,
            height: 1,
            codec: NormalCodec::Unorm,
            texels: vec![[0, byte, 0, 0]],
        };
        let before = unorm.decode(0, 0).y;
        unorm.flip_green();
        // −(2b/255 − 1) and 2(255 − b)/255 − 1 are the same number, each rounded twice near 1: 2·2⁻²⁴ apart at most.
        assert!(
            (unorm.decode(0, 0).y + before).abs() <= 2.0 * 2f32.powi(-24),
            "byte {byte}"
        );
    }
}

#[test]
fn the_shader_decode_is_the_codec() {
    for codec in [NormalCodec::Unorm, NormalCodec::Biased] {
        let [scale, bias] = codec.scale_bias();
        for byte in 1..=255u8 {
            let shader = f32::from(byte) / 255.0 * scale + bias;
            // c, the product (≤ 2.01) and the sum round once each, scale and bias once: 2⁻²⁵·2 + 2⁻²⁴·2 + 2⁻²⁵ + 2·2⁻²⁴.
            assert!(
                (shader - codec.decode(byte)).abs() <= 6.0 * 2f32.powi(-24),
                "{codec:?} {byte}"
            );
        }
    }
}

#[test]
fn the_example_textures_are_what_their_readme_says() {
    let of = |name: &str| load_image(&examples().join(name)).unwrap();
    let bricks = HeightField::from_image(&of("bricks_height.png"), Channel::Red).unwrap();
    assert!(!bricks.is_flat() && (bricks.width, bricks.height) == (512, 512));
    let hills = of("jacksboro_height.png");
    assert_eq!((hills.width, hills.height), (403, 344));
    let Texels::Unorm16(samples) = &hills.texels else {
        panic!("16 bits")
    };
    let elevation = |v: &u16| 236 + v / 78;
    assert!(samples.iter().all(|v| v % 78 == 0));
    assert_eq!(
        (
            samples.iter().map(elevation).min(),
            samples.iter().map(elevation).max()
        ),
        (Some(236), Some(1076))
    );
    assert!(
        HeightField::from_image(&of("flat_height.png"), Channel::Red)
            .unwrap()
            .is_flat()
    );
    let normals = |name: &str| NormalMap::from_image(&of(name), NormalCodec::Unorm).unwrap();
    assert!(normals("flat_normal.png").is_constant());
    assert!(!normals("tread_plate_normal.png").is_constant());
    let grating = ColorMap::from_image(&of("grating_albedo.png")).unwrap();
    assert_eq!(grating.alpha_range(), (0, 255));
    assert!(
        ColorMap::from_image(&of("bricks_albedo.png"))
            .unwrap()
            .is_opaque()
    );
}

#[test]
fn the_brick_normals_are_the_bake_of_the_brick_heights() {
    use bossage_assets::EdgeMode;
    use bossage_assets::height_to_normal::{Bake, bake};
    let of = |name: &str| load_image(&examples().join(name)).unwrap();
    let field = HeightField::from_image(&of("bricks_height.png"), Channel::Red).unwrap();
    let published = NormalMap::from_image(&of("bricks_normal.png"), NormalCodec::Unorm).unwrap();
    let baked = |edge, scale| {
        let settings = Bake::central(&field, [scale; 2], edge, NormalCodec::Unorm).unwrap();
        bake(&field, &settings)
            .texels
            .iter()
            .map(|t| [t[0], t[1], t[2], 255])
            .collect::<Vec<_>>()
    };
    assert_eq!(baked(EdgeMode::Wrap, 20.0 / 660.0), published.texels);
    assert_ne!(
        baked(EdgeMode::Clamp, 20.0 / 660.0),
        published.texels,
        "the control: another edge"
    );
    assert_ne!(
        baked(EdgeMode::Wrap, 20.0 / 661.0),
        published.texels,
        "the control: another scale"
    );
}
