//! Which techniques are swept, with which settings, and how they are written on the command line.
//!
//! The settings are those that engines ship or that stand in the techniques' sources; `relief` is layers + bisections. A technique is written
//! `relief`, which means all of its settings here, or `relief:layers=16,refinements=5`, which means just these.

use std::collections::BTreeMap;
use std::fmt;

use bossage_reference::relief_search::Search;
use bossage_shaders::{AssembledShader, HeightRead, Kernel, Library, ReliefSearch, ReliefTechnique};

use crate::error::Error;
use crate::record::Settings;

/// A technique of the library, and what it takes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Technique {
    /// The id, everywhere.
    pub id: &'static str,
    /// The names of its settings, in the order of [`Technique::swept`].
    pub takes: &'static [&'static str],
    /// The settings that a sweep has by default.
    pub swept: &'static [&'static [u32]],
    /// Whether a quick sweep has it, and then with its settings at these places of [`Technique::swept`].
    pub quick: &'static [usize],
}

/// All of them, from the cheapest form to the exact one.
pub const LADDER: &[Technique] = &[
    Technique {
        id: "parallax_offset",
        takes: &[],
        swept: &[&[]],
        quick: &[0],
    },
    Technique {
        id: "parallax_offset_limited",
        takes: &[],
        swept: &[&[]],
        quick: &[0],
    },
    Technique {
        id: "parallax_iterative",
        takes: &["iterations"],
        swept: &[&[4], &[8]],
        quick: &[0],
    },
    Technique {
        id: "steep_parallax",
        takes: &["layers"],
        swept: &[&[16], &[64]],
        quick: &[0],
    },
    Technique {
        id: "parallax_occlusion",
        takes: &["layers"],
        swept: &[&[8], &[16], &[32], &[64], &[128], &[256]],
        quick: &[1, 3],
    },
    Technique {
        id: "relief",
        takes: &["layers", "refinements"],
        swept: &[&[8, 4], &[16, 5], &[32, 6], &[64, 6], &[128, 6]],
        quick: &[1],
    },
    Technique {
        id: "cone_step",
        takes: &["steps"],
        swept: &[&[16], &[64]],
        quick: &[0],
    },
    Technique {
        id: "relaxed_cone_step",
        takes: &["steps", "refinements"],
        swept: &[&[8, 6], &[15, 6]],
        quick: &[1],
    },
    Technique {
        id: "exact",
        takes: &[],
        swept: &[&[]],
        quick: &[0],
    },
];

/// The entry point of all of them.
pub const ENTRY: &str = "relief_hits";

/// The kernel that runs a technique: heights through the sampler's filter, as engines read them.
///
/// # Errors
/// When the sources do not assemble.
pub fn assemble(library: &Library, technique: &Technique) -> Result<AssembledShader, Error> {
    let search = ReliefSearch {
        technique: ReliefTechnique::find(technique.id).ok_or_else(|| unknown(technique.id))?,
        heights: HeightRead::Filtered,
    };
    Ok(library.assemble_kernel(Kernel::ReliefHits(search))?)
}

/// The largest number that a setting takes: what the library's kernel stops at.
pub const MOST: u32 = 4096;

/// A technique with its settings.
#[derive(Clone, Debug, PartialEq)]
pub struct Chosen {
    /// Which.
    pub technique: &'static Technique,
    /// One number for each name that it takes.
    pub values: Vec<u32>,
}

impl Chosen {
    /// Names and numbers.
    #[must_use]
    pub fn settings(&self) -> Settings {
        let pairs = self.technique.takes.iter().zip(&self.values);
        Settings(
            pairs
                .map(|(name, value)| ((*name).to_owned(), f64::from(*value)))
                .collect(),
        )
    }

