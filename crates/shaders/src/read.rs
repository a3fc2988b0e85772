//! Reading source files from the disk.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

use crate::{Error, Result};

/// Every `.wesl` file below a folder, by its path relative to it with `/` between the parts.
pub(crate) fn folder(dir: &Path) -> Result<BTreeMap<String, String>> {
    let mut files = BTreeMap::new();
    let mut folders = vec![dir.to_owned()];
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(&folder).map_err(|source| Error::Read {
            path: folder.clone(),
            source,
        })? {
            let path = entry
                .map_err(|source| Error::Read {
                    path: folder.clone(),
                    source,
                })?
                .path();
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|extension| extension == "wesl") {
                let relative = path.strip_prefix(dir).unwrap_or(&path);
                files.insert(slashed(relative), text(&path)?);
            }
        }
    }
    Ok(files)
}

/// A file's text.
pub(crate) fn text(path: &Path) -> Result<String> {
    let bytes = fs::read(path).map_err(|source| Error::Read {
        path: path.to_owned(),
        source,
    })?;
    String::from_utf8(bytes).map_err(|_| Error::NotText {
        path: PathBuf::from(path),
    })
}

/// A relative path with `/` on every system.
pub(crate) fn slashed(path: &Path) -> String {
    path.components()
        .map(|part| part.as_os_str().to_string_lossy())
        .collect::<Vec<_>>()
        .join("/")
}
