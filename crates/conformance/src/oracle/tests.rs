//! The two oracles over every probe of the library, and what a broken oracle or a broken machine does to them.
//!
//! No adapter is needed: the machine under test is `bossage-bounds`' `F32` domain, which rounds each operation to nearest.

use bossage_bounds::{F32, F64, Limits, Program, run_probe};
use bossage_shaders::{Form, Library, PROBES, Probe};

use super::{Args, expected, truth, truth_of};
use crate::bound::Bound;
use crate::compare::{Comparison, Expected, Refusal};
use crate::generate::{Inputs, control, edge, random};
use crate::route::{Prepared, Route};
use crate::suite::defect::{Evidence, defects};
use crate::undecided;

/// The module of a probe, as every route prepares it.
fn module(probe: &Probe) -> Prepared {
    let library = Library::embedded().unwrap();
    Route::Wgsl
        .prepare(&library.assemble_probe(probe.id).unwrap())
        .unwrap()
}

fn program(probe: &Probe) -> std::sync::Arc<Program> {
    module(probe).program(probe.entry).unwrap()
}

/// What a machine without any error of its own returns, and what the formula as written gives in float64.
fn machine(probe: &Probe, program: &Program, inputs: &Inputs) -> Vec<f32> {
    let outputs = probe.output_floats * inputs.len();
    let (values, _) =
        run_probe::<F32>(program, &inputs.values, outputs, inputs.len(), &Limits::default()).unwrap();
    values.into_iter().map(|x| x as f32).collect()
}

/// The outputs of a machine against expectations.
fn judged(probe: &Probe, inputs: &Inputs, got: &[f32], expected: &[Vec<Expected>]) -> Comparison {
    let mut all = Comparison::default();
    for ((input, got), expected) in inputs.items().zip(got.chunks(probe.output_floats)).zip(expected) {
        all.item(input, got, expected);
    }
    all
}

fn find(function: &str) -> &'static Probe {
    PROBES.iter().find(|probe| probe.function() == function).unwrap()
}

#[test]
fn every_probe_has_a_truth_and_every_truth_a_probe() {
    for probe in PROBES {
        let inputs = random::generate(probe, 1, 0, 1);
        let truth =
            truth_of(probe, &inputs.values).unwrap_or_else(|| panic!("no truth for `{}`", probe.function()));
        assert_eq!(truth.len(), probe.output_floats, "{}: outputs", probe.id);
        let exact: Vec<f64> = inputs.values.iter().copied().map(f64::from).collect();
        let mut args = Args::new(&exact);
        truth::find(probe.function()).unwrap()(&mut args);
        assert!(args.is_empty(), "{}: the truth leaves inputs unread", probe.id);
    }
    let orphans: Vec<&str> = truth::names()
        .filter(|name| !PROBES.iter().any(|probe| probe.function() == *name))
        .collect();
    assert!(orphans.is_empty(), "truths without a probe: {orphans:?}");
}

#[test]
fn a_perfect_machine_and_the_truth_lie_in_every_interval() {
    for probe in PROBES {
        let program = program(probe);
        let sets = [
            random::generate(probe, 500, 0, 2),
            edge::generate(probe),
            control::generate(probe),
        ];
        for inputs in sets.iter().filter(|inputs| !inputs.is_empty()) {
            let expected = expected(probe, &program, inputs).unwrap();
            let result = judged(probe, inputs, &machine(probe, &program, inputs), &expected);
            assert_eq!(result.outputs, probe.output_floats * inputs.len(), "{}", probe.id);
            let worst = result.worst.map(|worst| worst.to_string()).unwrap_or_default();
            assert_eq!(result.refused, 0, "{}: {:?}\n{worst}", probe.id, result.refusal);
        }
    }
}

#[test]
fn hardened_functions_are_decided_on_random_inputs() {
    for probe in PROBES.iter().filter(|probe| probe.form == Form::Hardened) {
        let inputs = random::generate(probe, 2000, 0, 3);
        let expected = expected(probe, &program(probe), &inputs).unwrap().concat();
        let unsettled = expected.iter().filter(|e| !e.bound.is_settled()).count();
        let most = undecided::limit(probe.function(), undecided::Inputs::Random) * expected.len() as f64;
        let (id, n) = (probe.id, expected.len());
        assert!(unsettled as f64 <= most, "{id}: {unsettled} of {n} undecided");
    }
}

