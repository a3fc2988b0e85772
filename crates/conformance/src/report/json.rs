//! The report as JSON.
//!
//! Numbers that JSON cannot hold (NaN, infinities) are the strings `"NaN"`, `"inf"` and `"-inf"`.

use serde::ser::SerializeStruct;
use serde::{Serialize, Serializer};

use super::matrix::Matrix;
use super::{CaseResult, Report, SCHEMA, Totals};
use crate::environment::Environment;
use crate::error::Error;
use crate::heat::Heat;

/// A number that may be one JSON does not have.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Number(pub f64);

impl Serialize for Number {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        if self.0.is_finite() {
            serializer.serialize_f64(self.0)
        } else {
            serializer.serialize_str(&self.to_string())
        }
    }
}

impl std::fmt::Display for Number {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        // Shortest text that reads back as the same number.
        write!(f, "{:?}", self.0)
    }
}

impl Serialize for CaseResult {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut case = serializer.serialize_struct("case", 13)?;
        case.serialize_field("id", &self.id.to_string())?;
        case.serialize_field("route", self.route.name())?;
        case.serialize_field("adapter", &self.adapter)?;
        case.serialize_field("basis", &self.basis)?;
        case.serialize_field("inputs", &self.inputs)?;
        case.serialize_field("outputs", &self.outputs)?;
        case.serialize_field("undecided", &self.undecided)?;
        case.serialize_field("forked", &self.forked)?;
        case.serialize_field("refused", &self.refused)?;
        case.serialize_field("verdict", &self.verdict)?;
        case.serialize_field("worst", &self.worst)?;
        case.serialize_field("reason", &self.reason)?;
        case.serialize_field("rerun", &self.rerun())?;
        case.end()
    }
}

#[derive(Serialize)]
struct Document<'a> {
    schema: u32,
    environment: &'a Environment,
    totals: Totals,
    matrix: Matrix,
    cases: &'a [CaseResult],
    #[serde(skip_serializing_if = "<[_]>::is_empty")]
    heats: &'a [Heat],
}

/// The report as pretty-printed JSON with a line's end.
///
/// # Errors
/// [`Error::Report`] when the serializer refuses, which no report is known to cause.
pub fn write(report: &Report) -> Result<String, Error> {
    let document = Document {
        schema: SCHEMA,
        environment: &report.environment,
        totals: report.totals(),
        matrix: Matrix::of(report),
        cases: &report.cases,
        heats: &report.heats,
    };
    let text = serde_json::to_string_pretty(&document).map_err(|error| Error::Report {
        format: "JSON",
        message: error.to_string(),
    })?;
    Ok(text + "\n")
}
