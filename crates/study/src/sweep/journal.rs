//! Finished points, kept as they are finished, so that a study that is interrupted goes on where it stopped.
//!
//! A file of lines, each a JSON object with a key and a point, or the prices of a chart. The key is a hash of everything that determines them
//! but the machine's mood, so a point is found again exactly if it would come out the same. Lines are written whole and handed to the disk before the next
//! measurement begins. A process that is killed may leave the beginning of a line: it was not finished, and is cut off by the next run. A
//! line that is damaged otherwise is passed over and counted.
//!
//! Only one process at a time writes a journal: it holds the file's lock.

use std::collections::BTreeMap;
use std::fs::{File, OpenOptions, TryLockError};
use std::io::{Read, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};

use crate::error::Error;
use crate::record::{Point, Price};

/// The file's name in the folder of a study.
pub const NAME: &str = "points.jsonl";

/// A line.
#[derive(Serialize, Deserialize)]
struct Line {
    key: String,
    #[serde(flatten)]
    found: Found,
}

/// What a line keeps.
#[derive(Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
enum Found {
    Point(Box<Point>),
    Prices(Vec<Price>),
}

/// The points that are finished.
#[derive(Debug)]
pub struct Journal {
    path: PathBuf,
    file: File,
    points: BTreeMap<String, Point>,
    prices: BTreeMap<String, Vec<Price>>,
    /// Lines that could not be read.
    damaged: usize,
}

impl Journal {
    /// Opens the journal of a folder, which must be there, or begins one.
    ///
    /// # Errors
    /// When the file cannot be read or written, or another process writes it.
    pub fn open(folder: &Path) -> Result<Self, Error> {
        let path = folder.join(NAME);
        let wrong = |source| Error::Journal {
            path: path.clone(),
            source,
        };
        let mut options = OpenOptions::new();
        let file = options.read(true).write(true).create(true).truncate(false);
        let mut file = file.open(&path).map_err(wrong)?;
        match file.try_lock() {
            Ok(()) => {}
            Err(TryLockError::WouldBlock) => return Err(Error::Busy(path)),
            Err(TryLockError::Error(source)) => return Err(wrong(source)),
        }
        let mut bytes = Vec::new();
        file.read_to_end(&mut bytes).map_err(wrong)?;
        let whole = bytes
            .iter()
            .rposition(|byte| *byte == b'\n')
            .map_or(0, |at| at + 1);
        file.set_len(whole as u64).map_err(wrong)?;
        file.seek(SeekFrom::End(0)).map_err(wrong)?;
        let mut journal = Self {
            path,
            file,
            points: BTreeMap::new(),
            prices: BTreeMap::new(),
            damaged: 0,
        };
        for line in bytes[..whole]
            .split(|byte| *byte == b'\n')
            .filter(|line| !line.is_empty())
        {
            match serde_json::from_slice::<Line>(line) {
                Ok(line) => journal.remember(line),
                Err(_) => journal.damaged += 1,
            }
        }
        Ok(journal)
    }

    /// The point of that key, if it is finished.
    #[must_use]
    pub fn get(&self, key: &str) -> Option<&Point> {
        self.points.get(key)
    }

    /// How many points are finished.
    #[must_use]
    pub fn len(&self) -> usize {
        self.points.len()
    }

    /// Whether there are none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.points.is_empty()
    }

    /// How many lines of the file could not be read.
    #[must_use]
    pub fn damaged(&self) -> usize {
        self.damaged
    }

    /// The prices of that key, if they are finished.
    #[must_use]
    pub fn prices(&self, key: &str) -> Option<&[Price]> {
        self.prices.get(key).map(Vec::as_slice)
    }

    /// Keeps points that were measured together; they are on the disk when this returns.
    ///
    /// # Errors
    /// When they cannot be written.
    pub fn keep(&mut self, finished: Vec<(String, Point)>) -> Result<(), Error> {
        let line = |(key, point)| Line {
            key,
            found: Found::Point(Box::new(point)),
        };
        self.write(finished.into_iter().map(line))
    }

    /// Keeps the prices of a chart in the same way.
    ///
    /// # Errors
    /// When they cannot be written.
    pub fn keep_prices(&mut self, key: String, prices: Vec<Price>) -> Result<(), Error> {
        let found = Found::Prices(prices);
        self.write([Line { key, found }])
    }

    fn write(&mut self, finished: impl IntoIterator<Item = Line>) -> Result<(), Error> {
        let mut text = Vec::new();
        for line in finished {
            let mut line = serde_json::to_vec(&line).map_err(|error| self.wrong(error.into()))?;
            // As it will be read back: that may move the last bit of a number, and a study that goes on must come out the same.
            let read = serde_json::from_slice(&line).map_err(|error| self.wrong(error.into()))?;
            self.remember(read);
            text.append(&mut line);
            text.push(b'\n');
        }
        let written = self.file.write_all(&text).and_then(|()| self.file.sync_data());
        written.map_err(|source| self.wrong(source))
    }

    fn remember(&mut self, line: Line) {
        match line.found {
            Found::Point(point) => drop(self.points.insert(line.key, *point)),
            Found::Prices(prices) => drop(self.prices.insert(line.key, prices)),
        }
    }

    /// Forgets everything.
    ///
    /// # Errors
    /// When the file cannot be written.
    pub fn clear(&mut self) -> Result<(), Error> {
        self.points.clear();
        self.prices.clear();
        self.damaged = 0;
        let emptied = self.file.set_len(0).and_then(|()| self.file.rewind());
        emptied.map_err(|source| self.wrong(source))
    }

    fn wrong(&self, source: std::io::Error) -> Error {
        Error::Journal {
            path: self.path.clone(),
            source,
        }
    }
}

