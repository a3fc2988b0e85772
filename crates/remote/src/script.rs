//! The script that a process runs. It is part of this program, so that both sides of the pipes always fit together.

use std::io;
use std::path::PathBuf;

use tempfile::TempDir;

use crate::kind::Kind;

/// A folder with the modules, which goes when this is dropped.
#[derive(Debug)]
pub(crate) struct Script {
    kind: Kind,
    folder: TempDir,
}

impl Script {
    pub(crate) fn write(kind: Kind) -> io::Result<Self> {
        let folder = tempfile::Builder::new().prefix("bossage-").tempdir()?;
        for (name, text) in kind.modules() {
            std::fs::write(folder.path().join(name), text)?;
        }
        Ok(Self { kind, folder })
    }

    /// The module to run.
    pub(crate) fn main(&self) -> PathBuf {
        let first = self.kind.modules().first();
        self.folder.path().join(first.map_or("", |(name, _)| name))
    }
}
