//! The list of mutants that survive because they change no result that is promised, each with the reason.
//!
//! An entry is found by what it says, not by a line number: file, function or constant, operator, and the line before and after.
//! So edits elsewhere leave it alone, and an edit of the line itself makes it stale, which is an error: the reason has to be
//! thought about again. An entry whose mutant is caught after all is not needed and fails the run.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use serde::Deserialize;

use crate::error::Error;
use crate::mutant::Mutant;

/// The list.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct List {
    path: PathBuf,
    entries: Vec<Entry>,
}

/// One mutant that is equivalent to the original.
#[derive(Clone, Debug, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Entry {
    /// The file, below the shader folder.
    pub file: String,
    /// The function or constant.
    pub item: String,
    /// The operator.
    pub operator: String,
    /// The line before, as [`Mutant::was`].
    pub was: String,
    /// The line after, as [`Mutant::is`].
    pub is: String,
    /// Which of several that agree in all of this, from 1.
    #[serde(default = "first")]
    pub nth: usize,
    /// Why no output that is promised changes.
    pub reason: String,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Document {
    #[serde(default)]
    mutant: Vec<Entry>,
}

const fn first() -> usize {
    1
}

type Key<'a> = (&'a str, &'a str, &'a str, &'a str, &'a str, usize);

impl Entry {
    fn key(&self) -> Key<'_> {
        (
            &self.file,
            &self.item,
            &self.operator,
            &self.was,
            &self.is,
            self.nth,
        )
    }
}

fn key(mutant: &Mutant) -> Key<'_> {
    (
        &mutant.file,
        &mutant.item,
        mutant.operator,
        &mutant.was,
        &mutant.is,
        mutant.nth,
    )
}

impl List {
    /// Reads a list.
    ///
    /// # Errors
    /// [`Error::Read`]; [`Error::List`] for what is no list, an entry without a reason, or one that is there twice.
    pub fn read(path: &Path) -> Result<Self, Error> {
        let text = std::fs::read_to_string(path).map_err(|source| Error::Read {
            path: path.to_owned(),
            source,
        })?;
        Self::parse(path, &text)
    }

    /// The list that a text holds.
    ///
    /// # Errors
    /// As [`List::read`].
    pub fn parse(path: &Path, text: &str) -> Result<Self, Error> {
        let wrong = |message: String| Error::List {
            path: path.to_owned(),
            message,
        };
        let document: Document = toml::from_str(text).map_err(|error| wrong(error.to_string()))?;
        let mut seen = BTreeMap::new();
        for (number, entry) in (1..).zip(&document.mutant) {
            if entry.reason.trim().is_empty() {
                return Err(wrong(format!(
                    "entry {number} ({}, {}) gives no reason",
                    entry.file, entry.item
                )));
            }
            if let Some(earlier) = seen.insert(entry.key(), number) {
                return Err(wrong(format!("entry {number} says what entry {earlier} says")));
            }
        }
        Ok(Self {
            path: path.to_owned(),
            entries: document.mutant,
        })
    }

    /// The reason for a mutant, if it is listed.
    #[must_use]
    pub fn reason(&self, mutant: &Mutant) -> Option<&str> {
        let entry = self.entries.iter().find(|entry| entry.key() == key(mutant))?;
        Some(&entry.reason)
    }

    /// How many entries there are.
    #[must_use]
    pub fn len(&self) -> usize {
        self.entries.len()
    }

    /// Whether nothing is listed.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.entries.is_empty()
    }

    /// Each entry must fit a mutant.
    ///
    /// # Errors
    /// [`Error::Stale`] for the first that does not.
    pub fn check(&self, mutants: &[Mutant]) -> Result<(), Error> {
        let keys: std::collections::BTreeSet<Key<'_>> = mutants.iter().map(key).collect();
        let stale = (1..)
            .zip(&self.entries)
            .find(|(_, entry)| !keys.contains(&entry.key()));
        match stale {
            None => Ok(()),
            Some((number, entry)) => Err(Error::Stale {
                path: self.path.clone(),
                number,
                entry: Box::new(entry.clone()),
            }),
        }
    }
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::List;
    use crate::generate::of_file;

    const SHADER: &str = "fn f(a: f32) -> f32 {\n    return select(0.0, a, a >= 0.0);\n}\n";
    const ENTRY: &str = r#"
        [[mutant]]
        file = "lib/f.wesl"
        item = "f"
        operator = "swap_comparison"
        was = "return select(0.0, a, a >= 0.0);"
        is = "return select(0.0, a, a > 0.0);"
        reason = "at 0 both branches are 0"
    "#;

    fn parse(text: &str) -> Result<List, crate::Error> {
        List::parse(Path::new("equivalent.toml"), text)
    }

    #[test]
    fn an_entry_finds_its_mutant() {
        let mutants = of_file("lib/f.wesl", SHADER).unwrap();
        let list = parse(ENTRY).unwrap();
        list.check(&mutants).unwrap();
        let listed: Vec<&str> = mutants
            .iter()
            .filter(|mutant| list.reason(mutant).is_some())
            .map(|mutant| mutant.is.as_str())
            .collect();
        assert_eq!(listed, ["return select(0.0, a, a > 0.0);"]);
    }

    #[test]
    fn an_edited_line_makes_it_stale() {
        let edited = of_file("lib/f.wesl", &SHADER.replace("select(0.0,", "select(0.5,")).unwrap();
        let error = parse(ENTRY).unwrap().check(&edited).unwrap_err().to_string();
        assert!(
            error.contains("entry 1 (lib/f.wesl, f, swap_comparison) fits no mutant"),
            "{error}"
        );
    }

    #[test]
    fn a_bad_list_is_refused() {
        let unknown = parse(&ENTRY.replace("reason", "because"))
            .unwrap_err()
            .to_string();
        assert!(unknown.contains("because"), "{unknown}");
        let mute = parse(&ENTRY.replace("at 0 both branches are 0", " "))
            .unwrap_err()
            .to_string();
        assert!(mute.contains("gives no reason"), "{mute}");
        let twice = parse(&format!("{ENTRY}{ENTRY}")).unwrap_err().to_string();
        assert!(twice.contains("entry 2 says what entry 1 says"), "{twice}");
    }
}
