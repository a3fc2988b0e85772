//! A field with two axes in a part of a picture, and what is drawn into it.

use std::io;
use std::ops::Range;

use plotters::chart::ChartBuilder;
use plotters::coord::Shift;
use plotters::coord::ranged1d::{KeyPointHint, NoDefaultFormatting, Ranged, ValueFormatter};
use plotters::drawing::{DrawingArea, DrawingAreaErrorKind};
use plotters::element::{Circle, PathElement, Polygon, Rectangle};
use plotters::prelude::SVGBackend;
use plotters::style::text_anchor::{HPos, Pos, VPos};
use plotters::style::{Color, IntoFont, TextStyle};

use super::scale::LogScale;
use super::style::{BACK, FLOOR, GRID, Ink, Look, TEXT};

/// A part of a picture.
pub(super) type Area<'a> = DrawingArea<SVGBackend<'a>, Shift>;
/// What drawing gives.
pub(super) type Drawn<T = ()> = Result<T, DrawingAreaErrorKind<io::Error>>;

/// One axis. Its places are decades on a logarithmic axis, amounts on a linear one, and rows from the top down, negative.
#[derive(Clone, Debug)]
pub(super) enum Axis {
    /// Decades, with a floor for zeros.
    Log(LogScale),
    /// Evenly, from zero, with labelled ticks.
    Linear {
        /// The end.
        end: f64,
        /// Labelled places.
        ticks: Vec<f64>,
    },
    /// One row a name, the first on top.
    Rows(Vec<String>),
}

impl Axis {
    /// Evenly from zero to a round number beyond the greatest amount.
    pub(super) fn linear(amounts: impl IntoIterator<Item = f64>) -> Self {
        let greatest = amounts.into_iter().fold(0.0, f64::max);
        let step = round_step(greatest / 3.0);
        let count = (greatest / step).ceil().max(1.0) as usize;
        Self::Linear {
            end: step * count as f64,
            ticks: (0..=count).map(|number| step * number as f64).collect(),
        }
    }

    /// Where an amount lies, in the axis's own unit.
    pub(super) fn at(&self, amount: f64) -> f64 {
        match self {
            Self::Log(scale) => scale.at(amount),
            Self::Linear { .. } => amount,
            Self::Rows(_) => -amount,
        }
    }

    fn ends(&self) -> (f64, f64) {
        match self {
            Self::Log(scale) => scale.ends(),
            Self::Linear { end, .. } => (0.0, end * 1.02),
            Self::Rows(names) => (0.5 - names.len() as f64, 0.5),
        }
    }

    fn ticks(&self) -> Vec<f64> {
        match self {
            Self::Log(scale) => scale.ticks(),
            Self::Linear { ticks, .. } => ticks.clone(),
            Self::Rows(names) => (0..names.len()).map(|row| -(row as f64)).collect(),
        }
    }

    fn label(&self, tick: f64) -> String {
        match self {
            Self::Log(scale) => scale.label(tick),
            Self::Linear { .. } => short(tick),
            Self::Rows(names) => names.get((-tick).round() as usize).cloned().unwrap_or_default(),
        }
    }

    fn cut(&self) -> Option<f64> {
        match self {
            Self::Log(scale) => scale.cut(),
            Self::Linear { .. } | Self::Rows(_) => None,
        }
    }
}

impl Ranged for Axis {
    type FormatOption = NoDefaultFormatting;
    type ValueType = f64;

    fn map(&self, place: &f64, (first, last): (i32, i32)) -> i32 {
        let (start, end) = self.ends();
        let share = (place - start) / (end - start);
        (f64::from(first) + f64::from(last - first) * share).round() as i32
    }

    fn key_points<Hint: KeyPointHint>(&self, _: Hint) -> Vec<f64> {
        self.ticks()
    }

    fn range(&self) -> Range<f64> {
        let (start, end) = self.ends();
        start..end
    }
}

impl ValueFormatter<f64> for Axis {
    fn format_ext(&self, tick: &f64) -> String {
        self.label(*tick)
    }
}

