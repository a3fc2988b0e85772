//! The regression corpus: hard inputs that hunts found, a file a probe, replayed by ordinary runs.
//!
//! A file is TOML: `schema = 1`, the probe's name, and one `[[found]]` an input with what it was found for, the output's number, the ULPs
//! that it reached then, the seed, and its numbers as hexadecimal floats, which are exact. A new find replaces an old one of the same
//! output and goal only where it reaches more. The files in `crates/conformance/corpus/` are part of the program; another folder is read
//! instead of them where one is named.

use std::fmt::Write;
use std::path::Path;

use bossage_shaders::{PROBES, Probe};
use include_dir::{Dir, include_dir};
use serde::Deserialize;

use super::Goal;
use super::file::{self, hex, unhex, wrong};
use crate::error::Error;

static EMBEDDED: Dir<'_> = include_dir!("$CARGO_MANIFEST_DIR/corpus");

/// The hard inputs of a probe.
#[derive(Clone, Debug, PartialEq)]
pub struct Corpus {
    /// The probe's function.
    pub probe: String,
    /// The inputs, by output and goal.
    pub found: Vec<Found>,
}

/// One hard input.
#[derive(Clone, Debug, PartialEq)]
pub struct Found {
    /// What it was found for.
    pub goal: Goal,
    /// The output's number.
    pub output: usize,
    /// How many ULPs it reached.
    pub ulps: f64,
    /// The seed of the hunt.
    pub seed: u64,
    /// The item's floats.
    pub input: Vec<f32>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct File {
    schema: u32,
    probe: String,
    #[serde(default)]
    found: Vec<Entry>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Entry {
    goal: Goal,
    output: usize,
    ulps: f64,
    seed: u64,
    input: Vec<String>,
}

impl file::File for File {
    fn schema(&self) -> u32 {
        self.schema
    }
}

impl Corpus {
    /// An empty one.
    #[must_use]
    pub fn new(probe: &str) -> Self {
        Self {
            probe: probe.to_owned(),
            found: Vec::new(),
        }
    }

    /// Reads a file; `name` is what messages call it.
    ///
    /// # Errors
    /// [`Error::Corpus`], with the place where the file is no TOML or has an unknown key, or what does not fit the probe.
    pub fn parse(name: &str, text: &str) -> Result<Self, Error> {
        let file: File = file::parse(name, text)?;
        let probe = find(&file.probe)
            .ok_or_else(|| wrong(name, format!("the library has no probe `{}`", file.probe)))?;
        Ok(Self {
            found: file::entries(name, file.found, |entry| entry.read(probe))?,
            probe: file.probe,
        })
    }

    /// The file's text.
    #[must_use]
    pub fn text(&self) -> String {
        let mut text = format!(
            "# Hard inputs that `bossage conform --hunt` found; ordinary runs replay them.\nschema = 1\nprobe = \"{}\"\n",
            self.probe
        );
        for found in &self.found {
            let input: Vec<String> = found.input.iter().map(|x| format!("\"{}\"", hex(*x))).collect();
            let _ = write!(
                text,
                "\n[[found]]\ngoal = \"{}\"\noutput = {}\nulps = {:?}\nseed = {}\ninput = [{}]\n",
                found.goal.name(),
                found.output,
                found.ulps,
                found.seed,
                input.join(", ")
            );
        }
        text
    }

    /// Takes over what another has found, where it reaches more.
    pub fn merge(&mut self, other: Self) {
        let all = self.found.drain(..).chain(other.found);
        self.found = file::best(all, |found| (found.output, found.goal), |found| found.ulps);
    }
}

impl Entry {
    fn read(self, probe: &Probe) -> Result<Found, String> {
        let input: Vec<f32> = self
            .input
            .iter()
            .map(|text| unhex(text))
            .collect::<Result<_, _>>()?;
        if input.len() != probe.input_floats.max(1) {
            let (given, wanted) = (input.len(), probe.input_floats.max(1));
            return Err(format!(
                "{given} numbers are given, `{}` takes {wanted}",
                probe.function()
            ));
        }
        if self.output >= probe.output_floats {
            let n = probe.output_floats;
            return Err(format!("output {} of {n}, counted from 0", self.output));
        }
        Ok(Found {
            goal: self.goal,
            output: self.output,
            ulps: self.ulps,
            seed: self.seed,
            input,
        })
    }
}

/// The files that are part of the program.
///
/// # Errors
/// [`Error::Corpus`]; a test reads them all.
pub fn embedded() -> Result<Vec<Corpus>, Error> {
    let files = EMBEDDED
        .files()
        .filter(|file| file.path().extension().is_some_and(|e| e == "toml"));
    files
        .map(|file| {
            let name = file.path().display().to_string();
            Corpus::parse(&name, file.contents_utf8().unwrap_or_default())
        })
        .collect()
}

/// The files of a folder, sorted.
///
/// # Errors
/// [`Error::Corpus`].
pub fn read(folder: &Path) -> Result<Vec<Corpus>, Error> {
    let failed = |path: &Path, error: std::io::Error| wrong(&path.display().to_string(), error.to_string());
    let listed = std::fs::read_dir(folder).map_err(|error| failed(folder, error))?;
    let mut files = Vec::new();
    for entry in listed {
        let path = entry.map_err(|error| failed(folder, error))?.path();
        if path.extension().is_some_and(|extension| extension == "toml") {
            files.push(path);
        }
    }
    files.sort();
    let one = |path: &std::path::PathBuf| {
        let text = std::fs::read_to_string(path).map_err(|error| failed(path, error))?;
        Corpus::parse(&path.display().to_string(), &text)
    };
    files.iter().map(one).collect()
}

fn find(function: &str) -> Option<&'static Probe> {
    PROBES.iter().find(|probe| probe.function() == function)
}

#[cfg(test)]
mod tests {
    use super::{Corpus, Found, embedded};
    use crate::hunt::Goal;
    use crate::hunt::file::tests::refuses;

