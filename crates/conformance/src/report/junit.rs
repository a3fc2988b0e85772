//! The report as JUnit XML, which CI systems read: one suite a route and adapter, one test a case. Before them stands the suite
//! `matrix` with one test for each technique on each route and adapter, those that did not run among them.
//!
//! JUnit has no expected failure: such a case is a passed test with the defect in its output. A warning is a passed test
//! with the reason in its output.

use std::collections::BTreeMap;

use quick_junit::{NonSuccessKind, Report as Document, TestCase, TestCaseStatus, TestSuite};

use super::matrix::{Cell, Matrix};
use super::{CaseResult, Report};
use crate::error::Error;
use crate::verdict::Verdict;

/// The report as XML.
///
/// # Errors
/// [`Error::Report`] when the writer refuses, which no report is known to cause.
pub fn write(report: &Report) -> Result<String, Error> {
    let mut document = Document::new("bossage conform");
    let mut suites: BTreeMap<String, TestSuite> = BTreeMap::new();
    for case in &report.cases {
        let name = format!("{} on {}", case.route, case.adapter);
        suites
            .entry(name.clone())
            .or_insert_with(|| TestSuite::new(name))
            .add_test_case(test_case(case));
    }
    document.add_test_suite(matrix(&Matrix::of(report)));
    document.add_test_suites(suites.into_values());
    document.to_string().map_err(|error| Error::Report {
        format: "JUnit",
        message: error.to_string(),
    })
}

fn matrix(matrix: &Matrix) -> TestSuite {
    let mut suite = TestSuite::new("matrix");
    for row in &matrix.rows {
        let name = match &row.form {
            Some(form) => format!("{}/{form}", row.technique),
            None => row.technique.clone(),
        };
        for (column, cell) in matrix.columns.iter().zip(&row.cells) {
            let status = status(cell.verdict, cell.reason.as_deref(), || told(cell));
            let mut test = TestCase::new(name.clone(), status);
            test.set_classname(column.label());
            test.set_system_out(format!("{}: {}", cell.verdict.label(), told(cell)));
            suite.add_test_case(test);
        }
    }
    suite
}

/// What a cell knows besides its verdict.
fn told(cell: &Cell) -> String {
    let ulp = cell
        .worst_ulp
        .map_or_else(|| "–".to_owned(), |ulp| format!("{ulp:.3}"));
    let mut text = format!("{} cases, {} outputs, worst {ulp} ULP", cell.cases, cell.outputs);
    if let Some(place) = &cell.place {
        text += &format!(" at output {} of {} of {}", place.output, place.input, place.case);
    }
    if let Some(reason) = &cell.reason {
        text += &format!("; {reason}");
    }
    text
}

fn test_case(case: &CaseResult) -> TestCase {
    let reason = case.reason.clone().unwrap_or_default();
    let status = status(case.verdict, case.reason.as_deref(), || details(case));
    let mut test = TestCase::new(case.id.to_string(), status);
    test.set_classname(format!("{}.{}", case.route, case.id.technique));
    if matches!(case.verdict, Verdict::Warn | Verdict::ExpectedFail) {
        test.set_system_out(format!("{}: {reason}", case.verdict.label()));
    }
    test
}

fn status(verdict: Verdict, reason: Option<&str>, details: impl FnOnce() -> String) -> TestCaseStatus {
    let reason = reason.unwrap_or_default().to_owned();
    match verdict {
        Verdict::Pass | Verdict::Warn | Verdict::ExpectedFail => TestCaseStatus::success(),
        Verdict::Skip => {
            let mut status = TestCaseStatus::skipped();
            status.set_message(reason);
            status
        }
        Verdict::Fail => {
            let mut status = TestCaseStatus::non_success(NonSuccessKind::Failure);
            status
                .set_message(reason)
                .set_type("conformance")
                .set_description(details());
            status
        }
    }
}

/// What a failure says: the worst output and how to see it again.
fn details(case: &CaseResult) -> String {
    let worst = case.worst.as_ref().map(ToString::to_string).unwrap_or_default();
    format!(
        "{}\n{worst}\nrun again: {}",
        case.reason.as_deref().unwrap_or_default(),
        case.rerun()
    )
}
