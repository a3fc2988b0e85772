use super::super::tests::{embedded, find, library, measured};
use super::*;

/// The greatest angle by which a map of N texels a side can be off, by hand.
///
/// - Inside of a face the colours are those of f(p) = p/|p| at texel centres h = 2/N apart, of which no second derivative along a
///   line of the face's plane exceeds 1: filtering errs by at most 2·h²/8 = 1/N² of a unit vector.
/// - Each code is off by half a step at most, a vector of three by √3 times as much.
/// - Across an edge, texels 1/N before and behind it are mixed. From a place on the edge, one that lies t < 1/N before it is seen at an
///   angle of at most t/(2(1 − 1/N)), since d/(d² + t²) ≤ 1/(2t) wherever the line is. So the true direction and all that are
///   mixed lie within 1/(2(N − 1)) of the edge's; around a corner of three faces, within 0.471/N of the corner's.
fn bound_deg(size: u32, bits: u32) -> f64 {
    let n = f64::from(size);
    let step = 2.0 / (2f64.powi(bits as i32) - 1.0);
    let inside = (1.0 / (n * n) + 3f64.sqrt() * step / 2.0).asin();
    (inside + 1.0 / (n - 1.0)).to_degrees()
}

#[test]
fn no_map_errs_beyond_its_bound_by_hand() {
    let prices = measured("normaliser");
    for size in SIZES {
        for bits in [8, 16] {
            let price = find(prices, &format!("cube map {size} {bits}"));
            let bound = bound_deg(size, bits);
            assert!(price.max <= bound, "{}: {} > {bound}", price.variant, price.max);
            assert_eq!((price.fetches, price.bytes), (1.0, f64::from(bits) / 2.0));
        }
    }
    for name in ["normalise", "normalise published"] {
        // A dozen roundings of 2⁻²⁴ in f32.
        assert!(find(prices, name).max < 12.0 * 6e-8 * 57.3, "{name}");
        assert_eq!(find(prices, name).fetches, 0.0);
    }
}

#[test]
fn larger_and_deeper_maps_are_not_worse() {
    let prices = measured("normaliser");
    let of = |size: u32, bits: u32| find(prices, &format!("cube map {size} {bits}"));
    for pair in SIZES.windows(2) {
        // At 16 bits the filter is the error, four times less with twice the side, while 1/N² is four times a code's √3/65535: to 97.
        if pair[1] <= 97 {
            assert!(of(pair[1], 16).p50 < 0.5 * of(pair[0], 16).p50);
        }
        // At 8 bits the codes are a floor: from 64 texels on the median hardly falls. A tenth is let through for the other places
        // at which the codes are read.
        assert!(of(pair[1], 8).p50 < 1.1 * of(pair[0], 8).p50);
    }
    for size in SIZES {
        assert!(of(size, 16).p50 < of(size, 8).p50);
        assert!(of(size, 16).max < of(size, 8).max);
    }
}

#[test]
fn a_map_with_two_faces_exchanged_is_seen() {
    let library = library();
    let context = embedded(&library);
    let [_, items] = context.frame();
    let directions = sphere("normaliser", 1, items);
    let inputs = bytes_of(&vectors(&directions));
    let sound = cube(64, Depth::Eight).unwrap();
    let mut broken = sound.clone();
    let face = broken.levels[0].len() / 6;
    let (first, second) = broken.levels[0].split_at_mut(face);
    first.swap_with_slice(&mut second[..face]);
    let worst = |map: TextureData| {
        let frame = Frame::new(&context, TEXT, "by_cube_map", items, 16).unwrap();
        let frame = with_map(frame.buffer("directions", &inputs), map);
        let found = frame.measure(&context).unwrap().outputs;
        errors_deg(&directions, &found, 4).into_iter().fold(0.0, f64::max)
    };
    assert!(worst(sound) < bound_deg(64, 8));
    assert!(worst(broken) > 60.0);
}
