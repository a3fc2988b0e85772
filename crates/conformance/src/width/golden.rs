//! The reviewed widths: a table in the repository that the measured ones are held against.
//!
//! `snapshots/widths@bounds.snap` has one line an output field. It is written and reviewed like every other snapshot, so a change to a
//! shader or to a rule of `bossage-bounds` that widens (or narrows) an interval shows as a patch. Random cases of `bossage conform`
//! read the same table: a shader whose intervals are wider than reviewed fails, although every value lies in its own interval. That is
//! how a change is seen that only blurs a result.

use std::fmt::Write as _;

use bossage_shaders::Probe;

use super::FieldWidths;

/// The table as it was reviewed.
const REVIEWED: &str = include_str!("../../../../snapshots/widths@bounds.snap");

/// By how much a median or a 90th percentile may exceed the reviewed one: by a share, for single items that another machine's
/// mathematics library moves, and by one step of the format.
const SLACK: (f64, f64) = (0.05, 1.0);

/// What is printed for widths that have no bound.
const OPEN: &str = "open";

/// One line of the table: what is compared.
#[derive(Clone, Debug, PartialEq)]
pub struct Row {
    /// Median widths, component by component.
    pub medians: Vec<f64>,
    /// 90th percentiles.
    pub p90: Vec<f64>,
    /// Median widths at scale, which are shown and not held.
    pub at_scale: Vec<f64>,
}

/// The head of the table.
pub const HEAD: &str = "function | form | output | median | p90 | largest | median at scale | open | forked";

/// The line of one output field.
#[must_use]
pub fn line(probe: &Probe, field: &FieldWidths) -> String {
    let mut text = format!("{} | {} | {}", probe.function(), probe.form.as_str(), field.name);
    for list in [&field.medians, &field.p90] {
        let _ = write!(text, " | {}", numbers(list, number));
    }
    let _ = write!(text, " | {}", numbers(&field.largest, magnitude));
    let _ = write!(text, " | {}", numbers(&field.at_scale, number));
    for share in [field.open, field.forked] {
        let _ = write!(text, " | {:.2} %", 100.0 * share);
    }
    text
}

fn numbers(list: &[f64], show: fn(f64) -> String) -> String {
    list.iter().map(|&x| show(x)).collect::<Vec<_>>().join(" ")
}

/// Whole ULPs: widths of intervals are whole, quantiles of more inputs than one are no more exact.
fn number(x: f64) -> String {
    if x.is_finite() {
        format!("{x:.0}")
    } else {
        OPEN.to_owned()
    }
}

/// The largest width is the luck of one item: its power of two is enough.
fn magnitude(x: f64) -> String {
    match x {
        x if x.is_infinite() => OPEN.to_owned(),
        x if x < 1.0 => "0".to_owned(),
        x => format!("<2^{}", x.log2().floor() + 1.0),
    }
}

/// The reviewed row of an output field, if there is one.
#[must_use]
pub fn reviewed(probe: &Probe, field: &str) -> Option<Row> {
    find(REVIEWED, probe, field)
}

fn find(table: &str, probe: &Probe, field: &str) -> Option<Row> {
    table.lines().find_map(|line| {
        let mut cells = line.split(" | ");
        let named = cells.next() == Some(probe.function())
            && cells.next() == Some(probe.form.as_str())
            && cells.next() == Some(field);
        named.then(|| Row {
            medians: read(cells.next()),
            p90: read(cells.next()),
            at_scale: read(cells.nth(1)),
        })
    })
}

fn read(cell: Option<&str>) -> Vec<f64> {
    let one = |word: &str| word.parse().unwrap_or(f64::INFINITY);
    cell.unwrap_or_default().split_whitespace().map(one).collect()
}

/// The first output whose intervals are wider than reviewed, in words; `None` where all are as narrow.
#[must_use]
pub fn wider(probe: &Probe, measured: &[FieldWidths]) -> Option<String> {
    measured.iter().find_map(|field| {
        let Some(row) = reviewed(probe, field.name) else {
            return Some(format!(
                "the widths of output `{}` were never reviewed",
                field.name
            ));
        };
        let exceeds = |(measured, reviewed): (&f64, &f64)| *measured > reviewed * (1.0 + SLACK.0) + SLACK.1;
        let lists = [
            ("median", &field.medians, &row.medians),
            ("90th percentile", &field.p90, &row.p90),
        ];
        lists.into_iter().find_map(|(what, measured, reviewed)| {
            let (m, r) = measured.iter().zip(reviewed).find(|&pair| exceeds(pair))?;
            Some(format!(
                "the intervals of output `{}` are wider than reviewed: {what} {} ULP instead of {}",
                field.name,
                number(*m),
                number(*r)
            ))
        })
    })
}

#[cfg(test)]
mod tests {
    use bossage_shaders::{PROBES, Probe};

    use super::{FieldWidths, find, line, reviewed, wider};

    fn field(medians: &[f64], p90: &[f64]) -> FieldWidths {
        FieldWidths {
            name: "unit",
            medians: medians.to_vec(),
            p90: p90.to_vec(),
            largest: vec![f64::INFINITY; medians.len()],
            at_scale: medians.to_vec(),
            open: 0.25,
            forked: 0.0,
        }
    }

    #[test]
    fn a_line_reads_back() {
        let probe = Probe::find("normalise").unwrap();
        let written = line(
            probe,
            &field(&[1.0, 2.5, f64::INFINITY], &[4.0, 5.0, f64::INFINITY]),
        );
        assert_eq!(
            written,
            "normalise | hardened | unit | 1 2 open | 4 5 open | open open open | 1 2 open | 25.00 % | 0.00 %"
        );
        let row = find(&written, probe, "unit").unwrap();
        assert_eq!(row.medians, [1.0, 2.0, f64::INFINITY]);
        assert_eq!(row.p90, [4.0, 5.0, f64::INFINITY]);
        assert_eq!(row.at_scale, [1.0, 2.0, f64::INFINITY]);
        assert_eq!(find(&written, Probe::find("lambert").unwrap(), "unit"), None);
    }

    #[test]
    fn every_output_was_reviewed() {
        for probe in PROBES {
            for output in probe.outputs {
                let row = reviewed(probe, output.name);
                let widths = row.map(|row| row.medians.len());
                assert_eq!(
                    widths,
                    Some(output.shape.floats()),
                    "{}: {}",
                    probe.id,
                    output.name
                );
            }
        }
    }

    #[test]
    fn what_is_wider_is_named_and_what_is_narrower_is_not() {
        let probe = Probe::find("normalise").unwrap();
        let row = reviewed(probe, "unit").unwrap();
        let as_reviewed = field(&row.medians, &row.p90);
        assert_eq!(wider(probe, std::slice::from_ref(&as_reviewed)), None);
        let mut one = as_reviewed.clone();
        one.medians[1] = 2.0 * row.medians[1];
        assert!(
            wider(probe, &[one])
                .unwrap()
                .contains("`unit` are wider than reviewed: median")
        );
        let mut open = as_reviewed.clone();
        open.p90[2] = f64::INFINITY;
        assert!(
            wider(probe, &[open])
                .unwrap()
                .contains("90th percentile open ULP")
        );
        assert_eq!(wider(probe, &[field(&[0.0; 3], &[0.0; 3])]), None);
    }
}
