//! The numeric lint of shaders, joined from the evaluator (which knows spans) and the translator (which knows files and lines).
//!
//! Ranges of inputs come from `--ranges FILE`, else from `NAME.ranges.toml` beside the input, else from names and types. A sidecar that is
//! wrong, or that names what no entry point of the input has, ends the check of that input.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::time::Duration;

use bossage_bounds::lint::{self, Options};
use bossage_bounds::ranges::{Declared, Inputs};
use bossage_bounds::{Error as BoundsError, Program};
use bossage_translate::{Diagnostic, Lint, Severity, Shader};
use rayon::prelude::*;
use serde::Serialize;

use crate::error::{Error, Result, read};

/// A finding of either kind of lint.
#[derive(Clone, Debug, Serialize)]
pub(crate) struct Finding {
    #[serde(flatten)]
    pub(crate) lint: Lint,
    /// Inputs with which it happens; `None` for rules about text, and where the message says that none was found.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) witness: Option<Witness>,
    /// The line with a caret.
    #[serde(skip)]
    pub(crate) snippet: String,
}

/// Inputs with which something goes wrong.
#[derive(Clone, Debug, Serialize)]
pub(crate) struct Witness {
    /// The entry point to run.
    entry: String,
    /// Values by input; numbers are exact in `f32`.
    inputs: BTreeMap<String, Vec<f64>>,
    /// What the operation had there.
    operands: String,
    /// The seed of the search, from which texels come too.
    seed: u64,
}

impl From<Lint> for Finding {
    fn from(lint: Lint) -> Self {
        Self {
            lint,
            witness: None,
            snippet: String::new(),
        }
    }
}

/// How to lint.
#[derive(Clone, Debug)]
pub(crate) struct Settings {
    /// The sidecar, if the call names one.
    pub(crate) ranges: Option<PathBuf>,
    /// Seconds for each entry point; nothing is looked for in none.
    pub(crate) seconds: f64,
}

/// All numeric findings in the shaders of one input, by place.
pub(crate) fn lint_input(input: &Path, shaders: &[Shader], settings: &Settings) -> Result<Vec<Finding>> {
    let declared = sidecar(input, settings.ranges.as_deref())?;
    let entries: Vec<(&Shader, String)> = shaders
        .iter()
        .flat_map(|shader| {
            shader
                .entry_points()
                .map(move |(name, _)| (shader, name.to_owned()))
        })
        .collect();
    let prepared: Vec<Prepared<'_>> = entries
        .into_iter()
        .map(|(shader, entry)| prepare(shader, entry, declared.as_ref()))
        .collect::<Result<_>>()?;
    if let Some(declared) = &declared {
        let inputs: Vec<Inputs> = prepared.iter().filter_map(|p| p.inputs.clone()).collect();
        declared
            .check(&inputs)
            .map_err(|report| Error::Call(report.to_string()))?;
    }
    if settings.seconds <= 0.0 {
        return Ok(Vec::new());
    }
    let options = Options {
        time: Duration::from_secs_f64(settings.seconds),
        ..Options::default()
    };
    let mut findings: Vec<Finding> = prepared.par_iter().flat_map_iter(|p| p.lint(&options)).collect();
    let place = |f: &Finding| (f.lint.clone(), f.witness.is_none());
    findings.sort_by_key(place);
    // One function that several entry points call is named once, with a witness if any has one.
    findings.dedup_by(|b, a| {
        let key = |f: &Finding| {
            (
                f.lint.file.clone(),
                f.lint.line,
                f.lint.column,
                f.lint.rule.clone(),
            )
        };
        key(a) == key(b)
    });
    Ok(findings)
}

/// The sidecar of an input, read and parsed: the one that the call names, else the one beside it.
pub(crate) fn sidecar(input: &Path, named: Option<&Path>) -> Result<Option<Declared>> {
    let beside = input.with_extension("ranges.toml");
    let path = match named {
        Some(path) => path.to_owned(),
        None if beside.is_file() => beside,
        None => return Ok(None),
    };
    let name = path.display().to_string();
    let text = String::from_utf8(read(&path)?).map_err(|e| {
        Error::Call(format!(
            "{name} is not UTF-8 text (byte {})",
            e.utf8_error().valid_up_to()
        ))
    })?;
    let declared = Declared::parse(&name, &text).map_err(|report| Error::Call(report.to_string()))?;
    Ok(Some(declared))
}

/// An entry point, ready to be linted; without program and inputs where the evaluator leaves something out.
struct Prepared<'s> {
    shader: &'s Shader,
    entry: String,
    program: Option<Program>,
    inputs: Option<Inputs>,
    left_out: Option<BoundsError>,
}

