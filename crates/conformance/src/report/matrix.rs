//! Techniques down, routes and adapters across: the whole run as one table, in which no cell is empty.
//!
//! A column is a route on an adapter, or a route that nothing here or not that adapter runs, which says why. A cell joins the cases of its technique and
//! form: the gravest verdict, and the output that came nearest to its bound or is farthest beyond it.

use std::collections::BTreeSet;

use serde::Serialize;

use super::{CaseResult, Report, Totals};
use crate::route::Route;
use crate::verdict::Verdict;

/// A route on an adapter.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize)]
pub struct Column {
    /// The route.
    pub route: Route,
    /// The adapter's name; `None` of a route that nothing here runs.
    pub adapter: Option<String>,
    /// Why it did not run, and how to get what it needs; `None` where it ran.
    pub not_run: Option<String>,
}

impl Column {
    /// `wgsl on llvmpipe`.
    #[must_use]
    pub fn label(&self) -> String {
        match &self.adapter {
            Some(adapter) if self.not_run.is_some() => format!("{} on {adapter}, not run", self.route),
            Some(adapter) => format!("{} on {adapter}", self.route),
            None => format!("{}, not run", self.route),
        }
    }
}

/// Where the worst output is.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Place {
    /// The case.
    pub case: String,
    /// Which output of the item.
    pub output: usize,
    /// The item's inputs, or the name of the output of a user's shader.
    pub input: String,
}

/// A technique on a route and an adapter.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Cell {
    /// The gravest verdict of its cases; a skip where there are none.
    pub verdict: Verdict,
    /// How many cases.
    pub cases: usize,
    /// How many outputs were compared.
    pub outputs: usize,
    /// How many cases failed as they should.
    pub known_defects: usize,
    /// The worst output's error in ULPs of the truth; `None` where no output has one.
    pub worst_ulp: Option<f64>,
    /// The worst output's error as a share of what is allowed.
    pub worst_of_bound: Option<f64>,
    /// Where that is.
    #[serde(rename = "where")]
    pub place: Option<Place>,
    /// Why, of every verdict but a pass.
    pub reason: Option<String>,
}

/// A technique in one of its forms.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Row {
    /// The technique.
    pub technique: String,
    /// Its form, where it has two.
    pub form: Option<String>,
    /// One cell a column.
    pub cells: Vec<Cell>,
}

/// The table.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Matrix {
    /// Routes and adapters, those that ran and those that did not.
    pub columns: Vec<Column>,
    /// Techniques and forms.
    pub rows: Vec<Row>,
}

impl Matrix {
    /// The table of a run.
    #[must_use]
    pub fn of(report: &Report) -> Self {
        let columns = columns(report);
        let row = |((technique, form), cases): ((String, Option<String>), Vec<&CaseResult>)| Row {
            technique,
            form,
            cells: columns.iter().map(|column| cell(column, &cases)).collect(),
        };
        let rows = report.by_technique().into_iter().map(row).collect();
        Self { columns, rows }
    }
}

fn columns(report: &Report) -> Vec<Column> {
    let ran = report.cases.iter().map(|case| Column {
        route: case.route,
        adapter: Some(case.adapter.clone()),
        not_run: None,
    });
    let not_run = report.environment.not_run.iter().map(|one| Column {
        route: one.route,
        adapter: one.adapter.clone(),
        not_run: Some(one.reason.clone()),
    });
    let sorted: BTreeSet<Column> = ran.chain(not_run).collect();
    sorted.into_iter().collect()
}

fn cell(column: &Column, cases: &[&CaseResult]) -> Cell {
    let here =
        |case: &&&CaseResult| case.route == column.route && Some(&case.adapter) == column.adapter.as_ref();
    let cases: Vec<&CaseResult> = cases.iter().filter(here).copied().collect();
    let Some(gravest) = cases.iter().copied().reduce(graver) else {
        let reason = column.not_run.clone();
        return empty(reason.unwrap_or_else(|| "no case of it was selected here".to_owned()));
    };
    let totals = Totals::of(cases.iter().copied());
    let worst = cases
        .iter()
        .filter_map(|case| Some((*case, case.worst.as_ref()?)));
    let badness =
        |case: &CaseResult, of_bound: Option<f64>| (case.verdict == Verdict::Fail, of_bound.unwrap_or(0.0));
    let worst = worst.max_by(|(a, x), (b, y)| {
        let (a, b) = (badness(a, x.of_bound), badness(b, y.of_bound));
        a.0.cmp(&b.0).then(a.1.total_cmp(&b.1))
    });
    Cell {
        verdict: gravest.verdict,
        cases: totals.cases,
        outputs: totals.outputs,
        known_defects: totals.expected_fail,
        worst_ulp: worst
            .and_then(|(_, worst)| worst.ulp)
            .filter(|ulp| ulp.is_finite()),
        worst_of_bound: worst
            .and_then(|(_, worst)| worst.of_bound)
            .filter(|share| share.is_finite()),
        place: worst.map(|(case, worst)| Place {
            case: case.id.to_string(),
            output: worst.output,
            input: worst
                .place
                .clone()
                .unwrap_or_else(|| format!("{:?}", worst.input)),
        }),
        reason: (gravest.verdict != Verdict::Pass).then(|| {
            gravest
                .reason
                .clone()
                .unwrap_or_else(|| "no reason given".to_owned())
        }),
    }
}

/// The graver of two results; the first of equals.
fn graver<'a>(one: &'a CaseResult, other: &'a CaseResult) -> &'a CaseResult {
    if one.verdict.graver(other.verdict) == one.verdict {
        one
    } else {
        other
    }
}

fn empty(reason: String) -> Cell {
    Cell {
        verdict: Verdict::Skip,
        cases: 0,
        outputs: 0,
        known_defects: 0,
        worst_ulp: None,
        worst_of_bound: None,
        place: None,
        reason: Some(reason),
    }
}