/// The least of 1, 2, 5 times a power of ten that is not less; 1 for nothing.
fn round_step(amount: f64) -> f64 {
    if amount <= 0.0 {
        return 1.0;
    }
    let power = 10f64.powf(amount.log10().floor());
    let steps = [1.0, 2.0, 5.0, 10.0].map(|digit| digit * power);
    steps
        .into_iter()
        .find(|step| *step >= amount * 0.999_999)
        .unwrap_or(10.0 * power)
}

/// Three significant digits, without zeros behind them.
pub(crate) fn short(amount: f64) -> String {
    if amount == 0.0 {
        return "0".to_owned();
    }
    if !(1e-4..1e7).contains(&amount.abs()) {
        return format!("{amount:.2e}");
    }
    let digits = (2 - amount.abs().log10().floor() as i32).max(0) as usize;
    let text = format!("{amount:.digits$}");
    match text.contains('.') {
        true => text.trim_end_matches('0').trim_end_matches('.').to_owned(),
        false => text,
    }
}

/// Space around the field, pixels.
#[derive(Clone, Copy, Debug)]
pub(super) struct Margins {
    pub(super) left: u32,
    pub(super) right: u32,
    pub(super) top: u32,
    pub(super) bottom: u32,
}

/// A field with its axes drawn.
pub(super) struct Plot<'a> {
    area: Area<'a>,
    x: Axis,
    y: Axis,
    /// First and last pixel of the field, from left to right.
    columns: (i32, i32),
    /// First and last pixel of the field, from the bottom up.
    rows: (i32, i32),
}

impl<'a> Plot<'a> {
    /// Draws grid, axes and their titles.
    pub(super) fn on(
        area: &Area<'a>,
        (x, x_title): (Axis, &str),
        (y, y_title): (Axis, &str),
        margins: Margins,
    ) -> Drawn<Self> {
        let mut chart = ChartBuilder::on(area)
            .margin_left(6)
            .margin_bottom(8)
            .margin_top(margins.top)
            .margin_right(margins.right)
            .x_label_area_size(margins.bottom)
            .y_label_area_size(margins.left)
            .build_cartesian_2d(x.clone(), y.clone())?;
        // Pixels of the picture; those of its part begin at the part's corner.
        let (left, top) = area.get_base_pixel();
        let corner = |x: f64, y: f64| chart.plotting_area().map_coordinate(&(x, y));
        let (first, last) = (corner(x.ends().0, y.ends().0), corner(x.ends().1, y.ends().1));
        let plot = Self {
            area: area.clone(),
            x,
            y,
            columns: (first.0 - left, last.0 - left),
            rows: (first.1 - top, last.1 - top),
        };
        plot.floors()?;
        chart
            .configure_mesh()
            .bold_line_style(GRID.color())
            .light_line_style(BACK.color().mix(0.0))
            .axis_style(TEXT.color())
            .label_style(text(18.0))
            .axis_desc_style(text(19.0))
            .x_desc(x_title)
            .y_desc(y_title)
            .draw()?;
        Ok(plot)
    }

    /// A band behind what lies on a floor.
    fn floors(&self) -> Drawn {
        let style = FLOOR.color().filled();
        let ((left, right), (bottom, top)) = (self.columns, self.rows);
        if let Some(cut) = self.x.cut() {
            self.put(&Rectangle::new(
                [(left, top), (self.x.map(&cut, self.columns), bottom)],
                style,
            ))?;
        }
        if let Some(cut) = self.y.cut() {
            self.put(&Rectangle::new(
                [(left, self.y.map(&cut, self.rows)), (right, bottom)],
                style,
            ))?;
        }
        Ok(())
    }

    /// The pixel of a pair of amounts.
    pub(super) fn pixel(&self, x: f64, y: f64) -> (i32, i32) {
        (
            self.x.map(&self.x.at(x), self.columns),
            self.y.map(&self.y.at(y), self.rows),
        )
    }

    /// A line through pairs of amounts.
    pub(super) fn line(&self, points: &[[f64; 2]], ink: Ink, width: u32) -> Drawn {
        let pixels: Vec<(i32, i32)> = points.iter().map(|[x, y]| self.pixel(*x, *y)).collect();
        self.put(&PathElement::new(pixels, ink.color().stroke_width(width)))
    }