    /// The same search in f64.
    #[must_use]
    pub fn search(&self) -> Option<Search> {
        let setting = |name| self.setting(name).unwrap_or(1);
        let (layers, refinements, steps) = (setting("layers"), setting("refinements"), setting("steps"));
        match ReliefTechnique::find(self.technique.id)? {
            ReliefTechnique::ParallaxOffset => Some(Search::ParallaxOffset),
            ReliefTechnique::ParallaxOffsetLimited => Some(Search::ParallaxOffsetLimited),
            ReliefTechnique::ParallaxIterative => Some(Search::ParallaxIterative {
                iterations: setting("iterations"),
            }),
            ReliefTechnique::SteepParallax => Some(Search::SteepParallax { layers }),
            ReliefTechnique::ParallaxOcclusion => Some(Search::ParallaxOcclusion { layers }),
            ReliefTechnique::Relief => Some(Search::Relief { layers, refinements }),
            ReliefTechnique::ConeStep => Some(Search::ConeStep { steps }),
            ReliefTechnique::RelaxedConeStep => Some(Search::RelaxedConeStep { steps, refinements }),
            ReliefTechnique::Exact => Some(Search::Exact),
        }
    }

    /// The number of that name.
    #[must_use]
    pub fn setting(&self, name: &str) -> Option<u32> {
        let at = self.technique.takes.iter().position(|known| *known == name)?;
        self.values.get(at).copied()
    }
}

/// As the command line takes it.
impl fmt::Display for Chosen {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.technique.id)?;
        for (index, (name, value)) in self.technique.takes.iter().zip(&self.values).enumerate() {
            let before = if index == 0 { ':' } else { ',' };
            write!(f, "{before}{name}={value}")?;
        }
        Ok(())
    }
}

/// What a sweep has by default: what the kernel runs.
#[must_use]
pub fn default_choice(quick: bool) -> Vec<Chosen> {
    LADDER
        .iter()
        .filter(|technique| ReliefTechnique::find(technique.id).is_some())
        .flat_map(|technique| {
            let all = 0..technique.swept.len();
            all.filter(move |at| !quick || technique.quick.contains(at))
                .map(move |at| Chosen {
                    technique,
                    values: technique.swept[at].to_vec(),
                })
        })
        .collect()
}

/// Reads one technique of the command line: all of its settings, or the ones given.
///
/// # Errors
/// A name or a setting that is not known, with the nearest one; a number that is none, is 0 or above [`MOST`]; a setting that is missing.
pub fn parse(text: &str) -> Result<Vec<Chosen>, Error> {
    let (name, settings) = text
        .split_once(':')
        .map_or((text, None), |(name, rest)| (name, Some(rest)));
    let technique = find(name)?;
    let Some(settings) = settings else {
        return Ok(technique
            .swept
            .iter()
            .map(|values| Chosen {
                technique,
                values: values.to_vec(),
            })
            .collect());
    };
    let mut given = BTreeMap::new();
    for part in settings.split(',') {
        let (name, value) = setting(technique, text, part)?;
        if given.insert(name, value).is_some() {
            return Err(Error::Technique(format!("`{text}`: `{name}` is there twice")));
        }
    }
    let value = |name: &&'static str| {
        given.get(name).copied().ok_or_else(|| {
            Error::Technique(format!(
                "`{text}`: `{name}` is missing; it takes {}",
                form(technique)
            ))
        })
    };
    let values = technique.takes.iter().map(value).collect::<Result<_, _>>()?;
    Ok(vec![Chosen { technique, values }])
}

/// The technique with settings as a point states them; none of users' shaders, and where they don't fit.
#[must_use]
pub fn find_settings(name: &str, settings: &Settings) -> Option<Chosen> {
    let technique = find(name).ok()?;
    let value = |setting: &&str| settings.0.get(*setting).map(|value| *value as u32);
    let values = technique.takes.iter().map(value).collect::<Option<_>>()?;
    let chosen = Chosen { technique, values };
    (chosen.settings() == *settings).then_some(chosen)
}

fn find(name: &str) -> Result<&'static Technique, Error> {
    let found = LADDER
        .iter()
        .find(|technique| technique.id == name && ReliefTechnique::find(name).is_some());
    found.ok_or_else(|| unknown(name))
}

