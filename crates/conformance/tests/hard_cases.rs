//! The table of hard cases in `docs/numerics.md` is what the code says: one row a known defect, and what its cure costs.
//!
//! Cost: scalar operations that the function itself executes, built-in functions counted as the formulas from which they inherit
//! their accuracy, as the mean over the evenly spaced inputs of each form. The text is written anew with
//! `BOSSAGE_UPDATE_DOCS=1 cargo test -p bossage-conformance --test hard_cases`.

use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::ops::Range;
use std::path::{Path, PathBuf};

use bossage_bounds::{F32, Limits, Program, run_probe};
use bossage_conformance::generate::spaced;
use bossage_conformance::suite::defect::{Defect, defects};
use bossage_shaders::{Library, PROBES, Probe};
use bossage_translate::{Shader, Source};

const BEGIN: &str = "<!-- hard cases: written by crates/conformance/tests/hard_cases.rs -->\n";
const END: &str = "<!-- end of hard cases -->";
/// Inputs that the mean is taken over.
const ITEMS: usize = 512;

fn document() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/numerics.md")
}

/// The bytes of a function's text, from its name to its closing brace.
fn extent(text: &str, function: &str) -> Range<usize> {
    let start = text
        .find(&format!("fn {function}("))
        .unwrap_or_else(|| panic!("no function {function}"));
    let mut depth = 0;
    for (at, character) in text[start..].char_indices() {
        match character {
            '{' => depth += 1,
            '}' if depth == 1 => return start..start + at + 1,
            '}' => depth -= 1,
            _ => {}
        }
    }
    panic!("{function} does not end")
}

/// Mean operations of one call, without the probe's own reading and writing.
fn operations(library: &Library, probe: &Probe) -> f64 {
    let assembled = library
        .assemble_probe(probe.id)
        .unwrap_or_else(|why| panic!("{why}"));
    let shader =
        Shader::parse(&assembled.name, &Source::Wgsl(assembled.wgsl)).unwrap_or_else(|why| panic!("{why}"));
    let (module, info) = shader.module(probe.entry).expect("a probe has its entry");
    let program = Program::new(module, info, probe.entry).unwrap_or_else(|why| panic!("{why}"));
    let inputs = spaced::generate(probe, 0, ITEMS);
    let limits = Limits {
        count: true,
        ..Limits::default()
    };
    let outputs = ITEMS * probe.output_floats;
    let (_, outcome) = run_probe::<F32>(&program, &inputs.values, outputs, ITEMS, &limits)
        .unwrap_or_else(|why| panic!("{why}"));
    let entry = extent(shader.text(), probe.entry);
    let own = outcome.spans.iter().filter(|cost| {
        cost.span
            .to_range()
            .is_some_and(|span| !entry.contains(&span.start))
    });
    own.map(|cost| cost.operations).sum::<u64>() as f64 / ITEMS as f64
}

/// The operations of every function that a row names.
fn all_operations() -> BTreeMap<&'static str, f64> {
    let library = Library::embedded().unwrap_or_else(|why| panic!("{why}"));
    let named = defects().flat_map(|defect| [Some(defect.published), defect.hardened]);
    let mut costs = BTreeMap::new();
    for function in named.flatten() {
        let probe = Probe::find(function).unwrap_or_else(|| panic!("no probe {function}"));
        costs
            .entry(probe.function())
            .or_insert_with(|| operations(&library, probe));
    }
    costs
}

fn technique(function: &str) -> &'static str {
    PROBES
        .iter()
        .find(|probe| probe.function() == function)
        .map_or("?", |probe| probe.technique)
}

fn row(defect: &Defect, costs: &BTreeMap<&str, f64>) -> String {
    let published = costs[defect.published];
    let price = match defect.hardened {
        Some(function) => {
            let hardened = costs[function];
            format!("{published:.0} → {hardened:.0} ({:+.0})", hardened - published)
        }
        None => format!("{published:.0}"),
    };
    let [about, cure] = [defect.about, defect.cure].map(|text| text.replace('|', "\\|"));
    let (technique, name) = (technique(defect.published), defect.name);
    format!("| `{technique}` | `{name}` | {about} | {cure} | {price} |")
}

fn table() -> String {
    let costs = all_operations();
    let mut rows: Vec<&Defect> = defects().collect();
    rows.sort_by_key(|defect| (technique(defect.published), defect.name, defect.published));
    let mut text = String::from(
        "| technique | case | the published form | the hardened form | operations |\n|---|---|---|---|---|\n",
    );
    for defect in rows {
        let _ = writeln!(text, "{}", row(defect, &costs));
    }
    text
}

/// The document with its table replaced.
fn with_table(document: &str, table: &str) -> String {
    let start = document.find(BEGIN).expect("the document has the table's mark") + BEGIN.len();
    let end = start + document[start..].find(END).expect("the table has an end");
    format!("{}\n{table}\n{}", &document[..start], &document[end..])
}

#[test]
fn the_table_of_hard_cases_is_current() {
    let path = document();
    let found = std::fs::read_to_string(&path).unwrap_or_else(|why| panic!("{}: {why}", path.display()));
    let wanted = with_table(&found, &table());
    if std::env::var_os("BOSSAGE_UPDATE_DOCS").is_some() {
        std::fs::write(&path, wanted).unwrap_or_else(|why| panic!("{}: {why}", path.display()));
        return;
    }
    let stale = wanted
        .lines()
        .zip(found.lines())
        .find(|(wanted, found)| wanted != found);
    assert!(
        found == wanted,
        "docs/numerics.md is stale, from {stale:?} on; write it anew with BOSSAGE_UPDATE_DOCS=1"
    );
}

#[test]
fn a_stale_row_is_seen() {
    let document = format!("before\n{BEGIN}\n| old |\n\n{END}\nafter\n");
    assert_eq!(
        with_table(&document, "| new |\n"),
        format!("before\n{BEGIN}\n| new |\n\n{END}\nafter\n")
    );
}

#[test]
fn operations_are_counted_without_the_probe_s_own() {
    let library = Library::embedded().unwrap();
    let of = |name: &str| operations(&library, Probe::find(name).unwrap());
    // A product and a sum; a difference.
    assert_eq!(of("elevation"), 2.0);
    assert_eq!(of("emboss_difference"), 1.0);
    // A clamp more, and nothing else.
    assert_eq!(of("slope_occlusion") - of("slope_occlusion_published"), 0.0);
    assert!(of("normalise") > of("normalise_published"));
}
