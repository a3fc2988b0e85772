//! A normalisation cube map as six PNG files, 8 or 16 bits a component.
//!
//! The names end in the axis that the face looks along: `px`, `nx`, `py`, `ny`, `pz`, `nz`, in the order of cube textures.

use bossage_assets::{NormalisationCubeMap, Texels};
use image::ExtendedColorType;

use crate::error::Result;
use crate::picture;

const AXES: [&str; 6] = ["px", "nx", "py", "ny", "pz", "nz"];

/// Name and contents of each file.
pub(crate) fn encode(map: &NormalisationCubeMap) -> Result<Vec<(String, Vec<u8>)>> {
    let file = |(face, axis): (&Texels, &str)| {
        let (bytes, kind) = samples(face);
        let png = picture::png(map.size, map.size, &bytes, kind)?;
        Ok((format!("normalisation_{}_{axis}.png", map.size), png))
    };
    map.faces.iter().zip(AXES).map(file).collect()
}

/// Red, green and blue: alpha is full everywhere.
fn samples(face: &Texels) -> (Vec<u8>, ExtendedColorType) {
    match face {
        Texels::Unorm8(codes) => (opaque(codes).collect(), ExtendedColorType::Rgb8),
        // The encoder takes native-endian samples.
        Texels::Unorm16(codes) => (
            opaque(codes).flat_map(u16::to_ne_bytes).collect(),
            ExtendedColorType::Rgb16,
        ),
        Texels::Float32(values) => {
            let codes: Vec<u16> = values
                .iter()
                .map(|value| (value * 65535.0 + 0.5) as u16)
                .collect();
            samples(&Texels::Unorm16(codes))
        }
    }
}

fn opaque<T: Copy>(samples: &[T]) -> impl Iterator<Item = T> {
    samples
        .as_chunks::<4>()
        .0
        .iter()
        .flat_map(|[r, g, b, _]| [*r, *g, *b])
}

#[cfg(test)]
mod tests {
    use bossage_assets::normalisation_cube_map::Depth;

    use super::*;

    #[test]
    fn files_hold_the_codes_of_their_faces() {
        for (depth, middle, end) in [(Depth::Eight, 128, 255), (Depth::Sixteen, 32768, 65535)] {
            let files = encode(&NormalisationCubeMap::generate(1, depth).unwrap()).unwrap();
            let names: Vec<&str> = files.iter().map(|(name, _)| name.as_str()).collect();
            assert_eq!(names[0], "normalisation_1_px.png");
            assert_eq!(names[5], "normalisation_1_nz.png");
            let read = image::load_from_memory(&files[5].1).unwrap();
            let pixel = match &read {
                image::DynamicImage::ImageRgb8(picture) => picture.get_pixel(0, 0).0.map(u16::from),
                image::DynamicImage::ImageRgb16(picture) => picture.get_pixel(0, 0).0,
                other => panic!("{other:?}"),
            };
            assert_eq!(pixel, [middle, middle, 0]);
            let read = image::load_from_memory(&files[0].1).unwrap().to_rgb16();
            assert_eq!(read.get_pixel(0, 0).0[0], if end == 255 { 65535 } else { end });
        }
    }
}
