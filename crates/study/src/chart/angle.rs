//! Error against the view's angle: one line a technique, each at its dearest settings.

use std::collections::{BTreeMap, BTreeSet};

use super::plot::{Area, Axis, Drawn, Margins, Plot, marker, short, words_at};
use super::scale::LogScale;
use super::style::Looks;
use super::{Kind, Plan, file_part};
use crate::record::{Point, Study};

const MARGINS: Margins = Margins {
    left: 92,
    right: 260,
    top: 44,
    bottom: 58,
};
const SIZE: (u32, u32) = (900, 460);
const LEGEND: i32 = 655;

/// One chart a map that was seen at more than one angle.
pub(super) fn plans<'a>(study: &'a Study, looks: &'a Looks) -> Vec<Plan<'a>> {
    let mut maps: BTreeMap<&str, Vec<&Point>> = BTreeMap::new();
    // A scene's camera sees a range of angles, which has no place on this axis.
    for point in study.points.iter().filter(|point| point.scene.is_none()) {
        maps.entry(&point.map).or_default().push(point);
    }
    maps.into_iter()
        .filter_map(|(map, points)| plan(map, &points, looks))
        .collect()
}

fn plan<'a>(map: &str, points: &[&'a Point], looks: &'a Looks) -> Option<Plan<'a>> {
    let angles: BTreeSet<u64> = points
        .iter()
        .map(|point| (point.view_deg + 0.0).to_bits())
        .collect();
    if angles.len() < 2 {
        return None;
    }
    let lines = lines(points, looks);
    Some(Plan {
        kind: Kind::Angle,
        name: format!("angle-{}", file_part(map)),
        title: format!("{map}: error against view angle"),
        alt: alt(map, &lines),
        subject: map.to_owned(),
        size: SIZE,
        body: Box::new(move |area| draw(area, &lines, looks)),
    })
}

/// A technique at one choice of settings, by angle.
struct Line<'a> {
    technique: &'a str,
    settings: String,
    points: Vec<&'a Point>,
}

impl Line<'_> {
    fn name(&self) -> String {
        match self.settings.is_empty() {
            true => self.technique.to_owned(),
            false => format!("{} {}", self.technique, self.settings),
        }
    }
}

/// The dearest settings of each technique, by mean operations a ray.
fn lines<'a>(points: &[&'a Point], looks: &Looks) -> Vec<Line<'a>> {
    let mut choices: BTreeMap<(&str, String), Vec<&Point>> = BTreeMap::new();
    for point in points {
        choices
            .entry((&point.technique, point.settings.to_string()))
            .or_default()
            .push(point);
    }
    let mut dearest: BTreeMap<&str, (f64, Line<'_>)> = BTreeMap::new();
    for ((technique, settings), mut points) in choices {
        points.sort_by(|a, b| a.view_deg.total_cmp(&b.view_deg));
        let ops = points.iter().map(|point| point.ops).sum::<f64>() / points.len() as f64;
        if dearest.get(technique).is_none_or(|(most, _)| ops > *most) {
            let line = Line {
                technique,
                settings,
                points,
            };
            dearest.insert(technique, (ops, line));
        }
    }
    let order = looks.legend(dearest.keys().copied());
    order
        .into_iter()
        .filter_map(|(technique, _)| Some(dearest.remove(technique)?.1))
        .collect()
}

fn alt(map: &str, lines: &[Line<'_>]) -> String {
    let said: Vec<String> = lines
        .iter()
        .filter_map(|line| {
            let (first, last) = (line.points.first()?, line.points.last()?);
            Some(format!(
                "{} from {} texels at {}° to {} at {}°",
                line.name(),
                short(first.error_texels.p99),
                first.view_deg,
                short(last.error_texels.p99),
                last.view_deg
            ))
        })
        .collect();
    format!(
        "Error on {map} against the angle of the view from the normal, each technique at its dearest settings: {}.",
        said.join("; ")
    )
}

fn draw(area: &Area<'_>, lines: &[Line<'_>], looks: &Looks) -> Drawn {
    let all = || lines.iter().flat_map(|line| &line.points);
    let angles: BTreeSet<u64> = all().map(|point| (point.view_deg + 0.0).to_bits()).collect();
    let x = Axis::Linear {
        end: 90.0,
        ticks: angles.into_iter().map(f64::from_bits).collect(),
    };
    let y = Axis::Log(LogScale::over(all().map(|point| point.error_texels.p99)));
    let plot = Plot::on(
        area,
        (x, "view from the normal, degrees"),
        (y, "error (p99), texels"),
        MARGINS,
    )?;
    for (row, line) in lines.iter().enumerate() {
        let look = looks.look(line.technique);
        let path: Vec<[f64; 2]> = line
            .points
            .iter()
            .map(|point| [point.view_deg, point.error_texels.p99])
            .collect();
        plot.line(&path, look.ink, 2)?;
        for [angle, error] in &path {
            plot.marker(*angle, *error, look)?;
        }
        let row = 62 + 36 * row as i32;
        marker(area, (LEGEND, row), look)?;
        words_at(area, line.technique, (LEGEND + 16, row), 18.0)?;
        words_at(area, &line.settings, (LEGEND + 16, row + 16), 15.0)?;
    }
    Ok(())
}
