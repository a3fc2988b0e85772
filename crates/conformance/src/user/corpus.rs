//! Hard inputs of a user's shader: what hunts found of it, kept in a file beside it and replayed by later runs.
//!
//! A file is TOML: `schema = 1`, the shader's name, and one `[[found]]` an input with its entry point, what it was found for, the output's
//! name, the ULPs that it reached then, the seed, and all inputs by name, as hexadecimal floats or, where no f32 is that number, as decimals
//! that are exact in f64. A new find replaces an old one of the same entry point, output and goal only where it reaches more.

use std::collections::BTreeMap;
use std::fmt::Write;

use bossage_bounds::ranges::{Inputs, Point};
use serde::Deserialize;

use crate::error::Error;
use crate::hunt::Goal;
use crate::hunt::file::{self, hex, unhex, wrong};

/// The hard inputs of a shader.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Corpus {
    /// What messages call it.
    pub file: String,
    /// The shader's name: its file's without the extension.
    pub shader: String,
    /// The inputs, by entry point, output and goal.
    pub found: Vec<Found>,
}

/// One hard input.
#[derive(Clone, Debug, PartialEq)]
pub struct Found {
    /// The entry point.
    pub entry: String,
    /// What it was found for.
    pub goal: Goal,
    /// The output's name.
    pub output: String,
    /// How many ULPs it reached; infinite where an output lay outside of its interval.
    pub ulps: f64,
    /// The seed of the hunt.
    pub seed: u64,
    /// Scalars by the name of the input that they belong to.
    pub inputs: BTreeMap<String, Vec<f64>>,
    /// Texels, four channels each, by the name of the texture.
    pub texels: BTreeMap<String, Vec<f64>>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct File {
    schema: u32,
    shader: String,
    #[serde(default)]
    found: Vec<Entry>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Entry {
    entry: String,
    goal: Goal,
    output: String,
    ulps: f64,
    seed: u64,
    #[serde(default)]
    inputs: BTreeMap<String, Vec<String>>,
    #[serde(default)]
    texels: BTreeMap<String, Vec<String>>,
}

impl file::File for File {
    fn schema(&self) -> u32 {
        self.schema
    }
}

impl Corpus {
    /// An empty one.
    #[must_use]
    pub fn new(file: &str, shader: &str) -> Self {
        Self {
            file: file.to_owned(),
            shader: shader.to_owned(),
            found: Vec::new(),
        }
    }

    /// Reads a file; `name` is what messages call it.
    ///
    /// # Errors
    /// [`Error::Corpus`], with the place where the file is no TOML or has an unknown key.
    pub fn parse(name: &str, text: &str) -> Result<Self, Error> {
        let file: File = file::parse(name, text)?;
        Ok(Self {
            file: name.to_owned(),
            shader: file.shader,
            found: file::entries(name, file.found, Entry::read)?,
        })
    }

    /// The file's text.
    #[must_use]
    pub fn text(&self) -> String {
        let mut text = format!(
            "# Hard inputs that `bossage conform --hunt --shader` found; `bossage conform --shader` replays them.\n\
            schema = 1\nshader = {}\n",
            quoted(&self.shader)
        );
        for found in &self.found {
            let _ = write!(
                text,
                "\n[[found]]\nentry = {}\ngoal = \"{}\"\noutput = {}\nulps = {}\nseed = {}\n",
                quoted(&found.entry),
                found.goal.name(),
                quoted(&found.output),
                if found.ulps.is_finite() {
                    format!("{:?}", found.ulps)
                } else {
                    "inf".to_owned()
                },
                found.seed,
            );
            for (title, table) in [("inputs", &found.inputs), ("texels", &found.texels)] {
                if !table.is_empty() {
                    let _ = writeln!(text, "[found.{title}]");
                }
                for (name, values) in table {
                    let values: Vec<String> = values.iter().map(|x| format!("\"{}\"", written(*x))).collect();
                    let _ = writeln!(text, "{} = [{}]", quoted(name), values.join(", "));
                }
            }
        }
        text
    }

    /// Takes over what another has found, where it reaches more.
    pub fn merge(&mut self, other: Vec<Found>) {
        let key = |found: &Found| (found.entry.clone(), found.output.clone(), found.goal);
        let all = self.found.drain(..).chain(other);
        self.found = file::best(all, key, |found| found.ulps);
    }

    /// The inputs of an entry point.
    ///
    /// # Errors
    /// [`Error::Corpus`] where they are not those that the shader has, or lie outside of their ranges.
    pub(super) fn points(&self, entry: &str, inputs: &Inputs) -> Result<Vec<Point>, Error> {
        let numbered = (1..).zip(&self.found);
        let own = numbered.filter(|(_, found)| found.entry == entry);
        own.map(|(number, found)| {
            found.point(inputs).map_err(|problem| {
                wrong(
                    &self.file,
                    format!(
                        "found number {number}: {problem}; the shader or its ranges have changed since: take this entry out, or hunt again"
                    ),
                )
            })
        })
        .collect()
    }

    /// Every entry point must be one that the shader has.
    pub(super) fn check(&self, known: &[String]) -> Result<(), Error> {
        match self.found.iter().find(|found| !known.contains(&found.entry)) {
            None => Ok(()),
            Some(found) => Err(wrong(
                &self.file,
                format!(
                    "the shader has no entry point `{}`; it has: {}",
                    found.entry,
                    known.join(", ")
                ),
            )),
        }
    }
}

impl Entry {
    fn read(self) -> Result<Found, String> {
        let table = |table: BTreeMap<String, Vec<String>>| {
            table
                .into_iter()
                .map(|(name, texts)| {
                    let values = texts
                        .iter()
                        .map(|text| number(text))
                        .collect::<Result<Vec<f64>, _>>()?;
                    Ok((name, values))
                })
                .collect::<Result<BTreeMap<_, _>, String>>()
        };
        Ok(Found {
            entry: self.entry,
            goal: self.goal,
            output: self.output,
            ulps: self.ulps,
            seed: self.seed,
            inputs: table(self.inputs)?,
            texels: table(self.texels)?,
        })
    }
}

impl Found {
    /// The inputs of a point by name.
    pub(crate) fn tables(inputs: &Inputs, point: &Point) -> [BTreeMap<String, Vec<f64>>; 2] {
        let groups = names(inputs.groups.iter().map(|group| group.name.as_str()));
        let scalars = groups.into_iter().zip(&inputs.groups);
        let textures = names(inputs.textures.iter().map(|texture| texture.name.as_str()));
        [
            scalars
                .map(|(name, group)| (name, point.values[group.scalars.clone()].to_vec()))
                .collect(),
            textures.into_iter().zip(point.texels.iter().cloned()).collect(),
        ]
    }

    fn point(&self, inputs: &Inputs) -> Result<Point, String> {
        let mut point = Point {
            values: vec![0.0; inputs.scalars.len()],
            texels: Vec::new(),
        };
        let groups = names(inputs.groups.iter().map(|group| group.name.as_str()));
        for (name, group) in groups.iter().zip(&inputs.groups) {
            let values = take(&self.inputs, name, group.scalars.len())?;
            point.values[group.scalars.clone()].copy_from_slice(values);
        }
        let textures = names(inputs.textures.iter().map(|texture| texture.name.as_str()));
        for (name, texture) in textures.iter().zip(&inputs.textures) {
            point
                .texels
                .push(take(&self.texels, name, 4 * texture.texel_count())?.to_vec());
        }
        let unknown = |table: &BTreeMap<String, Vec<f64>>, known: &[String]| {
            table.keys().find(|name| !known.contains(name)).cloned()
        };
        if let Some(name) = unknown(&self.inputs, &groups).or_else(|| unknown(&self.texels, &textures)) {
            return Err(format!("the shader has no input `{name}`"));
        }
        let outside = inputs
            .groups
            .iter()
            .find(|group| !group.admits(&point.values[group.scalars.clone()]));
        match outside {
            Some(group) => Err(format!("`{}` lies outside of its range", group.name)),
            None => Ok(point),
        }
    }
}

fn take<'a>(table: &'a BTreeMap<String, Vec<f64>>, name: &str, wanted: usize) -> Result<&'a [f64], String> {
    let values = table
        .get(name)
        .ok_or_else(|| format!("the input `{name}` is missing"))?;
    match values.len() {
        given if given == wanted => Ok(values),
        given => Err(format!("`{name}` has {given} numbers, the shader takes {wanted}")),
    }
}