fn prepare<'s>(shader: &'s Shader, entry: String, declared: Option<&Declared>) -> Result<Prepared<'s>> {
    let mut prepared = Prepared {
        shader,
        entry,
        program: None,
        inputs: None,
        left_out: None,
    };
    let Some((module, info)) = shader.module(&prepared.entry) else {
        return Ok(prepared);
    };
    match Inputs::new(module, info, &prepared.entry, declared) {
        Ok(inputs) => prepared.inputs = Some(inputs),
        Err(error @ BoundsError::Ranges(_)) => return Err(Error::Call(error.to_string())),
        Err(error) => prepared.left_out = Some(error),
    }
    match Program::new(module, info, &prepared.entry) {
        Ok(program) => prepared.program = Some(program),
        Err(error) => prepared.left_out = Some(error),
    }
    Ok(prepared)
}

impl Prepared<'_> {
    fn lint(&self, options: &Options) -> Vec<Finding> {
        let (Some(program), Some(inputs)) = (&self.program, &self.inputs) else {
            return self.not_analysed().into_iter().collect();
        };
        let report = lint::lint(program, inputs, options);
        let findings = report.findings.iter();
        findings.map(|found| self.finding(found, options.seed)).collect()
    }

    /// That the evaluator leaves something out is said, as a note.
    fn not_analysed(&self) -> Option<Finding> {
        let error = self.left_out.as_ref()?;
        let message = format!("`{}` was not analysed numerically: {error}", self.entry);
        let span = error.span().unwrap_or_default();
        Some(self.located("not_analysed", Severity::Note, message, span))
    }

    fn finding(&self, found: &lint::Finding, seed: u64) -> Finding {
        let function = self
            .function(found.span)
            .map_or(String::new(), |name| format!(" in `{name}`"));
        let about = found.rule.about();
        let (severity, told) = match &found.witness {
            Some(witness) => (Severity::Warning, format!("witness: {}", shown(witness))),
            None => (Severity::Note, "possible; no witness found".to_owned()),
        };
        let message = format!("{about}{function} ({told})");
        let mut finding = self.located(found.rule.id(), severity, message, found.span);
        finding.witness = found.witness.as_ref().map(|witness| Witness {
            entry: self.entry.clone(),
            inputs: witness.inputs.iter().cloned().collect(),
            operands: witness.operands.clone(),
            seed,
        });
        finding
    }

    fn located(&self, rule: &str, severity: Severity, message: String, span: naga::Span) -> Finding {
        let (file, text) = (self.shader.name(), self.shader.text());
        let places = span.to_range().map(|range| (range, String::new()));
        let diagnostic = Diagnostic::new(bossage_translate::Code::Validate, "").at(file, text, places);
        Finding {
            lint: Lint {
                file: file.to_owned(),
                line: diagnostic.line,
                column: diagnostic.column,
                rule: rule.to_owned(),
                severity,
                message,
            },
            witness: None,
            snippet: diagnostic.snippet.clone(),
        }
    }

    /// The function that a place lies in.
    fn function(&self, span: naga::Span) -> Option<String> {
        let (module, _) = self.shader.module(&self.entry)?;
        let at = span.to_range()?.start;
        let functions = module.functions.iter();
        let inside = functions.filter(|(handle, _)| {
            let range = module.functions.get_span(*handle).to_range();
            range.is_some_and(|range| range.contains(&at))
        });
        inside.filter_map(|(_, function)| function.name.clone()).next()
    }
}

/// More inputs than these are left to the JSON.
const SHOWN: usize = 8;

fn shown(witness: &lint::Witness) -> String {
    let value = |values: &[f64]| match values {
        [x] => number(*x),
        many => format!(
            "({})",
            many.iter().map(|x| number(*x)).collect::<Vec<_>>().join(", ")
        ),
    };
    let mut list: Vec<String> = witness
        .inputs
        .iter()
        .take(SHOWN)
        .map(|(name, values)| format!("{name} = {}", value(values)))
        .collect();
    if witness.inputs.len() > SHOWN {
        list.push(format!("and {} inputs more", witness.inputs.len() - SHOWN));
    }
    let separator = if list.is_empty() { "" } else { ": " };
    format!("{}{separator}{}", list.join(", "), witness.operands)
}

/// The shortest digits that stand for the same `f32`.
fn number(x: f64) -> String {
    let single = x as f32;
    if f64::from(single) == x {
        format!("{single:?}")
    } else {
        format!("{x:?}")
    }
}
