//! Has anything changed since the last run? The stamp beside the outputs knows.
//!
//! It records the tool, the call, the SHA-256 of every file read and of every file written. A run that finds all of them
//! equal does nothing. The tool is known by version and by size and time of its executable, so that a rebuilt tool of the
//! same version counts as another one: the stamp is for one machine, which is why it is no part of the manifest.
//!
//! A stamp that cannot be read is treated as none.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::time::UNIX_EPOCH;

use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};

/// The stamp's file name in the output folder.
pub(crate) const FILE: &str = ".bossage-stamp.json";

/// What a run read and wrote.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Stamp {
    /// The tool.
    pub(crate) tool: String,
    /// The call: options and inputs.
    pub(crate) call: String,
    /// Whether everything that was asked for was written.
    pub(crate) complete: bool,
    /// SHA-256 of every file read.
    pub(crate) read: BTreeMap<PathBuf, String>,
    /// SHA-256 of every file written, by name in the output folder.
    pub(crate) written: BTreeMap<String, String>,
}

impl Stamp {
    /// The stamp of an earlier run into this folder.
    pub(crate) fn load(folder: &Path) -> Option<Self> {
        serde_json::from_slice(&std::fs::read(folder.join(FILE)).ok()?).ok()
    }

    /// Whether running `call` again would write the same: everything it read and wrote is as it was.
    pub(crate) fn is_current(&self, call: &str, folder: &Path) -> bool {
        self.complete
            && self.call == call
            && self.tool == tool()
            && self.read.iter().all(|(path, hash)| holds(path, hash))
            && self
                .written
                .iter()
                .all(|(name, hash)| holds(&folder.join(name), hash))
    }

    /// Files that the earlier run of the same call wrote, that are untouched since, and that are not written any more.
    pub(crate) fn orphans(&self, now: &Self, folder: &Path) -> Vec<PathBuf> {
        if self.call != now.call {
            return Vec::new();
        }
        let gone = self
            .written
            .iter()
            .filter(|(name, _)| !now.written.contains_key(*name));
        gone.map(|(name, hash)| (folder.join(name), hash))
            .filter(|(path, hash)| holds(path, hash))
            .map(|(path, _)| path)
            .collect()
    }
}

fn holds(path: &Path, hash: &str) -> bool {
    std::fs::read(path).is_ok_and(|bytes| sha256(&bytes) == hash)
}

/// SHA-256 in hexadecimal digits.
pub(crate) fn sha256(bytes: &[u8]) -> String {
    Sha256::digest(bytes)
        .iter()
        .map(|byte| format!("{byte:02x}"))
        .collect()
}

/// Version, and size and time of the executable.
pub(crate) fn tool() -> String {
    let executable = std::env::current_exe().and_then(std::fs::metadata);
    let build = executable.ok().map(|meta| {
        let time = meta
            .modified()
            .ok()
            .and_then(|t| t.duration_since(UNIX_EPOCH).ok())
            .unwrap_or_default();
        format!("{}@{}", meta.len(), time.as_nanos())
    });
    format!(
        "bossage {} {}",
        env!("CARGO_PKG_VERSION"),
        build.unwrap_or_default()
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    fn stamp(folder: &Path) -> Stamp {
        let (input, output) = (folder.join("in"), folder.join("out.spv"));
        std::fs::write(&input, "in").unwrap();
        std::fs::write(&output, "out").unwrap();
        Stamp {
            tool: tool(),
            call: "call".to_owned(),
            complete: true,
            read: BTreeMap::from([(input, sha256(b"in"))]),
            written: BTreeMap::from([("out.spv".to_owned(), sha256(b"out"))]),
        }
    }

    #[test]
    fn every_change_is_seen() {
        let folder = tempfile::tempdir().unwrap();
        let folder = folder.path();
        let good = stamp(folder);
        assert!(good.is_current("call", folder));
        assert!(!good.is_current("another call", folder));
        assert!(
            !Stamp {
                tool: "older".to_owned(),
                ..good.clone()
            }
            .is_current("call", folder)
        );
        assert!(
            !Stamp {
                complete: false,
                ..good.clone()
            }
            .is_current("call", folder)
        );
        std::fs::write(folder.join("in"), "changed").unwrap();
        assert!(!good.is_current("call", folder), "an input changed");
        std::fs::write(folder.join("in"), "in").unwrap();
        std::fs::remove_file(folder.join("out.spv")).unwrap();
        assert!(!good.is_current("call", folder), "an output is gone");
    }

    #[test]
    fn only_untouched_files_of_the_same_call_are_orphans() {
        let folder = tempfile::tempdir().unwrap();
        let folder = folder.path();
        let old = stamp(folder);
        let now = Stamp {
            written: BTreeMap::new(),
            ..old.clone()
        };
        assert_eq!(old.orphans(&now, folder), [folder.join("out.spv")]);
        assert!(
            old.orphans(
                &Stamp {
                    call: "other".to_owned(),
                    ..now.clone()
                },
                folder
            )
            .is_empty()
        );
        std::fs::write(folder.join("out.spv"), "edited by hand").unwrap();
        assert!(old.orphans(&now, folder).is_empty());
    }

    #[test]
    fn sha256_is_the_standards() {
        // FIPS 180-4, the empty message.
        assert_eq!(
            sha256(b""),
            "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855"
        );
    }
}
