//! The shader folder that mutants are made of, and a copy of it to put them into.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

use bossage_shaders::Library;
use tempfile::TempDir;

use crate::error::Error;
use crate::mutant::Mutant;

/// The sources of a folder: texts by path below it, with `/` between the parts.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Sources {
    /// The texts.
    pub files: BTreeMap<String, String>,
}

impl Sources {
    /// Reads every `.wesl` file below a folder.
    ///
    /// # Errors
    /// [`Error::Read`].
    pub fn read(folder: &Path) -> Result<Self, Error> {
        let mut files = BTreeMap::new();
        let mut folders = vec![folder.to_owned()];
        while let Some(next) = folders.pop() {
            for path in entries(&next)? {
                if path.is_dir() {
                    folders.push(path);
                } else if path.extension().is_some_and(|extension| extension == "wesl") {
                    let text = fs::read_to_string(&path).map_err(|source| Error::Read {
                        path: path.clone(),
                        source,
                    })?;
                    files.insert(slashed(path.strip_prefix(folder).unwrap_or(&path)), text);
                }
            }
        }
        Ok(Self { files })
    }

    /// Writes them into a new temporary folder.
    ///
    /// # Errors
    /// [`Error::Write`].
    pub fn copy(&self) -> Result<Copy, Error> {
        let folder = tempfile::tempdir().map_err(|source| Error::Write {
            path: std::env::temp_dir(),
            source,
        })?;
        for (file, text) in &self.files {
            let path = folder.path().join(file);
            if let Some(parent) = path.parent() {
                fs::create_dir_all(parent).map_err(|source| Error::Write {
                    path: parent.to_owned(),
                    source,
                })?;
            }
            write(&path, text)?;
        }
        Ok(Copy { folder })
    }
}

/// A folder with the sources, gone when dropped.
#[derive(Debug)]
pub struct Copy {
    folder: TempDir,
}

impl Copy {
    /// Where it is.
    #[must_use]
    pub fn path(&self) -> &Path {
        self.folder.path()
    }

    /// The library with the mutant's fault, or what the library says of it. The copy is as before afterwards.
    ///
    /// # Errors
    /// [`Error::Write`].
    pub fn library(
        &self,
        sources: &Sources,
        mutant: &Mutant,
    ) -> Result<Result<Library, bossage_shaders::Error>, Error> {
        let path = self.path().join(&mutant.file);
        write(&path, &mutant.text)?;
        let library = Library::from_dir(self.path());
        write(&path, sources.files.get(&mutant.file).map_or("", String::as_str))?;
        Ok(library)
    }
}

/// What is in a folder, sorted.
pub(crate) fn entries(folder: &Path) -> Result<Vec<PathBuf>, Error> {
    let failed = |source| Error::Read {
        path: folder.to_owned(),
        source,
    };
    let mut paths = fs::read_dir(folder)
        .map_err(failed)?
        .map(|entry| entry.map(|entry| entry.path()))
        .collect::<Result<Vec<_>, _>>()
        .map_err(failed)?;
    paths.sort();
    Ok(paths)
}

fn write(path: &Path, text: &str) -> Result<(), Error> {
    fs::write(path, text).map_err(|source| Error::Write {
        path: path.to_owned(),
        source,
    })
}

fn slashed(path: &Path) -> String {
    let parts = path.components().map(|part| part.as_os_str().to_string_lossy());
    parts.collect::<Vec<_>>().join("/")
}
