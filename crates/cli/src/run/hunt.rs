//! `bossage conform --hunt`: search for hard inputs, show them, and keep those of the library in its corpus.

use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::time::Duration;

use bossage_conformance::Selection;
use bossage_conformance::hunt::corpus::Corpus;
use bossage_conformance::hunt::{Finding, Hunted, Options, SECONDS, hunt_library, hunt_shader};
use serde::Serialize;

use super::conform::is_standard_output;
use super::conform_shader;
use crate::Verdict;
use crate::args::Global;
use crate::args::conform::Conform;
use crate::console::{self, Console};
use crate::error::{Error, Result};
use crate::inputs;
use crate::numeric;
use crate::output::Outputs;

/// Where the library's corpus is, seen from the root of the repository.
const CORPUS: &str = "crates/conformance/corpus";

pub(crate) fn run(
    args: &Conform,
    selection: &Selection,
    global: &Global,
    console: Console,
) -> Result<Verdict> {
    let options = Options {
        filter: args.filter.clone(),
        seed: args.user.seed,
        time: time(args),
        evaluations: args
            .hunt
            .evaluations
            .map(|n| usize::try_from(n).unwrap_or(usize::MAX)),
        threshold: args.hunt.threshold,
    };
    let mut told = |name: &str| console.note(format_args!("hunting {name}"));
    let hunted = match &args.user.shader {
        Some(file) => {
            let declared = numeric::sidecar(file, args.user.ranges.as_deref())?;
            let (shader, _) = conform_shader::read(file, &args.user, declared.as_ref(), global)?;
            let user_options = conform_shader::options(file, args)?;
            hunt_shader(&shader, declared.as_ref(), &user_options, &options, &mut told)?
        }
        None => {
            let (library, _) = inputs::library(global)?;
            hunt_library(&options, selection, &library, &mut told)?
        }
    };
    let mut outputs = Outputs::default();
    if let Some(file) = args.user.shader.as_deref().filter(|_| !hunted.kept.is_empty()) {
        let path = conform_shader::corpus_path(file, args);
        let mut corpus =
            conform_shader::corpus(file, args)?.unwrap_or_else(|| conform_shader::no_corpus(file));
        corpus.merge(hunted.kept.clone());
        console.note(format_args!("kept in {}", path.display()));
        outputs.add(path, "--corpus", corpus.text().into_bytes())?;
    } else if let Some(folder) = corpus_folder(args.hunt.corpus.as_deref()) {
        add_corpora(&hunted, &folder, &mut outputs)?;
    }
    let json = Document::of(&hunted, &options);
    let to_output = args.json.as_deref().is_some_and(is_standard_output);
    if let Some(path) = args.json.as_ref().filter(|_| !to_output) {
        outputs.add(path.clone(), "--json", console::json_text(&json)?.into_bytes())?;
    }
    outputs.commit()?;
    if to_output {
        console::print_json(&json)?;
    } else {
        console::print(&text(&hunted, &options))?;
    }
    let refused = hunted.findings.iter().any(|one| one.refused.is_some());
    Ok(if refused { Verdict::Failed } else { Verdict::Fine })
}

/// The time that the call names; without one only a number of evaluations ends a hunt earlier than its usual time.
fn time(args: &Conform) -> Option<Duration> {
    let usual = args.hunt.evaluations.is_none().then_some(SECONDS);
    args.hunt.time.or(usual).map(Duration::from_secs_f64)
}

/// The folder that the call names, else the repository's own where the call is made from its root.
fn corpus_folder(named: Option<&Path>) -> Option<PathBuf> {
    named
        .map(Path::to_owned)
        .or_else(|| Some(PathBuf::from(CORPUS)).filter(|folder| folder.is_dir()))
}

/// What was found, merged with what is there.
fn add_corpora(hunted: &Hunted, folder: &Path, outputs: &mut Outputs) -> Result<()> {
    for found in &hunted.corpora {
        let path = folder.join(format!("{}.toml", found.probe));
        let mut corpus = match std::fs::read_to_string(&path) {
            Ok(text) => Corpus::parse(&path.display().to_string(), &text)?,
            Err(error) if error.kind() == std::io::ErrorKind::NotFound => Corpus::new(&found.probe),
            Err(source) => return Err(Error::Read { path, source }),
        };
        corpus.merge(found.clone());
        outputs.add(path, "--corpus", corpus.text().into_bytes())?;
    }
    Ok(())
}

/// What was found, as JSON has it.
#[derive(Serialize)]
struct Document<'a> {
    schema: u32,
    seed: u64,
    #[serde(skip_serializing_if = "Option::is_none")]
    seconds: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    evaluations: Option<usize>,
    threshold_ulps: f64,
    findings: &'a [Finding],
    evaluated: Vec<Evaluated<'a>>,
    skipped: Vec<Skipped<'a>>,
}

#[derive(Serialize)]
struct Evaluated<'a> {
    subject: &'a str,
    inputs: usize,
}

#[derive(Serialize)]
struct Skipped<'a> {
    subject: &'a str,
    reason: &'a str,
}

impl<'a> Document<'a> {
    fn of(hunted: &'a Hunted, options: &Options) -> Self {
        Self {
            schema: 1,
            seed: options.seed,
            seconds: options.time.map(|time| time.as_secs_f64()),
            evaluations: options.evaluations,
            threshold_ulps: options.threshold,
            findings: &hunted.findings,
            evaluated: hunted
                .evaluated
                .iter()
                .map(|(subject, inputs)| Evaluated {
                    subject,
                    inputs: *inputs,
                })
                .collect(),
            skipped: hunted
                .skipped
                .iter()
                .map(|(subject, reason)| Skipped { subject, reason })
                .collect(),
        }
    }
}

/// More inputs than these are left to the JSON.
const SHOWN: usize = 6;

fn text(hunted: &Hunted, options: &Options) -> String {
    let mut text = String::new();
    for one in &hunted.findings {
        let what = match one.refused {
            Some(got) => console::bad(format_args!("{got} lies outside of its interval")),
            None => format!("{} of {:.4e} ULP", one.goal.name(), one.ulps),
        };
        let _ = writeln!(
            text,
            "{}, output {}: {what}",
            console::heading(&one.subject),
            one.output
        );
        for input in one.inputs.iter().take(SHOWN) {
            let _ = writeln!(text, "    {input}");
        }
        if one.inputs.len() > SHOWN {
            let _ = writeln!(text, "    and {} inputs more", one.inputs.len() - SHOWN);
        }
    }
    for (subject, reason) in &hunted.skipped {
        let _ = writeln!(
            text,
            "{subject}: {}",
            console::faint(format_args!("not hunted: {reason}"))
        );
    }
    let inputs: usize = hunted.evaluated.iter().map(|(_, n)| n).sum();
    let _ = writeln!(
        text,
        "\n{} hard inputs of {} ULP or more among {inputs} of {} subjects, seed {}",
        hunted.findings.len(),
        options.threshold,
        hunted.evaluated.len(),
        options.seed
    );
    text
}
