//! Units in the last place of f32, as sizes and as distances.
//!
//! ULP(x) is the gap between the two f32 numbers around x (for x itself an f32: the smaller neighbouring gap upward in
//! magnitude, 2^(⌊log₂|x|⌋ − 23)); below the normal range it stays 2⁻¹⁴⁹. That is the definition the WGSL specification uses
//! for its accuracy rules.

/// The smallest positive normal f32.
pub const MIN_NORMAL: f64 = f32::MIN_POSITIVE as f64;

/// The largest finite f32.
pub const MAX: f64 = f32::MAX as f64;

/// The size of one ULP at a magnitude, in f64. Infinite for what no finite f32 reaches, NaN for NaN.
#[must_use]
pub fn ulp(x: f64) -> f64 {
    let magnitude = x.abs();
    if magnitude.is_nan() || magnitude > 2.0 * MAX {
        return if magnitude.is_nan() {
            f64::NAN
        } else {
            f64::INFINITY
        };
    }
    // The exponent straight from the bits: `log2` would round up next to powers of two.
    let exponent = ((magnitude.to_bits() >> 52) & 0x7ff) as i32 - 1023;
    2f64.powi(exponent.max(-126) - 23)
}

/// How many f32 numbers lie between two, counting one end; the two zeros are one number. `None` where one is NaN.
#[must_use]
pub fn ulp_distance(a: f32, b: f32) -> Option<u64> {
    let ordered = |x: f32| {
        let bits = i64::from(x.to_bits() & 0x7fff_ffff);
        if x.is_sign_negative() { -bits } else { bits }
    };
    (!a.is_nan() && !b.is_nan()).then(|| ordered(a).abs_diff(ordered(b)))
}

/// |got − truth| in ULPs of the truth.
#[must_use]
pub fn error_ulps(got: f64, truth: f64) -> f64 {
    if got == truth {
        0.0
    } else {
        (got - truth).abs() / ulp(truth)
    }
}

#[cfg(test)]
mod tests {
    use super::{MAX, error_ulps, ulp, ulp_distance};

    #[test]
    fn sizes_at_known_places() {
        assert_eq!(ulp(1.0), f64::from(f32::EPSILON));
        assert_eq!(ulp(1.0 - 1e-12), f64::from(f32::EPSILON) / 2.0);
        assert_eq!(ulp(0.0), 2f64.powi(-149));
        assert_eq!(ulp(1e-42), 2f64.powi(-149));
        assert_eq!(ulp(MAX), 2f64.powi(104));
        assert_eq!(ulp(f64::INFINITY), f64::INFINITY);
        assert!(ulp(f64::NAN).is_nan());
    }

    #[test]
    fn size_is_the_gap_to_the_next_number() {
        for x in [1.0f32, 1.5, 3.999_999_8, 1e-30, f32::MIN_POSITIVE, 1e-40, 7e20] {
            assert_eq!(ulp(f64::from(x)), f64::from(x.next_up()) - f64::from(x), "{x}");
        }
    }

    #[test]
    fn distances() {
        assert_eq!(ulp_distance(1.0, 1.0f32.next_up()), Some(1));
        assert_eq!(ulp_distance(-0.0, 0.0), Some(0));
        assert_eq!(ulp_distance(-1e-45, 1e-45), Some(2));
        assert_eq!(ulp_distance(f32::MAX, f32::INFINITY), Some(1));
        assert_eq!(ulp_distance(f32::NAN, 0.0), None);
    }

    #[test]
    fn errors_are_counted_at_the_truth() {
        assert_eq!(error_ulps(f64::from(1.0f32.next_up().next_up()), 1.0), 2.0);
        assert_eq!(error_ulps(0.0, 0.0), 0.0);
    }
}
