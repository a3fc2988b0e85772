//! Hunts of shaders with a planted defect find it from a fixed seed within their evaluations; without it they find nothing.

use bossage_bounds::ranges::Declared;
use bossage_shaders::Library;
use bossage_translate::{Shader, Source};

use super::{Goal, Hunted, Options, hunt_library, hunt_shader};
use crate::heat::Wanted;
use crate::run::Selection;
use crate::user;

/// `a·(y − ROOT)`: y is off by a rounding, and near the root nothing else is left of the difference.
const PLANTED: &str = "
    @group(0) @binding(0) var<storage, read> source: array<vec2f>;
    @group(0) @binding(1) var<storage, read_write> result: array<f32>;
    @compute @workgroup_size(4) fn main(@builtin(local_invocation_index) i: u32) {
        let x = source[i].x;
        result[i] = source[i].y * (x * x - 2.345);
    }";

const RANGES: &str = "schema = 1\n[ranges]\nsource = { size = 4, lo = 1, hi = 2 }\n";

fn options(evaluations: usize, threshold: f64) -> Options {
    Options {
        filter: None,
        seed: 5,
        time: None,
        evaluations: Some(evaluations),
        threshold,
    }
}

fn hunt(text: &str, threshold: f64) -> Hunted {
    hunt_with(text, &options(6000, threshold))
}

fn hunt_with(text: &str, options: &Options) -> Hunted {
    let shader = Shader::parse("planted.wgsl", &Source::Wgsl(text.to_owned())).unwrap();
    let declared = Declared::parse("planted.ranges.toml", RANGES).unwrap();
    let user_options = user::Options {
        entry: None,
        filter: None,
        seed: 5,
        inputs: 1,
        workgroups: None,
        operations: user::OPERATIONS,
        attribute: Wanted::Nothing,
        corpus: None,
        original: None,
        arguments: Vec::new(),
    };
    hunt_shader(&shader, Some(&declared), &user_options, options, &mut |_| {}).unwrap()
}

#[test]
fn a_planted_cancellation_is_found_and_made_plain() {
    let hunted = hunt(PLANTED, 10_000.0);
    let found = hunted
        .findings
        .iter()
        .find(|one| one.goal == Goal::Error)
        .expect("the root is found");
    assert!(found.ulps >= 10_000.0 && found.refused.is_none(), "{found:?}");
    // The guilty element stands first, next to the root of 2.345; its factor and the other elements are plain.
    let first = &found.inputs[0];
    assert!((first.values[0] - 2.345_f64.sqrt()).abs() < 1e-3, "{found:?}");
    assert_eq!(first.values[1], 1.0, "{found:?}");
    assert!(
        found.inputs[1..].iter().all(|one| one.values == [1.0, 1.0]),
        "{found:?}"
    );
    assert_eq!(hunt(PLANTED, 10_000.0), hunted, "equal seeds hunt alike");
}

#[test]
fn without_the_defect_nothing_is_found() {
    let sound = PLANTED.replace("x * x - 2.345", "x * x + 2.345");
    let hunted = hunt(&sound, 64.0);
    assert_eq!(hunted.findings, []);
    assert_eq!(hunted.evaluated[0].1, 6000);
}

/// Neither a round of the search nor the candidates of a number run past the budget.
#[test]
fn a_number_of_evaluations_is_never_exceeded() {
    let sound = PLANTED.replace("x * x - 2.345", "x * x + 2.345");
    for evaluations in [1, 127, 300, 1001] {
        let spent = |text: &str, threshold: f64| {
            let hunted = hunt_with(text, &options(evaluations, threshold));
            (hunted.evaluated[0].1, hunted.findings.len())
        };
        assert_eq!(spent(&sound, 64.0), (evaluations, 0));
        let (evaluated, found) = spent(&sound, 0.1);
        assert!(
            found > 0 && evaluated <= evaluations,
            "{evaluated} of {evaluations}"
        );
    }
}

/// The published form at a grazing view, the defect that its article warns of: an elevation over a small V.z, magnified.
#[test]
fn probes_of_the_library_are_hunted_within_their_domains() {
    let mut told = Vec::new();
    let options = Options {
        filter: Some("codec_octahedral/hardened".to_owned()),
        ..options(1500, 1.0)
    };
    let hunted = hunt_library(
        &options,
        &Selection::default(),
        &Library::embedded().unwrap(),
        &mut |name| told.push(name.to_owned()),
    )
    .unwrap();
    assert!(
        told.len() > 1 && hunted.skipped.is_empty(),
        "{told:?}, {:?}",
        hunted.skipped
    );
    assert!(
        hunted.findings.iter().all(|one| one.refused.is_none()),
        "{hunted:?}"
    );
    assert!(!hunted.corpora.is_empty());
    for corpus in &hunted.corpora {
        let read = super::corpus::Corpus::parse("written", &corpus.text()).unwrap();
        assert_eq!(&read, corpus);
    }
}

#[test]
fn a_filter_that_finds_no_probe_is_an_error() {
    let options = Options {
        filter: Some("dot33".to_owned()),
        ..options(1, 1.0)
    };
    let library = Library::embedded().unwrap();
    assert!(hunt_library(&options, &Selection::default(), &library, &mut |_| {}).is_err());
}