/// Names that differ: what comes again gets a number.
fn names<'a>(list: impl Iterator<Item = &'a str>) -> Vec<String> {
    let mut seen: BTreeMap<&str, usize> = BTreeMap::new();
    list.map(|name| {
        let count = seen.entry(name).or_default();
        *count += 1;
        match *count {
            1 => name.to_owned(),
            again => format!("{name}#{again}"),
        }
    })
    .collect()
}

fn quoted(text: &str) -> String {
    // Every escape of JSON is one of TOML's basic strings.
    serde_json::to_string(text).unwrap_or_default()
}

/// A number, exactly.
fn written(x: f64) -> String {
    let single = x as f32;
    if single.is_finite() && f64::from(single).to_bits() == x.to_bits() {
        hex(single)
    } else {
        format!("{x:?}")
    }
}

fn number(text: &str) -> Result<f64, String> {
    if text.trim_start_matches('-').starts_with("0x") {
        return unhex(text).map(f64::from);
    }
    match text.parse::<f64>() {
        Ok(x) if x.is_finite() => Ok(x),
        _ => Err(format!(
            "`{text}` is no number; they look like -0x1.8p-3 or 16777217.0"
        )),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::hunt::file::tests::refuses;

    fn found(output: &str, ulps: f64) -> Found {
        Found {
            entry: "main".to_owned(),
            goal: Goal::Error,
            output: output.to_owned(),
            ulps,
            seed: 1,
            inputs: BTreeMap::from([(
                "a.b[3].\"x\"".to_owned(),
                vec![0.1_f32.into(), -0.0, 4_294_967_295.0],
            )]),
            texels: BTreeMap::from([("map".to_owned(), vec![0.5; 4])]),
        }
    }

    #[test]
    fn a_file_reads_back_and_keeps_the_best() {
        let mut corpus = Corpus::new("a.corpus.toml", "a");
        corpus.merge(vec![
            found("r[0]", 2.0),
            found("r[1]", f64::INFINITY),
            found("r[0]", 1.0),
        ]);
        assert_eq!(corpus.found.len(), 2);
        assert_eq!(corpus.found[0].ulps, 2.0);
        let read = Corpus::parse("a.corpus.toml", &corpus.text()).unwrap();
        assert_eq!(read, corpus);
        let bits = |corpus: &Corpus| corpus.found[0].inputs.values().next().unwrap()[1].to_bits();
        assert_eq!(bits(&read), (-0.0_f64).to_bits(), "the sign of zero stays");
    }

    #[test]
    fn what_is_wrong_with_a_file_is_said() {
        let mut corpus = Corpus::new("a.toml", "a");
        corpus.merge(vec![found("r", 2.0)]);
        let text = corpus.text();
        let wrong = |from: &str, to: &str, word: &str| refuses(Corpus::parse, &text, (from, to, word));
        wrong("schema = 1", "schema = 9", "schema 9");
        wrong("goal = \"error\"", "goal = \"eror\"", "eror");
        wrong("seed = 1", "sed = 1", "sed");
        wrong("4294967295.0", "nan", "no number");
        corpus.check(&["main".to_owned()]).unwrap();
        let error = corpus.check(&["other".to_owned()]).unwrap_err().to_string();
        assert!(error.contains("`main`") && error.contains("other"), "{error}");
    }
}