#[test]
fn defects_of_the_rules_are_open_where_published_and_decided_where_cured() {
    for defect in defects().filter(|defect| defect.evidence == Evidence::Rules) {
        let is_open = |function: &str, witness: &[f32]| {
            let probe = find(function);
            let inputs = Inputs {
                values: witness.to_vec(),
                stride: witness.len(),
            };
            let bounds = super::bounds(probe, &program(probe), &inputs).unwrap();
            bounds.iter().any(|bound| !bound.is_decided())
        };
        assert!(is_open(defect.published, defect.witness), "{}", defect.name);
        if let Some(hardened) = defect.hardened {
            let witness = defect.cured_witness.unwrap_or(defect.witness);
            assert!(!is_open(hardened, witness), "{}: the cure", defect.name);
        }
    }
}

/// Intervals that a broken oracle would give: those of every probe with random inputs, changed, must be refused somewhere.
fn caught(probe: &Probe, change: impl Fn(&mut Expected, f64)) -> Comparison {
    let (program, inputs) = (program(probe), random::generate(probe, 500, 0, 5));
    let outputs = probe.output_floats * inputs.len();
    let limits = Limits::default();
    let (formula, _) = run_probe::<F64>(&program, &inputs.values, outputs, inputs.len(), &limits).unwrap();
    let mut expected = expected(probe, &program, &inputs).unwrap();
    for (e, formula) in expected.iter_mut().flatten().zip(formula) {
        change(e, formula);
    }
    judged(probe, &inputs, &machine(probe, &program, &inputs), &expected)
}

/// Functions whose results are rounded, of all kinds: sums, products, quotients, roots, powers.
const ROUNDED: [&str; 6] = [
    "elevation",
    "normalise",
    "highlight_power",
    "parallax_offset",
    "height_to_normal",
    "normal_transform",
];

#[test]
fn an_interval_that_is_too_narrow_is_caught() {
    for function in ROUNDED {
        let narrowed = caught(find(function), |e, _| e.bound = Bound::exactly(e.bound.high()));
        assert!(narrowed.refused > 0, "{function}");
    }
}

#[test]
fn an_interval_without_the_accuracy_rules_is_caught() {
    // The formula's value alone, as if no operation were allowed to err: the truth is in it, a machine's result is not.
    for function in ROUNDED {
        let ruleless = caught(find(function), |e, formula| e.bound = Bound::exactly(formula));
        assert!(ruleless.refused > 0, "{function}");
    }
}

#[test]
fn a_wrong_truth_is_caught_although_the_machine_is_right() {
    for function in ROUNDED {
        let wrong = caught(find(function), |e, _| e.truth *= 1.01);
        assert_eq!(wrong.refusal, Some(Refusal::OraclesDisagree), "{function}");
    }
}

#[test]
fn another_formula_is_caught_although_its_interval_is_its_own() {
    // The shader of one function against the truth of its neighbour: the intervals follow the shader, the truth does not.
    for (shader, formula) in [
        ("parallax_offset", "parallax_offset_published"),
        ("codec_biased_decode", "codec_biased_decode_published"),
        ("dot3", "lambert"),
    ] {
        let (probe, program) = (find(shader), program(find(shader)));
        let inputs = random::generate(probe, 500, 0, 6);
        let mut expected = expected(probe, &program, &inputs).unwrap();
        for (row, input) in expected.iter_mut().zip(inputs.items()) {
            let wrong = truth_of(find(formula), input).unwrap();
            row.iter_mut().zip(wrong).for_each(|(e, truth)| e.truth = truth);
        }
        let result = judged(probe, &inputs, &machine(probe, &program, &inputs), &expected);
        assert_eq!(result.refusal, Some(Refusal::OraclesDisagree), "{shader}");
    }
}
