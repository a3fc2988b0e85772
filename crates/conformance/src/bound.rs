//! What an implementation may return for one output: an interval, or the statement that nothing can be said.
//!
//! Invariants. `low ≤ high`, both finite, where the bound is decided. An open bound admits everything, NaN too; it is open
//! because the accuracy rules say nothing (overflow, a domain error, a division by what may be zero) or because the evaluator
//! gave up at one of its limits. A bound is *forked* where a comparison or a step on the way can go either way, so that the
//! interval joins several results.

use bossage_bounds::Interval;

/// The acceptance interval of one output.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bound {
    low: f64,
    high: f64,
    forked: bool,
}

impl Bound {
    /// Nothing can be said.
    pub const OPEN: Self = Self {
        low: f64::NEG_INFINITY,
        high: f64::INFINITY,
        forked: false,
    };

    /// The numbers from `low` to `high`; open where these are no finite interval.
    #[must_use]
    pub fn between(low: f64, high: f64) -> Self {
        let finite = low.is_finite() && high.is_finite();
        if finite && low <= high {
            Self {
                low,
                high,
                forked: false,
            }
        } else {
            Self::OPEN
        }
    }

    /// One number.
    #[must_use]
    pub fn exactly(value: f64) -> Self {
        Self::between(value, value)
    }

    /// The same numbers, joined from several results.
    #[must_use]
    pub fn forked(self) -> Self {
        Self { forked: true, ..self }
    }

    /// The differences between a number of this bound and one of the other.
    #[must_use]
    pub fn minus(self, other: Self) -> Self {
        let forked = self.forked || other.forked;
        let difference = Self::between(self.low - other.high, self.high - other.low);
        Self { forked, ..difference }
    }

    /// The least value allowed.
    #[must_use]
    pub fn low(&self) -> f64 {
        self.low
    }

    /// The greatest value allowed.
    #[must_use]
    pub fn high(&self) -> f64 {
        self.high
    }

    /// Whether an undecided choice lies on the way.
    #[must_use]
    pub fn is_forked(&self) -> bool {
        self.forked
    }

    /// Whether the rules say anything about this output.
    #[must_use]
    pub fn is_decided(&self) -> bool {
        self.low.is_finite() && self.high.is_finite()
    }

    /// Whether one result alone follows from the input: decided, and on one way through the shader.
    #[must_use]
    pub fn is_settled(&self) -> bool {
        self.is_decided() && !self.forked
    }

    /// Whether a computed value is allowed.
    #[must_use]
    pub fn contains(&self, computed: f64) -> bool {
        !self.is_decided() || (self.low <= computed && computed <= self.high)
    }

    /// The width in ULPs at the greater end; `None` where the bound is open.
    #[must_use]
    pub fn width_ulps(&self) -> Option<f64> {
        let at = self.low.abs().max(self.high.abs());
        self.is_decided()
            .then(|| (self.high - self.low) / crate::ulp::ulp(at))
    }
}

impl From<Interval> for Bound {
    fn from(interval: Interval) -> Self {
        let bound = if interval.flags.is_none() {
            Self::between(interval.lo, interval.hi)
        } else {
            Self::OPEN
        };
        Self {
            forked: interval.is_forked() && bound.is_decided(),
            ..bound
        }
    }
}

#[cfg(test)]
mod tests {
    use bossage_bounds::{Flags, Interval};

    use super::Bound;

    #[test]
    fn what_the_language_leaves_open_admits_everything() {
        for flags in [Flags::INDETERMINATE, Flags::UNDECIDED, Flags::NAN] {
            let bound = Bound::from(Interval {
                flags,
                ..Interval::point(1.0)
            });
            assert!(!bound.is_decided() && bound.contains(f64::NAN), "{flags:?}");
        }
        assert!(!Bound::between(2.0, 1.0).is_decided() && !Bound::exactly(f64::NAN).is_decided());
    }

    #[test]
    fn a_fork_keeps_its_interval() {
        let forked = Bound::from(Interval {
            flags: Flags::FORKED,
            ..Interval::new(-1.0, 1.0)
        });
        assert!(forked.is_decided() && !forked.is_settled());
        assert!(forked.contains(1.0) && !forked.contains(1.5) && !forked.contains(f64::NAN));
    }

    #[test]
    fn width_is_counted_at_the_greater_end() {
        let ulp = f64::from(f32::EPSILON);
        assert_eq!(Bound::between(1.0, 1.0 + 3.0 * ulp).width_ulps(), Some(3.0));
        assert_eq!(Bound::exactly(-0.25).width_ulps(), Some(0.0));
        assert_eq!(Bound::OPEN.width_ulps(), None);
    }
}
