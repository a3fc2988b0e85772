use super::super::tests::{find, measured};
use super::*;

#[test]
fn the_patch_errs_by_its_roundings_only() {
    for price in measured("derivative_bilinear") {
        let (way, _) = price.variant.split_once(',').unwrap();
        // Differences of numbers up to 1, times scale · side texels of slope; a dozen roundings more. Smooth normals are off by more
        // than a degree somewhere: a patch of such waves bends.
        let texels = [8, 32].map(|length| Waves::new(1, 128, length).scale * 128.0);
        let bound = (12.0 * texels[1].max(texels[0]) * 2f64.powi(-24)).to_degrees();
        match way {
            "patch" => assert!(price.max <= bound, "{}: {}", price.variant, price.max),
            _ => assert!(price.max > 1.0, "{}: {}", price.variant, price.max),
        }
    }
}

#[test]
fn ways_read_what_they_need_and_forward_is_the_worst() {
    let prices = measured("derivative_bilinear");
    for length in LENGTHS {
        let of = |way: &str| find(prices, &format!("{way}, waves of {length} texels"));
        let fetches = WAYS.map(|(way, _)| of(way).fetches);
        assert_eq!(fetches, [12.0, 16.0, 32.0, 4.0]);
        assert!(of("forward").p50 > of("central").p50);
    }
}
