//! A sample of the library's mutants, small enough for every test run: one a kind of fault, each of which conformance must catch,
//! and one change that is no fault and must not be caught.
//!
//! The sample is fixed, so that a run fails for what was changed and not for what was drawn. The share of all mutants is another
//! question: `./x mutants` answers it.

use std::collections::BTreeSet;

use bossage_mutants::fate::Fate;
use bossage_mutants::generate;
use bossage_mutants::ground::{Ground, conformance};
use bossage_mutants::mutant::Mutant;
use bossage_mutants::operator::OPERATORS;

use crate::support::{device, sources};

/// Mutants of functions that have answers known on paper, which are judged in no time; of two kinds only kernels have any.
const SAMPLE: &[&str] = &[
    "entry/frame_from_uv.wesl:gathered:shorten_loop:1",
    "lib/bilinear.wesl:bilinear:drop_bias:1",
    "lib/bilinear.wesl:bilinear:swap_arithmetic:1",
    "lib/bilinear.wesl:bilinear_gradient:swap_arguments:1",
    "lib/bilinear.wesl:bilinear_gradient:swap_components:1",
    "lib/cube.wesl:cube_place:drop_guard:1",
    "lib/cube.wesl:cube_place:drop_negation:1",
    "lib/cube.wesl:cube_place:drop_statement:1",
    "lib/cube.wesl:cube_place:negate_condition:1",
    "lib/cube.wesl:cube_place:scale_constant:3",
    "lib/cube.wesl:cube_place:swap_comparison:2",
    "lib/edge.wesl:resolve_edge:swap_min_max:1",
    "lib/pack.wesl:pack_rgba8:swap_bitwise:1",
    "techniques/blinn_phong.wesl:half_vector:drop_normalise:1",
    "techniques/frame_from_uv.wesl:frame_from_uv_triangle:swap_logical:1",
];

fn sample() -> Vec<Mutant> {
    let all = generate::mutants(&sources()).expect("the library parses");
    let of = |id: &&str| {
        let found = all.iter().find(|mutant| mutant.id == *id);
        found
            .unwrap_or_else(|| panic!("no mutant is called {id}"))
            .clone()
    };
    SAMPLE.iter().map(of).collect()
}

#[test]
fn the_sample_has_each_kind_once() {
    let sample = sample();
    let kinds: BTreeSet<&str> = sample.iter().map(|mutant| mutant.operator).collect();
    assert_eq!(kinds, OPERATORS.iter().map(|operator| operator.name).collect());
    assert_eq!(sample.len(), OPERATORS.len());
}

#[test]
fn one_fault_of_each_kind_is_caught_and_no_fault_is_not() {
    let Some(device) = device("a sample of mutants") else {
        return;
    };
    let ground = Ground::new(sources(), false).expect("the library is whole");
    let judge = |mutant: &Mutant| {
        ground
            .judge(mutant, &device, conformance, &mut |_| {})
            .expect("the cases pass without a fault")
    };
    for mutant in sample() {
        let fate = judge(&mutant);
        assert!(matches!(fate, Fate::Caught { .. }), "{}: {fate:?}", mutant.id);
    }
    // A number by another name is no fault: every case that it reaches runs and passes.
    let (was, is) = ("let far = h01 +", "let corner = h01;\n    let far = corner +");
    let file = "lib/bilinear.wesl";
    let text = sources().files[file].replace(was, is);
    assert_ne!(text, sources().files[file], "`{was}` is not in {file}");
    let first = generate::of_file(file, &text).expect("the file parses").remove(0);
    let fate = judge(&Mutant { text, ..first });
    assert!(matches!(fate, Fate::Survived { cases: 1.. }), "{fate:?}");
}
