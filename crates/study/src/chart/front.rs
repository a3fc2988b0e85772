//! Error against cost: one series a technique, the spread of times as bars, and the front that nothing beats.

use std::collections::BTreeMap;

use super::plot::{Area, Axis, Drawn, Margins, Plot, marker, short, words_at};
use super::scale::LogScale;
use super::style::{FRONT, Looks};
use super::{Kind, Plan, file_part};
use crate::pareto;
use crate::record::{Point, Study};

const SIZE: (u32, u32) = (900, 520);
/// The column of the legend.
const LEGEND: i32 = 672;
const MARGINS: Margins = Margins {
    left: 92,
    right: 243,
    top: 44,
    bottom: 58,
};

/// What a point costs: the amount, and from where to where it was seen.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Cost {
    middle: f64,
    spread: Option<(f64, f64)>,
}

fn time(point: &Point) -> Option<Cost> {
    let time = point.time_ms.as_ref()?;
    Some(Cost {
        middle: time.median,
        spread: Some((time.min, time.max)),
    })
}

fn operations(point: &Point) -> Option<Cost> {
    Some(Cost {
        middle: point.ops,
        spread: None,
    })
}

/// Both kinds of cost for every map and angle that has figures for them.
pub(super) fn plans<'a>(study: &'a Study, looks: &'a Looks) -> Vec<Plan<'a>> {
    let mut groups: BTreeMap<(&str, u64), Vec<&Point>> = BTreeMap::new();
    for point in &study.points {
        // Angles are not negative, and such numbers are in the order of their bits.
        let group = (point.map.as_str(), (point.view_deg + 0.0).to_bits());
        groups.entry(group).or_default().push(point);
    }
    let kinds = [Kind::Time, Kind::Operations];
    let pairs = kinds
        .into_iter()
        .flat_map(|kind| groups.iter().map(move |group| (kind, group)));
    pairs
        .filter_map(|(kind, ((map, view), points))| plan(kind, map, f64::from_bits(*view), points, looks))
        .collect()
}

fn plan<'a>(
    kind: Kind,
    map: &str,
    view_deg: f64,
    points: &[&'a Point],
    looks: &'a Looks,
) -> Option<Plan<'a>> {
    let (cost, word, axis): (fn(&Point) -> Option<Cost>, _, _) = match kind {
        Kind::Operations => (operations, "operations", "counted operations a ray"),
        Kind::Time | Kind::Angle | Kind::Price => (time, "time", "time of a frame, ms"),
    };
    let costed: Vec<(&Point, Cost)> = points
        .iter()
        .filter_map(|point| Some((*point, cost(point)?)))
        .collect();
    if costed.is_empty() {
        return None;
    }
    let front = front(&costed);
    Some(Plan {
        kind,
        name: format!("{word}-{}-{view_deg}", file_part(map)),
        title: format!("{map} at {}°: error against {word}", short(view_deg)),
        alt: alt(word, map, view_deg, costed.len(), &front),
        subject: map.to_owned(),
        size: SIZE,
        body: Box::new(move |area| draw(area, &costed, &front, axis, looks)),
    })
}

/// The points that nothing beats, cheapest first.
fn front<'a>(costed: &[(&'a Point, Cost)]) -> Vec<(&'a Point, Cost)> {
    let pairs: Vec<Option<[f64; 2]>> = costed
        .iter()
        .map(|(point, cost)| pareto::with_error(point, cost.middle))
        .collect();
    let on_front = pareto::front(&pairs);
    let mut front: Vec<(&Point, Cost)> = costed
        .iter()
        .zip(on_front)
        .filter_map(|(costed, is_on_front)| is_on_front.then_some(*costed))
        .collect();
    front.sort_by(|(_, a), (_, b)| a.middle.total_cmp(&b.middle));
    front
}

fn alt(word: &str, map: &str, view_deg: f64, count: usize, front: &[(&Point, Cost)]) -> String {
    let unit = if word == "time" { "ms" } else { "operations a ray" };
    let steps: Vec<String> = front
        .iter()
        .map(|(point, cost)| {
            let error = short(point.error_texels.p99);
            format!("{} ({} {unit}, {error} texels)", named(point), short(cost.middle))
        })
        .collect();
    format!(
        "Error against {word} on {map}, seen {}° from the normal. Points: {count}. On the front, cheapest first: {}.",
        short(view_deg),
        steps.join("; ")
    )
}

/// A technique with its settings.
fn named(point: &Point) -> String {
    match point.settings.0.is_empty() {
        true => point.technique.clone(),
        false => format!("{} {}", point.technique, point.settings),
    }
}

fn draw(
    area: &Area<'_>,
    costed: &[(&Point, Cost)],
    front: &[(&Point, Cost)],
    axis: &str,
    looks: &Looks,
) -> Drawn {
    let costs = costed.iter().flat_map(|(_, cost)| {
        let (from, to) = cost.spread.unwrap_or((cost.middle, cost.middle));
        [from, cost.middle, to]
    });
    let x = Axis::Log(LogScale::over(costs));
    let y = Axis::Log(LogScale::over(
        costed.iter().map(|(point, _)| point.error_texels.p99),
    ));
    let plot = Plot::on(area, (x, axis), (y, "error (p99), texels"), MARGINS)?;
    let steps: Vec<[f64; 2]> = front
        .iter()
        .map(|(point, cost)| [cost.middle, point.error_texels.p99])
        .collect();
    plot.stairs(&steps, FRONT, 5)?;
    let series = looks.legend(costed.iter().map(|(point, _)| point.technique.as_str()));
    for (technique, look) in &series {
        let mut members: Vec<&(&Point, Cost)> = costed
            .iter()
            .filter(|(point, _)| point.technique == *technique)
            .collect();
        members.sort_by(|(_, a), (_, b)| a.middle.total_cmp(&b.middle));
        let path: Vec<[f64; 2]> = members
            .iter()
            .map(|(point, cost)| [cost.middle, point.error_texels.p99])
            .collect();
        plot.line(&path, look.ink, 1)?;
        for (point, cost) in members {
            let error = point.error_texels.p99;
            if let Some(spread) = cost.spread {
                plot.bar(spread, error, look.ink)?;
            }
            plot.marker(cost.middle, error, *look)?;
        }
    }
    legend(area, &series)
}

/// Names beside the markers, and what the grey line is.
fn legend(area: &Area<'_>, series: &[(&str, super::style::Look)]) -> Drawn {
    let mut row = 62;
    for (technique, look) in series {
        marker(area, (LEGEND, row), *look)?;
        words_at(area, technique, (LEGEND + 16, row), 17.0)?;
        row += 24;
    }
    row += 8;
    let style = plotters::style::Color::stroke_width(&FRONT.color(), 5);
    area.draw(&plotters::element::PathElement::new(
        vec![(LEGEND - 8, row), (LEGEND + 8, row)],
        style,
    ))?;
    words_at(area, "front: nothing beats it", (LEGEND + 16, row), 17.0)
}
