//! Shaders as others write them, one subject a file: each entry point is evaluated over every domain, to its end.
//!
//! `corpus` has one file a kind of the IR, with numbers worked out by hand. This is the other half: twenty whole programs, from sorting to
//! sphere tracing, of which nothing is asked but that all of them can be evaluated.

use crate::common::module;
use crate::mutated::run;
use bossage_bounds::ranges::{Inputs, Style};
use bossage_bounds::{Accept, Error, F32, F64, Program, Range};
use std::path::PathBuf;

/// The files, in the order of their names.
fn files() -> Vec<(String, String)> {
    let folder = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("tests/gallery");
    let mut files: Vec<(String, String)> = std::fs::read_dir(&folder)
        .unwrap_or_else(|e| panic!("{}: {e}", folder.display()))
        .map(|entry| entry.unwrap().path())
        .map(|path| {
            let text = std::fs::read_to_string(&path).unwrap();
            (path.file_name().unwrap().to_string_lossy().into_owned(), text)
        })
        .collect();
    files.sort();
    files
}

/// What keeps an entry point from being evaluated over all domains, by domain.
fn failures(text: &str) -> Vec<String> {
    let (module, info) = module(text);
    let mut failures = Vec::new();
    for entry in &module.entry_points {
        let mut note =
            |domain: &str, error: Error| failures.push(format!("{} {domain}: {error}", entry.name));
        let program = match Program::new(&module, &info, &entry.name) {
            Ok(program) => program,
            Err(error) => {
                note("compiled", error);
                continue;
            }
        };
        let inputs = Inputs::new(&module, &info, &entry.name, None).unwrap_or_else(|e| panic!("{e}"));
        for style in [Style::Random, Style::Edge] {
            let results = [
                ("F32", run::<F32>(&program, &inputs, style)),
                ("F64", run::<F64>(&program, &inputs, style)),
                ("Accept", run::<Accept>(&program, &inputs, style)),
                ("Range", run::<Range>(&program, &inputs, style)),
            ];
            results
                .into_iter()
                .filter_map(|(domain, result)| Some((domain, result.err()?)))
                .for_each(|(domain, error)| note(domain, error));
        }
    }
    failures
}

#[test]
fn whole_programs_are_evaluated_over_every_domain() {
    let files = files();
    assert!(files.len() >= 20, "{}", files.len());
    let failed: Vec<String> = files
        .iter()
        .flat_map(|(name, text)| failures(text).into_iter().map(move |why| format!("{name} {why}")))
        .collect();
    assert!(failed.is_empty(), "{}", failed.join("\n"));
}

/// Control: what is left out, and what does not end, is told.
#[test]
fn a_program_that_is_not_evaluated_is_seen() {
    let endless = "@group(0) @binding(0) var<storage, read_write> o: array<f32>;\n\
        @compute @workgroup_size(1) fn main() { var x = 1.0; while (x > 0.0) { x += 1.0; } o[0] = x; }";
    assert!(
        failures(endless).iter().any(|why| why.starts_with("main F32")),
        "{:?}",
        failures(endless)
    );
}
