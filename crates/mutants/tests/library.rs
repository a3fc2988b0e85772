//! The mutants of the library as it is, without running any.

use std::collections::BTreeSet;
use std::path::Path;

use bossage_mutants::equivalent::List;
use bossage_mutants::folder::Sources;
use bossage_mutants::generate;
use bossage_mutants::operator::OPERATORS;

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

fn sources() -> Sources {
    Sources::read(&root().join("../../shaders")).expect("the shaders are there")
}

#[test]
fn every_operator_finds_something_to_break() {
    let mutants = generate::mutants(&sources()).expect("the library parses");
    let used: BTreeSet<&str> = mutants.iter().map(|mutant| mutant.operator).collect();
    let all: BTreeSet<&str> = OPERATORS.iter().map(|operator| operator.name).collect();
    assert_eq!(used, all);
}

#[test]
fn ids_are_unique_and_generation_is_the_same_each_time() {
    let sources = sources();
    let mutants = generate::mutants(&sources).expect("the library parses");
    let ids: BTreeSet<&str> = mutants.iter().map(|mutant| mutant.id.as_str()).collect();
    assert_eq!(ids.len(), mutants.len());
    assert_eq!(mutants, generate::mutants(&sources).expect("the library parses"));
    for mutant in &mutants {
        assert_ne!(
            mutant.text, sources.files[&mutant.file],
            "{} changes nothing",
            mutant.id
        );
        assert_ne!(mutant.was, mutant.is, "{}", mutant.id);
    }
}

#[test]
fn every_file_with_a_function_is_broken_somewhere() {
    let sources = sources();
    let mutants = generate::mutants(&sources).expect("the library parses");
    let broken: BTreeSet<&str> = mutants.iter().map(|mutant| mutant.file.as_str()).collect();
    for (file, text) in &sources.files {
        let computes = text.lines().any(|line| line.starts_with("fn "));
        assert!(
            !computes || broken.contains(file.as_str()),
            "nothing is broken in {file}"
        );
    }
}

#[test]
fn every_entry_of_the_list_fits_a_mutant() {
    let list = List::read(&root().join("equivalent.toml")).expect("the list is one");
    let mutants = generate::mutants(&sources()).expect("the library parses");
    if let Err(stale) = list.check(&mutants) {
        panic!("{stale}");
    }
}
