//! `bossage conform`: execute, compare, report.

use std::fmt::Write;
use std::path::{Path, PathBuf};

use bossage_conformance::heat::{self, Heat};
use bossage_conformance::{CaseResult, Progress, Report, Route, Selection, Verdict as CaseVerdict, report};
use bossage_runner::AdapterSelector;
use bossage_shaders::Library;

use super::{conform_shader, hunt};
use crate::Verdict;
use crate::args::Global;
use crate::args::conform::Conform;
use crate::console::{self, Bar, Console};
use crate::error::{Error, Result};
use crate::inputs;
use crate::nearest::suggestion;
use crate::output::{self, Outputs};

pub(crate) fn run(args: &Conform, global: &Global, console: Console) -> Result<Verdict> {
    if args.serve {
        return conform_shader::serve();
    }
    let selection = selection(args)?;
    check_outputs(args)?;
    if args.user.seed != 1 && args.user.shader.is_none() && !args.hunt.hunt {
        return Err(Error::Call(
            "--seed goes with --shader or --hunt; the library's cases have their seeds in their names"
                .to_owned(),
        ));
    }
    if args.hunt.corpus.is_some() && args.user.shader.is_none() && !args.hunt.hunt {
        return Err(Error::Call(
            "--corpus goes with --shader or --hunt; the library's own corpus is part of the program"
                .to_owned(),
        ));
    }
    if args.hunt.hunt {
        return hunt::run(args, &selection, global, console);
    }
    let report = match &args.user.shader {
        Some(file) => conform_shader::report(file, args, &selection, global, console)?,
        None if args.list => return list(&selection),
        None => library_report(args, &selection, global, console)?,
    };
    write_reports(args, &report)?;
    if args.json.as_deref().is_some_and(is_standard_output) {
        console::print(&report::json::write(&report)?)?;
    } else {
        console::print(&text(&report))?;
    }
    Ok(if report.is_ok() {
        Verdict::Fine
    } else {
        Verdict::Failed
    })
}

fn list(selection: &Selection) -> Result<Verdict> {
    let cases = selection.cases().map_err(|error| explained(error, selection))?;
    let names: String = cases.iter().map(|case| format!("{}\n", case.id())).collect();
    console::print(&names)?;
    Ok(Verdict::Fine)
}

fn library_report(
    args: &Conform,
    selection: &Selection,
    global: &Global,
    console: Console,
) -> Result<Report> {
    // Before anything is run, so that a filter that finds nothing is answered at once.
    selection.cases().map_err(|error| explained(error, selection))?;
    let (library, _) = inputs::library(global)?;
    let heats = args
        .attribute
        .as_deref()
        .map(|output| heats(output, selection, &library));
    let heats = heats.transpose()?.unwrap_or_default();
    let mut report = bossage_conformance::run(selection, &library, &mut Watch::new(console))?;
    report.heats = heats;
    Ok(report)
}

/// Probes whose bound is attributed in one call.
const MOST_HEATS: usize = 16;

/// Where the bounds of that output come from, for every probe that the filter selects.
fn heats(output: &str, selection: &Selection, library: &Library) -> Result<Vec<Heat>> {
    let number = output.parse().map_err(|_| {
        Error::Call(format!(
            "--attribute {output}: outputs of the library's functions have numbers, from 0"
        ))
    })?;
    let probes = bossage_conformance::hunt::probes(selection.filter.as_deref());
    if !(1..=MOST_HEATS).contains(&probes.len()) {
        return Err(Error::Call(format!(
            "--attribute: the filter selects {} functions; name 1 to {MOST_HEATS} of them, as in `conform normalise/hardened --attribute 0`",
            probes.len()
        )));
    }
    let seed = selection
        .seed
        .unwrap_or(bossage_conformance::generate::random::SEED);
    Ok(heat::of_probes(&probes, number, seed, library)?)
}

fn check_outputs(args: &Conform) -> Result<()> {
    let files = [&args.json, &args.junit, &args.html]
        .into_iter()
        .flatten()
        .filter(|path| !is_standard_output(path));
    files.map(PathBuf::as_path).try_for_each(output::check_writable)
}

/// `-` is standard output.
pub(super) fn is_standard_output(path: &Path) -> bool {
    path.as_os_str() == "-"
}

fn selection(args: &Conform) -> Result<Selection> {
    Ok(Selection {
        filter: args.filter.clone(),
        routes: args.route.iter().map(|name| route(name)).collect::<Result<_>>()?,
        adapters: adapters(&args.adapter),
        shard: args.shard.as_deref().map(shard).transpose()?,
        full: args.full,
        scenes: args.scene.clone(),
        ..Selection::default()
    })
}

fn route(name: &str) -> Result<Route> {
    let names: Vec<&str> = Route::ALL.iter().map(|route| route.name()).collect();
    let route = Route::ALL.into_iter().find(|route| route.name() == name);
    route.ok_or_else(|| Error::Call(format!("unknown route `{name}`; {}", suggestion(name, &names))))
}

fn shard(text: &str) -> Result<(usize, usize)> {
    let parts = text
        .split_once('/')
        .and_then(|(i, n)| Some((i.parse().ok()?, n.parse().ok()?)));
    match parts {
        Some((index, count)) if (1..=count).contains(&index) => Ok((index, count)),
        _ => Err(Error::Call(format!(
            "--shard {text}: write it as I/N with I from 1 to N, for example 2/4"
        ))),
    }
}

/// Names separated by commas; but a comma may also be part of an adapter's own name.
fn adapters(given: &[String]) -> Vec<String> {
    if given.is_empty() {
        return Vec::new();
    }
    let found = bossage_conformance::machines::adapters();
    let is_whole = |name: &str| {
        found
            .iter()
            .any(|info| AdapterSelector::named(name).matches(info))
    };
    given
        .iter()
        .flat_map(|text| match is_whole(text) {
            true => vec![text.clone()],
            false => text.split(',').map(|name| name.trim().to_owned()).collect(),
        })
        .collect()
}

