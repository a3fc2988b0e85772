//! The report as one self-contained page: no script, no font and no picture from elsewhere.
//!
//! Everything works by keyboard (links and `details`), headings are in order, tables have captions and scoped headers,
//! colours follow the reader's light or dark setting and never carry meaning alone. No cell of the matrix is empty:
//! what was not run says so.

use maud::{Markup, PreEscaped, html};

use super::matrix::{Cell, Column, Matrix, Row};
use super::page::Page;
use super::{CaseResult, Report};
use crate::verdict::Verdict;

const STYLE: &str = include_str!("style.css");

/// The whole page.
#[must_use]
pub fn write(report: &Report) -> String {
    let page = Page {
        title: "Bossage numeric conformance",
        style: STYLE,
        parts: &[],
        main: body(report),
        script: "",
    };
    page.write()
}

/// The report without the page around it, for embedding in another [`Page`].
#[must_use]
pub fn fragment(report: &Report) -> String {
    html! { style { (PreEscaped(STYLE)) } (body(report)) }.into_string()
}

fn body(report: &Report) -> Markup {
    html! {
        (summary(report))
        (matrix(report))
        (failures(report))
        (super::heat::section(&report.heats))
        (all_cases(report))
        (environment(report))
    }
}

fn summary(report: &Report) -> Markup {
    let totals = report.totals();
    let verdict = if report.is_ok() {
        "Nothing failed."
    } else {
        "This run did not pass."
    };
    let share = 100.0 * report.undecided().share();
    html! {
        section aria-labelledby="summary" {
            h2 id="summary" { "Summary" }
            p class="verdict" { (verdict) }
            dl class="totals" {
                @for verdict in Verdict::ALL {
                    div class=(verdict.as_str()) { dt { (verdict.label()) } dd { (totals.count(verdict)) } }
                }
                div { dt { "inputs" } dd { (grouped(totals.inputs)) } }
                div { dt { "outputs compared" } dd { (grouped(totals.outputs)) } }
                div { dt { "undecided, hardened forms" } dd { (format!("{share:.2} %")) } }
            }
            p { "An output passes when it lies in the interval that the accuracy rules of WGSL allow at its input. " em { "Undecided" }
                " outputs are those on which the rules say nothing, or for which a comparison allows two results." }
        }
    }
}

fn matrix(report: &Report) -> Markup {
    let matrix = Matrix::of(report);
    html! {
        section aria-labelledby="matrix" {
            h2 id="matrix" { "Techniques" }
            div class="scroll" tabindex="0" role="region" aria-labelledby="matrix" {
                table class="matrix" {
                    caption { "Gravest verdict, cases and worst output of each technique on each route and adapter; a cell opens to say where that is" }
                    thead { tr {
                        th scope="col" { "technique" }
                        th scope="col" { "form" }
                        @for column in &matrix.columns {
                            th scope="col" { (column.route) @if let Some(adapter) = &column.adapter { br; small { (adapter) } }
                                @if let Some(reason) = &column.not_run { details { summary { "not run" } small { (reason) } } } }
                        }
                    } }
                    tbody { @for row in &matrix.rows { (matrix_row(row, &matrix.columns)) } }
                }
            }
        }
    }
}

fn matrix_row(row: &Row, columns: &[Column]) -> Markup {
    html! {
        tr {
            th scope="row" { a href=(format!("#{}", anchor(&row.technique, row.form.as_deref()))) { (row.technique) } }
            td { (row.form.as_deref().unwrap_or("one form")) }
            @for (one, column) in row.cells.iter().zip(columns) { (cell(one, column)) }
        }
    }
}

