//! Arrows between crates point one way, and two oracles stay independent.
//!
//! The table below is `docs/architecture.md` in code: which of our crates may import which, and which outside crates are
//! forbidden where. It is held over `cargo metadata`, so a dependency that creeps into a `Cargo.toml` fails here.

use std::collections::{BTreeMap, BTreeSet};

use cargo_metadata::{DependencyKind, MetadataCommand};

type Graph = BTreeMap<String, BTreeSet<String>>;

/// Every crate that stands above in the table.
const ABOVE: &str = "all above";

/// Crate, then the crates of ours that it may import (normal and build dependencies; tests may reach further).
const MAY_IMPORT: &[(&str, &[&str])] = &[
    ("assets", &[]),
    ("shaders", &[]),
    ("translate", &[]),
    ("bounds", &[]),
    ("reference", &["assets"]),
    ("scene", &["assets", "shaders", "reference"]),
    ("runner", &["translate"]),
    ("embedded", &["translate", "bounds", "runner"]),
    ("remote", &["translate", "runner"]),
    ("metal", &["translate", "bounds", "runner", "embedded"]),
    ("conformance", &[ABOVE]),
    ("study", &[ABOVE]),
    ("cli", &[ABOVE]),
    ("mutants", &["shaders", "translate", "runner", "conformance"]),
];

/// Crate, then outside crates that it must never import, with the reason in the message.
const NEVER: &[(&str, &[&str], &str)] = &[
    (
        "reference",
        &["naga", "wgpu", "wesl"],
        "the float64 truth must not share code with what it checks",
    ),
    (
        "bounds",
        &["wgpu", "wesl"],
        "the evaluator reads the IR alone: it is the second, independent oracle",
    ),
    ("shaders", &["naga", "wgpu"], "assembling text needs no compiler"),
    (
        "translate",
        &["wgpu", "wesl"],
        "translation runs on machines without an adapter",
    ),
    (
        "embedded",
        &["wgpu", "wesl"],
        "it is there for machines that have no driver",
    ),
    (
        "scene",
        &["naga", "wgpu"],
        "a plan is made without compiling or running anything",
    ),
    (
        "assets",
        &["naga", "wgpu", "wesl"],
        "images and meshes know no shaders",
    ),
];

/// Every arrow that breaks the two tables, as one readable line each.
fn violations(graph: &Graph) -> Vec<String> {
    let mut found = Vec::new();
    for (name, imports) in graph {
        let Some(at) = MAY_IMPORT.iter().position(|(n, _)| n == name) else {
            found.push(format!("crates/{name} is not in the layering table"));
            continue;
        };
        for import in imports {
            match import.strip_prefix("bossage-") {
                Some(ours) if !may_import(at, ours) => {
                    found.push(format!("{name} must not import {ours}"));
                }
                Some(_) => {}
                None => found.extend(forbidden(name, import)),
            }
        }
    }
    found
}

/// Whether the crate at a place of the table may import another of ours.
fn may_import(at: usize, import: &str) -> bool {
    let allowed = MAY_IMPORT[at].1;
    let is_above = MAY_IMPORT[..at].iter().any(|(name, _)| *name == import);
    allowed.contains(&import) || (allowed.contains(&ABOVE) && is_above)
}

fn forbidden(name: &str, import: &str) -> Option<String> {
    let (_, _, why) = NEVER
        .iter()
        .find(|(n, list, _)| *n == name && list.contains(&import))?;
    Some(format!("{name} must not import {import}: {why}"))
}

/// Our crates (by directory name) with every crate they import outside of tests.
fn workspace_graph() -> Graph {
    let metadata = MetadataCommand::new()
        .no_deps()
        .exec()
        .expect("cargo metadata runs in the workspace");
    let ours = metadata
        .packages
        .iter()
        .filter(|p| p.name.as_str() != "bossage-tests");
    ours.map(|package| {
        let name = package
            .name
            .strip_prefix("bossage-")
            .unwrap_or(&package.name)
            .to_owned();
        let imports = package.dependencies.iter();
        let imports = imports.filter(|d| d.kind != DependencyKind::Development);
        (name, imports.map(|d| d.name.clone()).collect())
    })
    .collect()
}

#[test]
fn arrows_point_one_way() {
    let graph = workspace_graph();
    assert!(graph.len() >= 9, "the workspace lost crates: {:?}", graph.keys());
    assert_eq!(violations(&graph), Vec::<String>::new());
}

#[test]
fn every_crate_of_the_table_exists() {
    let graph = workspace_graph();
    for (name, _) in MAY_IMPORT {
        assert!(
            graph.contains_key(*name),
            "the layering table names {name}, which does not exist"
        );
    }
}

#[test]
fn a_wrong_arrow_is_caught() {
    let mut graph = workspace_graph();
    graph
        .get_mut("reference")
        .unwrap()
        .insert("bossage-shaders".into());
    graph.get_mut("reference").unwrap().insert("naga".into());
    graph.get_mut("conformance").unwrap().insert("bossage-cli".into());
    graph.insert("attic".into(), BTreeSet::new());
    let found = violations(&graph);
    assert_eq!(found.len(), 4, "{found:?}");
    assert!(found.contains(&"reference must not import shaders".to_owned()));
    assert!(found.contains(&"conformance must not import cli".to_owned()));
    assert!(found.contains(&"crates/attic is not in the layering table".to_owned()));
}
