use super::super::tests::{embedded, find, library, measured};
use super::*;

/// The angle of a vector that is off by at most this much from a unit vector.
fn turned_deg(off: f64) -> f64 {
    off.asin().to_degrees()
}

/// Roundings of the decoder and of the unit vector in f32: twenty of 2⁻²⁴, in degrees.
const ROUNDING_DEG: f64 = 20.0 * 6e-8 * 57.3;

/// The greatest angle by which a codec can be off, by hand. Half a step of a component is s.
///
/// - three components: the vector is off by at most √3·s;
/// - two components: their point in the disc is off by d = √2·s at most. Points of the unit half-sphere over points that are d
///   apart have heights with |z² − z'²| ≤ 2d, so |z − z'|² ≤ 2d: the chord is at most √(d² + 2d). A point outside of the disc is
///   drawn back onto it by at most as much as it lies apart;
/// - octahedral: a step (dx, dy) moves the point of the octahedron by (dx, dy, ±dx ± dy), by √6·s at most, and no point of it is
///   nearer to the middle than 1/√3.
fn bound_deg(name: &str) -> f64 {
    let chord_deg = |d: f64| 2.0 * ((d * d + 2.0 * d).sqrt() / 2.0).asin().to_degrees();
    let (s8, s16) = (0.5 / 127.0, 0.5 / 32767.0);
    match name {
        "unorm 8" => turned_deg(3f64.sqrt() / 255.0),
        "unorm 16" => turned_deg(3f64.sqrt() / 65535.0),
        // Truncation loses a whole step.
        "biased 8 published" => turned_deg(3f64.sqrt() * 2.0 * s8),
        "biased 8" | "snorm 8" => turned_deg(3f64.sqrt() * s8),
        "snorm 16" => turned_deg(3f64.sqrt() * s16),
        "two channels 8" => chord_deg(2f64.sqrt() * s8),
        "two channels 16" => chord_deg(2f64.sqrt() * s16),
        "octahedral 8" => turned_deg(18f64.sqrt() * s8),
        "octahedral 16" => turned_deg(18f64.sqrt() * s16),
        "float 32" => 0.0,
        other => panic!("no bound for `{other}`"),
    }
}

#[test]
fn no_codec_errs_beyond_its_bound_by_hand_and_each_comes_near_it() {
    let prices = measured("codec");
    assert_eq!(prices.len(), CODECS.len());
    for price in prices {
        let bound = bound_deg(&price.variant) + ROUNDING_DEG;
        assert!(price.max <= bound, "{}: {} > {bound}", price.variant, price.max);
        // The bounds are no idle ones: 16,384 directions come within a half of each.
        let reached = price.max >= 0.5 * (bound - ROUNDING_DEG);
        assert!(reached, "{}: {} of {bound}", price.variant, price.max);
        assert!(price.p50 <= price.p99 && price.p99 <= price.max);
    }
}

#[test]
fn more_bits_are_not_worse_and_cost_bytes() {
    let prices = measured("codec");
    for code in ["unorm", "snorm", "two channels", "octahedral"] {
        let [eight, sixteen] = [8, 16].map(|bits| find(prices, &format!("{code} {bits}")));
        assert!(sixteen.p50 < eight.p50 && sixteen.p99 < eight.p99 && sixteen.max < eight.max);
        assert_eq!(sixteen.bytes, 2.0 * eight.bytes);
    }
    assert!(find(prices, "biased 8").p50 < find(prices, "biased 8 published").p50);
    assert!(
        prices
            .iter()
            .all(|price| price.fetches == 1.0 && price.ops > 10.0)
    );
    // A root and a fold are more than a scale and a bias.
    assert!(find(prices, "octahedral 8").ops > find(prices, "snorm 8").ops);
}

#[test]
fn a_codec_read_by_another_is_seen() {
    let library = library();
    let context = embedded(&library);
    let broken = [
        // The article's own mistake: biased bytes read as unorm.
        Codec {
            entry: "decode_unorm",
            ..CODECS[3]
        },
        // Signed bytes read as unsigned ones.
        Codec {
            format: TexelFormat::Rgba8Unorm,
            ..CODECS[4]
        },
        // Red and green exchanged.
        Codec::new("octahedral 8", TexelFormat::Rg8Snorm, "decode_octahedral", |n| {
            let [red, green]: [u8; 2] = (CODECS[8].encode)(n).try_into().unwrap();
            vec![green, red]
        }),
    ];
    for price in measure(&context, &broken).unwrap() {
        let bound = bound_deg(&price.variant) + ROUNDING_DEG;
        assert!(
            price.max > 1.2 * bound,
            "{}: {} is within {bound}",
            price.variant,
            price.max
        );
    }
}
