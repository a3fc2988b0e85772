//! Float arithmetic of the point domains, bit for bit, and of the acceptance intervals, by containment.

use crate::common::probe;
use bossage_bounds::{Accept, F32, F64};
use proptest::prelude::*;

fn bits(list: &[f64]) -> Vec<u32> {
    list.iter().map(|&x| (x as f32).to_bits()).collect()
}

/// An expression, and what it is in the processor's arithmetic.
type Case = (&'static str, fn(f32, f32) -> f32);

/// The operations that a perfect machine rounds correctly, against the processor's own.
fn exact_cases() -> Vec<Case> {
    vec![
        ("a[2u*i] + a[2u*i+1u]", |x, y| x + y),
        ("a[2u*i] - a[2u*i+1u]", |x, y| x - y),
        ("a[2u*i] * a[2u*i+1u]", |x, y| x * y),
        ("a[2u*i] / a[2u*i+1u]", |x, y| x / y),
        ("sqrt(abs(a[2u*i]))", |x, _| x.abs().sqrt()),
        ("fma(a[2u*i], a[2u*i+1u], 0.1)", |x, y| x.mul_add(y, 0.1)),
        ("floor(a[2u*i])", |x, _| x.floor()),
        ("round(a[2u*i])", |x, _| x.round_ties_even()),
    ]
}

proptest! {
    #![proptest_config(crate::common::cases(64))]

    #[test]
    fn f32_results_are_bit_exact(values in prop::collection::vec(any::<f32>().prop_filter("number", |x| !x.is_nan()), 128)) {
        for (expression, f) in exact_cases() {
            let got = probe::<F32>(&format!("o[i] = {expression};"), &values, 64);
            for (pair, got) in values.chunks(2).zip(got) {
                let want = f(pair[0], pair[1]);
                let same = want.is_nan() && got.is_nan() || want.to_bits() == (got as f32).to_bits();
                prop_assert!(same, "{expression} of {pair:?}: {got}, want {want}");
            }
        }
    }

    #[test]
    fn accept_contains_the_perfect_machine(values in prop::collection::vec(-1e6f32..1e6, 128)) {
        for (expression, f) in exact_cases() {
            let got = probe::<Accept>(&format!("o[i] = {expression};"), &values, 64);
            for (pair, got) in values.chunks(2).zip(got) {
                let want = f64::from(f(pair[0], pair[1]));
                prop_assert!(got.contains(want), "{expression} of {pair:?}: {want} not in {got:?}");
            }
        }
    }
}

#[test]
fn control_flow_and_functions() {
    let body = "var s = 0.0; for (var k = 0; k < 10; k++) { if (k == 3) { continue; } if (k == 7) { break; } s += f32(k) * a[0]; } o[i] = s;";
    // 0 + 1 + 2 + 4 + 5 + 6 = 18.
    assert_eq!(probe::<F32>(body, &[2.0], 3), [36.0; 3]);
    assert_eq!(probe::<F64>(body, &[2.0], 3), [36.0; 3]);
    assert!(probe::<Accept>(body, &[2.0], 1)[0].contains(36.0));
}

#[test]
fn the_formula_in_f64_is_not_rounded_to_f32() {
    let got = probe::<F64>("o[i] = a[0] / a[1];", &[1.0, 3.0], 1);
    assert_eq!(got, [1.0 / 3.0]);
    assert_eq!(
        bits(&probe::<F32>("o[i] = a[0] / a[1];", &[1.0, 3.0], 1)),
        [(1.0f32 / 3.0).to_bits()]
    );
}
