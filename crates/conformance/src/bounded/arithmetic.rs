//! + − × ÷ and negation.
//!
//! Rules: sum, difference and product are correctly rounded in either direction, so they are off by less than one ULP and
//! not at all where the exact result is an f32. A quotient is off by at most 2.5 ULP for a divisor of magnitude 2⁻¹²⁶ to
//! 2¹²⁶, and open otherwise.

use std::ops::{Add, Div, Mul, Neg, Sub};

use super::Bounded;

/// The divisors for which the rules promise anything.
const SMALLEST_DIVISOR: f64 = f32::MIN_POSITIVE as f64;
const LARGEST_DIVISOR: f64 = SMALLEST_DIVISOR.recip();

/// Whether an f32 holds the value, as a normal number or zero.
fn is_f32(value: f64) -> bool {
    f64::from(value as f32) == value && !(value as f32).is_subnormal()
}

/// Whether a + b is exact in f64 (Knuth's two-sum leaves no remainder).
fn sum_is_exact(a: f64, b: f64) -> bool {
    let sum = a + b;
    let b_part = sum - a;
    (a - (sum - b_part)) + (b - b_part) == 0.0
}

impl Add for Bounded {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        let value = self.value + other.value;
        let error = self.error + other.error;
        let exact = error == 0.0 && is_f32(value) && sum_is_exact(self.value, other.value);
        Self {
            value,
            error,
            forked: false,
        }
        .rounded(if exact { 0.0 } else { 1.0 })
        .marked(&[self, other])
    }
}

impl Sub for Bounded {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Neg for Bounded {
    type Output = Self;

    fn neg(self) -> Self {
        Self {
            value: -self.value,
            ..self
        }
    }
}

impl Mul for Bounded {
    type Output = Self;

    fn mul(self, other: Self) -> Self {
        if !self.is_decided() || !other.is_decided() {
            return Self::OPEN.marked(&[self, other]);
        }
        let value = self.value * other.value;
        let error =
            self.value.abs() * other.error + other.value.abs() * self.error + self.error * other.error;
        // The product of two f32 numbers is exact in f64, so `is_f32` sees the exact product.
        let exact = error == 0.0 && is_f32(value);
        Self {
            value,
            error,
            forked: false,
        }
        .rounded(if exact { 0.0 } else { 1.0 })
        .marked(&[self, other])
    }
}

impl Div for Bounded {
    type Output = Self;

    fn div(self, other: Self) -> Self {
        let smallest = other.value.abs() - other.error;
        let in_domain = smallest >= SMALLEST_DIVISOR && other.magnitude() <= LARGEST_DIVISOR;
        if !self.is_decided() || !in_domain {
            return Self::OPEN.marked(&[self, other]);
        }
        let value = self.value / other.value;
        let error = (self.error + value.abs() * other.error) / smallest;
        let quotient = Self {
            value,
            error,
            forked: false,
        };
        // Zero divided by what is not zero is zero, however the quotient is made.
        let ulps = if self.magnitude() == 0.0 { 0.0 } else { 2.5 };
        quotient.rounded(ulps).marked(&[self, other])
    }
}