    fn found(output: usize, goal: Goal, ulps: f64) -> Found {
        Found {
            goal,
            output,
            ulps,
            seed: 1,
            input: vec![0.25, -1.0, 3.0],
        }
    }

    #[test]
    fn a_file_reads_back_and_keeps_the_best() {
        let mut corpus = Corpus::new("normalise");
        corpus.found = vec![found(0, Goal::Error, 2.0), found(1, Goal::Width, 9.0)];
        let read = Corpus::parse("normalise.toml", &corpus.text()).unwrap();
        assert_eq!(read, corpus);
        let mut other = Corpus::new("normalise");
        other.found = vec![
            found(0, Goal::Error, 3.0),
            found(1, Goal::Width, 8.0),
            found(0, Goal::Width, 1.0),
        ];
        corpus.merge(other);
        let kept: Vec<(usize, Goal, f64)> = corpus
            .found
            .iter()
            .map(|one| (one.output, one.goal, one.ulps))
            .collect();
        assert_eq!(
            kept,
            [
                (0, Goal::Error, 3.0),
                (0, Goal::Width, 1.0),
                (1, Goal::Width, 9.0)
            ]
        );
    }

    #[test]
    fn what_is_wrong_with_a_file_is_said() {
        let text = "schema = 1\nprobe = \"normalise\"\n[[found]]\ngoal = \"error\"\noutput = 0\nulps = 1.0\nseed = 1\ninput = [\"0x1p+0\", \"0x0p+0\", \"0x0p+0\"]\n";
        let wrong = |from: &str, to: &str, word: &str| refuses(Corpus::parse, text, (from, to, word));
        wrong("schema = 1", "schema = 2", "schema 2");
        wrong("normalise", "normalize", "`normalize`");
        wrong("goal = \"error\"", "goal = \"eror\"", "eror");
        wrong("output = 0", "output = 7", "output 7 of 3");
        wrong("seed = 1", "sed = 1", "sed");
        wrong("\"0x1p+0\", ", "", "2 numbers");
        wrong("0x1p+0", "1.0", "hexadecimal");
        wrong("ulps = 1.0", "ulps = ", "line 6");
    }

    #[test]
    fn the_embedded_files_are_right_and_called_after_their_probes() {
        for corpus in embedded().unwrap() {
            assert!(!corpus.found.is_empty(), "{}", corpus.probe);
            assert!(
                super::EMBEDDED
                    .get_file(format!("{}.toml", corpus.probe))
                    .is_some(),
                "{}",
                corpus.probe
            );
        }
    }
}
