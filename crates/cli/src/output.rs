//! Files out: all or nothing, never half-written.
//!
//! A command collects everything it will write in an [`Outputs`], which refuses a path that two origins claim, and then
//! commits it once. Committing stages every file in a hidden folder beside its target, and only when all of them are
//! complete does it rename them into place. A full disk, a folder that cannot be written or a target that is a folder is
//! therefore found before the first visible change. A file that already holds the same bytes is left alone, its time
//! stamp included, so that build systems downstream see no change.
//!
//! Devices and pipes (`/dev/stdout`) are written directly: there is nothing to rename onto.
//!
//! Not promised: durability across a power failure (nothing is synced), or that a reader sees all renames at once.

use std::collections::BTreeMap;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use tempfile::TempDir;

use crate::error::{Error, Result};

/// Files that a command is going to write, keyed by path.
///
/// ```
/// use bossage_cli::output::Outputs;
///
/// let folder = tempfile::tempdir()?;
/// let mut outputs = Outputs::default();
/// outputs.add(folder.path().join("a.txt"), "the first input", b"one".to_vec())?;
/// assert!(outputs.add(folder.path().join("a.txt"), "the second input", b"two".to_vec()).is_err());
/// let written = outputs.commit()?;
/// assert_eq!(written.changed, 1);
/// assert_eq!(std::fs::read(folder.path().join("a.txt"))?, b"one");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Default)]
pub struct Outputs {
    files: BTreeMap<PathBuf, Planned>,
}

#[derive(Debug)]
struct Planned {
    path: PathBuf,
    origin: String,
    bytes: Vec<u8>,
}

/// What a commit did.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Written {
    /// Files that were created or replaced.
    pub changed: usize,
    /// Files that already held these bytes.
    pub unchanged: usize,
}

impl Outputs {
    /// Plans one file. `origin` names the input it comes from.
    ///
    /// # Errors
    /// [`Error::Collision`] when the path is planned already. Names that differ in case only collide too, because they
    /// do on the file systems of two of the three desktops.
    pub fn add(&mut self, path: PathBuf, origin: &str, bytes: Vec<u8>) -> Result<()> {
        let planned = Planned {
            path,
            origin: origin.to_owned(),
            bytes,
        };
        match self.files.entry(collision_key(&planned.path)) {
            std::collections::btree_map::Entry::Vacant(slot) => {
                slot.insert(planned);
                Ok(())
            }
            std::collections::btree_map::Entry::Occupied(slot) => Err(Error::Collision {
                output: planned.path,
                first: slot.get().origin.clone(),
                second: planned.origin,
            }),
        }
    }

    /// Writes everything, or nothing.
    ///
    /// # Errors
    /// [`Error::Write`] naming the file that could not be written.
    pub fn commit(self) -> Result<Written> {
        let mut staging = Staging::default();
        let mut unchanged = 0;
        for planned in self.files.values() {
            if !staging
                .stage(&planned.path, &planned.bytes)
                .map_err(|e| cannot_write(&planned.path, e))?
            {
                unchanged += 1;
            }
        }
        let changed = self.files.len() - unchanged;
        staging.publish()?;
        Ok(Written { changed, unchanged })
    }
}

/// Writes one file, completely or not at all.
///
/// # Errors
/// [`Error::Write`] naming the file.
pub fn write_whole(path: &Path, bytes: Vec<u8>) -> Result<()> {
    let mut outputs = Outputs::default();
    outputs.add(path.to_owned(), "", bytes)?;
    outputs.commit().map(drop)
}

/// Finds out early whether a file could be written, so that long work is not done for nothing. Leaves no trace.
///
/// # Errors
/// [`Error::Write`] naming the file.
pub fn check_writable(path: &Path) -> Result<()> {
    Staging::default()
        .stage(path, b"")
        .map(drop)
        .map_err(|e| cannot_write(path, e))
}

fn cannot_write(path: &Path, source: io::Error) -> Error {
    Error::Write {
        path: path.to_owned(),
        source,
    }
}

fn collision_key(path: &Path) -> PathBuf {
    let tidy: PathBuf = path.components().collect();
    match tidy.file_name().map(|name| name.to_string_lossy().to_lowercase()) {
        Some(name) => tidy.with_file_name(name),
        None => tidy,
    }
}

/// Complete files in hidden folders, waiting to be renamed; dropping it leaves no trace.
#[derive(Debug, Default)]
struct Staging {
    /// Folders that did not exist, outermost first: removed again (while empty) unless published.
    created: Vec<PathBuf>,
    folders: BTreeMap<PathBuf, TempDir>,
    moves: Vec<(PathBuf, PathBuf)>,
    direct: Vec<(PathBuf, Vec<u8>)>,
}

impl Staging {
    /// Stages one file; false when its target already holds these bytes.
    fn stage(&mut self, path: &Path, bytes: &[u8]) -> io::Result<bool> {
        let target = if path.is_symlink() {
            fs::canonicalize(path)?
        } else {
            path.to_owned()
        };
        match fs::metadata(&target) {
            Ok(meta) if meta.is_dir() => return Err(io::Error::other("it is a folder")),
            Ok(meta) if !meta.is_file() => {
                self.direct.push((target, bytes.to_vec()));
                return Ok(true);
            }
            Ok(meta) if holds(&target, &meta, bytes) => return Ok(false),
            _ => {}
        }
        let folder = parent(&target);
        self.create_folder(&folder)?;
        let staged = self
            .staging_folder(&folder)?
            .join(format!("{}", self.moves.len()));
        fs::write(&staged, bytes)?;
        self.moves.push((staged, target));
        Ok(true)
    }

