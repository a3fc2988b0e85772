//! Negative controls: pictures of a blending unit that does not multiply, or not by the right factor, are refused.

use super::{Found, code_of_one, code_of_two};
use crate::compare::Comparison;

/// What a target of bytes keeps.
fn store(colour: f32) -> u8 {
    (255.0 * colour.clamp(0.0, 1.0)).round() as u8
}

/// A picture's worth of lights and colours, blended by `blend` from a kept light and a colour, both in [0, 1].
fn judged(blend: impl Fn(f32, f32) -> f32) -> Comparison {
    let mut found = Found::default();
    for at in 0..1024_u16 {
        let (light, colour) = (f32::from(at % 32) / 31.0, f32::from(at / 32) / 31.0);
        let two = store(blend(f32::from(store(light)) / 255.0, colour));
        let one = store(light * colour);
        let written = [[light * colour; 4], [light; 4], [colour; 4]];
        found.bytes(&[f32::from(at)], written, [one; 4], [two; 4]);
    }
    found.comparison
}

#[test]
fn a_blending_unit_that_multiplies_passes() {
    let exact = judged(|destination, source| destination * source);
    assert_eq!((exact.refused, exact.outputs), (0, 1024 * 4 * 3));
    let rounds_its_source = judged(|destination, source| destination * f32::from(store(source)) / 255.0);
    assert_eq!(rounds_its_source.refused, 0);
}

#[test]
fn no_blending_is_refused() {
    assert!(judged(|_, source| source).refused > 1000);
    assert!(judged(|destination, _| destination).refused > 1000);
}

#[test]
fn the_wrong_factor_is_refused() {
    assert!(judged(|destination, source| destination + source).refused > 1000);
    assert!(judged(|destination, source| destination * source * source).refused > 1000);
    // Two codes off at the bright end.
    assert!(judged(|destination, source| 0.99 * destination * source).refused > 0);
}

#[test]
fn codes_at_a_boundary_have_two_answers_and_others_one() {
    let one = code_of_one(100.4 / 255.0);
    assert!(one.bound.contains(100.0) && !one.bound.contains(101.0));
    let boundary = code_of_one(100.5 / 255.0);
    assert!(boundary.bound.contains(100.0) && boundary.bound.contains(101.0));
    // 200 · 100.4/255 = 78.7, 200 · 100/255 = 78.4: 78 or 79.
    let two = code_of_two(200.0 / 255.0, 100.4 / 255.0);
    assert!(two.bound.contains(78.0) && two.bound.contains(79.0));
    assert!(!two.bound.contains(77.0) && !two.bound.contains(80.0));
    // 255 · 17/255 is 17 and nothing else.
    let exact = code_of_two(1.0, 17.0 / 255.0);
    assert!(exact.bound.contains(17.0) && !exact.bound.contains(16.0) && !exact.bound.contains(18.0));
}
