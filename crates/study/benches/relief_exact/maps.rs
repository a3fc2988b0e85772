//! The maps that designs are measured on.

use std::path::Path;

use bossage_assets::{Channel, EdgeMode, HeightField, load_image};
use bossage_runner::TextureData;

use crate::Failure;

pub(crate) struct Map {
    pub(crate) name: String,
    pub(crate) field: HeightField,
    pub(crate) edge: EdgeMode,
}

impl Map {
    pub(crate) fn texture(&self) -> TextureData {
        TextureData::r32f(self.field.width, self.field.height, &self.field.texels)
    }

    /// As the shaders have it.
    pub(crate) fn edge_number(&self) -> f32 {
        match self.edge {
            EdgeMode::Wrap => 0.0,
            EdgeMode::Mirror => 1.0,
            EdgeMode::Clamp => 2.0,
        }
    }
}

/// Bricks of 512² that tile; real elevation of 403×344 that does not, clamped and mirrored.
pub(crate) fn bundled() -> Result<Vec<Map>, Failure> {
    let textures = concat!(env!("CARGO_MANIFEST_DIR"), "/../../examples/textures/");
    let field = |file: &str| load(&format!("{textures}{file}"));
    let elevation = field("jacksboro_height.png")?;
    let named = |name: &str, field, edge| Map {
        name: name.to_owned(),
        field,
        edge,
    };
    Ok(vec![
        named("bricks", field("bricks_height.png")?, EdgeMode::Wrap),
        named("elevation", elevation.clone(), EdgeMode::Clamp),
        named("elevation, mirrored", elevation, EdgeMode::Mirror),
    ])
}

/// An image of the user's, which tiles.
pub(crate) fn read(path: &str) -> Result<Map, Failure> {
    Ok(Map {
        name: path.rsplit('/').next().unwrap_or(path).to_owned(),
        field: load(path)?,
        edge: EdgeMode::Wrap,
    })
}

fn load(path: &str) -> Result<HeightField, Failure> {
    Ok(HeightField::from_image(
        &load_image(Path::new(path))?,
        Channel::Red,
    )?)
}
