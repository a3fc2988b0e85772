//! `docs/errata.md` names what is there: every test and every conformance case in its last column exists, and every defect of the
//! conformance suite is named. The document says how its names are read.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

fn root() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR"))
}

fn text(path: &Path) -> String {
    fs::read_to_string(path).unwrap_or_else(|why| panic!("{}: {why}", path.display()))
}

/// What a name stands for.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Held {
    /// A test function in one of these files.
    Test { files: Vec<PathBuf>, name: String },
    /// A defect of the conformance suite, under a filter.
    Defect { filter: String, name: String },
}

/// The names in code marks of a table's last column, in order.
fn names(row: &str) -> Vec<String> {
    let cells: Vec<&str> = row.trim().trim_matches('|').split(" | ").collect();
    let last = cells.last().copied().unwrap_or_default();
    last.split('`').skip(1).step_by(2).map(str::to_owned).collect()
}

/// What the rows of the document's tables name.
fn held(document: &str) -> Vec<Held> {
    let rows = document
        .lines()
        .filter(|line| line.starts_with("| ") && line.as_bytes().get(2).is_some_and(u8::is_ascii_digit));
    rows.flat_map(|row| {
        let mut before = None;
        let names = names(row).into_iter().filter_map(move |name| {
            let found = read(&name, before.as_ref())?;
            before = Some(found.clone());
            Some(found)
        });
        names.collect::<Vec<_>>()
    })
    .collect()
}

/// One name, given the one before it in the cell. `None` for what is no test: a lint's rule, a function.
fn read(name: &str, before: Option<&Held>) -> Option<Held> {
    let crates = root().join("crates");
    let test = |files: Vec<PathBuf>, name: &str| {
        Some(Held::Test {
            files,
            name: name.to_owned(),
        })
    };
    if let Some(name) = name.strip_prefix("E::") {
        return test(vec![crates.join("reference/tests/errata.rs")], name);
    }
    if let Some((file, name)) = name.strip_prefix("R::").and_then(|rest| rest.split_once("::")) {
        let source = crates.join("reference/src");
        return test(
            vec![
                source.join(format!("{file}.rs")),
                source.join(format!("{file}/tests.rs")),
            ],
            name,
        );
    }
    if let Some((file, name)) = name.strip_prefix("A::").and_then(|rest| rest.split_once("::")) {
        let assets = crates.join("assets");
        let file = format!("{file}.rs");
        return test(
            vec![assets.join("tests").join(&file), assets.join("src").join(&file)],
            name,
        );
    }
    if let Some((filter, name)) = name.strip_prefix("C:").and_then(|rest| rest.split_once(' ')) {
        return Some(Held::Defect {
            filter: filter.to_owned(),
            name: name.to_owned(),
        });
    }
    match before? {
        Held::Test { files, .. } => test(files.clone(), name),
        Held::Defect { filter, .. } => Some(Held::Defect {
            filter: filter.clone(),
            name: name.to_owned(),
        }),
    }
}

/// The defects of the conformance suite: the names of its rows.
fn defects() -> BTreeSet<String> {
    let folder = root().join("crates/conformance/src/suite/defect");
    let files = fs::read_dir(&folder).unwrap_or_else(|why| panic!("{}: {why}", folder.display()));
    let mut found = BTreeSet::new();
    for file in files.flatten() {
        let text = text(&file.path());
        let named = |mark: &str| -> Vec<String> {
            let parts = text.split(mark).skip(1);
            parts
                .filter_map(|rest| rest.split('"').next())
                .map(str::to_owned)
                .collect()
        };
        found.extend(named("name: \""));
        found.extend(named(".with(\"defect\", \""));
    }
    found
}

fn missing(document: &str) -> Vec<String> {
    let defects = defects();
    let exists = |held: &Held| match held {
        Held::Test { files, name } => {
            let signature = format!("fn {name}(");
            files
                .iter()
                .any(|file| file.exists() && text(file).contains(&signature))
        }
        Held::Defect { filter, name } => {
            let technique = filter.split('/').next().unwrap_or_default();
            let known = bossage_shaders::PROBES
                .iter()
                .any(|probe| probe.technique == technique);
            known && defects.contains(name)
        }
    };
    let wrong = held(document).into_iter().filter(|held| !exists(held));
    wrong.map(|held| format!("{held:?}")).collect()
}

fn document() -> String {
    text(&root().join("docs/errata.md"))
}

#[test]
fn everything_that_is_named_exists() {
    assert!(held(&document()).len() > 80);
    assert_eq!(missing(&document()), Vec::<String>::new());
}

#[test]
fn every_defect_of_the_suite_is_named() {
    let document = document();
    let named: BTreeSet<String> = held(&document)
        .into_iter()
        .filter_map(|held| match held {
            Held::Defect { name, .. } => Some(name),
            Held::Test { .. } => None,
        })
        .collect();
    let unnamed: Vec<String> = defects().difference(&named).cloned().collect();
    assert_eq!(unnamed, Vec::<String>::new());
}

#[test]
fn a_name_that_is_gone_is_seen() {
    for row in [
        "| 9.1 | a | b | c | `E::no_such_test` |",
        "| 9.1 | a | b | c | `R::dot3::no_such_test` |",
        "| 9.1 | a | b | c | `A::bakes::no_such_test` |",
        "| 9.1 | a | b | c | `C:dot3/published no_such_defect` |",
        "| 9.1 | a | b | c | `C:no_such_technique zero_light` |",
        "| 9.1 | a | b | c | `C:dot3/published zero_light`, `no_such_defect` |",
    ] {
        assert_eq!(missing(row).len(), 1, "{row}");
    }
    assert_eq!(
        missing("| 9.1 | a | b | c | lint `implicit_derivative`; see 4.3 |"),
        Vec::<String>::new()
    );
}