/// A filter that finds nothing is answered with the nearest technique.
fn explained(error: bossage_conformance::Error, selection: &Selection) -> Error {
    let (bossage_conformance::Error::NoSuchCase { filter, .. }, Ok(all)) = (
        &error,
        Selection {
            filter: None,
            shard: None,
            ..selection.clone()
        }
        .cases(),
    ) else {
        return error.into();
    };
    let mut techniques: Vec<&str> = all.iter().map(|case| case.id().technique.as_str()).collect();
    techniques.dedup();
    let word = filter.split('/').next().unwrap_or_default();
    Error::Call(format!(
        "no case's id contains `{filter}`; {} (--list names all {} cases)",
        suggestion(word, &techniques),
        all.len()
    ))
}

fn write_reports(args: &Conform, report: &Report) -> Result<()> {
    let mut outputs = Outputs::default();
    if let Some(path) = args.json.as_ref().filter(|path| !is_standard_output(path)) {
        outputs.add(path.clone(), "--json", report::json::write(report)?.into_bytes())?;
    }
    if let Some(path) = &args.junit {
        outputs.add(
            path.clone(),
            "--junit",
            report::junit::write(report)?.into_bytes(),
        )?;
    }
    if let Some(path) = &args.html {
        outputs.add(path.clone(), "--html", report::html::write(report).into_bytes())?;
    }
    outputs.commit().map(drop)
}

/// A bar that counts results.
pub(crate) struct Watch {
    console: Console,
    bar: Option<Bar>,
}

impl Watch {
    pub(crate) const fn new(console: Console) -> Self {
        Self { console, bar: None }
    }
}

impl Progress for Watch {
    fn start(&mut self, total: usize) {
        self.bar = Some(self.console.bar(total as u64, "conform"));
    }

    fn done(&mut self, result: &CaseResult) {
        if let Some(Bar(bar)) = &self.bar {
            bar.set_message(result.id.to_string());
            bar.inc(1);
        }
    }
}

/// The report for people: one line a technique and form, then every case that needs a look, then the totals.
pub(crate) fn text(report: &Report) -> String {
    let mut text = String::new();
    for adapter in &report.environment.adapters {
        let _ = writeln!(
            text,
            "adapter {} ({})",
            console::heading(&adapter.name),
            adapter.driver
        );
    }
    for one in &report.environment.not_run {
        let reason = console::faint(format_args!("not run: {}", one.reason));
        let on = one.adapter.iter().map(|adapter| format!(" on {adapter}"));
        let _ = writeln!(text, "route {}{} {reason}", one.route, on.collect::<String>());
    }
    for ((technique, form), cases) in report.by_technique() {
        let name = form.map_or_else(|| technique.clone(), |form| format!("{technique} ({form})"));
        let _ = writeln!(text, "  {name:38} {}", counts(&cases));
    }
    for case in &report.cases {
        if let (CaseVerdict::Fail | CaseVerdict::Warn | CaseVerdict::Skip, reason) =
            (case.verdict, &case.reason)
        {
            text.push_str(&needs_a_look(case, reason.as_deref().unwrap_or_default()));
        }
    }
    let totals = report.totals();
    let _ = writeln!(
        text,
        "\n{} results: {} passed, {} failed, {} with a warning, {} skipped, {} failed as expected; {} outputs of {} inputs",
        totals.cases,
        totals.pass,
        totals.fail,
        totals.warn,
        totals.skip,
        totals.expected_fail,
        totals.outputs,
        totals.inputs
    );
    let undecided = report.undecided();
    if undecided.outputs > 0 {
        let _ = writeln!(
            text,
            "undecided: {:.2} % of the outputs of hardened forms ({} open, {} forked of {})",
            100.0 * undecided.share(),
            undecided.open,
            undecided.forked,
            undecided.outputs
        );
    }
    text
}

fn counts(cases: &[&CaseResult]) -> String {
    let count = |verdict: CaseVerdict| cases.iter().filter(|case| case.verdict == verdict).count();
    let some = CaseVerdict::ALL.into_iter().filter(|verdict| count(*verdict) > 0);
    let words: Vec<String> = some
        .map(|verdict| painted(verdict, &format!("{} {}", count(verdict), verdict.label())))
        .collect();
    words.join(", ")
}

fn painted(verdict: CaseVerdict, text: &str) -> String {
    match verdict {
        CaseVerdict::Pass | CaseVerdict::ExpectedFail => console::good(text),
        CaseVerdict::Warn | CaseVerdict::Skip => console::faint(text),
        CaseVerdict::Fail => console::bad(text),
    }
}

fn needs_a_look(case: &CaseResult, reason: &str) -> String {
    let verdict = painted(case.verdict, case.verdict.label());
    format!(
        "\n{verdict}: {}\n  route {} on {}\n  {reason}\n  again: {}\n",
        case.id,
        case.route,
        case.adapter,
        case.rerun()
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shards_count_from_one() {
        assert_eq!(shard("2/4").unwrap(), (2, 4));
        for wrong in ["", "0/4", "5/4", "1/0", "1", "a/b", "1/2/3", "-1/2"] {
            assert_eq!(shard(wrong).unwrap_err().exit_code(), 2, "{wrong} is no shard");
        }
    }

    #[test]
    fn a_route_has_its_name_or_a_suggestion() {
        assert_eq!(route("spirv").unwrap(), Route::Spirv);
        assert!(
            route("spriv")
                .unwrap_err()
                .to_string()
                .contains("did you mean spirv?")
        );
    }
}
