//! The environment of a scene file: six faces of a cube map, each wrong one reported at its own place.

use std::path::PathBuf;
use std::sync::Arc;

use bossage_assets::{ColorMap, CubeFace, CubeMap};

use crate::fields::Value;
use crate::files::{Files, chain};
use crate::model::Environment;

/// The `[environment]` table.
pub(crate) fn environment(value: &Value<'_>, files: &Files) -> Option<Environment> {
    let table = value.table()?;
    let faces = table
        .need("faces", "`faces`, six images: +X, −X, +Y, −Y, +Z, −Z")
        .and_then(|value| faces(&value, files));
    table.finish();
    faces
}

fn faces(value: &Value<'_>, files: &Files) -> Option<Environment> {
    let items = value.items()?;
    if items.len() != CubeFace::ALL.len() {
        value.note(
            format!("a cube map has 6 faces, found {}", items.len()),
            "give six images, in the order +X, −X, +Y, −Y, +Z, −Z",
        );
        return None;
    }
    let read: Vec<Option<(PathBuf, ColorMap)>> = items.iter().map(|item| face(item, files)).collect();
    let (paths, maps): (Vec<PathBuf>, Vec<ColorMap>) =
        read.into_iter().collect::<Option<Vec<_>>>()?.into_iter().unzip();
    let sound: Vec<bool> = items
        .iter()
        .zip(&maps)
        .map(|(item, map)| is_square(item, map) && is_as_large(item, map, &maps[0]))
        .collect();
    if sound.contains(&false) {
        return None;
    }
    let map = CubeMap::from_faces(maps, |face| &paths[face as usize])
        .map_err(|error| value.note(chain(&error), "give six square images of one size"))
        .ok()?;
    Some(Environment {
        paths,
        map: Arc::new(map),
    })
}

fn face(value: &Value<'_>, files: &Files) -> Option<(PathBuf, ColorMap)> {
    let (path, image) = files.image(value)?;
    let map = ColorMap::from_image(&image)
        .map_err(|error| value.note(chain(&error), "use an image with colours from 0 to 1"))
        .ok()?;
    Some((path, map))
}

fn is_square(value: &Value<'_>, map: &ColorMap) -> bool {
    let square = map.width == map.height;
    if !square {
        value.note(
            format!(
                "this face is {}x{}; faces of a cube map are square",
                map.width, map.height
            ),
            "crop or scale the image to a square",
        );
    }
    square
}

fn is_as_large(value: &Value<'_>, map: &ColorMap, first: &ColorMap) -> bool {
    let equal = map.width == first.width;
    if !equal {
        value.note(
            format!(
                "this face is {side}x{side}, the first is {first}x{first}; all six are of one size",
                side = map.width,
                first = first.width
            ),
            "scale the images to one size",
        );
    }
    equal
}
