//! Which relief technique: the one place that decides, and the one to replace when there are more techniques and costs.
//!
//! Rule. Candidates come with their predicted error (sampled rays of this scene against the f64 first hit) in order of cost,
//! cheapest first. The cheapest whose 99th-percentile error on screen meets the budget is taken; if none does, the one of
//! least error, cheapest first among equals, and the choice says that the budget is not met.

use serde::Serialize;

use crate::predict;

/// A technique that could be used, with what it would cost in accuracy.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Candidate {
    /// Technique id, or `none`.
    pub technique: &'static str,
    /// The error to expect.
    #[serde(flatten)]
    pub error: predict::Error,
}

/// What was chosen and what it was chosen over.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Choice {
    /// The chosen technique.
    pub chosen: Candidate,
    /// Whether it meets the budget.
    pub meets_budget: bool,
    /// The others, in order of cost.
    pub others: Vec<Candidate>,
}

/// Chooses among candidates given in order of cost, cheapest first. `None` if there are none.
pub(crate) fn choose(candidates: &[Candidate], budget_px: f64) -> Option<Choice> {
    let fits = |candidate: &&Candidate| candidate.error.px_p99 <= budget_px;
    let least = || {
        candidates
            .iter()
            .min_by(|a, b| a.error.px_p99.total_cmp(&b.error.px_p99))
    };
    let chosen = *candidates.iter().find(fits).or_else(least)?;
    let others = candidates
        .iter()
        .filter(|other| other.technique != chosen.technique)
        .copied()
        .collect();
    Some(Choice {
        chosen,
        meets_budget: fits(&&chosen),
        others,
    })
}

#[cfg(test)]
mod tests {
    use super::{Candidate, choose};
    use crate::predict::Error;

    fn candidate(technique: &'static str, px_p99: f64) -> Candidate {
        Candidate {
            technique,
            error: Error {
                texels_p99: 2.0 * px_p99,
                px_p99,
            },
        }
    }

    #[test]
    fn cheapest_that_fits_then_least_error() {
        let candidates = [
            candidate("cheap", 2.0),
            candidate("middle", 0.5),
            candidate("dear", 0.1),
        ];
        let at =
            |budget| choose(&candidates, budget).map(|choice| (choice.chosen.technique, choice.meets_budget));
        assert_eq!(at(3.0), Some(("cheap", true)));
        assert_eq!(at(0.5), Some(("middle", true)));
        assert_eq!(at(0.05), Some(("dear", false)));
        assert_eq!(choose(&[], 1.0), None);
    }
}
