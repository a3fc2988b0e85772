//! The library as it is: everything passes, the known defects show, nothing is skipped.

use bossage_conformance::suite::scene::files_in;
use bossage_conformance::{Selection, Verdict};
use bossage_shaders::{Library, TECHNIQUES};

use crate::support::{listed, report, root};

#[test]
fn every_technique_conforms_on_every_route() {
    let library = Library::embedded().expect("the embedded library is whole");
    let Some(report) = report("every technique", &Selection::default(), &library) else {
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
    assert!(totals.expected_fail > 0, "the known defects must show");
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
    assert_eq!(report.totals().skip, 0, "{}", listed(&report, Verdict::Skip));
}
