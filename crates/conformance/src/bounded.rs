//! `Bounded`: a value in f64 that carries how far a conforming f32 implementation may be from it.
//!
//! A formula evaluated over `Bounded` numbers is a forward error analysis of that formula **at that input**: what is
//! well-conditioned gets a narrow bound, what cancels gets a wide one, and nothing has to be guessed or fitted. Each
//! operation adds the error that the accuracy rules of WGSL allow it and carries the operands' errors along.
//!
//! Source: the *Floating Point Accuracy* tables of the WGSL specification, written out in `docs/numerics.md`; the
//! propagation is the usual first-order analysis with the second-order terms kept (Higham, *Accuracy and Stability of
//! Numerical Algorithms*, chapter 3).
//!
//! Invariants. |what an implementation computes − `value`| ≤ `error`, or `error` is infinite: then the rules leave the
//! result open (overflow, a domain error, a division by what may be zero) and nothing can be judged. Contraction to fma and
//! the flushing of subnormals to zero are always allowed for. Where a comparison can go either way, both results are
//! joined and `forked` says so.
//!
//! Limits. Bounds are not the tightest: correlated errors are treated as independent. The order of a sum inside [`dot`] is
//! left open, other orders follow the formula as written here.
//!
//! [`dot`]: crate::bounded::vector::dot

mod arithmetic;
mod builtin;
mod decide;
pub mod vector;

pub use decide::Decision;

use crate::ulp::{MAX, MIN_NORMAL, ulp};

/// A value with the absolute error that an implementation may have made on the way to it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounded {
    /// The value in float64.
    pub value: f64,
    /// The largest |computed − value| that the rules allow; infinite where they leave the result open.
    pub error: f64,
    /// Whether an undecidable comparison lies on the way, so that the interval joins two results.
    pub forked: bool,
}

impl Bounded {
    /// A number of which the rules say nothing.
    pub const OPEN: Self = Self {
        value: f64::NAN,
        error: f64::INFINITY,
        forked: false,
    };

    /// A constant of the shader's text that f32 holds exactly.
    #[must_use]
    pub const fn exact(value: f32) -> Self {
        Self {
            value: value as f64,
            error: 0.0,
            forked: false,
        }
    }

    /// An input: exact, except that a subnormal may be taken for zero.
    #[must_use]
    pub fn input(value: f32) -> Self {
        let error = if value.is_subnormal() {
            f64::from(value.abs())
        } else {
            0.0
        };
        Self {
            value: f64::from(value),
            error,
            forked: false,
        }
    }

    /// A number known to within an error, such as an interpolated value or a filtered texel.
    #[must_use]
    pub fn within(value: f64, error: f64) -> Self {
        if value.is_finite() && error >= 0.0 {
            Self {
                value,
                error,
                forked: false,
            }
        } else {
            Self::OPEN
        }
    }

    /// The value and the interval [low, high] around it.
    #[must_use]
    pub fn between(value: f64, low: f64, high: f64) -> Self {
        Self::within(value, (value - low).max(high - value).max(0.0))
    }

    /// Whether the rules say anything about this number.
    #[must_use]
    pub fn is_decided(&self) -> bool {
        self.error.is_finite()
    }

    /// The smallest value that an implementation may have.
    #[must_use]
    pub fn low(&self) -> f64 {
        if self.is_decided() {
            self.value - self.error
        } else {
            f64::NEG_INFINITY
        }
    }

    /// The largest value that an implementation may have.
    #[must_use]
    pub fn high(&self) -> f64 {
        if self.is_decided() {
            self.value + self.error
        } else {
            f64::INFINITY
        }
    }

    /// The largest magnitude that an implementation may have.
    #[must_use]
    pub fn magnitude(&self) -> f64 {
        if self.is_decided() {
            self.value.abs() + self.error
        } else {
            f64::INFINITY
        }
    }

    /// Whether a computed value is allowed.
    #[must_use]
    pub fn contains(&self, computed: f64) -> bool {
        !self.is_decided() || (computed - self.value).abs() <= self.error
    }

    /// The same number with the error grown by `ulps` units in the last place of the largest magnitude, the flushing of a
    /// subnormal result allowed for, and overflow noticed. This is where each operation ends.
    pub(crate) fn rounded(self, ulps: f64) -> Self {
        let magnitude = self.magnitude();
        if !self.value.is_finite() || magnitude.is_nan() || magnitude > MAX {
            return Self {
                forked: self.forked,
                ..Self::OPEN
            };
        }
        let error = self.error + ulps * ulp(magnitude);
        if magnitude + ulps * ulp(magnitude) > MAX {
            return Self {
                forked: self.forked,
                ..Self::OPEN
            };
        }
        let may_flush = self.value.abs() - error < MIN_NORMAL && magnitude > 0.0;
        Self {
            error: if may_flush {
                error + MIN_NORMAL.min(magnitude + error)
            } else {
                error
            },
            ..self
        }
    }

    /// Joins the marks of two operands into a result.
    pub(crate) fn marked(self, others: &[Self]) -> Self {
        Self {
            forked: self.forked || others.iter().any(|other| other.forked),
            ..self
        }
    }
}

impl From<Bounded> for crate::bound::Bound {
    fn from(bounded: Bounded) -> Self {
        let bound = Self::between(bounded.low(), bounded.high());
        if bounded.forked && bound.is_decided() {
            bound.forked()
        } else {
            bound
        }
    }
}

#[cfg(test)]
mod tests;
