//! `codec_biased`: a normal's component in a byte by way of 127 n + 128.
//!
//! Source: the fourth article, *Normal Maps and Height Maps*: byte = trunc(127 n + 128), n = (byte − 128) / 127.
//! Range: n in [−1, 1]; bytes 0 to 255.
//!
//! Known faults of the published form: byte 0 decodes to −1.0079, and truncation doubles the largest error of rounding.

/// As published: truncates. Values that leave the byte's range wrap in the article's C; here they are clamped, since the
/// formula's domain is [−1, 1].
#[must_use]
pub fn encode_published(component: f64) -> u8 {
    (127.0 * component + 128.0).trunc().clamp(0.0, 255.0) as u8
}

/// Hardened: rounds to nearest, and never writes byte 0, which has no place in [−1, 1].
#[must_use]
pub fn encode_hardened(component: f64) -> u8 {
    (127.0 * component.clamp(-1.0, 1.0) + 128.0).round() as u8
}

/// As published. Byte 0 gives −128/127.
#[must_use]
pub fn decode_published(byte: f64) -> f64 {
    (byte - 128.0) / 127.0
}

/// Hardened: byte 0 is read as −1.
#[must_use]
pub fn decode_hardened(byte: f64) -> f64 {
    decode_published(byte).max(-1.0)
}

#[cfg(test)]
mod tests {
    use super::{decode_hardened, decode_published, encode_hardened, encode_published};

    #[test]
    fn known_bytes() {
        assert_eq!([-1.0, 0.0, 1.0].map(encode_published), [1, 128, 255]);
        assert_eq!([-1.0, 0.0, 1.0].map(encode_hardened), [1, 128, 255]);
        assert_eq!(decode_published(0.0), -128.0 / 127.0);
        assert_eq!(decode_hardened(0.0), -1.0);
    }

    #[test]
    fn truncation_doubles_the_error() {
        let worst = |encode: fn(f64) -> u8| {
            (0..=20_000)
                .map(|i| f64::from(i) / 10_000.0 - 1.0)
                .fold(0.0, |worst: f64, n| {
                    worst.max((decode_published(f64::from(encode(n))) - n).abs())
                })
        };
        // Half a step and a whole step of 1/127, less than the sampling step 1e-4 away from the supremum.
        assert!((worst(encode_hardened) * 127.0 - 0.5).abs() < 127.0e-4);
        assert!((worst(encode_published) * 127.0 - 1.0).abs() < 127.0e-4);
    }
}
