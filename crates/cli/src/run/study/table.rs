//! The points for people.

use std::fmt::Write;

use bossage_study::record::{Point, Study};
use bossage_study::versus::{GOAL_FASTER, GOAL_SMALLER};

use crate::console;

/// A line each, by map and angle.
pub(super) fn of(study: &Study) -> String {
    let mut text = String::new();
    let mut last = None;
    for point in &study.points {
        let cell = (point.map.as_str(), point.view_deg);
        if last != Some(cell) {
            text.push_str(&heading(point));
            last = Some(cell);
        }
        text.push_str(&line(point));
    }
    text.push_str(&versus(study));
    text
}

/// What exactness costs beside marching, in two lines a map and angle; at the angle of the goals whether they are met.
fn versus(study: &Study) -> String {
    let mut text = String::new();
    for versus in &study.exact_against_marching {
        let title = format!("{} at {}°, exact against marching", versus.map, versus.view_deg);
        let _ = writeln!(text, "\n{}", console::heading(&title));
        let both = [
            (versus.error_words(), versus.is_faster(), GOAL_FASTER),
            (versus.time_words(), versus.is_smaller(), GOAL_SMALLER),
        ];
        for (words, is_met, goal) in both {
            let verdict = match (versus.has_goals(), is_met) {
                (false, _) => String::new(),
                (true, true) => format!("; goal of {goal} times met"),
                (true, false) => format!("; goal of {goal} times not met"),
            };
            let _ = writeln!(text, "  {words}{verdict}");
        }
    }
    text
}

fn heading(point: &Point) -> String {
    format!(
        "\n{} at {}°, {} rays, {:.4} % grazing\n  {:44} {:>9} {:>9} {:>8} {:>9} {:>7} {:>9} {:>8} {:>7}\n",
        console::heading(&point.map),
        point.view_deg,
        point.rays,
        100.0 * point.grazing,
        "",
        "p50 texel",
        "p99",
        "over 1",
        if point.scene.is_some() { "p99 px" } else { "" },
        if point.scene.is_some() { "FLIP" } else { "" },
        "ms",
        "ops",
        "fetches"
    )
}

fn line(point: &Point) -> String {
    let time = point
        .time_ms
        .map_or_else(|| "no driver".to_owned(), |time| format!("{:.3}", time.median));
    let px = point
        .scene
        .as_ref()
        .map_or_else(String::new, |scene| format!("{:.4}", scene.error_px.p99));
    let flip = point
        .scene
        .as_ref()
        .and_then(|scene| scene.flip)
        .map_or_else(String::new, |flip| format!("{flip:.4}"));
    let error = &point.error_texels;
    let mut text = format!(
        "  {:44} {:>9.4} {:>9.4} {:>6.2} % {:>9} {:>7} {:>9} {:>8.1} {:>7.2}",
        format!("{} {}", point.technique, point.settings),
        error.p50,
        error.p99,
        100.0 * error.over_1,
        px,
        flip,
        time,
        point.ops,
        point.fetches
    );
    if point.disagreement.lost > 0.0 {
        let lost = console::bad(format_args!(
            "  {:.2} % are no numbers",
            100.0 * point.disagreement.lost
        ));
        text.push_str(&lost);
    }
    let _ = writeln!(text);
    text
}