fn cell(cell: &Cell, column: &Column) -> Markup {
    if cell.cases == 0 {
        // A whole column that was not run has its reason at its head.
        let own = cell.reason.as_ref().filter(|_| column.not_run.is_none());
        return html! { td class="skip" { "not run" @if let Some(reason) = own { br; small { (reason) } } } };
    }
    let worst = match cell.worst_ulp {
        Some(ulp) => format!("{ulp:.3} ULP"),
        None => "its worst".to_owned(),
    };
    html! {
        td class=(cell.verdict.as_str()) {
            strong { (cell.verdict.label()) }
            details {
                summary { (worst) }
                small {
                    (cell.cases) " cases, " (grouped(cell.outputs)) " outputs"
                    @if cell.known_defects > 0 { ", " (cell.known_defects) " known defects" }
                    @if let Some(share) = cell.worst_of_bound { "; worst " (percent(share)) " of the allowed error" }
                    @if let Some(place) = &cell.place {
                        " in " code { (place.case) } ", output " (place.output) " of " code { (place.input) }
                    }
                }
            }
        }
    }
}

fn failures(report: &Report) -> Markup {
    let failed: Vec<&CaseResult> = report.failures().collect();
    html! {
        section aria-labelledby="failures" {
            h2 id="failures" { "Failures" }
            @if failed.is_empty() { p { "None." } }
            @for case in failed { (failure(case)) }
        }
    }
}

fn failure(case: &CaseResult) -> Markup {
    html! {
        article class="fail" {
            h3 { code { (case.id) } }
            p { (case.reason.as_deref().unwrap_or("no reason given")) " (" (case.route) ", " (case.adapter) ")" }
            @if let Some(worst) = &case.worst { pre { (worst) } }
            p { "Run it again: " code { (case.rerun()) } }
        }
    }
}

fn all_cases(report: &Report) -> Markup {
    html! {
        section aria-labelledby="cases" {
            h2 id="cases" { "Cases" }
            @for ((technique, form), cases) in report.by_technique() {
                details id=(anchor(&technique, form.as_deref())) {
                    summary { (technique) @if let Some(form) = &form { ", " (form) } " – " (cases.len()) " results" }
                    div class="scroll" tabindex="0" role="region" aria-label=(format!("cases of {technique}")) {
                        (case_table(&technique, &cases))
                    }
                }
            }
        }
    }
}

fn case_table(technique: &str, cases: &[&CaseResult]) -> Markup {
    html! {
        table {
            caption { "Cases of " (technique) }
            thead { tr {
                @for title in ["case", "route", "adapter", "verdict", "outputs", "undecided", "worst ULP", "worst error", "of the bound", "judged by", "reason"] {
                    th scope="col" { (title) }
                }
            } }
            tbody { @for case in cases { (case_row(case)) } }
        }
    }
}

fn case_row(case: &CaseResult) -> Markup {
    let worst = case.worst.as_ref();
    html! {
        tr {
            th scope="row" { code { (case.id) } }
            td { (case.route) }
            td { (case.adapter) }
            td class=(case.verdict.as_str()) { (case.verdict.label()) }
            td class="number" { (grouped(case.outputs)) }
            td class="number" { (percent(case.undecided_share())) }
            td class="number" { (worst.and_then(|w| w.ulp).map_or("–".to_owned(), |x| format!("{x:.3}"))) }
            td class="number" { (worst.and_then(|w| w.abs).map_or("–".to_owned(), |x| format!("{x:.3e}"))) }
            td class="number" { (worst.and_then(|w| w.of_bound).map_or("–".to_owned(), percent)) }
            td { (case.basis.join(", ")) }
            td { (case.reason.as_deref().unwrap_or("–")) }
        }
    }
}

fn environment(report: &Report) -> Markup {
    html! {
        section aria-labelledby="environment" {
            h2 id="environment" { "Environment" }
            table {
                caption { "What this run ran on" }
                tbody {
                    @for (name, value) in report.environment.rows() {
                        tr { th scope="row" { (name) } td { (value) } }
                    }
                }
            }
        }
    }
}

fn anchor(technique: &str, form: Option<&str>) -> String {
    format!("cases-{technique}-{}", form.unwrap_or("only"))
}

fn percent(share: f64) -> String {
    format!("{:.1} %", 100.0 * share)
}

/// Digits in groups of three, with a space that does not break.
fn grouped(n: usize) -> String {
    let digits = n.to_string();
    let groups: Vec<&str> = digits
        .as_bytes()
        .rchunks(3)
        .rev()
        .filter_map(|g| std::str::from_utf8(g).ok())
        .collect();
    groups.join("\u{202f}")
}
