//! Ways to draw a scene, as `render` takes them: a relief technique by name, or a setting of all materials.

use std::path::Path;

use bossage_scene::{Scene, Setting, TechniquePin};

use crate::error::{Error, Result};
use crate::nearest::suggestion;

/// The technique of that name, or what it might have meant.
pub(crate) fn named(name: &str) -> Result<TechniquePin> {
    let known = TechniquePin::NAMES.iter().find(|(known, _)| *known == name);
    known.map(|(_, technique)| *technique).ok_or_else(|| {
        let names: Vec<&str> = TechniquePin::NAMES.iter().map(|(name, _)| *name).collect();
        Error::Call(format!(
            "unknown technique `{name}`; {}",
            suggestion(name, &names)
        ))
    })
}

/// The scene with every material drawn by that technique that can be. A scene in which none can is refused.
pub(crate) fn pinned(scene: &Scene, name: &str) -> Result<Scene> {
    let technique = named(name)?;
    let mut pinned = scene.clone();
    pinned
        .pin_technique(technique)
        .map_err(|why| Error::Call(format!("{}: {why}", scene.path.display())))?;
    Ok(pinned)
}

/// The scene of a file in a way of drawing it: a technique, or KEY=VALUE for all materials.
pub(crate) fn varied(path: &Path, way: &str) -> Result<Scene> {
    if way.contains('=') {
        let setting: Setting = way.parse().map_err(Error::Call)?;
        return Ok(bossage_scene::load_with(path, &[setting])?);
    }
    pinned(&bossage_scene::load(path)?, way)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_typo_is_answered_with_the_name() {
        assert_eq!(named("none").unwrap(), TechniquePin::None);
        let error = named("paralax_offset_limitted").unwrap_err();
        assert_eq!(error.exit_code(), 2);
        assert!(
            error
                .to_string()
                .contains("did you mean parallax_offset_limited?"),
            "{error}"
        );
    }
}
