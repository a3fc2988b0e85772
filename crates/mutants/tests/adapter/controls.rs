//! Negative controls of the judgement: an oracle that accepts everything catches nothing, a library without a fault is not
//! caught, and faults that conformance must see are.

use bossage_conformance::case::Outcome;
use bossage_mutants::fate::Fate;
use bossage_mutants::generate;
use bossage_mutants::ground::{Ground, Jury, Step, conformance};
use bossage_mutants::mutant::Mutant;
use bossage_runner::Device;

use crate::support::{device, sources};

const FILE: &str = "techniques/parallax_offset_limited.wesl";

fn accepts_everything(_outcome: &Outcome) -> bool {
    false
}

fn refuses_everything(_outcome: &Outcome) -> bool {
    true
}

fn ground() -> Ground {
    Ground::new(sources(), true).expect("the library is whole")
}

fn judge(ground: &Ground, device: &Device, mutant: &Mutant, jury: Jury) -> (Fate, Vec<Step>) {
    let mut steps = Vec::new();
    let fate = ground
        .judge(mutant, device, jury, &mut |step| steps.push(step))
        .expect("the cases pass without a fault");
    (fate, steps)
}

/// A mutant of the file by hand: `from` becomes `to`.
fn by_hand(from: &str, to: &str) -> Mutant {
    let sources = sources();
    let text = &sources.files[FILE];
    assert!(text.contains(from), "`{from}` is not in {FILE}");
    let mutants = generate::of_file(FILE, text).expect("the file parses");
    let first = mutants.into_iter().next().expect("the file has mutants");
    Mutant {
        text: text.replace(from, to),
        ..first
    }
}

#[test]
fn the_oracle_makes_the_difference() {
    let Some(device) = device("the oracle makes the difference") else {
        return;
    };
    let ground = ground();
    let mutants = generate::of_file(FILE, &sources().files[FILE]).expect("the file parses");
    let counted: Vec<&Mutant> = mutants.iter().filter(|mutant| mutant.is != "{}").collect();
    assert!(counted.len() >= 5);
    for mutant in counted {
        let (fate, _) = judge(&ground, &device, mutant, conformance);
        assert!(
            matches!(fate, Fate::Caught { .. } | Fate::Invalid { .. }),
            "{}: {fate:?}",
            mutant.id
        );
        let (blind, _) = judge(&ground, &device, mutant, accepts_everything);
        assert_eq!(blind.survived(), blind.counts(), "{}: {blind:?}", mutant.id);
    }
}

#[test]
fn a_library_without_a_fault_is_not_caught() {
    let Some(device) = device("a library without a fault") else {
        return;
    };
    let ground = ground();
    // A comment changes no assembled text: nothing runs, not even for an oracle that refuses everything.
    let comment = by_hand("return uv + ", "// the sum\n    return uv + ");
    let (fate, steps) = judge(&ground, &device, &comment, refuses_everything);
    assert_eq!((fate, steps.len()), (Fate::Unreached, 0));
    // Another name for a value changes the text and no result: everything that it reaches runs and passes.
    let renamed = by_hand("return uv + ", "let start = uv;\n    return start + ");
    let (fate, steps) = judge(&ground, &device, &renamed, conformance);
    let Fate::Survived { cases } = fate else {
        panic!("{fate:?}");
    };
    assert_eq!(steps.iter().filter(|step| !step.unmutated).count(), cases);
    assert!(
        steps
            .iter()
            .any(|step| step.case.starts_with("parallax_offset_limited/")),
        "{steps:?}"
    );
    assert!(
        !steps.iter().any(|step| step.case.starts_with("dot3/")),
        "a case ran that it does not reach"
    );
}

#[test]
fn what_does_not_validate_is_no_mutant() {
    let Some(device) = device("what does not validate") else {
        return;
    };
    let ground = ground();
    for (from, to) in [
        ("return uv + ", "return 1u + "),
        ("return uv + ", "return uv uv"),
        ("return uv + ", "return nobody + "),
    ] {
        let (fate, steps) = judge(&ground, &device, &by_hand(from, to), refuses_everything);
        assert!(matches!(fate, Fate::Invalid { .. }), "{to}: {fate:?}");
        assert!(steps.is_empty(), "{to}: it ran");
    }
}
