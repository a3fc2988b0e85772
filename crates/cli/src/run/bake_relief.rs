//! The maps that tracing reads, as files of `bossage bake`.
//!
//! PNG, which every engine reads, with as many bits as keep a map right and of use. What rounding takes is always width, never safety:
//!
//! | map | samples | why |
//! |---|---|---|
//! | `max_mip` | 16-bit grey, a file a level | codes of heights; exact for 8- and 16-bit images, else up |
//! | `cone`, `relaxed_cone` | 16-bit RGB: height, ratio, 0 | the layout that the techniques read. 8 bits would leave steep maps no cone at all: a ratio may be 1/(√2 · side). A tip that is raised and a cone that is narrower lie inside the one that was baked |
//! | `window_maxima` | 8-bit RGBA: depths | as baked: a depth that is rounded down costs a step at most |

use bossage_assets::max_mip::codes::MaxCodes;
use bossage_assets::{ConeMap, EdgeMode, HeightField, cone_map, relaxed_cone_map, window_maxima};
use image::ExtendedColorType;

use crate::args::bake::ReliefMaps;
use crate::error::Result;
use crate::picture;

/// Name and contents of each file that is asked for, and of the levels of maxima that were baked.
pub(super) fn files(
    maps: ReliefMaps,
    levels: &[MaxCodes],
    field: &HeightField,
    edge: EdgeMode,
) -> Result<Vec<(String, Vec<u8>)>> {
    let mut files = Vec::new();
    let mut add = |name: String, png: Result<Vec<u8>>| png.map(|png| files.push((name, png)));
    for (level, map) in levels.iter().enumerate() {
        let png = png16(map.width, map.height, &map.codes, ExtendedColorType::L16);
        add(format!("max_mip{level}.png"), png)?;
    }
    if maps.cone {
        add("cone.png".to_owned(), cones(field, &cone_map::bake(field, edge)))?;
    }
    if maps.relaxed_cone {
        let map = relaxed_cone_map::bake(field, edge);
        add("relaxed_cone.png".to_owned(), cones(field, &map))?;
    }
    if maps.window_maxima {
        let map = window_maxima::bake(field, edge);
        let png = picture::png_rgba8(2 * map.columns, 2 * map.rows, map.texels.as_flattened());
        add("window_maxima.png".to_owned(), png)?;
    }
    Ok(files)
}

/// Heights in red, ratios in green.
fn cones(field: &HeightField, map: &ConeMap) -> Result<Vec<u8>> {
    let pairs = field.to_unorm16_up().into_iter().zip(map.to_unorm16());
    let samples: Vec<u16> = pairs.flat_map(|(height, ratio)| [height, ratio, 0]).collect();
    png16(map.width, map.height, &samples, ExtendedColorType::Rgb16)
}

fn png16(width: u32, height: u32, samples: &[u16], kind: ExtendedColorType) -> Result<Vec<u8>> {
    // The encoder takes native-endian samples.
    let bytes: Vec<u8> = samples.iter().flat_map(|sample| sample.to_ne_bytes()).collect();
    picture::png(width, height, &bytes, kind)
}
