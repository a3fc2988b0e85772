//! Height maps to sweep over: heights, the layer they fill, and what lies beyond the border.

use std::path::Path;
use std::sync::Arc;

use bossage_assets::{Channel, EdgeMode, HeightField, load_image};
use bossage_reference::relief_ray::Layer;
use glam::DVec2;

use super::textures::Textures;
use crate::error::Error;

/// Thickness of the layer where no scene says it, in widths of the tile.
pub const DEPTH: f64 = 0.05;

/// Maps that travel inside the binary.
const BUNDLED: [(&str, &[u8], EdgeMode); 2] = [
    (
        "bricks",
        include_bytes!("../../../../examples/textures/bricks_height.png"),
        EdgeMode::Wrap,
    ),
    (
        "jacksboro",
        include_bytes!("../../../../examples/textures/jacksboro_height.png"),
        EdgeMode::Clamp,
    ),
];

/// A height map with its place over the polygon.
#[derive(Clone, Debug)]
pub struct Map {
    /// The name in reports.
    pub name: String,
    /// What the command line takes for it.
    pub origin: String,
    /// Heights in [0, 1].
    pub field: Arc<HeightField>,
    /// Beyond the border.
    pub edge: EdgeMode,
    /// Where the relief lies.
    pub layer: Layer,
    /// What shaders read of it.
    pub textures: Textures,
}

impl Map {
    /// Names of the bundled maps.
    #[must_use]
    pub fn bundled_names() -> Vec<&'static str> {
        BUNDLED.iter().map(|(name, ..)| *name).collect()
    }

    /// A bundled map, or the one of a file; its layer hangs below the polygon, `depth` thick, on square texels.
    ///
    /// Bundled maps keep their own edges unless one is given; files repeat unless told otherwise.
    ///
    /// # Errors
    /// A file that is no image, or whose heights are not in [0, 1].
    pub fn open(origin: &str, depth: f64, edge: Option<EdgeMode>) -> Result<Self, Error> {
        let bundled = BUNDLED.iter().find(|(name, ..)| *name == origin);
        let (image, name, usual_edge) = match bundled {
            Some((name, bytes, edge)) => {
                let image = bossage_assets::decode(Path::new(&format!("{name}.png")), bytes);
                (image, (*name).to_owned(), *edge)
            }
            None => (load_image(Path::new(origin)), stem(origin), EdgeMode::Wrap),
        };
        let field = HeightField::from_image(&image?, Channel::Red)?;
        Ok(Self {
            name,
            origin: origin.to_owned(),
            layer: below(&field, depth),
            field: Arc::new(field),
            edge: edge.unwrap_or(usual_edge),
            textures: Textures::default(),
        })
    }

    /// A map of a function of column and row, [`DEPTH`] thick.
    #[must_use]
    pub fn of(name: &str, width: u32, height: u32, at: impl Fn(u32, u32) -> f32, edge: EdgeMode) -> Self {
        let field = HeightField::from_fn(width, height, at);
        Self {
            name: name.to_owned(),
            origin: name.to_owned(),
            layer: below(&field, DEPTH),
            field: Arc::new(field),
            edge,
            textures: Textures::default(),
        }
    }

    /// Texels a tile, along u and v.
    #[must_use]
    pub fn sides(&self) -> DVec2 {
        DVec2::new(f64::from(self.field.width), f64::from(self.field.height))
    }
}

/// A layer below the polygon on tiles whose texels are square.
fn below(field: &HeightField, depth: f64) -> Layer {
    Layer {
        v_factor: f64::from(field.width) / f64::from(field.height),
        ..Layer::below(depth)
    }
}

fn stem(path: &str) -> String {
    Path::new(path)
        .file_stem()
        .map_or_else(|| path.to_owned(), |stem| stem.to_string_lossy().into_owned())
}

#[cfg(test)]
mod tests {
    use bossage_assets::EdgeMode;

    use super::Map;

    #[test]
    fn bundled_maps_are_there() {
        for name in Map::bundled_names() {
            let map = Map::open(name, 0.05, None).unwrap();
            assert!(!map.field.is_flat(), "{name}");
            assert_eq!((map.layer.scale, map.layer.bias), (0.05, -0.05));
        }
        let map = Map::open("jacksboro", 0.05, None).unwrap();
        assert_eq!((map.edge, map.layer.v_factor), (EdgeMode::Clamp, 403.0 / 344.0));
    }

    #[test]
    fn a_file_that_is_not_there_is_named() {
        let message = Map::open("no/such.png", 0.05, None).unwrap_err().to_string();
        assert!(message.contains("no/such.png"), "{message}");
    }
}
