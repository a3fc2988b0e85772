//! `exact` beside marching, map by map and angle by angle, in words and figures.

use maud::{Markup, html};

use crate::record::{Rival, Versus};
use crate::versus::{EQUAL_ERROR_TEXELS, GOAL_DEG, GOAL_FASTER, GOAL_SMALLER};

/// The section.
pub(super) fn section(all: &[Versus]) -> Markup {
    html! {
        @if all.is_empty() { p { "`exact` and a marching technique were not both timed on one map at one angle." } }
        @else {
            p { "How much faster is the exact hit than the fastest march that errs by at most " (EQUAL_ERROR_TEXELS)
                " texel at the 99th percentile, and how much smaller is its error than that of the best march which takes no longer? At "
                (GOAL_DEG) "° from the normal the goals are " (GOAL_FASTER) " and " (GOAL_SMALLER) " times." }
            @for versus in all.iter().filter(|versus| versus.has_goals()) { (goals(versus)) }
            div.scroll tabindex="0" role="region" aria-label="Table of exact against marching" {
                table {
                    caption { "Exact against marching on each map and view angle" }
                    thead { tr {
                        @for title in ["map", "view", "exact, ms", "exact, p99", "march at equal error", "its ms", "times faster", "march at equal time", "its p99", "times smaller"] {
                            th scope="col" { (title) }
                        }
                    } }
                    tbody { @for versus in all { (row(versus)) } }
                }
            }
        }
    }
}

fn goals(versus: &Versus) -> Markup {
    let verdict = |met: bool| if met { "Met" } else { "Not met" };
    html! {
        h3 { (versus.map) " at " (versus.view_deg) "°" }
        ul {
            li { (verdict(versus.is_faster())) ": " (versus.error_words()) "." }
            li { (verdict(versus.is_smaller())) ": " (versus.time_words()) "." }
        }
    }
}

fn row(versus: &Versus) -> Markup {
    let Versus {
        exact,
        at_equal_error: there,
        at_equal_time: as_fast,
        ..
    } = versus;
    html! {
        tr {
            th scope="row" { (versus.map) }
            td.number { (versus.view_deg) "°" }
            td.number { (format!("{:.3}", exact.ms)) }
            td.number { (format!("{:.2e}", exact.p99)) }
            td { (named(there, versus.gets_there, "none gets there; nearest: ")) }
            td.number { (format!("{:.3}", there.ms)) }
            td.number { (format!("{:.2}", versus.times_faster)) }
            td { (named(as_fast, versus.is_as_fast, "none is as fast; fastest: ")) }
            td.number { (format!("{:.4}", as_fast.p99)) }
            td.number { (versus.times_smaller.map_or_else(|| "no error".to_owned(), |times| format!("{times:.0}"))) }
        }
    }
}

fn named(rival: &Rival, is_there: bool, otherwise: &str) -> String {
    if is_there {
        rival.to_string()
    } else {
        format!("{otherwise}{rival}")
    }
}
