//! The heat column: a text with the share of an error bound that each line is needed for.
//!
//! The share is a number in the cell; the colour behind it says the same once more, and nothing else. Lines of nothing but declarations
//! have an empty share, which reads as "nothing computed".

use maud::{Markup, html};

use crate::heat::{Heat, Line};

pub(super) fn section(heats: &[Heat]) -> Markup {
    html! {
        @if !heats.is_empty() {
            section aria-labelledby="heat" {
                h2 id="heat" { "Where the error bound comes from" }
                p { "If a line were exact, the interval of this output would be so much narrower. Errors amplify and hide each other, so the shares need not add up to 100 %." }
                @for (number, heat) in heats.iter().enumerate() { (one(number, heat)) }
            }
        }
    }
}

fn one(number: usize, heat: &Heat) -> Markup {
    let id = format!("heat-{number}");
    html! {
        article class="heat" {
            h3 id=(id) { code { (heat.subject) } ", output " code { (heat.output) } }
            p { "Allowed: " (heat.interval[0]) " to " (heat.interval[1]) ", " (format!("{:.1}", heat.ulps)) " ULP, at these inputs:" }
            ul {
                @for input in heat.inputs.iter().take(8) { li { code { (input) } } }
                @if heat.inputs.len() > 8 { li { "and " (heat.inputs.len() - 8) " more" } }
            }
            (hottest(heat))
            div class="scroll" tabindex="0" role="region" aria-labelledby=(id) {
                table class="source" {
                    caption { "Source of " (heat.subject) " with the share of each line" }
                    thead { tr { th scope="col" { "line" } th scope="col" { "share" } th scope="col" { "source" } } }
                    tbody { @for line in &heat.lines { (row(number, line)) } }
                }
            }
        }
    }
}

/// Links to the lines that matter most, so that nobody has to search a long text for them.
fn hottest(heat: &Heat) -> Markup {
    let mut lines: Vec<(&Line, f64)> = heat
        .lines
        .iter()
        .filter_map(|line| Some((line, line.share.filter(|share| *share >= 0.01)?)))
        .collect();
    lines.sort_by(|a, b| b.1.total_cmp(&a.1));
    html! {
        @if lines.is_empty() { p { "No line alone contributes 1 % or more." } }
        @else {
            p { "Most: "
                @for (at, (line, share)) in lines.iter().take(5).enumerate() {
                    @if at > 0 { ", " }
                    "line " (line.number) " (" (percent(*share)) ")"
                }
            }
        }
    }
}

fn row(number: usize, line: &Line) -> Markup {
    html! {
        tr {
            th scope="row" id=(format!("heat-{number}-line-{}", line.number)) { (line.number) }
            @match line.share {
                Some(share) => { td class="number share" style=(format!("--share: {:.1}%", 100.0 * share)) { (percent(share)) } }
                None => { td class="number" { span class="unseen" { "nothing computed" } } }
            }
            td { pre { code { (line.text) } } }
        }
    }
}

fn percent(share: f64) -> String {
    if share > 0.0 && share < 0.001 {
        "< 0.1 %".to_owned()
    } else {
        format!("{:.1} %", 100.0 * share)
    }
}
