//! `bossage check`: validate, emit every target in memory, ask the external compilers, lint.
//!
//! An input that cannot be read or is not valid ends with exit code 2 after all others have been checked; a target that
//! cannot be emitted, or a file that an external compiler rejects, with 1. Lints fail nothing.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use bossage_translate::external::{self, Check, CheckState, State, Validator};
use bossage_translate::{Diagnostic, EmitOptions, Shader, Target, lint};
use rayon::prelude::*;
use serde::Serialize;

use crate::Verdict;
use crate::args::{Global, check};
use crate::console::{self, Console};
use crate::error::{self, Error, Result};
use crate::inputs::{self, Inputs, Module};
use crate::numeric::{self, Finding};
use crate::options;
use crate::translation::{Translation, translate_all};

pub(crate) fn run(args: &check::Check, global: &Global, console: Console) -> Result<Verdict> {
    let options = options::options(&args.versions);
    let validators = external::detect();
    if !args.json {
        console.note(banner(&validators).trim_end());
    }
    let (library, _) = inputs::library(global)?;
    let stage = args.inputs.stage.map(options::stage);
    let checker = Checker {
        options: &options,
        validators: &validators,
        cache: cache_folder(args.cache.cache.as_deref()),
    };
    let numeric = numeric::Settings {
        ranges: args.ranges.clone(),
        seconds: args.lint_time,
    };
    let bar = console.bar(args.inputs.inputs.len() as u64, "checking");
    let mut reports = Vec::new();
    let mut wrong = Vec::new();
    for path in &args.inputs.inputs {
        bar.0.set_message(path.display().to_string());
        let mut inputs = Inputs::default();
        let outcome = inputs
            .add(path, stage, &library)
            .and_then(|()| checker.check(path, &inputs.modules, &numeric));
        let report = outcome.unwrap_or_else(|error| {
            let report = InputReport::wrong(path, error::chain(&error));
            wrong.push(error);
            report
        });
        reports.push(report);
        bar.0.inc(1);
    }
    drop(bar);
    answer(
        &Report {
            schema: 1,
            validators,
            inputs: reports,
        },
        wrong,
        args.json,
    )
}

fn answer(report: &Report, wrong: Vec<Error>, json: bool) -> Result<Verdict> {
    if json {
        console::print_json(report)?;
    } else {
        console::print(&report.text())?;
    }
    match wrong.into_iter().next() {
        Some(first) if json => Err(first),
        Some(_) => Err(Error::Call("some inputs are wrong (see above)".to_owned())),
        None if report.inputs.iter().all(|input| input.ok) => Ok(Verdict::Fine),
        None => Ok(Verdict::Failed),
    }
}

/// The user's cache folder for ours, unless another is asked for. None where the system has no such thing.
pub(crate) fn cache_folder(asked: Option<&Path>) -> Option<PathBuf> {
    asked.map(Path::to_owned).or_else(external::cache_folder)
}

/// Which external tools take part, one line each.
pub(crate) fn banner(validators: &[Validator]) -> String {
    let line = |validator: &Validator| {
        let version = validator.version.as_deref().unwrap_or("");
        match validator.state {
            State::Enabled => format!("{}  {} {version}\n", console::good("ENABLED "), validator.tool),
            State::Disabled => {
                let reason = validator.reason.as_deref().unwrap_or("");
                format!("{}  {}: {reason}\n", console::faint("DISABLED"), validator.tool)
            }
        }
    };
    validators.iter().map(line).collect()
}

/// The result, as JSON has it.
#[derive(Debug, Serialize)]
pub(crate) struct Report {
    schema: u32,
    validators: Vec<Validator>,
    inputs: Vec<InputReport>,
}

/// One input.
#[derive(Debug, Serialize)]
pub(crate) struct InputReport {
    path: PathBuf,
    pub(crate) ok: bool,
    #[serde(skip_serializing_if = "Option::is_none")]
    error: Option<String>,
    pub(crate) targets: BTreeMap<&'static str, TargetReport>,
    pub(crate) lints: Vec<Finding>,
}

/// One target of an input.
#[derive(Debug, Default, Serialize)]
pub(crate) struct TargetReport {
    pub(crate) emitted: bool,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub(crate) errors: Vec<Diagnostic>,
    pub(crate) checks: Vec<Check>,
}

/// What checks need to know.
pub(crate) struct Checker<'a> {
    pub(crate) options: &'a EmitOptions,
    pub(crate) validators: &'a [Validator],
    pub(crate) cache: Option<PathBuf>,
}

