use std::collections::BTreeSet;

use super::super::tests::{embedded, find, library, measured};
use super::*;

#[test]
fn every_published_function_is_compared_or_said_to_be_alone() {
    let published = PROBES.iter().filter(|probe| probe.form == Form::Published);
    let all: BTreeSet<&str> = published.map(Probe::function).collect();
    let compared: BTreeSet<&str> = pairs().iter().map(|pair| pair.published.function()).collect();
    let alone: BTreeSet<&str> = ALONE.iter().map(|(name, _)| *name).collect();
    assert!(compared.is_disjoint(&alone));
    // A new one: give it a hardened function of the same name, inputs and outputs, or a reason in `ALONE`.
    assert_eq!(&compared | &alone, all);
}

#[test]
fn the_two_forms_of_a_pair_take_and_give_the_same() {
    for pair in pairs() {
        let Pair { hardened, published } = pair;
        assert_eq!(hardened.input_floats, published.input_floats, "{}", hardened.id);
        assert_eq!(hardened.output_floats, published.output_floats, "{}", hardened.id);
    }
}

/// What hardening is for: published forms fail wholly on hard inputs, hardened ones nowhere. `normalise` and what is made of it alone is
/// a dozen roundings of 2⁻²⁴.
#[test]
fn published_forms_fail_on_hard_inputs_and_hardened_ones_do_not() {
    let prices = measured("form");
    for name in ["normalise", "half_vector", "dot3", "light_to_colour"] {
        assert_eq!(
            find(prices, &format!("{name} published, hard")).max,
            1.0,
            "{name}"
        );
        let cured = find(prices, &format!("{name} hardened, hard"));
        assert!(cured.max <= 12.0 * 2f64.powi(-24), "{name}: {}", cured.max);
    }
    // On ordinary inputs the median of the two is hardly different: the fault is at the edges.
    let [one, two] = ["hardened", "published"].map(|form| find(prices, &format!("dot3 {form}, ordinary")));
    assert!(one.p50 < 1e-6 && two.p50 < 1e-6);
    // The guard costs something.
    assert!(one.ops > two.ops);
}

#[test]
fn a_wrong_form_is_seen() {
    let library = library();
    let context = embedded(&library);
    let of = |name: &str| PROBES.iter().find(|probe| probe.function() == name).unwrap();
    // Colours for directions: another formula of the same shape.
    let swapped = Pair {
        hardened: of("normalise"),
        published: of("light_to_colour"),
    };
    let prices = measure(&context, &[swapped]).unwrap();
    let wrong = prices.iter().filter(|price| price.p50 > 0.1).count();
    assert_eq!(wrong, 2, "{prices:?}");
}

#[test]
fn errors_are_relative_and_end_at_one() {
    assert_eq!(error(&[2.0, 0.0], &[2.0, 0.5]), 0.25);
    assert_eq!(error(&[0.0], &[0.0]), 0.0);
    assert_eq!(error(&[0.0], &[1e-30]), 1.0);
    assert_eq!(error(&[1.0, 1.0], &[f64::NAN, 1.0]), 1.0);
    assert_eq!(error(&[1.0], &[f64::INFINITY]), 1.0);
    assert_eq!(error(&[1.0], &[-7.0]), 1.0);
}
