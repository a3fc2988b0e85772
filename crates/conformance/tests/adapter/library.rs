//! The library as it is: everything passes, the known defects show, nothing is skipped.

use bossage_conformance::suite::scene::files_in;
use std::collections::BTreeSet;

use bossage_conformance::bench::Bench;
use bossage_conformance::{Module, Route, Selection, Verdict};
use bossage_runner::{AdapterSelector, Device};
use bossage_shaders::{Library, TECHNIQUES};

use crate::support::{listed, report, root};

/// Cases that may warn: through a driver's filter the interval of a cone grows from step to step, and on steep waves more outputs join
/// several results than the limit derived from the rays that f64 finds touchy; so do a few shadows there. No output of theirs is refused.
const WARNED: [&str; 3] = [
    "cone_step/hits:heights=filtered;map=waves",
    "relaxed_cone_step/hits:heights=filtered;map=waves",
    "self_shadow/light:heights=filtered;map=waves",
];

#[test]
fn every_technique_conforms_on_every_route() {
    let library = Library::embedded().expect("the embedded library is whole");
    let Some(report) = report("every technique", &Selection::default(), &library) else {
        return;
    };
    assert!(report.is_ok(), "{}", listed(&report, Verdict::Fail));
    let totals = report.totals();
    assert_eq!(totals.skip, 0, "{}", listed(&report, Verdict::Skip));
    let warned: Vec<String> = report
        .cases
        .iter()
        .filter(|case| case.verdict == Verdict::Warn)
        .map(|case| case.id.to_string())
        .filter(|id| !WARNED.contains(&id.as_str()))
        .collect();
    assert!(warned.is_empty(), "{}", listed(&report, Verdict::Warn));
    assert!(totals.expected_fail > 0, "the known defects must show");
    let undecided = report.undecided();
    assert!(undecided.outputs > 1_000_000, "{undecided:?}");
    assert!(undecided.share() < 0.01, "{undecided:?}");
    for technique in TECHNIQUES {
        let inputs: usize = report
            .cases
            .iter()
            .filter(|c| c.id.technique == technique.id)
            .map(|c| c.inputs)
            .sum();
        assert!(inputs >= 10_000, "{}: {inputs} inputs", technique.id);
    }
}

#[test]
fn every_example_scene_conforms_as_planned_and_with_all_effects() {
    let library = Library::embedded().expect("the embedded library is whole");
    let scenes = files_in(&root().join("examples")).expect("the examples are there");
    assert!(scenes.len() >= 4, "{scenes:?}");
    let selection = Selection {
        filter: Some("scene/".to_owned()),
        scenes,
        ..Selection::default()
    };
    let Some(report) = report("every scene", &selection, &library) else {
        return;
    };
    assert!(report.is_ok(), "{}", listed(&report, Verdict::Fail));
    let totals = report.totals();
    assert_eq!(
        (totals.skip, totals.warn),
        (0, 0),
        "{}{}",
        listed(&report, Verdict::Skip),
        listed(&report, Verdict::Warn)
    );
}

/// A kind of case that kept quiet about a module would escape whoever asks which cases a change reaches.
#[test]
fn cases_name_the_modules_that_they_ask_for() {
    let library = Library::embedded().expect("the embedded library is whole");
    let small = [
        "/control",
        "/defect",
        "field=one",
        "mesh=degenerate",
        "scene=brick_wall",
    ];
    let selection = Selection {
        scenes: vec![root().join("examples/brick_wall.toml")],
        ..Selection::default()
    };
    // Says that it is skipped where there is no adapter.
    let one = Selection {
        filter: Some("dot3/hardened/control".to_owned()),
        ..Selection::default()
    };
    if report("modules of cases", &one, &library).is_none() {
        return;
    }
    let device = Device::open(&AdapterSelector::Any).expect("the adapter that was just there");
    let mut kinds = BTreeSet::new();
    let cases = selection.cases().expect("there are cases");
    for case in cases
        .iter()
        .filter(|case| small.iter().any(|part| case.id().matches(part)))
    {
        let bench = Bench::new(&device, Route::Wgsl, &library);
        case.run(&bench);
        let named: BTreeSet<Module> = case.modules().expect("the files are there").into_iter().collect();
        let asked: BTreeSet<Module> = bench.asked().into_iter().collect();
        assert!(!asked.is_empty(), "{} asked for nothing", case.id());
        let quiet: Vec<String> = asked.difference(&named).map(ToString::to_string).collect();
        assert!(quiet.is_empty(), "{} does not name {quiet:?}", case.id());
        kinds.insert(case.id().generator.clone());
    }
    assert!(kinds.len() >= 7, "{kinds:?}");
}
