//! Cost profiles: what a ray and a step of each relief technique take on one machine, as `bossage study --calibrate` measures it.
//!
//! A profile is a TOML file. Keys not listed here are refused.
//!
//! | key | value | |
//! |---|---|---|
//! | `schema` | `1` | required |
//! | `name` | what the profile is called in plans | required |
//! | `adapter`, `driver` | the machine on which it was measured | required |
//! | `[technique.ID]` | one for each technique that was measured; the others are no candidates on this profile | |
//! | `technique.ID.ray_ns` | nanoseconds a ray, ≥ 0: what does not depend on the steps | required |
//! | `technique.ID.step_ns` | nanoseconds a step, ≥ 0 | required |
//! | `technique.ID.residual` | relative root mean square by which the measured times are off the line, ≥ 0 | none |
//! | `technique.ID.points` | how many measured points the line was laid through, ≥ 1 | none |
//!
//! Model: a frame's rays take pixels × (ray_ns + steps × step_ns), steps being the mean of what [`bossage_reference::relief_search`]
//! counts on rays of the scene. That is the time of the relief alone, with nothing else to do for the machine; shading comes on top.

use std::collections::BTreeMap;
use std::fmt::Write;
use std::path::Path;

use toml::de::DeTable;

use crate::error::{Error, Report};
use crate::fields::{NOT_NEGATIVE, Sink, Table, Value};
use crate::load::read_text;
use crate::sheet::Sheet;
use crate::suggest;

/// The version this crate reads.
pub const SCHEMA: u32 = 1;
/// Largest profile read.
pub const MAX_BYTES: u64 = 1 << 20;
/// The techniques that a profile may have figures for.
pub const TECHNIQUES: [&str; 11] = [
    "parallax_offset_limited",
    "parallax_offset",
    "parallax_slope_ao",
    "parallax_slope_ao_directed",
    "parallax_iterative",
    "steep_parallax",
    "parallax_occlusion",
    "relief",
    "cone_step",
    "relaxed_cone_step",
    "exact",
];
/// The profiles that come with the program, by name.
const BUNDLED: [(&str, &str); 1] = [("lavapipe", include_str!("../profiles/lavapipe.toml"))];

/// A cost profile.
#[derive(Clone, Debug, PartialEq)]
pub struct Profile {
    /// What it is called.
    pub name: String,
    /// The adapter on which it was measured.
    pub adapter: String,
    /// Its driver.
    pub driver: String,
    /// Figures by technique id, one of [`TECHNIQUES`].
    pub techniques: BTreeMap<String, Cost>,
}

/// What one technique takes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cost {
    /// Nanoseconds a ray.
    pub ray_ns: f64,
    /// Nanoseconds a step.
    pub step_ns: f64,
    /// Relative root mean square of the fit.
    pub residual: Option<f64>,
    /// Measured points.
    pub points: Option<u32>,
}

impl Cost {
    /// Nanoseconds of a ray of so many steps.
    #[must_use]
    pub fn ns(&self, steps: f64) -> f64 {
        self.ray_ns + steps * self.step_ns
    }
}

impl Profile {
    /// Reads a profile.
    ///
    /// # Errors
    /// When the file cannot be read, or anything in it is wrong; all problems are in the error.
    pub fn load(path: &Path) -> Result<Self, Error> {
        let text = read_text("cost profile", path, MAX_BYTES)?;
        Ok(Self::parse(path, &text)?)
    }

    /// Reads a profile from its text; `path` names it in messages.
    ///
    /// # Errors
    /// When anything in it is wrong; all problems are in the report.
    pub fn parse(path: &Path, text: &str) -> Result<Self, Box<Report>> {
        let sheet = Sheet::new(text, &[]);
        let sink = Sink::new(&sheet);
        let (document, syntax) = DeTable::parse_recoverable(text);
        sink.note_syntax(&syntax);
        let read = if syntax.is_empty() {
            profile(&Table::root(&document, "a cost profile", &sink))
        } else {
            None
        };
        match (sink.into_report(path, text), read) {
            (Some(report), _) => Err(report),
            (None, Some(profile)) => Ok(profile),
            (None, None) => Err(Box::new(Report::unexplained(path, text))),
        }
    }

    /// A profile that comes with the program.
    ///
    /// # Errors
    /// The names that there are, when it is none of them.
    pub fn bundled(name: &str) -> Result<Self, String> {
        let names = BUNDLED.map(|(name, _)| name);
        let found = BUNDLED.into_iter().find(|(bundled, _)| *bundled == name);
        let (_, text) = found.ok_or_else(|| suggest::hint(name, "bundled", &names))?;
        Self::parse(Path::new(name), text).map_err(|report| report.to_string())
    }

    /// The profile as a file.
    #[must_use]
    pub fn to_toml(&self) -> String {
        let quoted = |text: &str| toml::Value::String(text.to_owned()).to_string();
        let mut text = format!(
            "schema = {SCHEMA}\nname = {}\nadapter = {}\ndriver = {}\n",
            quoted(&self.name),
            quoted(&self.adapter),
            quoted(&self.driver)
        );
        for (id, cost) in &self.techniques {
            // Debug writes the shortest decimal that reads back as the same number, with a point.
            let _ = write!(
                text,
                "\n[technique.{id}]\nray_ns = {:?}\nstep_ns = {:?}\n",
                cost.ray_ns, cost.step_ns
            );
            if let Some(residual) = cost.residual {
                let _ = writeln!(text, "residual = {residual:?}");
            }
            if let Some(points) = cost.points {
                let _ = writeln!(text, "points = {points}");
            }
        }
        text
    }
}

fn profile(root: &Table<'_>) -> Option<Profile> {
    let version = root
        .need("schema", "`schema = 1` as the first line")
        .and_then(|value| value.version(SCHEMA));
    let word = |key, what| {
        let value = root.need(key, what)?;
        value.name().map(str::to_owned)
    };
    let name = word("name", "`name`, what the profile is called");
    let adapter = word("adapter", "`adapter`, the machine on which it was measured");
    let driver = word("driver", "`driver`, the adapter's driver");
    let techniques = root.or("technique", BTreeMap::new(), techniques);
    root.finish();
    version?;
    Some(Profile {
        name: name?,
        adapter: adapter?,
        driver: driver?,
        techniques: techniques?,
    })
}

fn techniques(value: &Value<'_>) -> Option<BTreeMap<String, Cost>> {
    let table = value.table()?;
    let given = TECHNIQUES.into_iter().filter_map(|id| Some((id, table.get(id)?)));
    let read: Vec<Option<(String, Cost)>> = given
        .map(|(id, value)| Some((id.to_owned(), cost(&value)?)))
        .collect();
    table.finish();
    read.into_iter().collect()
}

fn cost(value: &Value<'_>) -> Option<Cost> {
    let table = value.table()?;
    let ray_ns = table
        .need("ray_ns", "`ray_ns`, nanoseconds a ray")
        .and_then(|v| v.number(NOT_NEGATIVE));
    let step_ns = table
        .need("step_ns", "`step_ns`, nanoseconds a step")
        .and_then(|v| v.number(NOT_NEGATIVE));
    let residual = table.or("residual", None, |v| v.number(NOT_NEGATIVE).map(Some));
    let points = table.or("points", None, |v| v.whole(1..=u32::MAX).map(Some));
    table.finish();
    Some(Cost {
        ray_ns: ray_ns?,
        step_ns: step_ns?,
        residual: residual?,
        points: points?,
    })
}

#[cfg(test)]
mod tests;
