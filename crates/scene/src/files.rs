//! The files that a scene names: found beside the scene, read once each, and reported at the field that names them.

use std::cell::RefCell;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use bossage_assets::{Image, Mesh, load_image, obj};

use crate::error::Error;
use crate::fields::Value;
use crate::profile::Profile;

/// Reads files relative to a scene, each once.
pub(crate) struct Files {
    folder: PathBuf,
    images: RefCell<BTreeMap<PathBuf, Result<Arc<Image>, String>>>,
}

impl Files {
    /// For a scene file.
    pub(crate) fn new(scene: &Path) -> Self {
        Self {
            folder: scene.parent().unwrap_or(Path::new("")).to_owned(),
            images: RefCell::default(),
        }
    }

    /// The image that a field names. A file named twice is read, and reported, at each place.
    pub(crate) fn image(&self, value: &Value<'_>) -> Option<(PathBuf, Arc<Image>)> {
        let path = self.resolve(value)?;
        let mut images = self.images.borrow_mut();
        let read = images
            .entry(path.clone())
            .or_insert_with(|| load_image(&path).map(Arc::new).map_err(|error| chain(&error)));
        match read {
            Ok(image) => Some((path, image.clone())),
            Err(message) => {
                value.note(message.clone(), "images: PNG, JPEG, TGA, BMP, TIFF, OpenEXR, Radiance HDR; paths start at the scene's folder");
                None
            }
        }
    }

    /// The mesh that a field names.
    pub(crate) fn mesh(&self, value: &Value<'_>) -> Option<(PathBuf, Mesh)> {
        let path = self.resolve(value)?;
        match obj::load(&path) {
            Ok(mesh) => Some((path, mesh)),
            Err(error) => {
                value.note(
                    chain(&error),
                    "a Wavefront OBJ with faces and texture coordinates; paths start at the scene's folder",
                );
                None
            }
        }
    }

    /// The cost profile that a field names. What is wrong in it is shown in the profile.
    pub(crate) fn profile(&self, value: &Value<'_>) -> Option<Profile> {
        match Profile::load(&self.resolve(value)?) {
            Ok(profile) => Some(profile),
            Err(Error::Invalid(report)) => {
                value.note_named(*report);
                None
            }
            Err(error) => {
                value.note(chain(&error), "a cost profile; paths start at the scene's folder");
                None
            }
        }
    }

    fn resolve(&self, value: &Value<'_>) -> Option<PathBuf> {
        Some(self.folder.join(value.name()?))
    }
}

/// An error with its causes, joined by colons.
pub(crate) fn chain(error: &dyn std::error::Error) -> String {
    let mut text = error.to_string();
    let mut cause = error.source();
    while let Some(next) = cause {
        text = format!("{text}: {next}");
        cause = next.source();
    }
    text
}
