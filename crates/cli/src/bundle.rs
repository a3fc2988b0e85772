//! The scenes that travel inside the binary, so that the demo and the study run anywhere.

use std::path::{Path, PathBuf};

use bossage_scene::Scene;

use crate::error::{Error, Result};
use crate::output::Outputs;

/// A scene of the repository's examples.
#[derive(Debug)]
pub(crate) struct Bundled {
    /// The name of its file, without extension.
    pub(crate) name: &'static str,
    /// File names below the scene's folder, the scene first, and what is in them.
    files: &'static [(&'static str, &'static [u8])],
}

/// What the demo shows.
pub(crate) const BRICK_WALL: Bundled = Bundled {
    name: "brick_wall",
    files: &[
        (
            "brick_wall.toml",
            include_bytes!("../../../examples/brick_wall.toml"),
        ),
        (
            "textures/bricks_albedo.png",
            include_bytes!("../../../examples/textures/bricks_albedo.png"),
        ),
        (
            "textures/bricks_height.png",
            include_bytes!("../../../examples/textures/bricks_height.png"),
        ),
        (
            "textures/bricks_normal.png",
            include_bytes!("../../../examples/textures/bricks_normal.png"),
        ),
    ],
};

const ELEVATION: Bundled = Bundled {
    name: "elevation",
    files: &[
        (
            "elevation.toml",
            include_bytes!("../../../examples/elevation.toml"),
        ),
        (
            "textures/jacksboro_height.png",
            include_bytes!("../../../examples/textures/jacksboro_height.png"),
        ),
    ],
};

/// All of them.
pub(crate) const SCENES: [Bundled; 2] = [BRICK_WALL, ELEVATION];

impl Bundled {
    /// Writes the scene into a folder and returns the scene file.
    pub(crate) fn unpack(&self, folder: &Path) -> Result<PathBuf> {
        let mut outputs = Outputs::default();
        for (name, bytes) in self.files {
            outputs.add(folder.join(name), "the bundled scene", bytes.to_vec())?;
        }
        outputs.commit()?;
        Ok(folder.join(self.files[0].0))
    }

    /// The scene, loaded from a folder that is gone afterwards.
    pub(crate) fn load(&self) -> Result<Scene> {
        let folder = tempfile::tempdir().map_err(|source| Error::Write {
            path: std::env::temp_dir(),
            source,
        })?;
        Ok(bossage_scene::load(&self.unpack(folder.path())?)?)
    }
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use super::*;

    /// The bundle holds what the scene reads, and nothing that it does not.
    #[test]
    fn the_bundle_is_complete() {
        for bundled in SCENES {
            let folder = tempfile::tempdir().unwrap();
            let scene = bossage_scene::load(&bundled.unpack(folder.path()).unwrap()).unwrap();
            let names = bundled.files.iter().map(|(name, _)| folder.path().join(name));
            let files: BTreeSet<PathBuf> = names.collect();
            assert_eq!(crate::inputs::files_of(&scene), files);
            assert_eq!(scene.path.file_stem().unwrap(), bundled.name);
            assert_eq!(bundled.load().unwrap().materials.len(), scene.materials.len());
        }
    }
}
