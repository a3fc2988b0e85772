//! The tables: every point and price with all figures and the command that makes it again.
//!
//! Without the script they are plain tables in the order of the study. With it, their heads hold buttons that sort.

use maud::{Markup, html};

use crate::chart::short;
use crate::record::{Point, Price, SceneError, Study, Time};

/// Every point of the ladder.
pub(super) fn points(study: &Study) -> Markup {
    html! {
        @if study.points.is_empty() { p { "The study has no points." } }
        @else {
            p { "Errors in texels, times in milliseconds; operations and texture reads are those of one ray, counted. Shares of rays: "
                "more than 1 texel off; of these through the surface, or stopped early before it; lost, without a number for an answer. "
                "Colours of a scene's picture, in linear light, and FLIP are differences to its picture in f64. "
                "The heads of the table sort it." }
            div.scroll tabindex="0" role="region" aria-label="Table of all points" {
                table data-sortable {
                    caption { "Techniques and settings on each map and view angle" }
                    thead { tr {
                        @for title in [
                            "technique", "settings", "map", "view", "mean", "p50", "p99", "max", "over 1 texel", "through", "early", "lost", "colour, mean", "colour, max", "FLIP", "time", "fastest to slowest",
                            "operations", "reads", "front", "command",
                        ] { th scope="col" { (title) } }
                    } }
                    tbody { @for point in &study.points { (point_row(point)) } }
                }
            }
        }
    }
}

fn point_row(point: &Point) -> Markup {
    let (errors, kinds) = (&point.error_texels, &point.disagreement);
    html! {
        tr {
            th scope="row" { code { (point.technique) } }
            td { (or_none(&point.settings.to_string())) }
            td { (point.map) }
            td.number data-sort=(point.view_deg) { (short(point.view_deg)) "°" }
            @for error in [errors.mean, errors.p50, errors.p99, errors.max] { (number(error)) }
            @for share in [errors.over_1, kinds.missed, kinds.early, kinds.lost] { (percent(share)) }
            (on_screen(point.scene.as_ref()))
            (times(point.time_ms.as_ref(), point.no_time.as_deref()))
            (number(point.ops))
            (number(point.fetches))
            td { (if point.pareto { "yes" } else { "no" }) }
            td { code { (point.rerun) } }
        }
    }
}

/// Colour and FLIP of a scene's picture; other points have none, and those that were not drawn say why.
fn on_screen(scene: Option<&SceneError>) -> Markup {
    let drawn = scene.and_then(|scene| Some((scene.colour?, scene.flip?)));
    let why_not = scene.and_then(|scene| scene.not_drawn.as_deref());
    html! {
        @match drawn {
            Some((colour, flip)) => { @for value in [colour.mean, colour.max, flip] { (number(value)) } }
            None => {
                td { @match why_not { Some(why) => { "not drawn: " (why) } None => { "–" } } }
                td { "–" }
                td { "–" }
            }
        }
    }
}

/// Every other price.
pub(super) fn prices(study: &Study) -> Markup {
    html! {
        @if study.prices.is_empty() { p { "The study has no other prices." } }
        @else {
            p { "Errors in the unit that is named, times in milliseconds; operations and texture reads are those of one item, counted." }
            div.scroll tabindex="0" role="region" aria-label="Table of all prices" {
                table data-sortable {
                    caption { "Variants of each chart" }
                    thead { tr {
                        @for title in [
                            "chart", "variant", "unit", "p50", "p99", "max", "time", "fastest to slowest", "operations", "reads", "bytes", "command",
                        ] { th scope="col" { (title) } }
                    } }
                    tbody { @for price in &study.prices { (price_row(price)) } }
                }
            }
        }
    }
}

fn price_row(price: &Price) -> Markup {
    html! {
        tr {
            th scope="row" { (price.chart) }
            td { (price.variant) }
            td { (price.unit) }
            @for error in [price.p50, price.p99, price.max] { (number(error)) }
            (times(price.time_ms.as_ref(), price.no_time.as_deref()))
            @for cost in [price.ops, price.fetches, price.bytes] { (number(cost)) }
            td { code { (price.rerun) } }
        }
    }
}

fn number(value: f64) -> Markup {
    html! { td.number data-sort=(value) { (short(value)) } }
}

fn percent(share: f64) -> Markup {
    html! { td.number data-sort=(share) { (format!("{:.2} %", 100.0 * share)) } }
}

/// Median and spread; what was not timed says so, and sorts last.
fn times(time: Option<&Time>, why_not: Option<&str>) -> Markup {
    html! {
        @match time {
            Some(time) => {
                (number(time.median))
                td.number data-sort=(time.max - time.min) { (short(time.min)) "–" (short(time.max)) }
            }
            None => { td { "not timed" @if let Some(why) = why_not { ": " (why) } } td { "–" } }
        }
    }
}

fn or_none(settings: &str) -> &str {
    if settings.is_empty() { "none" } else { settings }
}
