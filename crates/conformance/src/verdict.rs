//! What came of a case.

use serde::Serialize;

/// The verdict on a case.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Verdict {
    /// Every output is allowed.
    Pass,
    /// Every output is allowed, but something needs a look: too many outputs on which the rules say nothing.
    Warn,
    /// An output is not allowed, was not written, the oracles disagree, or an expected failure did not happen.
    Fail,
    /// Not run, for the reason given.
    Skip,
    /// A known defect of a published form showed, as it should.
    ExpectedFail,
}

impl Verdict {
    /// All of them, in the order of the reports.
    pub const ALL: [Self; 5] = [Self::Pass, Self::Warn, Self::Fail, Self::Skip, Self::ExpectedFail];

    /// As in the JSON report.
    #[must_use]
    pub fn as_str(self) -> &'static str {
        match self {
            Self::Pass => "pass",
            Self::Warn => "warn",
            Self::Fail => "fail",
            Self::Skip => "skip",
            Self::ExpectedFail => "expected_fail",
        }
    }

    /// For people.
    #[must_use]
    pub fn label(self) -> &'static str {
        match self {
            Self::Pass => "pass",
            Self::Warn => "warning",
            Self::Fail => "FAIL",
            Self::Skip => "skipped",
            Self::ExpectedFail => "expected failure",
        }
    }

    /// The graver of two, for a summary of several cases. A skip is graver than a pass: it must not hide behind one.
    #[must_use]
    pub fn graver(self, other: Self) -> Self {
        let rank = |verdict| match verdict {
            Self::Pass => 0,
            Self::ExpectedFail => 1,
            Self::Skip => 2,
            Self::Warn => 3,
            Self::Fail => 4,
        };
        if rank(other) > rank(self) { other } else { self }
    }
}

#[cfg(test)]
mod tests {
    use super::Verdict;

    #[test]
    fn nothing_hides_a_failure() {
        for verdict in Verdict::ALL {
            assert_eq!(verdict.graver(Verdict::Fail), Verdict::Fail);
            assert_eq!(Verdict::Fail.graver(verdict), Verdict::Fail);
            assert_eq!(verdict.graver(Verdict::Pass), verdict);
        }
    }
}
