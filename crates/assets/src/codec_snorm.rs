//! `codec_snorm`: signed normalised integers, n = max(c/127, −1) for 8 bits and max(c/32767, −1) for 16.
//!
//! Source: the fixed-point conversions of the graphics interfaces. −1, 0 and 1 are exact, so flat maps stay flat; the lowest
//! integer (−128, −32768) also means −1 and is never written. One form: what is published here has no known fault.

/// Encodes to the nearest of −127 to 127: clamp, multiply, round with ties away from zero. NaN becomes 0.
#[inline]
#[must_use]
pub fn encode8(n: f32) -> i8 {
    (n.clamp(-1.0, 1.0) * 127.0).round() as i8
}

/// Decodes; −128 counts as −127.
#[inline]
#[must_use]
pub fn decode8(code: i8) -> f32 {
    (f32::from(code) / 127.0).max(-1.0)
}

/// Encodes to the nearest of −32767 to 32767. NaN becomes 0.
#[inline]
#[must_use]
pub fn encode16(n: f32) -> i16 {
    (n.clamp(-1.0, 1.0) * 32767.0).round() as i16
}

/// Decodes; −32768 counts as −32767.
#[inline]
#[must_use]
pub fn decode16(code: i16) -> f32 {
    (f32::from(code) / 32767.0).max(-1.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn ends_and_middle_are_exact() {
        assert_eq!(
            [-9.0, -1.0, 0.0, 1.0, 9.0].map(encode8),
            [-127, -127, 0, 127, 127]
        );
        assert_eq!([-128, -127, 0, 127].map(decode8), [-1.0, -1.0, 0.0, 1.0]);
        assert_eq!([-32768, -32767, 0, 32767].map(decode16), [-1.0, -1.0, 0.0, 1.0]);
        assert_eq!((encode8(f32::NAN), encode16(f32::NAN)), (0, 0));
    }

    #[test]
    fn every_code_but_the_lowest_survives_a_round_trip() {
        assert!((-127..=127i8).all(|c| encode8(decode8(c)) == c));
        assert!((-32767..=32767i16).all(|c| encode16(decode16(c)) == c));
    }

    proptest! {
        #[test]
        fn errors_stay_within_half_a_step(n in -1.0f32..=1.0) {
            // The product is rounded by half an ulp of up to 127 (32767), the quotient by half an ulp of 1.
            let bound = |one: f64| 0.5 / one + 2f64.powi(-24) + 2f64.powi(-24);
            prop_assert!((f64::from(decode8(encode8(n))) - f64::from(n)).abs() <= bound(127.0));
            prop_assert!((f64::from(decode16(encode16(n))) - f64::from(n)).abs() <= bound(32767.0));
        }
    }
}
