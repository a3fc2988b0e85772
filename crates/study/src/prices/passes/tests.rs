use super::super::tests::{embedded, find, library, measured};
use super::*;

/// Half a code of a target of bytes.
const HALF_CODE: f64 = 0.5 / 255.0;

/// The combiner and the product in f32: the terms of 4·Σ(a − ½)(b − ½) are at most 1 in all, and some ten roundings follow one another.
const ROUNDINGS: f64 = 10.0 * 6e-8;

#[test]
fn a_target_rounds_once_a_pass() {
    let prices = measured("passes");
    let bounds = [
        ("one pass, bytes", HALF_CODE),
        ("two passes, bytes", 2.0 * HALF_CODE),
        ("one pass, floats", 0.0),
        ("two passes, floats", 0.0),
    ];
    for (name, bound) in bounds {
        let max = find(prices, name).max;
        assert!(max <= bound + ROUNDINGS, "{name}: {max}");
        assert!(max >= 0.9 * bound, "{name}: {max} of {bound}");
    }
}

#[test]
fn the_second_pass_costs_no_read_more_and_little_arithmetic() {
    let prices = measured("passes");
    for target in ["bytes", "floats"] {
        let [one, two] = ["one pass", "two passes"].map(|way| find(prices, &format!("{way}, {target}")));
        assert_eq!((one.fetches, two.fetches), (3.0, 3.0));
        assert!(two.ops > 0.5 * one.ops);
        assert!(two.p50 >= one.p50);
    }
    assert_eq!(find(prices, "one pass, bytes").bytes, 4.0);
}

#[test]
fn a_surface_multiplied_twice_is_seen() {
    let library = library();
    let broken = TEXT.replace(
        "return vec4f(dot3_first_pass(normal, light), 1.0);",
        "return vec4f(dot3_first_pass(normal, light) * textureLoad(surfaces, pixel, 0).rgb, 1.0);",
    );
    assert_ne!(broken, TEXT);
    let prices = measure(&embedded(&library), &broken).unwrap();
    assert!(find(&prices, "two passes, bytes").p50 > 10.0 * HALF_CODE);
    assert!(find(&prices, "one pass, bytes").max <= HALF_CODE + ROUNDINGS);
}
