//! Verdicts kept between runs.
//!
//! One small JSON file a verdict, named by a hash of tool, version, arguments and content. An entry holds a checksum of
//! itself: one that is cut short, edited, or of another key is ignored and written anew.

use std::io::Write;
use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};

use crate::external::CheckState;
use crate::manifest::hex;

/// Hexadecimal digits of a checksum.
const SUM_DIGITS: usize = 64;

#[derive(Serialize, Deserialize)]
struct Entry {
    key: String,
    state: CheckState,
    message: String,
    checksum: String,
}

impl Entry {
    fn new(key: &str, state: CheckState, message: &str) -> Self {
        let mut entry = Self {
            key: key.to_owned(),
            state,
            message: message.to_owned(),
            checksum: String::new(),
        };
        entry.checksum = entry.sum();
        entry
    }

    fn sum(&self) -> String {
        digest(&[
            self.key.as_bytes(),
            format!("{:?}", self.state).as_bytes(),
            self.message.as_bytes(),
        ])
    }
}

/// A hash of byte strings that keeps them apart by their lengths.
pub(super) fn digest(parts: &[&[u8]]) -> String {
    let mut hash = Sha256::new();
    for part in parts {
        hash.update((part.len() as u64).to_le_bytes());
        hash.update(part);
    }
    hex(&hash.finalize())
}

/// The key of a verdict.
pub(super) fn key(tool: &str, version: &str, arguments: &[String], content: &[u8]) -> String {
    let mut parts = vec![tool.as_bytes(), version.as_bytes()];
    parts.extend(arguments.iter().map(String::as_bytes));
    parts.push(content);
    format!("{tool}-{}", digest(&parts))
}

fn path(dir: &Path, key: &str) -> PathBuf {
    dir.join(format!("{key}.json"))
}

/// A verdict that is kept and whole.
pub(super) fn read(dir: &Path, key: &str) -> Option<(CheckState, String)> {
    let bytes = std::fs::read(path(dir, key)).ok()?;
    let entry: Entry = serde_json::from_slice(&bytes).ok()?;
    let whole = entry.key == key && entry.checksum == entry.sum();
    whole.then_some((entry.state, entry.message))
}

/// Keeps a verdict: written beside, then renamed. What cannot be written is not kept.
pub(super) fn write(dir: &Path, key: &str, state: CheckState, message: &str) {
    let _ = try_write(dir, key, state, message);
}

fn try_write(dir: &Path, key: &str, state: CheckState, message: &str) -> std::io::Result<()> {
    std::fs::create_dir_all(dir)?;
    let mut file = tempfile::NamedTempFile::new_in(dir)?;
    file.write_all(&serde_json::to_vec(&Entry::new(key, state, message))?)?;
    file.persist(path(dir, key))?;
    Ok(())
}

/// What a tool made, if it is kept and whole.
pub(super) fn read_object(dir: &Path, key: &str) -> Option<Vec<u8>> {
    let bytes = std::fs::read(dir.join(key)).ok()?;
    let (sum, object) = bytes.split_at_checked(SUM_DIGITS)?;
    (sum == digest(&[key.as_bytes(), object]).as_bytes()).then(|| object.to_vec())
}

/// Keeps what a tool made, behind its checksum. What cannot be written is not kept.
pub(super) fn write_object(dir: &Path, key: &str, object: &[u8]) {
    let write = || -> std::io::Result<()> {
        std::fs::create_dir_all(dir)?;
        let mut file = tempfile::NamedTempFile::new_in(dir)?;
        file.write_all(digest(&[key.as_bytes(), object]).as_bytes())?;
        file.write_all(object)?;
        file.persist(dir.join(key))?;
        Ok(())
    };
    let _ = write();
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_verdict_comes_back() {
        let dir = tempfile::tempdir().unwrap();
        let dir = dir.path().join("made/when/needed");
        let key = key("tool", "1", &[], b"x");
        assert_eq!(read(&dir, &key), None);
        write(&dir, &key, CheckState::Fail, "bad");
        assert_eq!(read(&dir, &key), Some((CheckState::Fail, "bad".to_owned())));
    }

    #[test]
    fn everything_counts_for_the_key() {
        let a = |s: &str| vec![s.to_owned()];
        let keys = [
            key("t", "1", &a("x"), b"c"),
            key("u", "1", &a("x"), b"c"),
            key("t", "2", &a("x"), b"c"),
            key("t", "1", &a("y"), b"c"),
            key("t", "1", &a("x"), b"d"),
            key("t", "1x", &a(""), b"c"),
        ];
        let distinct: std::collections::BTreeSet<&String> = keys.iter().collect();
        assert_eq!(distinct.len(), keys.len());
    }

    #[test]
    fn a_corrupt_entry_is_ignored_and_rewritten() {
        let dir = tempfile::tempdir().unwrap();
        let key = key("tool", "1", &[], b"x");
        write(dir.path(), &key, CheckState::Pass, "");
        let file = path(dir.path(), &key);
        let whole = std::fs::read_to_string(&file).unwrap();
        for broken in [&whole[..whole.len() / 2], "", &whole.replace("pass", "fail")] {
            std::fs::write(&file, broken).unwrap();
            assert_eq!(read(dir.path(), &key), None, "{broken}");
        }
        write(dir.path(), &key, CheckState::Pass, "");
        assert_eq!(read(dir.path(), &key), Some((CheckState::Pass, String::new())));
    }

    #[test]
    fn an_object_comes_back_whole_or_not_at_all() {
        let dir = tempfile::tempdir().unwrap();
        write_object(dir.path(), "key", b"object");
        assert_eq!(read_object(dir.path(), "key").as_deref(), Some(&b"object"[..]));
        std::fs::copy(dir.path().join("key"), dir.path().join("other")).unwrap();
        assert_eq!(read_object(dir.path(), "other"), None);
        let whole = std::fs::read(dir.path().join("key")).unwrap();
        for broken in [&whole[..whole.len() - 1], &whole[..10], b""] {
            std::fs::write(dir.path().join("key"), broken).unwrap();
            assert_eq!(read_object(dir.path(), "key"), None);
        }
    }
}