fn unknown(name: &str) -> Error {
    Error::UnknownTechnique {
        given: name.to_owned(),
        known: LADDER
            .iter()
            .map(|technique| technique.id)
            .filter(|id| ReliefTechnique::find(id).is_some())
            .collect(),
    }
}

fn setting(technique: &'static Technique, text: &str, part: &str) -> Result<(&'static str, u32), Error> {
    let wrong = |problem: String| {
        Error::Technique(format!(
            "`{text}`: {problem}; {} takes {}",
            technique.id,
            form(technique)
        ))
    };
    let (name, value) = part
        .split_once('=')
        .ok_or_else(|| wrong(format!("`{part}` is no NAME=NUMBER")))?;
    let known = technique.takes.iter().find(|known| **known == name);
    let known = known.ok_or_else(|| wrong(format!("there is no `{name}`")))?;
    let number = value.parse().ok().filter(|number| (1..=MOST).contains(number));
    let number =
        number.ok_or_else(|| wrong(format!("`{name}` is a number from 1 to {MOST}, not `{value}`")))?;
    Ok((known, number))
}

/// What a technique takes, for messages.
fn form(technique: &Technique) -> String {
    if technique.takes.is_empty() {
        return "no settings".to_owned();
    }
    let names: Vec<String> = technique.takes.iter().map(|name| format!("{name}=N")).collect();
    names.join(",")
}

#[cfg(test)]
mod tests {
    use super::{LADDER, default_choice, find_settings, parse};

    #[test]
    fn what_is_written_reads_back() {
        for chosen in default_choice(false) {
            let again = parse(&chosen.to_string()).unwrap();
            // A technique without settings is written as its name.
            let search = chosen.search().unwrap();
            assert_eq!(search.id(), chosen.technique.id);
            let settings: Vec<(String, f64)> = chosen.settings().0.into_iter().collect();
            let mut names: Vec<(String, f64)> = search
                .settings()
                .into_iter()
                .map(|(name, value)| (name.to_owned(), f64::from(value)))
                .collect();
            names.sort_by(|a, b| a.0.cmp(&b.0));
            assert_eq!(names, settings, "shader and reference take the same settings");
            assert_eq!(
                find_settings(chosen.technique.id, &chosen.settings()),
                Some(chosen.clone())
            );
            assert_eq!(again, [chosen]);
        }
    }

    #[test]
    fn a_bare_name_means_all_of_its_settings() {
        let all = parse("relief").unwrap();
        let written: Vec<String> = all.iter().map(ToString::to_string).collect();
        assert_eq!(
            written,
            [
                "relief:layers=8,refinements=4",
                "relief:layers=16,refinements=5",
                "relief:layers=32,refinements=6",
                "relief:layers=64,refinements=6",
                "relief:layers=128,refinements=6"
            ]
        );
        assert_eq!(all[1].settings().to_string(), "layers=16 refinements=5");
        assert_eq!(all[1].setting("refinements"), Some(5));
    }

    #[test]
    fn what_is_wrong_is_named() {
        let cases = [
            ("relif", "relief"),
            ("relief:layers=16", "`refinements` is missing"),
            ("relief:layer=16,refinements=5", "there is no `layer`"),
            (
                "relief:layers=0,refinements=5",
                "a number from 1 to 4096, not `0`",
            ),
            ("relief:layers=1e3,refinements=5", "not `1e3`"),
            ("relief:layers=1,layers=2,refinements=5", "twice"),
            ("parallax_offset:layers=4", "takes no settings"),
            ("relief:", "no NAME=NUMBER"),
        ];
        for (text, says) in cases {
            let message = parse(text).unwrap_err().to_string();
            assert!(message.contains(says), "{text}: {message}");
        }
    }

    #[test]
    fn the_table_fits_itself() {
        for technique in LADDER {
            assert!(
                technique
                    .swept
                    .iter()
                    .all(|values| values.len() == technique.takes.len())
            );
            assert!(
                !technique.quick.is_empty() && technique.quick.iter().all(|at| *at < technique.swept.len())
            );
        }
        assert!(default_choice(true).len() < default_choice(false).len());
    }
}
