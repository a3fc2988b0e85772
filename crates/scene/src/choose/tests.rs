use bossage_reference::relief_search::Search;

use super::{Candidate, Limits, decide};
use crate::predict::Error;
use crate::technique::{Settings, Technique};

/// Candidates of so many layers, milliseconds and pixels, cheapest first.
fn candidates(figures: &[(u32, f64, f64)]) -> Vec<Candidate> {
    let one = |&(layers, time_ms, px_p99): &(u32, f64, f64)| {
        let how = Technique::Search(Search::SteepParallax { layers });
        Candidate {
            how,
            technique: how.id(),
            settings: how.settings(),
            error: Error {
                texels_p99: 2.0 * px_p99,
                px_p99,
            },
            error_px_p99_at_most: Some(1.1 * px_p99),
            steps: 0.0,
            time_ms,
            rays: 1000,
        }
    };
    figures.iter().map(one).collect()
}

const FIGURES: [(u32, f64, f64); 4] = [(1, 1.0, 2.0), (2, 2.0, 0.5), (3, 3.0, 0.6), (4, 4.0, 0.1)];

fn limits(error_px: Option<f64>, time_ms: Option<f64>) -> Limits {
    Limits { error_px, time_ms }
}

fn layers(candidate: &Candidate) -> u32 {
    candidate.settings["layers"]
}

#[test]
fn the_cheapest_within_the_error_then_the_least_error() {
    let at = |px| {
        let choice = decide(&candidates(&FIGURES), limits(Some(px), None)).unwrap();
        (layers(&choice.chosen), choice.meets_budget)
    };
    assert_eq!(at(3.0), (1, true));
    assert_eq!(at(0.6), (2, true));
    // The estimate is within, the bound is not.
    assert_eq!(at(0.52), (4, true));
    assert_eq!(at(0.05), (4, false));
}

#[test]
fn the_least_error_within_the_time() {
    let at = |ms| {
        let choice = decide(&candidates(&FIGURES), limits(None, Some(ms))).unwrap();
        (layers(&choice.chosen), choice.meets_budget)
    };
    assert_eq!(at(1.5), (1, true));
    assert_eq!(at(3.5), (2, true));
    assert_eq!(at(9.0), (4, true));
    // Not even the cheapest is in time.
    assert_eq!(at(0.5), (1, false));
}

#[test]
fn within_both_or_as_near_as_time_allows() {
    let at = |px, ms| {
        let choice = decide(&candidates(&FIGURES), limits(Some(px), Some(ms))).unwrap();
        (layers(&choice.chosen), choice.meets_budget)
    };
    assert_eq!(at(0.6, 9.0), (2, true));
    assert_eq!(at(0.2, 9.0), (4, true));
    assert_eq!(at(0.2, 3.5), (2, false));
}

#[test]
fn neighbours_are_what_more_and_less_would_buy() {
    let choice = decide(&candidates(&FIGURES), limits(Some(0.6), None)).unwrap();
    let named = |candidate: &Option<Candidate>| candidate.as_ref().map(layers);
    // The third has the larger error and is no better for anything; without the second it would not fit either.
    assert_eq!(named(&choice.runner_up), Some(4));
    assert_eq!(named(&choice.cheaper), Some(1));
    assert_eq!(named(&choice.more_accurate), Some(4));
    assert_eq!(choice.others.iter().map(layers).collect::<Vec<_>>(), [1, 3, 4]);
    let best = decide(&candidates(&FIGURES), limits(Some(0.2), None)).unwrap();
    assert_eq!(
        (named(&best.cheaper), named(&best.more_accurate)),
        (Some(2), None)
    );
}

#[test]
fn too_few_rays_meet_no_error_and_no_candidate_is_no_choice() {
    let mut few = candidates(&FIGURES[..1]);
    few[0].error_px_p99_at_most = None;
    assert!(!decide(&few, limits(Some(99.0), None)).unwrap().meets_budget);
    assert_eq!(decide(&[], limits(Some(1.0), None)), None);
    assert_eq!(Technique::None.settings(), Settings::new());
}
