//! `codec_biased`: bytes 1 to 255 for −1 to 1, byte 128 for exactly 0.
//!
//! Published form (the article on height and normal maps): `byte = trunc(127·n + 128)`, `n = (byte − 128)/127`. Faults:
//! byte 0, which foreign maps do hold, decodes to −1.0079; truncation errs by up to a whole step of 1/127, always the same
//! way, so every map leans.
//!
//! Hardened form: rounds to the nearest byte (error at most 1/254) and clamps −1.0079 to −1. Both forms hold 0 exactly,
//! which `codec_unorm` cannot, so flat maps stay flat.

/// Encodes as published: truncates. Values outside [−1, 1] saturate (in the article's language they are undefined).
#[inline]
#[must_use]
pub fn encode_published(n: f32) -> u8 {
    (127.0 * n + 128.0) as u8
}

/// Decodes as published: byte 0 gives −1.0079.
#[inline]
#[must_use]
pub fn decode_published(byte: u8) -> f32 {
    (f32::from(byte) - 128.0) / 127.0
}

/// Encodes to the nearest byte: clamp to [−1, 1], multiply by 127, add 128.5, truncate. NaN becomes byte 128, a 0.
#[inline]
#[must_use]
pub fn encode(n: f32) -> u8 {
    let n = if n.is_nan() { 0.0 } else { n.clamp(-1.0, 1.0) };
    (n * 127.0 + 128.5) as u8
}

/// Decodes, byte 0 counting as −1.
#[inline]
#[must_use]
pub fn decode(byte: u8) -> f32 {
    decode_published(byte).max(-1.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// A quotient in [−1.01, 1.01], rounded once, is off by at most half an ulp of 1: 2⁻²⁴ (2⁻²³ above 1).
    const DIVISION: f64 = 1.2e-7;

    #[test]
    fn witness_byte_zero_leaves_the_unit_interval() {
        assert!((f64::from(decode_published(0)) + 128.0 / 127.0).abs() <= DIVISION);
        assert!(
            decode_published(0) < -1.0078,
            "the published fault must stay visible"
        );
        assert_eq!(decode(0), -1.0);
    }

    #[test]
    fn witness_truncation_leans_and_rounding_does_not() {
        // Just under a code: truncation falls a whole step, rounding does not.
        let n = 63.999f32 / 127.0;
        assert_eq!((encode_published(n), encode(n)), (191, 192));
        // Over an even grid the mean error of truncation is half a step down; that of rounding is none. The grid's cell is
        // 1/1270 of the interval, so each mean is exact to 2 cells = 0.0016, far under half a step = 0.0039.
        let mean = |encode: fn(f32) -> u8, decode: fn(u8) -> f32| {
            let grid = (0..1270).map(|i| -1.0 + (f64::from(i) + 0.5) / 635.0);
            grid.map(|n| f64::from(decode(encode(n as f32))) - n).sum::<f64>() / 1270.0
        };
        assert!((mean(encode_published, decode_published) + 0.5 / 127.0).abs() < 0.0016);
        assert!(mean(encode, decode).abs() < 0.0016);
    }

    #[test]
    fn zero_and_the_ends_are_exact() {
        for (n, byte) in [(-1.0, 1), (0.0, 128), (1.0, 255)] {
            assert_eq!((encode(n), decode(byte)), (byte, n));
            assert_eq!((encode_published(n), decode_published(byte)), (byte, n));
        }
    }

    #[test]
    fn every_byte_survives_a_hardened_round_trip() {
        for byte in 1..=255u8 {
            assert_eq!(encode(decode(byte)), byte);
        }
        assert_eq!(encode(decode(0)), 1, "byte 0 is not a code; it means −1");
    }

    #[test]
    fn not_a_number_is_flat() {
        assert_eq!(encode(f32::NAN), 128);
        assert_eq!((encode(f32::INFINITY), encode(f32::NEG_INFINITY)), (255, 1));
    }

    proptest! {
        #[test]
        fn errors_stay_within_the_step(n in -1.0f32..=1.0) {
            // Before truncation the sum is below 256, rounded twice to 2⁻¹⁷ or better: 2·2⁻¹⁷/127 in n.
            let rounding = 2.0 * 2f64.powi(-17) / 127.0 + DIVISION;
            let error = |decoded: f32| f64::from(decoded) - f64::from(n);
            prop_assert!(error(decode(encode(n))).abs() <= 0.5 / 127.0 + rounding);
            let published = error(decode_published(encode_published(n)));
            prop_assert!((-1.0 / 127.0 - rounding..=rounding).contains(&published));
        }
    }
}
