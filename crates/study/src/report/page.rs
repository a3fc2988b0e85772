//! The page: charts, pictures, every point with its command, in one file.

use bossage_conformance::report::page::Page;
use maud::{Markup, PreEscaped, html};

use super::pair::Compared;
use super::{pair, table, versus};
use crate::chart::{self, Chart, Kind};
use crate::record::Study;

const STYLE: &str = include_str!("style.css");
const SCRIPT: &str = include_str!("page.js");

/// The whole page.
pub(super) fn write(study: &Study, charts: &[Chart], pairs: &[Compared<'_>]) -> String {
    let main = html! {
        (summary(study))
        (section("time", "Error against time", fronts(charts, Kind::Time, NOT_TIMED)))
        (section("operations", "Error against operations", fronts(charts, Kind::Operations, NOTHING)))
        (section("angle", "Error against view angle", plain(charts, Kind::Angle, "The study has one view angle only.")))
        (section("exact", "Exact against marching", versus::section(&study.exact_against_marching)))
        (section("pictures", "Pictures", pair::section(pairs)))
        (section("prices", "Other prices of accuracy", plain(charts, Kind::Price, NOTHING)))
        (section("points", "All points", table::points(study)))
        (section("prices-table", "All prices", table::prices(study)))
        (section("environment", "Environment", environment(study)))
    };
    let page = Page {
        title: "Bossage: what accuracy costs",
        style: &format!("{STYLE}{}", chart::page_rules()),
        parts: &PARTS,
        main,
        script: SCRIPT,
    };
    page.write()
}

const NOT_TIMED: &str = "Nothing was timed: that needs a driver. Counted operations are below.";
const NOTHING: &str = "The study has none.";

/// Sections of the page.
const PARTS: [(&str, &str); 9] = [
    ("time", "Time"),
    ("operations", "Operations"),
    ("angle", "View angle"),
    ("exact", "Exact against marching"),
    ("pictures", "Pictures"),
    ("prices", "Other prices"),
    ("points", "All points"),
    ("prices-table", "All prices"),
    ("environment", "Environment"),
];

fn section(id: &str, title: &str, content: Markup) -> Markup {
    let heading = format!("{id}-heading");
    html! {
        section id=(id) aria-labelledby=(heading) {
            h2 id=(heading) { (title) }
            (content)
        }
    }
}

fn summary(study: &Study) -> Markup {
    let distinct = |name: fn(&crate::record::Point) -> String| {
        study
            .points
            .iter()
            .map(name)
            .collect::<std::collections::BTreeSet<_>>()
            .len()
    };
    let counts = [
        ("points", study.points.len()),
        ("techniques", distinct(|point| point.technique.clone())),
        ("maps", distinct(|point| point.map.clone())),
        ("view angles", distinct(|point| point.view_deg.to_string())),
        (
            "points on a front",
            study.points.iter().filter(|point| point.pareto).count(),
        ),
        ("other prices", study.prices.len()),
    ];
    html! {
        dl.totals { @for (name, count) in counts { div { dt { (name) } dd { (count) } } } }
        p { "Errors are distances from the true hit in texels of the height map; charts show the 99th percentile over many rays. "
            "Times are medians, their bars reach from the fastest to the slowest run. Results without error lie on a floor labelled 0, "
            "below the logarithmic part of the axis." }
    }
}

/// Charts under a heading for each map.
fn fronts(charts: &[Chart], kind: Kind, otherwise: &str) -> Markup {
    let charts: Vec<&Chart> = charts.iter().filter(|chart| chart.kind == kind).collect();
    html! {
        @if charts.is_empty() { p { (otherwise) } }
        @for group in charts.chunk_by(|a, b| a.subject == b.subject) {
            h3 { (group[0].subject) }
            div.charts { @for chart in group { (figure(chart)) } }
        }
    }
}

fn plain(charts: &[Chart], kind: Kind, otherwise: &str) -> Markup {
    let charts: Vec<&Chart> = charts.iter().filter(|chart| chart.kind == kind).collect();
    html! {
        @if charts.is_empty() { p { (otherwise) } }
        div.charts { @for chart in charts { (figure(chart)) } }
    }
}

fn figure(chart: &Chart) -> Markup {
    let files = [
        ("SVG", format!("{}.svg", chart.name)),
        ("PNG", format!("{}.png", chart.name)),
        ("PNG, dark", format!("{}-dark.png", chart.name)),
    ];
    html! {
        figure {
            div.scroll tabindex="0" role="region" aria-label={ "Chart: " (chart.title) } { (PreEscaped(chart.inline())) }
            figcaption {
                (chart.title) ". Files: "
                @for (index, (name, file)) in files.iter().enumerate() {
                    @if index > 0 { ", " }
                    a href=(file) { (name) span.unseen { " of " (chart.title) } }
                }
            }
        }
    }
}

fn environment(study: &Study) -> Markup {
    html! {
        @if study.environment.is_empty() { p { "The study does not say what it ran on." } }
        @else {
            div.scroll tabindex="0" role="region" aria-label="Environment" {
                table {
                    caption { "What this study ran on" }
                    tbody { @for (name, value) in &study.environment { tr { th scope="row" { (name) } td { (value) } } } }
                }
            }
        }
    }
}
