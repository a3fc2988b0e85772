//! Floating-point formats and directed rounding, in software.
//!
//! Every float of the evaluator is carried in an `f64`; a [`Width`] says which format the shader gave it. Rounding to that
//! format is done here, without touching the processor's rounding mode:
//!
//! - a sum or product of two `f32` (or `f16`) values computed in `f64` is either exact or comes with its error term
//!   (`two_sum`, a fused multiply-add), so the directed roundings below are the exact ones;
//! - quotients and roots come with the sign of their residual.
//!
//! Invariants: `round_down(x) <= x <= round_up(x)`, both are values of the format (or an infinity), and they differ by at most
//! one step. Source: IEEE 754-2019, sections 4.3 and 5.3.1; Muller, *On the definition of ulp(x)*, 2005.

use half::f16;

/// A floating-point format of the shading language.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Width {
    /// `f16`: 11 bits of significand.
    F16,
    /// `f32`: 24 bits of significand.
    F32,
    /// `f64`: 53 bits of significand.
    F64,
}

impl Width {
    /// The largest finite value.
    #[inline(always)]
    pub const fn max_finite(self) -> f64 {
        match self {
            Self::F16 => 65504.0,
            Self::F32 => f32::MAX as f64,
            Self::F64 => f64::MAX,
        }
    }

    /// The smallest positive normal value.
    #[inline(always)]
    pub const fn min_normal(self) -> f64 {
        match self {
            Self::F16 => 6.103_515_625e-5,
            Self::F32 => f32::MIN_POSITIVE as f64,
            Self::F64 => f64::MIN_POSITIVE,
        }
    }

    /// The smallest positive subnormal value, which is also the distance between neighbours near zero.
    #[inline(always)]
    pub const fn min_subnormal(self) -> f64 {
        match self {
            Self::F16 => 5.960_464_477_539_063e-8,
            Self::F32 => 1.401_298_464_324_817e-45,
            Self::F64 => 5e-324,
        }
    }

    /// Number of bits of the significand, the hidden one included.
    #[inline(always)]
    pub const fn precision(self) -> i32 {
        match self {
            Self::F16 => 11,
            Self::F32 => 24,
            Self::F64 => 53,
        }
    }

    /// The exponent `e` such that `2^e` is the largest power of two that division and `atan2` have a stated accuracy for.
    #[inline(always)]
    pub const fn quotient_exponent(self) -> i32 {
        match self {
            Self::F16 => 14,
            Self::F32 => 126,
            Self::F64 => 1022,
        }
    }

    /// Rounds to nearest, ties to even.
    #[inline(always)]
    pub fn round(self, x: f64) -> f64 {
        match self {
            Self::F16 => f16_nearest(x),
            Self::F32 => f64::from(x as f32),
            Self::F64 => x,
        }
    }

    /// The next value of the format above `x`, which must be a value of the format. Infinity after the largest finite one.
    #[inline(always)]
    pub fn next_up(self, x: f64) -> f64 {
        match self {
            Self::F16 => f16_next_up(x),
            Self::F32 => f64::from((x as f32).next_up()),
            Self::F64 => x.next_up(),
        }
    }

    /// The next value of the format below `x`, which must be a value of the format.
    #[inline(always)]
    pub fn next_down(self, x: f64) -> f64 {
        -self.next_up(-x)
    }

    /// The largest value of the format that is not above `x + residual`, where `residual` only tells on which side of the
    /// `f64` value `x` the exact number lies.
    #[inline(always)]
    pub fn round_down(self, x: f64, residual: f64) -> f64 {
        let nearest = self.round(x);
        if nearest > x || (nearest == x && residual < 0.0) {
            self.next_down(nearest)
        } else {
            nearest
        }
    }

    /// The smallest value of the format that is not below `x + residual`; see [`Width::round_down`].
    #[inline(always)]
    pub fn round_up(self, x: f64, residual: f64) -> f64 {
        let nearest = self.round(x);
        if nearest < x || (nearest == x && residual > 0.0) {
            self.next_up(nearest)
        } else {
            nearest
        }
    }

    /// The unit in the last place at the real number `x`: the least distance between two different finite values `a <= x <= b`.
    ///
    /// At a power of two that is the distance to the neighbour below it, as the definition the WGSL text cites has it.
    pub fn ulp(self, x: f64) -> f64 {
        let x = x.abs();
        if x.is_nan() || x >= self.max_finite() {
            return exp2i(max_exponent(self) - self.precision() + 1);
        }
        if x <= self.min_normal() {
            return self.min_subnormal();
        }
        let exponent = exponent_of(x);
        let at_power = if x == exp2i(exponent) { 1 } else { 0 };
        exp2i(exponent - self.precision() + 1 - at_power).max(self.min_subnormal())
    }

