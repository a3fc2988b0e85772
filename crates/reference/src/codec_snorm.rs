//! `codec_snorm`: a normal's component as a signed normalised integer, n = max(c / (2^(b−1) − 1), −1), for b = 8 and 16.
//!
//! Source: the fixed-point conversions of the graphics interfaces (Vulkan, D3D11, WebGPU's `snorm` formats).
//! Range: n in [−1, 1]; c in [−128, 127] or [−32768, 32767].
//!
//! Zero, one and minus one are exact. The lowest integer has no value of its own: it also means −1, and is never written.

/// Bits of the integer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Bits {
    /// −128 to 127, in steps of 1/127.
    Eight,
    /// −32768 to 32767, in steps of 1/32767.
    Sixteen,
}

impl Bits {
    /// The integer that stands for 1.
    #[must_use]
    pub fn one(self) -> f64 {
        match self {
            Bits::Eight => 127.0,
            Bits::Sixteen => 32767.0,
        }
    }
}

/// n to the nearest integer, n clamped to [−1, 1]; ties away from zero.
#[must_use]
pub fn encode(component: f64, bits: Bits) -> i32 {
    (bits.one() * component.clamp(-1.0, 1.0)).round() as i32
}

/// The integer to n; the lowest one to −1.
#[must_use]
pub fn decode(code: i32, bits: Bits) -> f64 {
    (f64::from(code) / bits.one()).max(-1.0)
}

#[cfg(test)]
mod tests {
    use super::{Bits, decode, encode};

    #[test]
    fn known_answers() {
        assert_eq!(
            [-2.0, -1.0, 0.0, 1.0, 2.0].map(|n| encode(n, Bits::Eight)),
            [-127, -127, 0, 127, 127]
        );
        assert_eq!(
            [-128, -127, 0, 127].map(|c| decode(c, Bits::Eight)),
            [-1.0, -1.0, 0.0, 1.0]
        );
        assert_eq!(
            [-32768, -32767, 0, 32767].map(|c| decode(c, Bits::Sixteen)),
            [-1.0, -1.0, 0.0, 1.0]
        );
    }

    #[test]
    fn the_guard_is_needed() {
        // What the formula gives without max: as far outside as byte 0 of `codec_biased`.
        assert!(-128.0 / Bits::Eight.one() < -1.0078);
    }

    #[test]
    fn every_code_but_the_lowest_survives_the_round_trip() {
        for (bits, one) in [(Bits::Eight, 127), (Bits::Sixteen, 32767)] {
            assert!((-one..=one).all(|code| encode(decode(code, bits), bits) == code));
            assert_eq!(encode(decode(-one - 1, bits), bits), -one);
        }
    }

    #[test]
    fn a_flat_normal_stays_flat() {
        // What `codec_unorm` cannot do.
        assert_eq!(decode(encode(0.0, Bits::Eight), Bits::Eight), 0.0);
    }
}
