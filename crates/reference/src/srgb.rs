//! The sRGB transfer functions of IEC 61966-2-1, in float64.
//!
//! Domain: encoded and linear values in [0, 1]; values outside are clamped first, NaN gives NaN. The two pieces meet at
//! the linear value 0.0031308 (encoded 0.04045); the standard's rounded constants leave a step of about 3e-8 there, which
//! is part of the standard and kept.

/// Linear light to the encoded value, both in [0, 1].
#[must_use]
pub fn encode(linear: f64) -> f64 {
    let linear = linear.clamp(0.0, 1.0);
    if linear <= 0.003_130_8 {
        12.92 * linear
    } else {
        1.055 * linear.powf(1.0 / 2.4) - 0.055
    }
}

/// The encoded value to linear light, both in [0, 1].
#[must_use]
pub fn decode(encoded: f64) -> f64 {
    let encoded = encoded.clamp(0.0, 1.0);
    if encoded <= 0.040_45 {
        encoded / 12.92
    } else {
        ((encoded + 0.055) / 1.055).powf(2.4)
    }
}

/// Linear light to the nearest byte of an sRGB image.
#[must_use]
pub fn encode_byte(linear: f64) -> u8 {
    (encode(linear) * 255.0).round() as u8
}

/// A byte of an sRGB image to linear light.
#[must_use]
pub fn decode_byte(byte: u8) -> f64 {
    decode(f64::from(byte) / 255.0)
}

#[cfg(test)]
mod tests {
    use super::{decode, decode_byte, encode, encode_byte};

    #[test]
    fn every_byte_survives_the_round_trip() {
        for byte in 0..=255 {
            assert_eq!(encode_byte(decode_byte(byte)), byte);
        }
    }

    #[test]
    fn known_values() {
        // 0.5 encoded, from the formula evaluated by hand with 20 digits: 0.21404114048223255.
        assert!((decode(0.5) - 0.214_041_140_482_232_55).abs() < 1e-15);
        // The inverse: two correctly rounded `powf` and three operations, each 2^-53 relative, amplified by at most 2.4.
        assert!((encode(0.214_041_140_482_232_55) - 0.5).abs() < 1e-15);
        assert_eq!(encode_byte(2.0), 255);
        assert!(encode(f64::NAN).is_nan());
    }
}