    fn create_folder(&mut self, folder: &Path) -> io::Result<()> {
        let missing: Vec<&Path> = folder
            .ancestors()
            .take_while(|a| !a.as_os_str().is_empty() && !a.exists())
            .collect();
        for ancestor in missing.into_iter().rev() {
            match fs::create_dir(ancestor) {
                Ok(()) => self.created.push(ancestor.to_owned()),
                Err(e) if e.kind() == io::ErrorKind::AlreadyExists => {}
                Err(e) => return Err(e),
            }
        }
        Ok(())
    }

    fn staging_folder(&mut self, folder: &Path) -> io::Result<PathBuf> {
        if !self.folders.contains_key(folder) {
            let hidden = tempfile::Builder::new().prefix(".bossage-").tempdir_in(folder)?;
            self.folders.insert(folder.to_owned(), hidden);
        }
        Ok(self.folders[folder].path().to_owned())
    }

    fn publish(mut self) -> Result<()> {
        for (path, bytes) in &self.direct {
            fs::OpenOptions::new()
                .write(true)
                .open(path)
                .and_then(|mut file| io::Write::write_all(&mut file, bytes))
                .map_err(|e| cannot_write(path, e))?;
        }
        for (staged, target) in &self.moves {
            fs::rename(staged, target).map_err(|e| cannot_write(target, e))?;
        }
        self.created.clear();
        Ok(())
    }
}

impl Drop for Staging {
    fn drop(&mut self) {
        self.folders.clear();
        for folder in self.created.iter().rev() {
            // Not empty any more means that somebody else uses it: theirs now.
            let _ = fs::remove_dir(folder);
        }
    }
}

fn parent(path: &Path) -> PathBuf {
    match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder.to_owned(),
        _ => PathBuf::from("."),
    }
}

fn holds(path: &Path, meta: &fs::Metadata, bytes: &[u8]) -> bool {
    meta.len() == bytes.len() as u64 && fs::read(path).is_ok_and(|found| found == bytes)
}

#[cfg(test)]
mod tests {
    use crate::error::chain;

    use super::*;

    fn entries(folder: &Path) -> Vec<String> {
        let mut names: Vec<String> = fs::read_dir(folder)
            .unwrap()
            .map(|e| e.unwrap().file_name().into_string().unwrap())
            .collect();
        names.sort();
        names
    }

    #[test]
    fn two_origins_of_one_file_are_both_named() {
        let mut outputs = Outputs::default();
        outputs.add("out/x.spv".into(), "a/x.wgsl", vec![]).unwrap();
        let error = outputs
            .add("out/./X.spv".into(), "b/X.wgsl", vec![])
            .unwrap_err()
            .to_string();
        assert!(
            error.contains("a/x.wgsl") && error.contains("b/X.wgsl"),
            "{error}"
        );
        outputs.add("out/y.spv".into(), "b/X.wgsl", vec![]).unwrap();
    }

    #[test]
    fn one_bad_target_leaves_nothing_behind() {
        let folder = tempfile::tempdir().unwrap();
        let out = folder.path().join("deep/out");
        let blocked = folder.path().join("file");
        fs::write(&blocked, "I am a file").unwrap();
        let mut outputs = Outputs::default();
        outputs.add(out.join("good.txt"), "a", b"1".to_vec()).unwrap();
        outputs.add(blocked.join("bad.txt"), "b", b"2".to_vec()).unwrap();
        let error = outputs.commit().unwrap_err();
        assert_eq!(error.exit_code(), 2);
        assert!(error.to_string().contains("bad.txt"), "{error}");
        assert_eq!(
            entries(folder.path()),
            ["file"],
            "folders made on the way are removed too"
        );
    }

    #[test]
    fn asking_whether_a_file_can_be_written_leaves_no_trace() {
        let folder = tempfile::tempdir().unwrap();
        check_writable(&folder.path().join("a/b/c.json")).unwrap();
        assert!(entries(folder.path()).is_empty());
        fs::write(folder.path().join("file"), "").unwrap();
        assert!(check_writable(&folder.path().join("file/c.json")).is_err());
    }

    #[test]
    fn a_folder_in_the_way_is_found_before_the_first_rename() {
        let folder = tempfile::tempdir().unwrap();
        fs::create_dir(folder.path().join("z")).unwrap();
        let mut outputs = Outputs::default();
        outputs.add(folder.path().join("a"), "a", b"1".to_vec()).unwrap();
        outputs.add(folder.path().join("z"), "z", b"2".to_vec()).unwrap();
        assert!(chain(&outputs.commit().unwrap_err()).contains("folder"));
        assert_eq!(entries(folder.path()), ["z"]);
    }

    #[test]
    fn equal_bytes_keep_their_time_stamp() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a");
        write_whole(&path, b"1".to_vec()).unwrap();
        let stamp = fs::metadata(&path).unwrap().modified().unwrap();
        let mut outputs = Outputs::default();
        outputs.add(path.clone(), "a", b"1".to_vec()).unwrap();
        assert_eq!(
            outputs.commit().unwrap(),
            Written {
                changed: 0,
                unchanged: 1
            }
        );
        assert_eq!(fs::metadata(&path).unwrap().modified().unwrap(), stamp);
        write_whole(&path, b"2".to_vec()).unwrap();
        assert_eq!(fs::read(&path).unwrap(), b"2");
        assert_eq!(entries(folder.path()), ["a"]);
    }

    #[cfg(target_os = "linux")]
    #[test]
    fn a_full_device_is_an_error() {
        let error = write_whole(Path::new("/dev/full"), b"1".to_vec()).unwrap_err();
        assert!(error.to_string().contains("/dev/full"), "{error}");
        write_whole(Path::new("/dev/null"), b"1".to_vec()).unwrap();
    }
}
