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
use bossage_assets::{ConeMap, EdgeMode, HeightField, cone_map, max_mip, relaxed_cone_map, window_maxima};
use image::ExtendedColorType;

use crate::args::Global;
use crate::args::bake::ReliefMaps;
use crate::console::Console;
use crate::error::Result;
use crate::picture;

/// What is baked, and where.
pub(super) struct Baker<'a> {
    pub(super) field: &'a HeightField,
    pub(super) edge: EdgeMode,
    /// On the adapter where there is something here, else on the processor.
    pub(super) adapter: Option<(&'a Global, Console)>,
}

impl Baker<'_> {
    /// Name and contents of each file that is asked for.
    pub(super) fn files(&self, maps: ReliefMaps) -> Result<Vec<(String, Vec<u8>)>> {
        let mut files = Vec::new();
        if maps.max_mip {
            for (level, map) in self.maxima()?.iter().enumerate() {
                let png = png16(map.width, map.height, &map.codes, ExtendedColorType::L16)?;
                files.push((format!("max_mip{level}.png"), png));
            }
        }
        if maps.cone {
            files.push(("cone.png".to_owned(), cones(self.field, &self.cones(false)?)?));
        }
        if maps.relaxed_cone {
            files.push((
                "relaxed_cone.png".to_owned(),
                cones(self.field, &self.cones(true)?)?,
            ));
        }
        if maps.window_maxima {
            let map = window_maxima::bake(self.field, self.edge);
            let png = picture::png_rgba8(2 * map.columns, 2 * map.rows, map.texels.as_flattened())?;
            files.push(("window_maxima.png".to_owned(), png));
        }
        Ok(files)
    }

    fn maxima(&self) -> Result<Vec<MaxCodes>> {
        match self.adapter {
            Some((global, console)) => super::bake_gpu::max_mip(self.field, self.edge, global, console),
            None => Ok(max_mip::codes::bake(self.field, self.edge)),
        }
    }

    fn cones(&self, relaxed: bool) -> Result<ConeMap> {
        match (self.adapter, relaxed) {
            (Some((global, console)), _) => {
                super::bake_gpu::cones(self.field, self.edge, relaxed, global, console)
            }
            (None, false) => Ok(cone_map::bake(self.field, self.edge)),
            (None, true) => Ok(relaxed_cone_map::bake(self.field, self.edge)),
        }
    }
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
