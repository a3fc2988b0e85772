//! Comparisons between bounded numbers, which may be undecidable, and what follows from them.

use super::Bounded;

/// The outcome of a comparison for every implementation that keeps the rules.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Decision {
    /// True everywhere.
    Always,
    /// False everywhere.
    Never,
    /// Implementations may differ; `nominal` is what exact arithmetic says.
    Either {
        /// The outcome in exact arithmetic.
        nominal: bool,
    },
}

impl Decision {
    /// A comparison by its outcome at the ends of the intervals.
    fn of(always: bool, never: bool, nominal: bool) -> Self {
        match (always, never) {
            (true, _) => Self::Always,
            (false, true) => Self::Never,
            (false, false) => Self::Either { nominal },
        }
    }

    /// Both.
    #[must_use]
    pub fn and(self, other: Self) -> Self {
        match (self, other) {
            (Self::Never, _) | (_, Self::Never) => Self::Never,
            (Self::Always, decision) | (decision, Self::Always) => decision,
            (Self::Either { nominal: a }, Self::Either { nominal: b }) => Self::Either { nominal: a && b },
        }
    }

    /// Either.
    #[must_use]
    pub fn or(self, other: Self) -> Self {
        self.negated().and(other.negated()).negated()
    }

    /// The opposite.
    #[must_use]
    pub fn negated(self) -> Self {
        match self {
            Self::Always => Self::Never,
            Self::Never => Self::Always,
            Self::Either { nominal } => Self::Either { nominal: !nominal },
        }
    }
}

impl Bounded {
    /// self < other.
    #[must_use]
    pub fn less(&self, other: Self) -> Decision {
        Decision::of(
            self.high() < other.low(),
            self.low() >= other.high(),
            self.value < other.value,
        )
    }

    /// self ≤ other.
    #[must_use]
    pub fn less_or_equal(&self, other: Self) -> Decision {
        other.less(*self).negated()
    }

    /// self > other.
    #[must_use]
    pub fn greater(&self, other: Self) -> Decision {
        other.less(*self)
    }

    /// self = 0. Exact zeros only: an interval around zero is undecided.
    #[must_use]
    pub fn is_zero(&self) -> Decision {
        let zero = self.value == 0.0 && self.error == 0.0;
        Decision::of(zero, self.low() > 0.0 || self.high() < 0.0, self.value == 0.0)
    }

    /// `if condition { yes } else { no }`. Where the condition is undecided the interval covers both, and is marked.
    #[must_use]
    pub fn select(condition: Decision, yes: Self, no: Self) -> Self {
        match condition {
            Decision::Always => yes,
            Decision::Never => no,
            Decision::Either { nominal } => {
                let chosen = if nominal { yes } else { no };
                if !yes.is_decided() || !no.is_decided() {
                    return Self {
                        forked: true,
                        ..Self::OPEN
                    };
                }
                let joined = Self::between(chosen.value, yes.low().min(no.low()), yes.high().max(no.high()));
                Self {
                    forked: yes != no || joined.marked(&[yes, no]).forked,
                    ..joined
                }
            }
        }
    }
}
