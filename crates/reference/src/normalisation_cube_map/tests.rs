//! Known texels, the errors by size and depth, and what they are made of.

use glam::DVec3;

use super::{Depth, Errors, Map, faces_evenly};
use crate::cube::Seams;
use crate::sphere::{angle_deg, fibonacci};

fn over_faces(map: Map) -> Errors {
    map.errors(faces_evenly(20_000))
}

fn within(share: f64, found: f64, stated: f64) -> bool {
    (found - stated).abs() <= share * stated
}

#[test]
fn known_texels() {
    // One texel a face holds the face's own direction.
    let one = Map::new(1, Depth::Eight);
    assert_eq!(one.texel(0, 0, 0) * 255.0, DVec3::new(255.0, 128.0, 128.0));
    assert_eq!(one.texel(3, 0, 0) * 255.0, DVec3::new(128.0, 0.0, 128.0));
    // Two texels: the first of +Z looks along (−½, ½, 1), unit (−1, 1, 2)/√6.
    let texel = Map::new(2, Depth::Exact).texel(4, 0, 0) * 2.0 - 1.0;
    assert!((texel - DVec3::new(-1.0, 1.0, 2.0) / 6f64.sqrt()).length() < 1e-15);
}

#[test]
fn the_generated_map_holds_the_same_codes() {
    use bossage_assets::normalisation_cube_map::{self as generated, NormalisationCubeMap};
    for (depth, made) in [
        (Depth::Eight, generated::Depth::Eight),
        (Depth::Sixteen, generated::Depth::Sixteen),
    ] {
        for size in [1, 2, 7, 16] {
            let (truth, map) = (
                Map::new(size, depth),
                NormalisationCubeMap::generate(size, made).unwrap(),
            );
            for (face, texels) in map.faces.iter().enumerate() {
                for i in 0..size * size {
                    let stored =
                        DVec3::from_array([0, 1, 2].map(|c| f64::from(texels.sample((4 * i + c) as usize))));
                    // The sample is an f32 quotient of at most 1: half an ulp, 2^-25. A code is 2^-16 at least.
                    let off = (stored - truth.texel(face, i % size, i / size))
                        .abs()
                        .max_element();
                    assert!(off <= 2f64.powi(-25), "{depth:?} {size} {face} {i}: {off}");
                }
            }
        }
    }
}

#[test]
fn the_length_of_the_input_does_not_matter() {
    let map = Map::new(32, Depth::Eight);
    for d in fibonacci(500) {
        // Powers of two scale exactly.
        assert_eq!(
            [map.lookup(2f64.powi(-60) * d), map.lookup(2f64.powi(60) * d)],
            [map.lookup(d); 2]
        );
    }
    assert!(map.lookup(DVec3::ZERO).is_nan());
}

#[test]
fn errors_by_size_are_those_stated() {
    // The stated figures hold for directions spread evenly over the cube, not over the sphere: 16² and 32² would have an rms of
    // 0.30° and 0.16° there (next test).
    for (size, rms_deg, max_deg) in [
        (16, 0.39, 2.09),
        (32, 0.18, 1.10),
        (64, 0.131, 0.72),
        (256, 0.129, 0.37),
    ] {
        let found = over_faces(Map::new(size, Depth::Eight));
        assert!(within(0.1, found.rms_deg, rms_deg), "{size}: {found:?}");
        assert!(within(0.1, found.max_deg, max_deg), "{size}: {found:?}");
    }
}

#[test]
fn errors_by_solid_angle_are_smaller_for_small_maps() {
    // Face borders, where the clamp is, take less of the sphere than of the cube. Measured: 0.2993, 0.1582, 0.1313, 0.1345.
    for (size, rms_deg) in [(16, 0.299), (32, 0.158), (64, 0.131), (256, 0.1345)] {
        let found = Map::new(size, Depth::Eight).errors(fibonacci(50_000));
        assert!(within(0.02, found.rms_deg, rms_deg), "{size}: {found:?}");
    }
}

#[test]
fn the_largest_error_is_half_a_texel_clamped_at_a_border() {
    for size in [16, 64, 256] {
        // From the middle of an edge (45°) to the last texel centre, at 1 − 1/N.
        let clamped_deg = 45.0 - (1.0 - 1.0 / f64::from(size)).atan().to_degrees();
        let edge = DVec3::new(1.0, 1.0 / f64::from(size), 1.0);
        let found = angle_deg(Map::new(size, Depth::Exact).lookup(edge), edge);
        // In the middle of an edge the other coordinate is exact at a texel centre; its own direction turns by 1/N² less.
        assert!(
            within(2.0 / f64::from(size), found, clamped_deg),
            "{size}: {found}"
        );
        let seamless = Map {
            seams: Seams::Seamless,
            ..Map::new(size, Depth::Exact)
        };
        // The mean of the texels on both sides of the edge, (2 − 1/N, 2/N, 2 − 1/N): its y is off by 1/2N² of its x.
        let off = angle_deg(seamless.lookup(edge), edge).to_radians();
        assert!(
            off < 0.5 / f64::from(size).powi(2),
            "{size}: {off}: hardware has the texel on the other side"
        );
    }
}

#[test]
fn sixteen_bits_leave_the_error_of_filtering() {
    let [eight, sixteen, exact] =
        [Depth::Eight, Depth::Sixteen, Depth::Exact].map(|depth| over_faces(Map::new(64, depth)).rms_deg);
    // A code of 16 bits is 257 times finer: 0.13°/257 beside 0.044°, in squares.
    assert!(within(1e-3, sixteen, exact), "{sixteen} {exact}");
    assert!(
        eight > 2.5 * exact,
        "8 bits: the code's error is the larger part at 64²"
    );
}

#[test]
fn the_code_s_floor_is_that_of_rounding() {
    // Uniform rounding errors of ±1/255 in n have the variance 1/(3·255²) each; two of three turn the vector: √(2/3)/255 rad.
    // Bilinear weights average four texels' roundings: Σw² has the mean (2/3)² = 4/9.
    let nearest = (2.0f64 / 3.0).sqrt() / 255.0;
    let filtered_deg = (nearest * 2.0 / 3.0).to_degrees();
    let found = over_faces(Map::new(256, Depth::Eight)).rms_deg;
    // 0.122°. Neighbouring texels often round alike, so less averages out: by a tenth, measured.
    assert!(
        found > filtered_deg && within(0.1, found, filtered_deg),
        "{found} {filtered_deg}"
    );
}

#[test]
fn filtered_vectors_are_near_unit_length_only() {
    let errors = over_faces(Map::new(16, Depth::Exact));
    // The chord over a texel's diagonal of 2√2/16 cuts off at most (√2/16)²/2 = 1/256; 1 is reached at texel centres only.
    assert!(
        errors.longest <= 1.0 + 1e-15 && errors.shortest >= 1.0 - 1.0 / 256.0,
        "{errors:?}"
    );
    // Rounding adds up to √3/255.
    let eight = over_faces(Map::new(64, Depth::Eight));
    assert!(
        eight.longest > 1.004 && eight.longest <= 1.0 + 3f64.sqrt() / 255.0,
        "{eight:?}"
    );
}
