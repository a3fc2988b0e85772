//! The charts of a study, as SVG that follows the reader's light or dark setting and as PNG in both.
//!
//! plotters draws; what differs between light and dark is a style sheet (`style.rs`), so that each chart is drawn once. PNGs are made from
//! the same SVG by resvg, with a font of ours: a chart looks alike on every machine.

mod angle;
mod error;
mod front;
mod plot;
mod price;
mod raster;
mod scale;
mod style;

use plotters::drawing::IntoDrawingArea;
use plotters::prelude::SVGBackend;
use rayon::prelude::*;

pub use error::Error;
pub use raster::Theme;

use crate::record::Study;
use plot::{Area, Drawn};
use style::{BACK, Looks};

pub(crate) use plot::short;

/// What a chart shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Kind {
    /// Error against time, with the front; one a map and angle.
    Time,
    /// Error against counted operations, with the front; one a map and angle.
    Operations,
    /// Error against the view's angle; one a map.
    Angle,
    /// Another price of accuracy.
    Price,
}

/// One chart.
#[derive(Clone, Debug, PartialEq)]
pub struct Chart {
    /// What it shows.
    pub kind: Kind,
    /// Name of its files without ending, as `time-bricks-75`.
    pub name: String,
    /// Heading.
    pub title: String,
    /// What can be seen, in words, for those who can't.
    pub alt: String,
    /// The map that it is about; for prices the chart's name.
    pub subject: String,
    /// The drawing in its light form, without a style sheet.
    drawing: String,
}

/// Every chart for which the study has figures, in the order of a report.
///
/// # Errors
/// [`Error`] when the drawing crate refuses.
pub fn all(study: &Study) -> Result<Vec<Chart>, Error> {
    let looks = Looks::of(study.points.iter().map(|point| point.technique.as_str()));
    let mut plans = front::plans(study, &looks);
    plans.extend(angle::plans(study, &looks));
    plans.extend(price::plans(study));
    plans.into_par_iter().map(Plan::draw).collect()
}

impl Chart {
    /// A file of its own, light or dark by the reader's setting.
    #[must_use]
    pub fn svg(&self) -> String {
        let rules = format!(
            "@media (prefers-color-scheme: dark) {{\n{}}}\n",
            style::dark_rules("svg")
        );
        self.with_head(&rules)
    }

    /// A part of a page that has [`page_rules`].
    #[must_use]
    pub fn inline(&self) -> String {
        let open = format!(
            "<svg class=\"chart\" role=\"img\" aria-label=\"{}\"",
            escaped(&self.alt)
        );
        let fluid = without_size(&self.drawing);
        fluid.replacen("<svg", &open, 1)
    }

    /// The drawing as PNG, at twice its nominal size.
    ///
    /// # Errors
    /// [`Error`] when the renderer refuses.
    pub fn png(&self, theme: Theme) -> Result<Vec<u8>, Error> {
        let rules = match theme {
            Theme::Light => String::new(),
            Theme::Dark => style::dark_rules("svg"),
        };
        raster::png(&self.name, &self.with_head(&rules))
    }

    /// Title, description and style sheet come first in the drawing.
    fn with_head(&self, rules: &str) -> String {
        let (title, alt) = (escaped(&self.title), escaped(&self.alt));
        let head = format!("<title>{title}</title>\n<desc>{alt}</desc>\n<style>\n{rules}</style>\n");
        match self.drawing.split_once('>') {
            Some((open, rest)) => format!("{open}>\n{head}{}", rest.trim_start()),
            None => head,
        }
    }
}

/// The style sheet by which a page's charts turn dark with it.
#[must_use]
pub fn page_rules() -> String {
    format!(
        "@media (prefers-color-scheme: dark) {{\n{}}}\n",
        style::dark_rules(".chart")
    )
}

/// The drawing fills its place; its proportions stay in the view box.
fn without_size(drawing: &str) -> String {
    let Some((open, rest)) = drawing.split_once('>') else {
        return drawing.to_owned();
    };
    let kept: Vec<&str> = open
        .split_inclusive("\" ")
        .filter(|part| !part.starts_with("width=") && !part.starts_with("height="))
        .collect();
    let kept = kept.concat().replacen("<svg width", "<svg data-width", 1);
    format!("{kept}>{rest}")
}

fn escaped(text: &str) -> String {
    maud::html! { (text) }.into_string()
}

/// A chart that is yet to be drawn.
struct Plan<'a> {
    kind: Kind,
    name: String,
    title: String,
    alt: String,
    subject: String,
    size: (u32, u32),
    body: Box<dyn Fn(&Area<'_>) -> Drawn + Send + Sync + 'a>,
}

impl Plan<'_> {
    fn draw(self) -> Result<Chart, Error> {
        let mut drawing = String::new();
        {
            let area = SVGBackend::with_string(&mut drawing, self.size).into_drawing_area();
            let drawn = area
                .fill(&BACK.color())
                .and_then(|()| plot::words_at(&area, &self.title, (14, 20), 23.0))
                .and_then(|()| (self.body)(&area))
                .and_then(|()| area.present());
            drawn.map_err(|source| Error {
                chart: self.name.clone(),
                source: source.into(),
            })?;
        }
        Ok(Chart {
            kind: self.kind,
            name: self.name,
            title: self.title,
            alt: self.alt,
            subject: self.subject,
            drawing,
        })
    }
}

/// Part of a file's name: letters, digits, `-`, `_` and `.` stay, everything else becomes `-`.
pub(crate) fn file_part(name: &str) -> String {
    let kept = |c: char| c.is_ascii_alphanumeric() || matches!(c, '_' | '-' | '.');
    name.chars().map(|c| if kept(c) { c } else { '-' }).collect()
}
