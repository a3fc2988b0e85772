//! The regression corpus: hard inputs that hunts found, a file a probe, replayed by ordinary runs.
//!
//! A file is TOML: `schema = 1`, the probe's name, and one `[[found]]` an input with what it was found for, the output's number, the ULPs
//! that it reached then, the seed, and its numbers as hexadecimal floats, which are exact. A new find replaces an old one of the same
//! output and goal only where it reaches more. The files in `crates/conformance/corpus/` are part of the program; another folder is read
//! instead of them where one is named.

use std::collections::BTreeMap;
use std::fmt::Write;
use std::path::Path;

use bossage_shaders::{PROBES, Probe};
use include_dir::{Dir, include_dir};
use serde::Deserialize;

use super::Goal;
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
        let wrong = |message: String| Error::Corpus {
            file: name.to_owned(),
            message,
        };
        let file: File =
            toml::from_str(text).map_err(|error| wrong(error.to_string().trim_end().to_owned()))?;
        if file.schema != 1 {
            return Err(wrong(format!(
                "schema {} is not known here; write schema = 1",
                file.schema
            )));
        }
        let probe =
            find(&file.probe).ok_or_else(|| wrong(format!("the library has no probe `{}`", file.probe)))?;
        let mut corpus = Self::new(&file.probe);
        for (number, entry) in file.found.into_iter().enumerate() {
            let entry = entry
                .read(probe)
                .map_err(|problem| wrong(format!("found number {}: {problem}", number + 1)))?;
            corpus.found.push(entry);
        }
        Ok(corpus)
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
        let mut all: BTreeMap<(usize, Goal), Found> = BTreeMap::new();
        for found in self.found.drain(..).chain(other.found) {
            let key = (found.output, found.goal);
            if all.get(&key).is_none_or(|kept| found.ulps > kept.ulps) {
                all.insert(key, found);
            }
        }
        self.found = all.into_values().collect();
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
    let wrong = |path: &Path, message: String| Error::Corpus {
        file: path.display().to_string(),
        message,
    };
    let listed = std::fs::read_dir(folder).map_err(|error| wrong(folder, error.to_string()))?;
    let mut files = Vec::new();
    for entry in listed {
        let path = entry.map_err(|error| wrong(folder, error.to_string()))?.path();
        if path.extension().is_some_and(|extension| extension == "toml") {
            files.push(path);
        }
    }
    files.sort();
    let one = |path: &std::path::PathBuf| {
        let text = std::fs::read_to_string(path).map_err(|error| wrong(path, error.to_string()))?;
        Corpus::parse(&path.display().to_string(), &text)
    };
    files.iter().map(one).collect()
}

fn find(function: &str) -> Option<&'static Probe> {
    PROBES.iter().find(|probe| probe.function() == function)
}

/// A float as C writes it in hexadecimal: exact, and its bits can be read off.
pub(crate) fn hex(x: f32) -> String {
    let bits = x.to_bits();
    let sign = if bits >> 31 == 1 { "-" } else { "" };
    let (exponent, mantissa) = ((bits >> 23) & 0xff, bits & 0x007f_ffff);
    let (lead, power) = match exponent {
        0 if mantissa == 0 => return format!("{sign}0x0p+0"),
        0 => (0, -126),
        _ => (1, exponent as i32 - 127),
    };
    let digits = format!("{:06x}", mantissa << 1);
    let digits = digits.trim_end_matches('0');
    let point = if digits.is_empty() { "" } else { "." };
    format!("{sign}0x{lead}{point}{digits}p{power:+}")
}

/// Reads what [`hex`] writes.
pub(crate) fn unhex(text: &str) -> Result<f32, String> {
    let wrong = || format!("`{text}` is no hexadecimal float; they look like -0x1.8p-3");
    let (negative, rest) = match text.strip_prefix('-') {
        Some(rest) => (true, rest),
        None => (false, text),
    };
    let (digits, power) = rest
        .strip_prefix("0x")
        .and_then(|rest| rest.split_once('p'))
        .ok_or_else(wrong)?;
    let power: i32 = power.parse().map_err(|_| wrong())?;
    let (lead, fraction) = digits.split_once('.').unwrap_or((digits, ""));
    let all = format!("{lead}{fraction}");
    let known = all.len() <= 8 && !lead.is_empty() && (-200..=200).contains(&power);
    let mantissa = u32::from_str_radix(&all, 16)
        .ok()
        .filter(|_| known)
        .ok_or_else(wrong)?;
    let exact = f64::from(mantissa) * f64::from(power - 4 * fraction.len() as i32).exp2();
    let x = if negative { -exact } else { exact };
    if f64::from(x as f32) == x && x.is_finite() {
        Ok(x as f32)
    } else {
        Err(format!("`{text}` is no f32"))
    }
}

#[cfg(test)]
mod tests {
    use super::{Corpus, Found, embedded, hex, unhex};
    use crate::hunt::Goal;

    #[test]
    fn hexadecimal_floats_are_exact() {
        for x in [
            0.0,
            -0.0,
            1.0,
            -1.5,
            0.1,
            f32::MAX,
            f32::MIN_POSITIVE,
            1e-45,
            -1.175_493_2e-38,
            16_777_217.0,
        ] {
            let read = unhex(&hex(x)).unwrap();
            assert_eq!(read.to_bits(), x.to_bits(), "{x:?} is {}", hex(x));
        }
        assert_eq!(hex(0.1), "0x1.99999ap-4");
        for wrong in [
            "",
            "1.0",
            "0x",
            "0xp1",
            "0x1",
            "0x1.gp0",
            "0x1p999",
            "0x1.0000001p+0",
            "nan",
        ] {
            assert!(unhex(wrong).is_err(), "{wrong}");
        }
    }

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
        Corpus::parse("a.toml", text).unwrap();
        let wrong = |from: &str, to: &str, word: &str| {
            assert!(text.contains(from), "{from}");
            let message = Corpus::parse("a.toml", &text.replace(from, to))
                .unwrap_err()
                .to_string();
            assert!(message.contains("a.toml") && message.contains(word), "{message}");
        };
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
