//! The built-in functions, each with its rule.
//!
//! | function | rule |
//! |---|---|
//! | `abs` `min` `max` `clamp` `saturate` | exact |
//! | `floor` `trunc` | exact: a step inside the interval joins both sides |
//! | `inverseSqrt` | 2 ULP |
//! | `sqrt` | inherited from 1 / inverseSqrt(x) |
//! | `exp2` | (3 + 2·abs(x)) ULP |
//! | `log2` | 2⁻²¹ absolute on [0.5, 2], 3 ULP elsewhere |
//! | `pow` | inherited from exp2(y · log2(x)) |

use super::Bounded;
use crate::ulp::{MIN_NORMAL, ulp};

/// `log2` on [0.5, 2] is off by at most this much.
const LOG2_ERROR: f64 = 1.0 / 2_097_152.0;

impl Bounded {
    /// |x|.
    #[must_use]
    pub fn abs(self) -> Self {
        self.mapped_monotone_pieces(f64::abs, &[0.0])
    }

    /// The smaller of two.
    #[must_use]
    pub fn min(self, other: Self) -> Self {
        if !self.is_decided() || !other.is_decided() {
            return Self::OPEN.marked(&[self, other]);
        }
        let (low, high) = (self.low().min(other.low()), self.high().min(other.high()));
        Self::between(self.value.min(other.value), low, high).marked(&[self, other])
    }

    /// The larger of two.
    #[must_use]
    pub fn max(self, other: Self) -> Self {
        -(-self).min(-other)
    }

    /// min(max(x, low), high).
    #[must_use]
    pub fn clamp(self, low: f32, high: f32) -> Self {
        self.max(Self::exact(low)).min(Self::exact(high))
    }

    /// Clamps to [0, 1].
    #[must_use]
    pub fn saturate(self) -> Self {
        self.clamp(0.0, 1.0)
    }

    /// The largest integer not above x.
    #[must_use]
    pub fn floor(self) -> Self {
        self.stepped(f64::floor)
    }

    /// x without its fraction.
    #[must_use]
    pub fn trunc(self) -> Self {
        self.stepped(f64::trunc)
    }

    /// 1 / √x for x > 0; open where x may be zero, subnormal or negative.
    #[must_use]
    pub fn inverse_sqrt(self) -> Self {
        if !self.is_decided() || self.low() < MIN_NORMAL {
            return Self::OPEN.marked(&[self]);
        }
        let f = |x: f64| x.sqrt().recip();
        Self::between(f(self.value), f(self.high()), f(self.low()))
            .rounded(2.0)
            .marked(&[self])
    }

    /// √x by way of 1 / inverseSqrt(x). The rule leaves √0 open; every implementation that is known returns 0 or goes
    /// through an infinity, so formulas must not rely on it.
    #[must_use]
    pub fn sqrt(self) -> Self {
        Self::exact(1.0) / self.inverse_sqrt()
    }

    /// 2ˣ.
    #[must_use]
    pub fn exp2(self) -> Self {
        if !self.is_decided() {
            return Self::OPEN.marked(&[self]);
        }
        let ulps = 3.0 + 2.0 * self.magnitude();
        Self::between(self.value.exp2(), self.low().exp2(), self.high().exp2())
            .rounded(ulps)
            .marked(&[self])
    }

    /// log₂ x for x > 0; open where x may be zero, subnormal or negative.
    #[must_use]
    pub fn log2(self) -> Self {
        if !self.is_decided() || self.low() < MIN_NORMAL {
            return Self::OPEN.marked(&[self]);
        }
        let exact = Self::between(self.value.log2(), self.low().log2(), self.high().log2());
        let near_one = self.low() >= 0.5 && self.high() <= 2.0;
        let error = if near_one {
            LOG2_ERROR
        } else {
            LOG2_ERROR.max(3.0 * ulp(exact.magnitude()))
        };
        Self {
            error: exact.error + error,
            ..exact
        }
        .rounded(0.0)
        .marked(&[self])
    }

    /// x^y by way of exp2(y · log2(x)); open where x may be zero, subnormal or negative.
    #[must_use]
    pub fn pow(self, exponent: Self) -> Self {
        (exponent * self.log2()).exp2()
    }

    /// A function that is monotone between the given corners.
    fn mapped_monotone_pieces(self, f: impl Fn(f64) -> f64, corners: &[f64]) -> Self {
        if !self.is_decided() {
            return self;
        }
        let inside = corners
            .iter()
            .copied()
            .filter(|c| *c > self.low() && *c < self.high());
        let ends = [self.low(), self.high()].into_iter().chain(inside).map(&f);
        let (low, high) = ends.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), y| {
            (l.min(y), h.max(y))
        });
        Self::between(f(self.value), low, high).marked(&[self])
    }

    /// A step function: exact inside a step, both sides joined across one.
    fn stepped(self, f: impl Fn(f64) -> f64) -> Self {
        if !self.is_decided() {
            return self;
        }
        let (low, high) = (f(self.low()), f(self.high()));
        let joined = Self::between(f(self.value), low, high).marked(&[self]);
        Self {
            forked: joined.forked || low != high,
            ..joined
        }
    }
}
