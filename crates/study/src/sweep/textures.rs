//! What shaders read of a map, made when one first asks for it.
//!
//! Heights are 32-bit floats in red. Beside them the kernel's `relief_map`: window maxima for `exact`; height and cone ratio, or height
//! and the normal's third component, for the techniques that read pairs.

use std::sync::OnceLock;

use bossage_assets::cone_map::{self, ConeMap};
use bossage_assets::{EdgeMode, HeightField, relaxed_cone_map, window_maxima};
use bossage_reference::relief_ray::Layer;
use bossage_runner::TextureData;
use bossage_shaders::ReliefTechnique;

use super::kernel;
use super::map::Map;

/// Heights, and what is baked of them.
#[derive(Clone, Debug, Default)]
pub struct Textures {
    heights: OnceLock<TextureData>,
    maxima: OnceLock<TextureData>,
    cones: OnceLock<Pair<ConeMap>>,
    relaxed_cones: OnceLock<Pair<ConeMap>>,
    normals_z: OnceLock<Pair<HeightField>>,
}

/// A second number a texel, and both as a texture.
#[derive(Clone, Debug)]
pub(super) struct Pair<T> {
    pub(super) second: T,
    texture: TextureData,
}

impl<T> Pair<T> {
    fn new(field: &HeightField, second: T, numbers: impl Fn(&T) -> &[f32]) -> Self {
        let both = field.texels.iter().zip(numbers(&second));
        let texels: Vec<[f32; 4]> = both
            .map(|(height, number)| [*height, *number, 0.0, 0.0])
            .collect();
        let texture = TextureData::rgba32f(field.width, field.height, &texels);
        Self { second, texture }
    }
}

impl Textures {
    /// The texture that a binding of that name gets; none where no map is called so. `relief_map` is the technique's; of users' shaders it is
    /// the maxima.
    pub(super) fn of<'a>(
        &'a self,
        binding: &str,
        technique: Option<ReliefTechnique>,
        map: &Map,
    ) -> Option<&'a TextureData> {
        match binding {
            kernel::HEIGHT_MAP => Some(self.heights(&map.field)),
            kernel::CONE_MAP => Some(&self.cones(map).texture),
            kernel::RELAXED_CONE_MAP => Some(&self.relaxed_cones(map).texture),
            kernel::RELIEF_MAP => match technique {
                Some(ReliefTechnique::ConeStep) => Some(&self.cones(map).texture),
                Some(ReliefTechnique::RelaxedConeStep) => Some(&self.relaxed_cones(map).texture),
                Some(ReliefTechnique::ParallaxIterative) => Some(&self.normals_z(map).texture),
                Some(_) | None => Some(self.maxima(map)),
            },
            _ => None,
        }
    }

    fn heights(&self, field: &HeightField) -> &TextureData {
        let texture = || TextureData::r32f(field.width, field.height, &field.texels);
        self.heights.get_or_init(texture)
    }

    fn maxima(&self, map: &Map) -> &TextureData {
        self.maxima.get_or_init(|| {
            let windows = window_maxima::bake(&map.field, map.edge);
            TextureData::rgba8(2 * windows.columns, 2 * windows.rows, &windows.texels)
        })
    }

    pub(super) fn cones(&self, map: &Map) -> &Pair<ConeMap> {
        self.cones.get_or_init(|| {
            Pair::new(&map.field, cone_map::bake(&map.field, map.edge), |cones| {
                &cones.ratios
            })
        })
    }

    pub(super) fn relaxed_cones(&self, map: &Map) -> &Pair<ConeMap> {
        self.relaxed_cones.get_or_init(|| {
            Pair::new(
                &map.field,
                relaxed_cone_map::bake(&map.field, map.edge),
                |cones| &cones.ratios,
            )
        })
    }

    pub(super) fn normals_z(&self, map: &Map) -> &Pair<HeightField> {
        self.normals_z.get_or_init(|| {
            let second = normals_z(&map.field, map.edge, &map.layer);
            Pair::new(&map.field, second, |field| &field.texels)
        })
    }
}

/// The third component of the unit normal at each texel, by central differences of the layer's elevations.
fn normals_z(field: &HeightField, edge: EdgeMode, layer: &Layer) -> HeightField {
    let texel =
        |x: i64, y: i64| f64::from(field.texel(edge.resolve(x, field.width), edge.resolve(y, field.height)));
    // Elevation over a way of two texels, both in widths of the tile.
    let per_texel = 0.5 * layer.scale;
    let (along_x, along_y) = (
        f64::from(field.width) * per_texel,
        f64::from(field.height) * layer.v_factor * per_texel,
    );
    HeightField::from_fn(field.width, field.height, |x, y| {
        let (x, y) = (i64::from(x), i64::from(y));
        let slope_x = along_x * (texel(x + 1, y) - texel(x - 1, y));
        let slope_y = along_y * (texel(x, y + 1) - texel(x, y - 1));
        (1.0 / (1.0 + slope_x * slope_x + slope_y * slope_y).sqrt()) as f32
    })
}

#[cfg(test)]
mod tests {
    use bossage_assets::EdgeMode;

    use super::super::map::Map;

    #[test]
    fn a_slope_of_one_has_its_normal_at_45_degrees() {
        // Rises by 1/20 a texel of 1/20 tile, in a layer of one tile: as far up as along.
        let mut map = Map::of("slope", 20, 10, |x, _| x as f32 / 20.0, EdgeMode::Clamp);
        map.layer.scale = 1.0;
        let z = &map.textures.normals_z(&map).second;
        assert!(
            (z.texel(10, 5) - 0.5f32.sqrt()).abs() < 1e-6,
            "{}",
            z.texel(10, 5)
        );
        // Along v the tile is half as high, so that its texels are square: the same.
        let mut turned = Map::of("slope", 10, 20, |_, y| y as f32 / 20.0, EdgeMode::Clamp);
        turned.layer.scale = 2.0;
        // v_factor ½: twenty texels are two widths of the tile.
        let z = &turned.textures.normals_z(&turned).second;
        assert!(
            (z.texel(5, 10) - 0.5f32.sqrt()).abs() < 1e-6,
            "{}",
            z.texel(5, 10)
        );
    }
}
