use bossage_reference::relief_truth::first_hit_lifted;

use super::super::tests::{find, measured};
use super::*;

/// Rounded heights lie within half a code of the others, and so do the two bilinear surfaces: the hit lies between those on the surface
/// lifted and lowered by that much. A step of f32's in a height of 8 or 16 bits and of f64's in a root is let through.
#[test]
fn a_hit_on_rounded_heights_lies_between_those_half_a_code_above_and_below() {
    let surface = Waves::new(1, 128, LENGTH);
    let unrounded = field(&surface, Storage::Float32);
    for storage in [Storage::Unorm8, Storage::Unorm16] {
        let rounded = field(&surface, storage);
        let half = storage.codes().map_or(0.0, |codes| 0.5 / codes) + 2f64.powi(-23);
        for angle_deg in VIEWS_DEG {
            for view in views(2, 1000, angle_deg) {
                let ray = view.ray().unwrap();
                let at = |lift| first_hit_lifted(&unrounded, EdgeMode::Wrap, &ray, lift).t;
                let hit = first_hit(&rounded, EdgeMode::Wrap, &ray).t;
                assert!(at(half) <= hit + 1e-9 && hit <= at(-half) + 1e-9, "{storage:?}");
            }
        }
    }
}

#[test]
fn more_bits_are_not_worse_and_flat_views_are() {
    let prices = measured("height_depth");
    let of = |storage: Storage, angle: u32| find(prices, &format!("{} bits, {angle}°", storage.bits()));
    for angle in VIEWS_DEG {
        let [eight, sixteen, floats] = Storage::ALL.map(|storage| of(storage, angle));
        // 257 times finer codes.
        assert!(eight.p50 > 100.0 * sixteen.p50 && sixteen.p50 > 0.0);
        assert!(eight.p99 > sixteen.p99);
        assert_eq!([floats.p50, floats.max], [0.0, 0.0]);
        assert_eq!([eight.bytes, sixteen.bytes, floats.bytes], [1.0, 2.0, 4.0]);
        assert!(eight.fetches > f64::from(HALVINGS));
    }
    assert!(of(Storage::Unorm8, 80).p50 > of(Storage::Unorm8, 60).p50);
}

#[test]
fn heights_in_four_bits_are_seen() {
    let surface = Waves::new(1, 128, LENGTH);
    let unrounded = field(&surface, Storage::Float32);
    let (side, views) = (surface.side, views(1, 500, 60));
    let coarse = HeightField::from_fn(side, side, |x, y| (unrounded.texel(x, y) * 15.0).round() / 15.0);
    let median = |rounded: &HeightField| {
        let mut errors = errors(&unrounded, rounded, &views);
        errors.sort_by(f64::total_cmp);
        errors[errors.len() / 2]
    };
    assert!(median(&coarse) > 5.0 * median(&field(&surface, Storage::Unorm8)));
    assert_eq!(median(&unrounded), 0.0);
}