#[cfg(test)]
mod tests {
    use std::fs;

    use super::{Journal, NAME};
    use crate::error::Error;
    use crate::record::Point;

    fn point(name: &str) -> Point {
        Point {
            technique: name.to_owned(),
            view_deg: 60.1,
            ..Point::default()
        }
    }

    fn entry(key: &str) -> (String, Point) {
        (key.to_owned(), point(key))
    }

    #[test]
    fn what_was_kept_is_found_again() {
        let folder = tempfile::tempdir().unwrap();
        let mut journal = Journal::open(folder.path()).unwrap();
        assert!(journal.is_empty());
        journal.keep(vec![entry("a"), entry("b")]).unwrap();
        journal.keep(vec![entry("c")]).unwrap();
        journal.keep_prices("chart".to_owned(), Vec::new()).unwrap();
        drop(journal);
        let journal = Journal::open(folder.path()).unwrap();
        assert_eq!(journal.prices("chart"), Some([].as_slice()));
        assert_eq!((journal.len(), journal.damaged()), (3, 0));
        assert_eq!(journal.get("b"), Some(&point("b")));
        assert_eq!(journal.get("d"), None);
        assert_eq!(journal.prices("a"), None);
    }

    #[test]
    fn a_line_torn_anywhere_costs_that_line_alone() {
        let folder = tempfile::tempdir().unwrap();
        Journal::open(folder.path())
            .unwrap()
            .keep(vec![entry("a"), entry("b")])
            .unwrap();
        let path = folder.path().join(NAME);
        let whole = fs::read(&path).unwrap();
        let first = whole.iter().position(|byte| *byte == b'\n').unwrap() + 1;
        for end in first..whole.len() {
            fs::write(&path, &whole[..end]).unwrap();
            let mut journal = Journal::open(folder.path()).unwrap();
            assert_eq!((journal.len(), journal.damaged()), (1, 0), "cut at {end}");
            journal.keep(vec![entry("c")]).unwrap();
            drop(journal);
            let again = Journal::open(folder.path()).unwrap();
            assert_eq!((again.len(), again.damaged()), (2, 0), "cut at {end}");
            assert!(again.get("a").is_some() && again.get("c").is_some());
        }
    }

    #[test]
    fn a_damaged_line_in_the_middle_is_counted_and_the_rest_is_kept() {
        let folder = tempfile::tempdir().unwrap();
        Journal::open(folder.path())
            .unwrap()
            .keep(vec![entry("a"), entry("b"), entry("c")])
            .unwrap();
        let path = folder.path().join(NAME);
        let text = fs::read_to_string(&path)
            .unwrap()
            .replace("\"key\":\"b\"", "\"key\":\u{fffd}");
        fs::write(&path, text).unwrap();
        let journal = Journal::open(folder.path()).unwrap();
        assert_eq!((journal.len(), journal.damaged()), (2, 1));
    }

    #[test]
    fn two_writers_are_told() {
        let folder = tempfile::tempdir().unwrap();
        let first = Journal::open(folder.path()).unwrap();
        assert!(matches!(Journal::open(folder.path()), Err(Error::Busy(_))));
        drop(first);
        let mut second = Journal::open(folder.path()).unwrap();
        second.keep(vec![entry("a")]).unwrap();
        second.clear().unwrap();
        drop(second);
        assert!(Journal::open(folder.path()).unwrap().is_empty());
    }
}
