//! `codec_unorm`: a normal's component as an unsigned normalised texel, c = 0.5 n + 0.5 and n = 2 c − 1.
//!
//! Source: the third and fourth articles. Range: n in [−1, 1], c in [0, 1]; an 8-bit texel holds round(255 c).
//!
//! Known fault: no byte stands for n = 0. Byte 128 decodes to 1/255 = 0.0039, so a flat map of (128, 128, 255) tilts by
//! 0.318°. It lies in the format, not in the two formulas.

/// n to c, both real.
#[must_use]
pub fn encode(component: f64) -> f64 {
    0.5 * component + 0.5
}

/// c to n, both real.
#[must_use]
pub fn decode(texel: f64) -> f64 {
    2.0 * texel - 1.0
}

/// n to the byte of an 8-bit texel, rounded to nearest as the graphics interfaces do.
#[must_use]
pub fn encode_byte(component: f64) -> u8 {
    (255.0 * encode(component).clamp(0.0, 1.0)).round() as u8
}

/// The byte of an 8-bit texel to n.
#[must_use]
pub fn decode_byte(byte: u8) -> f64 {
    decode(f64::from(byte) / 255.0)
}

#[cfg(test)]
mod tests {
    use super::{decode_byte, encode_byte};

    #[test]
    fn ends_are_exact_and_the_middle_is_not() {
        assert_eq!((decode_byte(0), decode_byte(255)), (-1.0, 1.0));
        // Two roundings near 0.5 and one near 0: below 2^-53.
        assert!((decode_byte(128) - 1.0 / 255.0).abs() < 2.3e-16);
        assert_eq!((encode_byte(-2.0), encode_byte(2.0)), (0, 255));
    }

    #[test]
    fn every_byte_survives_the_round_trip() {
        assert!((0..=255).all(|byte| encode_byte(decode_byte(byte)) == byte));
    }

    #[test]
    fn flat_map_tilts_by_a_third_of_a_degree() {
        let (x, z) = (decode_byte(128), decode_byte(255));
        let tilt_deg = (x * x + x * x).sqrt().atan2(z).to_degrees();
        // atan(sqrt(2) / 255) = 0.317755 degrees to six digits.
        assert!((tilt_deg - 0.317_755).abs() < 5e-7);
    }
}