impl Checker<'_> {
    /// Checks the modules of one input.
    fn check(&self, path: &Path, modules: &[Module], numeric: &numeric::Settings) -> Result<InputReport> {
        let shaders: Vec<Shader> = modules.par_iter().map(Module::parse).collect::<Result<_>>()?;
        let translations = translate_all(modules, &shaders, &Target::ALL, self.options);
        let mut report = self.check_translations(path, &translations);
        let labelled: Vec<Shader> = modules
            .iter()
            .map(Module::parse_labelled)
            .collect::<Result<_>>()?;
        report.lints = labelled.iter().flat_map(lint).map(Finding::from).collect();
        report
            .lints
            .extend(numeric::lint_input(path, &labelled, numeric)?);
        Ok(report)
    }

    /// Asks the external tools about everything that was emitted.
    pub(crate) fn check_translations(&self, path: &Path, translations: &[Translation]) -> InputReport {
        let mut report = InputReport {
            path: path.to_owned(),
            ok: true,
            error: None,
            targets: BTreeMap::new(),
            lints: Vec::new(),
        };
        for target in Target::ALL {
            report.targets.insert(
                target.name(),
                TargetReport {
                    emitted: true,
                    ..TargetReport::default()
                },
            );
        }
        let emitted: Vec<_> = translations
            .iter()
            .flat_map(|translation| &translation.emitted)
            .collect();
        let ask =
            |emitted: &&_| external::check(emitted, self.options, self.validators, self.cache.as_deref());
        let checks: Vec<Vec<Check>> = emitted.par_iter().map(ask).collect();
        for (emitted, checks) in emitted.iter().zip(checks) {
            report
                .targets
                .entry(emitted.target.name())
                .or_default()
                .checks
                .extend(checks);
        }
        for (target, diagnostic) in translations.iter().flat_map(|translation| &translation.failures) {
            let entry = report.targets.entry(target.name()).or_default();
            entry.emitted = false;
            entry.errors.push(diagnostic.clone());
        }
        report.ok = report.targets.values().all(TargetReport::is_fine);
        report
    }
}

impl TargetReport {
    fn is_fine(&self) -> bool {
        self.emitted && self.checks.iter().all(|check| check.state != CheckState::Fail)
    }

    fn count(&self, state: CheckState) -> usize {
        self.checks.iter().filter(|check| check.state == state).count()
    }

    /// One line, and what failed below it.
    fn text(&self, target: &str) -> String {
        let [pass, fail, skip] =
            [CheckState::Pass, CheckState::Fail, CheckState::Skip].map(|state| self.count(state));
        let counts = format!("{pass} passed, {fail} failed, {skip} skipped");
        let mut text = match (self.is_fine(), self.checks.is_empty()) {
            (true, true) => format!(
                "  {target:6} {}: no external compiler checks it\n",
                console::faint("emitted")
            ),
            (true, false) if pass == 0 => format!("  {target:6} {}: {counts}\n", console::faint("emitted")),
            (true, false) => format!("  {target:6} {}: {counts}\n", console::good("ok")),
            (false, _) => format!("  {target:6} {}: {counts}\n", console::bad("FAIL")),
        };
        for error in &self.errors {
            text.push_str(&indented(&error.to_string()));
        }
        for check in self.checks.iter().filter(|check| check.state == CheckState::Fail) {
            text.push_str(&indented(&format!(
                "{} rejects {}:\n{}",
                check.tool,
                check.file,
                check.message.trim_end()
            )));
        }
        text
    }
}

impl InputReport {
    fn wrong(path: &Path, error: String) -> Self {
        Self {
            path: path.to_owned(),
            ok: false,
            error: Some(error),
            targets: BTreeMap::new(),
            lints: Vec::new(),
        }
    }

    /// The result for people.
    pub(crate) fn text(&self) -> String {
        let verdict = if self.ok {
            console::good("ok")
        } else {
            console::bad("FAIL")
        };
        let mut text = format!("{}: {verdict}\n", console::heading(self.path.display()));
        if let Some(error) = &self.error {
            text.push_str(&indented(error));
        }
        text.extend(self.targets.iter().map(|(target, report)| report.text(target)));
        text.extend(self.lints.iter().map(lint_line));
        text
    }
}

fn lint_line(found: &Finding) -> String {
    let lint = &found.lint;
    let place = match (lint.line, lint.column) {
        (Some(line), Some(column)) => format!("{}:{line}:{column}", lint.file),
        _ => lint.file.clone(),
    };
    let line = format!(
        "  {} {place}: {} [{}]\n",
        console::faint("lint"),
        lint.message,
        lint.rule
    );
    line + &indented(&found.snippet)
}

fn indented(text: &str) -> String {
    text.lines().map(|line| format!("    {line}\n")).collect()
}

impl Report {
    fn text(&self) -> String {
        self.inputs.iter().map(InputReport::text).collect()
    }
}