    /// The way down a front: right to the next cost, then down to its error.
    pub(super) fn stairs(&self, points: &[[f64; 2]], ink: Ink, width: u32) -> Drawn {
        let mut steps: Vec<[f64; 2]> = Vec::new();
        for [x, y] in points {
            if let Some([_, above]) = steps.last().copied() {
                steps.push([*x, above]);
            }
            steps.push([*x, *y]);
        }
        self.line(&steps, ink, width)
    }

    /// A level bar with ends, from one amount to another.
    pub(super) fn bar(&self, (from, to): (f64, f64), y: f64, ink: Ink) -> Drawn {
        let (left, row) = self.pixel(from, y);
        let (right, _) = self.pixel(to, y);
        let style = ink.color().stroke_width(1);
        for line in [
            [(left, row), (right, row)],
            [(left, row - 4), (left, row + 4)],
            [(right, row - 4), (right, row + 4)],
        ] {
            self.put(&PathElement::new(line.to_vec(), style))?;
        }
        Ok(())
    }

    /// A marker at a pair of amounts.
    pub(super) fn marker(&self, x: f64, y: f64, look: Look) -> Drawn {
        marker(&self.area, self.pixel(x, y), look)
    }

    /// Words beside a pixel.
    pub(super) fn words(&self, words: &str, pixel: (i32, i32), size: f64) -> Drawn {
        words_at(&self.area, words, pixel, size)
    }

    fn put<E>(&self, element: &E) -> Drawn
    where
        for<'e> &'e E: plotters::element::PointCollection<'e, (i32, i32)>,
        E: plotters::element::Drawable<SVGBackend<'a>>,
    {
        self.area.draw(element)
    }
}

fn text<'a>(size: f64) -> TextStyle<'a> {
    ("sans-serif", size).into_font().color(&TEXT.color())
}

/// A marker at a pixel.
pub(super) fn marker(area: &Area<'_>, pixel: (i32, i32), look: Look) -> Drawn {
    let (fill, edge) = (look.ink.color().filled(), BACK.color().stroke_width(1));
    let Some(outline) = look.marker.outline() else {
        area.draw(&Circle::new(pixel, 6, fill))?;
        return area.draw(&Circle::new(pixel, 6, edge));
    };
    let mut corners: Vec<(i32, i32)> = outline.iter().map(|(x, y)| (pixel.0 + x, pixel.1 + y)).collect();
    area.draw(&Polygon::new(corners.clone(), fill))?;
    corners.extend(corners.first().copied());
    area.draw(&PathElement::new(corners, edge))
}

/// Words that begin at a pixel, centred on its row.
pub(super) fn words_at(area: &Area<'_>, words: &str, pixel: (i32, i32), size: f64) -> Drawn {
    let style = text(size).pos(Pos::new(HPos::Left, VPos::Center));
    area.draw_text(words, &style, pixel)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn linear_axes_end_at_a_round_number_that_holds_everything() {
        let ends = |amounts: &[f64]| match Axis::linear(amounts.iter().copied()) {
            Axis::Linear { end, ticks } => (end, ticks.len()),
            Axis::Log(_) | Axis::Rows(_) => unreachable!("it was asked for a linear axis"),
        };
        assert_eq!(ends(&[3.0, 7.0]), (10.0, 3));
        assert_eq!(ends(&[90.0]), (100.0, 3));
        assert_eq!(ends(&[0.0]), (1.0, 2));
        assert_eq!(ends(&[]), (1.0, 2));
    }

    #[test]
    fn numbers_are_short() {
        let shown = [0.0, 0.012_345, 1.0, 1234.4, 0.5, 1e-7, 12.0, 100.0].map(short);
        assert_eq!(shown, ["0", "0.0123", "1", "1234", "0.5", "1.00e-7", "12", "100"]);
    }

    #[test]
    fn rows_run_down() {
        let axis = Axis::Rows(vec!["first".into(), "second".into()]);
        assert!(axis.at(0.0) > axis.at(1.0));
        assert_eq!(axis.label(axis.at(1.0)), "second");
    }
}
