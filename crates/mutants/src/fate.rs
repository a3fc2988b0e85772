//! What became of a mutant.

use serde::{Deserialize, Serialize};

/// The end of one mutant.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case", tag = "fate")]
pub enum Fate {
    /// It does not assemble or validate, so it is no mutant. Does not count.
    Invalid {
        /// The first line of what the assembler or validator says.
        reason: String,
    },
    /// A case refused an output.
    Caught {
        /// The case.
        case: String,
        /// Why it failed.
        reason: String,
    },
    /// A case did not end in its time. Counts as caught.
    TimedOut {
        /// The case.
        case: String,
    },
    /// The process that ran a case ended. Counts as caught.
    Crashed {
        /// The case.
        case: String,
        /// The last that it said.
        reason: String,
    },
    /// Every case that it reaches passed.
    Survived {
        /// How many that were.
        cases: usize,
    },
    /// It changes no module that a case uses.
    Unreached,
}

impl Fate {
    /// Whether the mutant counts.
    #[must_use]
    pub fn counts(&self) -> bool {
        match self {
            Self::Invalid { .. } => false,
            Self::Caught { .. }
            | Self::TimedOut { .. }
            | Self::Crashed { .. }
            | Self::Survived { .. }
            | Self::Unreached => true,
        }
    }

    /// Whether conformance missed it.
    #[must_use]
    pub fn survived(&self) -> bool {
        match self {
            Self::Survived { .. } | Self::Unreached => true,
            Self::Invalid { .. } | Self::Caught { .. } | Self::TimedOut { .. } | Self::Crashed { .. } => {
                false
            }
        }
    }

    /// In a few words, for people.
    #[must_use]
    pub fn told(&self) -> String {
        match self {
            Self::Invalid { reason } => format!("does not count: {reason}"),
            Self::Caught { case, reason } => format!("caught by {case}: {reason}"),
            Self::TimedOut { case } => format!("caught: {case} did not end in its time"),
            Self::Crashed { case, reason } => format!("caught: {case} ended the process: {reason}"),
            Self::Survived { cases: 1 } => "the one case that it reaches passes".to_owned(),
            Self::Survived { cases } => format!("all {cases} cases that it reaches pass"),
            Self::Unreached => "no case uses a module that it changes".to_owned(),
        }
    }
}