    /// True when `x` is not zero and smaller in magnitude than every normal value.
    #[inline(always)]
    pub fn is_subnormal(self, x: f64) -> bool {
        x != 0.0 && x.abs() < self.min_normal()
    }
}

const fn max_exponent(w: Width) -> i32 {
    match w {
        Width::F16 => 15,
        Width::F32 => 127,
        Width::F64 => 1023,
    }
}

/// The exponent of the binade that holds the positive, finite `x`.
pub(crate) fn exponent_of(x: f64) -> i32 {
    let biased = ((x.to_bits() >> 52) & 0x7ff) as i32;
    if biased == 0 {
        -1074 + (63 - x.to_bits().leading_zeros() as i32)
    } else {
        biased - 1023
    }
}

/// `2^e` exactly, also where it is subnormal; zero or infinity beyond the range of `f64`.
pub(crate) fn exp2i(e: i32) -> f64 {
    if e > 1023 {
        f64::INFINITY
    } else if e >= -1022 {
        f64::from_bits(((e + 1023) as u64) << 52)
    } else if e >= -1074 {
        f64::from_bits(1u64 << (e + 1074))
    } else {
        0.0
    }
}

/// The sum in `f64` and its exact error (Knuth's two-sum), for finite operands whose sum does not overflow.
#[inline(always)]
pub(crate) fn two_sum(a: f64, b: f64) -> (f64, f64) {
    let s = a + b;
    let t = s - a;
    (s, (a - (s - t)) + (b - t))
}

fn f16_nearest(x: f64) -> f64 {
    // `f16::from_f64` rounds once for values of `f64`'s upper half only, so the rounding is done here on the exact grid.
    if x.is_nan() || x.is_infinite() || x == 0.0 {
        return x;
    }
    let exponent = exponent_of(x.abs()).max(-14);
    let step = exp2i(exponent - 10);
    let rounded = (x / step).round_ties_even() * step;
    if rounded.abs() > 65504.0 {
        f64::INFINITY.copysign(x)
    } else {
        rounded
    }
}

fn f16_next_up(x: f64) -> f64 {
    if x.is_nan() || x == f64::INFINITY {
        return x;
    }
    if x == f64::NEG_INFINITY {
        return -65504.0;
    }
    let bits = f16::from_f64(x).to_bits();
    let next = match bits {
        0x0000 | 0x8000 => 1,
        b if b & 0x8000 == 0 => b + 1,
        b => b - 1,
    };
    f16::from_bits(next).to_f64()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ulp_follows_the_cited_definition() {
        // One step above 1 is 2^-23 and one step below is 2^-24; the lesser counts at the power of two itself.
        assert_eq!(Width::F32.ulp(1.0), exp2i(-24));
        assert_eq!(Width::F32.ulp(1.5), exp2i(-23));
        assert_eq!(Width::F32.ulp(0.0), exp2i(-149));
        assert_eq!(Width::F32.ulp(f64::INFINITY), exp2i(104));
        assert_eq!(Width::F16.ulp(1.5), exp2i(-10));
    }

    #[test]
    fn directed_roundings_enclose_the_number() {
        let third = 1.0 / 3.0;
        for w in [Width::F16, Width::F32] {
            let (down, up) = (w.round_down(third, 0.0), w.round_up(third, 0.0));
            assert!(down < third && third < up);
            assert_eq!(w.next_up(down), up);
        }
        // Negative control: dropping the residual loses the number 1 - 2^-60.
        assert!(Width::F32.round_down(1.0, -1.0) < 1.0);
        assert_eq!(Width::F32.round_down(1.0, 0.0), 1.0);
    }

    #[test]
    fn f16_rounds_every_code_to_itself_and_ties_to_even() {
        for bits in 0..0x7c00u16 {
            let x = f16::from_bits(bits).to_f64();
            assert_eq!(f16_nearest(x), x);
            assert_eq!(f16_nearest(-x), -x);
        }
        assert_eq!(f16_nearest(2049.0), 2048.0);
        assert_eq!(f16_nearest(2051.0), 2052.0);
        assert_eq!(f16_nearest(65520.0), f64::INFINITY);
        assert_eq!(f16_nearest(65519.0), 65504.0);
    }
}
