//! The scene that travels inside the binary, so that the demo runs anywhere.

use std::path::{Path, PathBuf};

use crate::error::Result;
use crate::output::Outputs;

/// File names below the scene's folder, and what is in them: the repository's own example.
const FILES: &[(&str, &[u8])] = &[
    (
        "brick_wall.toml",
        include_bytes!("../../../../../examples/brick_wall.toml"),
    ),
    (
        "textures/bricks_albedo.png",
        include_bytes!("../../../../../examples/textures/bricks_albedo.png"),
    ),
    (
        "textures/bricks_height.png",
        include_bytes!("../../../../../examples/textures/bricks_height.png"),
    ),
    (
        "textures/bricks_normal.png",
        include_bytes!("../../../../../examples/textures/bricks_normal.png"),
    ),
];

/// Writes the scene into a folder and returns the scene file.
pub(super) fn unpack(folder: &Path) -> Result<PathBuf> {
    let mut outputs = Outputs::default();
    for (name, bytes) in FILES {
        outputs.add(folder.join(name), "the bundled scene", bytes.to_vec())?;
    }
    outputs.commit()?;
    Ok(folder.join(FILES[0].0))
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use super::*;

    /// The bundle holds what the scene reads, and nothing that it does not.
    #[test]
    fn the_bundle_is_complete() {
        let folder = tempfile::tempdir().unwrap();
        let scene = bossage_scene::load(&unpack(folder.path()).unwrap()).unwrap();
        let bundled: BTreeSet<PathBuf> = FILES.iter().map(|(name, _)| folder.path().join(name)).collect();
        assert_eq!(crate::inputs::files_of(&scene), bundled);
    }
}
