use super::super::tests::{find, measured};
use super::*;

/// By hand: two heights, each off by half a code at most, give a difference that is off by a code, along two axes √2 codes of slope; an
/// angle is at most the difference of the slopes. A dozen roundings of f32 besides.
fn bound_deg(storage: Storage, surface: &Waves) -> f64 {
    let code = storage.codes().map_or(2f64.powi(-24), f64::recip);
    let slope = surface.scale * f64::from(surface.side) / 2.0;
    (2f64.sqrt() * code * slope + 12.0 * 2f64.powi(-24) * (1.0 + slope)).to_degrees()
}

#[test]
fn no_depth_errs_beyond_its_bound_by_hand_and_more_bits_are_not_worse() {
    let prices = measured("height_normals");
    for length in LENGTHS {
        let surface = Waves::new(1, 128, length);
        let depths = Storage::ALL.map(|storage| {
            let price = find(
                prices,
                &format!("{} bits, waves of {length} texels", storage.bits()),
            );
            let bound = bound_deg(storage, &surface);
            assert!(price.max <= bound, "{}: {} > {bound}", price.variant, price.max);
            assert_eq!(price.bytes, storage.bytes());
            price
        });
        let [eight, sixteen, floats] = depths;
        assert!(eight.p50 > 50.0 * sixteen.p50 && sixteen.p50 > floats.p50);
        assert!(eight.max > sixteen.max && sixteen.max > floats.max);
        // Integers are not idle bounds.
        assert!(eight.max > 0.5 * bound_deg(Storage::Unorm8, &surface));
    }
    // The gentler the waves, the coarser a code is beside their slope.
    let [steep, gentle] = LENGTHS.map(|length| find(prices, &format!("8 bits, waves of {length} texels")));
    assert!(gentle.p50 > 2.0 * steep.p50);
}
