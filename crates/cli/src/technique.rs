//! Relief techniques by name, as `render` takes them.

use bossage_scene::{Scene, TechniquePin};

use crate::error::{Error, Result};
use crate::nearest::suggestion;

/// What can be asked for.
const NAMES: &[(&str, TechniquePin)] = &[
    ("auto", TechniquePin::Auto),
    ("none", TechniquePin::None),
    ("parallax_offset", TechniquePin::ParallaxOffset),
    ("parallax_offset_limited", TechniquePin::ParallaxOffsetLimited),
];

/// The technique of that name, or what it might have meant.
pub(crate) fn named(name: &str) -> Result<TechniquePin> {
    let known = NAMES.iter().find(|(known, _)| *known == name);
    known.map(|(_, technique)| *technique).ok_or_else(|| {
        let names: Vec<&str> = NAMES.iter().map(|(name, _)| *name).collect();
        Error::Call(format!(
            "unknown technique `{name}`; {}",
            suggestion(name, &names)
        ))
    })
}

/// The scene with every height map drawn by that technique. A scene without a height map has nothing to draw by it.
pub(crate) fn pinned(scene: &Scene, name: &str) -> Result<Scene> {
    let technique = named(name)?;
    if scene.materials.iter().all(|material| material.height.is_none()) {
        let path = scene.path.display();
        return Err(Error::Call(format!(
            "{path}: no material has a height map, so technique `{name}` has nothing to work on"
        )));
    }
    let mut scene = scene.clone();
    scene.pin_technique(technique);
    Ok(scene)
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
