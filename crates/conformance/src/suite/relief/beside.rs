//! What is baked from a height map for the techniques that read more than heights.

use bossage_assets::window_maxima::{self, WindowMaxima};
use bossage_assets::{EdgeMode, HeightField, cone_map, relaxed_cone_map};
use bossage_reference::relief_truth::height_at;
use bossage_runner::TextureData;
use bossage_shaders::ReliefTechnique;
use glam::DVec2;

/// A map beside the heights.
pub(super) struct Beside {
    /// As the kernel reads it, as `relief_map`.
    pub(super) texture: TextureData,
    /// What it holds beside the height, one number a texel.
    second: HeightField,
    edge: EdgeMode,
}

impl Beside {
    /// What the technique reads, where it reads more than heights.
    pub(super) fn of(technique: ReliefTechnique, field: &HeightField, edge: EdgeMode) -> Option<Self> {
        let pair = |numbers: Vec<f32>| {
            let pairs: Vec<[f32; 4]> = field
                .texels
                .iter()
                .zip(&numbers)
                .map(|(height, number)| [*height, *number, 0.0, 0.0])
                .collect();
            let second = HeightField {
                texels: numbers,
                ..field.clone()
            };
            Some(Self {
                texture: TextureData::rgba32f(field.width, field.height, &pairs),
                second,
                edge,
            })
        };
        match technique {
            ReliefTechnique::ParallaxIterative => pair(normals_z(field, edge)),
            ReliefTechnique::ConeStep => pair(cone_map::bake(field, edge).ratios),
            ReliefTechnique::RelaxedConeStep => pair(relaxed_cone_map::bake(field, edge).ratios),
            ReliefTechnique::Exact => Some(Self {
                texture: windows(&window_maxima::bake(field, edge)),
                second: field.clone(),
                edge,
            }),
            ReliefTechnique::ParallaxOffset
            | ReliefTechnique::ParallaxOffsetLimited
            | ReliefTechnique::SteepParallax
            | ReliefTechnique::ParallaxOcclusion
            | ReliefTechnique::Relief => None,
        }
    }

    /// The number beside the height at a place, filtered as heights are.
    pub(super) fn number(&self, uv: DVec2) -> f64 {
        height_at(&self.second, self.edge, uv)
    }
}

/// The third component of normals by central differences of elevations a sixteenth of a side high.
fn normals_z(field: &HeightField, edge: EdgeMode) -> Vec<f32> {
    let texel =
        |x: i64, y: i64| f64::from(field.texel(edge.resolve(x, field.width), edge.resolve(y, field.height)));
    let z = |(x, y): (i64, i64)| {
        let along_x = (texel(x + 1, y) - texel(x - 1, y)) * f64::from(field.width) / 32.0;
        let along_y = (texel(x, y + 1) - texel(x, y - 1)) * f64::from(field.height) / 32.0;
        (1.0 / (1.0 + along_x * along_x + along_y * along_y).sqrt()) as f32
    };
    let rows = 0..i64::from(field.height);
    rows.flat_map(|y| (0..i64::from(field.width)).map(move |x| (x, y)))
        .map(z)
        .collect()
}

/// Depths over windows as the shader reads them.
fn windows(map: &WindowMaxima) -> TextureData {
    TextureData::rgba8(2 * map.columns, 2 * map.rows, &map.texels)
}
