//! Verdicts of earlier runs, so that an interrupted run goes on where it stopped and a repeated one is cheap.
//!
//! A verdict is taken over only where everything that made it is the same, byte by byte: this program, the adapter, the example
//! scenes, and the mutated sources. Each state of that has its own file below `target/`. Cases that ran out of time are tried
//! again.

use std::collections::BTreeMap;
use std::fs;
use std::io::Write;
use std::path::{Path, PathBuf};

use bossage_runner::AdapterInfo;
use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};

use crate::error::Error;
use crate::fate::Fate;
use crate::folder::{Sources, entries};
use crate::mutant::Mutant;

/// The verdicts of one state of program, adapter, scenes and sources.
#[derive(Debug)]
pub(crate) struct Ledger {
    path: PathBuf,
    known: BTreeMap<String, Fate>,
}

#[derive(Serialize, Deserialize)]
struct Line {
    id: String,
    #[serde(flatten)]
    fate: Fate,
}

impl Ledger {
    /// The verdicts so far; none with `fresh`.
    pub(crate) fn open(folder: &Path, state: &str, fresh: bool) -> Result<Self, Error> {
        fs::create_dir_all(folder).map_err(|source| Error::Write {
            path: folder.to_owned(),
            source,
        })?;
        let path = folder.join(format!("{state}.jsonl"));
        if fresh && path.exists() {
            fs::remove_file(&path).map_err(|source| Error::Write {
                path: path.clone(),
                source,
            })?;
        }
        // A last line that was cut off by an interruption is no verdict.
        let text = fs::read_to_string(&path).unwrap_or_default();
        let lines = text
            .lines()
            .filter_map(|line| serde_json::from_str::<Line>(line).ok());
        let known = lines.map(|line| (line.id, line.fate)).collect();
        Ok(Self { path, known })
    }

    /// The verdict on a mutant, if it is known.
    pub(crate) fn known(&self, mutant: &Mutant) -> Option<&Fate> {
        self.known.get(&mutant.id)
    }

    /// Keeps a verdict.
    pub(crate) fn keep(&self, mutant: &Mutant, fate: &Fate) -> Result<(), Error> {
        if matches!(fate, Fate::TimedOut { .. }) {
            return Ok(());
        }
        let failed = |source| Error::Write {
            path: self.path.clone(),
            source,
        };
        let line = Line {
            id: mutant.id.clone(),
            fate: fate.clone(),
        };
        let text = serde_json::to_string(&line).map_err(|error| failed(error.into()))?;
        let mut file = fs::OpenOptions::new()
            .create(true)
            .append(true)
            .open(&self.path)
            .map_err(failed)?;
        // One write, on a line of its own even after a line that was cut off.
        file.write_all(format!("\n{text}\n").as_bytes()).map_err(failed)
    }
}

/// A hash of everything that verdicts depend on.
pub(crate) fn state(
    sources: &Sources,
    scenes: Option<&Path>,
    adapter: &AdapterInfo,
) -> Result<String, Error> {
    let mut hash = Sha256::new();
    let program = std::env::current_exe().map_err(|source| Error::Read {
        path: PathBuf::from("this program"),
        source,
    })?;
    part(&mut hash, &read(&program)?);
    part(&mut hash, format!("{adapter:?}").as_bytes());
    match scenes {
        Some(scenes) => folder(&mut hash, scenes)?,
        None => part(&mut hash, b"without scenes"),
    }
    for (file, text) in &sources.files {
        part(&mut hash, file.as_bytes());
        part(&mut hash, text.as_bytes());
    }
    let digest = hash.finalize();
    Ok(digest.iter().take(8).map(|byte| format!("{byte:02x}")).collect())
}

fn folder(hash: &mut Sha256, path: &Path) -> Result<(), Error> {
    for entry in entries(path)? {
        if entry.is_dir() {
            folder(hash, &entry)?;
        } else {
            part(hash, entry.to_string_lossy().as_bytes());
            part(hash, &read(&entry)?);
        }
    }
    Ok(())
}

/// With its length, so that parts cannot run into each other.
fn part(hash: &mut Sha256, bytes: &[u8]) {
    hash.update((bytes.len() as u64).to_le_bytes());
    hash.update(bytes);
}

fn read(path: &Path) -> Result<Vec<u8>, Error> {
    fs::read(path).map_err(|source| Error::Read {
        path: path.to_owned(),
        source,
    })
}

#[cfg(test)]
mod tests {
    use std::io::Write;

    use super::Ledger;
    use crate::fate::Fate;
    use crate::generate::of_file;

    #[test]
    fn verdicts_are_kept_but_for_lack_of_time() {
        let folder = tempfile::tempdir().unwrap();
        let mutants = of_file("x.wesl", "fn f(a: f32) -> f32 { return a + 1.0; }").unwrap();
        let ledger = Ledger::open(folder.path(), "state", false).unwrap();
        assert!(ledger.known(&mutants[0]).is_none());
        let case = "a/random".to_owned();
        ledger.keep(&mutants[0], &Fate::Survived { cases: 3 }).unwrap();
        ledger.keep(&mutants[1], &Fate::TimedOut { case }).unwrap();
        let again = Ledger::open(folder.path(), "state", false).unwrap();
        assert_eq!(again.known(&mutants[0]), Some(&Fate::Survived { cases: 3 }));
        assert!(again.known(&mutants[1]).is_none());
        let other = Ledger::open(folder.path(), "other", false).unwrap();
        assert!(other.known(&mutants[0]).is_none());
        let fresh = Ledger::open(folder.path(), "state", true).unwrap();
        assert!(fresh.known(&mutants[0]).is_none());
    }

    #[test]
    fn a_line_cut_off_loses_nothing_else() {
        let folder = tempfile::tempdir().unwrap();
        let mutants = of_file("x.wesl", "fn f(a: f32) -> f32 { return a + 1.0; }").unwrap();
        let mut file = std::fs::File::create(folder.path().join("state.jsonl")).unwrap();
        file.write_all(b"{\"id\": \"x.wesl:f:swap").unwrap();
        let ledger = Ledger::open(folder.path(), "state", false).unwrap();
        ledger.keep(&mutants[0], &Fate::Unreached).unwrap();
        let again = Ledger::open(folder.path(), "state", false).unwrap();
        assert_eq!(again.known(&mutants[0]), Some(&Fate::Unreached));
    }
}
