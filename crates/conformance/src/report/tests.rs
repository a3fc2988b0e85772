//! Reports of a made-up run: formats, links, and nothing silently empty.

use super::matrix::Matrix;
use super::{CaseResult, Report, html, json, junit};
use crate::bound::Bound;
use crate::case_id::CaseId;
use crate::compare::{Comparison, Expected, Worst};
use crate::environment::{Adapter, Environment};
use crate::machines::NotRun;
use crate::route::Route;
use crate::verdict::Verdict;

fn worst(got: f32) -> Option<Worst> {
    let mut comparison = Comparison::default();
    comparison.item(
        &[0.5, f32::INFINITY],
        &[got],
        &[Expected {
            truth: 1.0,
            bound: Bound::between(0.9, 1.1),
        }],
    );
    comparison.worst
}

fn case(technique: &str, route: Route, verdict: Verdict) -> CaseResult {
    CaseResult {
        id: CaseId::new(technique, Some("published"), "edge").with("fn", "it's"),
        route,
        adapter: "llvmpipe <1>".to_owned(),
        basis: vec!["reference f64"],
        arguments: vec!["--scene".to_owned(), "my scenes/a.toml".to_owned()],
        inputs: 1000,
        outputs: 3000,
        undecided: 3,
        forked: 0,
        refused: usize::from(verdict == Verdict::Fail),
        verdict,
        worst: worst(if verdict == Verdict::Fail { f32::NAN } else { 1.05 }),
        reason: (verdict != Verdict::Pass).then(|| format!("{} & why", verdict.label())),
    }
}

/// One case of each verdict; `dot3` was not run on the second route.
pub(crate) fn sample() -> Report {
    let cases = vec![
        case("dot3", Route::Wgsl, Verdict::Fail),
        case("blinn_phong", Route::Wgsl, Verdict::Pass),
        case("blinn_phong", Route::Spirv, Verdict::Skip),
        case("codec_biased", Route::Spirv, Verdict::ExpectedFail),
        case("codec_unorm", Route::Spirv, Verdict::Warn),
    ];
    let adapter = Adapter {
        name: "llvmpipe <1>".to_owned(),
        kind: "cpu".to_owned(),
        backend: "vulkan".to_owned(),
        driver: "llvmpipe Mesa 1".to_owned(),
        llvm: Some("15".to_owned()),
    };
    Report::new(
        Environment {
            adapters: vec![adapter],
            not_run: vec![NotRun {
                route: Route::Glsl,
                adapter: None,
                reason: "get glslang".to_owned(),
            }],
            ..Environment::of(&[])
        },
        cases,
    )
}

#[test]
fn only_what_the_library_promises_counts_as_undecided() {
    let mut report = sample();
    assert_eq!(report.undecided().outputs, 0, "published forms promise nothing");
    report.cases[0].id = CaseId::new("dot3", Some("hardened"), "random");
    report.cases[1].id = CaseId::new("accuracy", None, "random");
    let undecided = report.undecided();
    assert_eq!(
        (undecided.outputs, undecided.open, undecided.forked),
        (3000, 3, 0)
    );
    assert_eq!(undecided.share(), 0.001);
}

#[test]
fn totals_count_each_verdict_once() {
    let totals = sample().totals();
    assert_eq!(totals.cases, 5);
    for verdict in Verdict::ALL {
        assert_eq!(totals.count(verdict), 1, "{verdict:?}");
    }
    assert_eq!((totals.outputs, totals.undecided), (15_000, 15));
}

#[test]
fn a_failure_or_an_empty_run_is_not_ok() {
    let mut report = sample();
    assert!(!report.is_ok());
    report.cases.retain(|case| case.verdict != Verdict::Fail);
    assert!(report.is_ok());
    report.cases.retain(|case| case.verdict == Verdict::Skip);
    assert!(!report.is_ok(), "a run that skipped everything shows nothing");
    report.cases.clear();
    assert!(!report.is_ok());
}

#[test]
fn a_rerun_is_quoted_for_the_shell() {
    let rerun = case("dot3", Route::Wgsl, Verdict::Fail).rerun();
    let expected = r"bossage conform 'dot3/published/edge:fn=it'\''s' --route wgsl --adapter 'llvmpipe <1>' --scene 'my scenes/a.toml'";
    assert_eq!(rerun, expected);
}

#[test]
fn json_holds_the_promised_keys_and_survives_numbers_that_json_lacks() {
    let text = json::write(&sample()).unwrap();
    let document: serde_json::Value = serde_json::from_str(&text).unwrap();
    assert_eq!(document["schema"], 1);
    assert_eq!(document["totals"]["expected_fail"], 1);
    let cases = document["cases"].as_array().unwrap();
    for case in cases {
        for key in [
            "id", "route", "adapter", "basis", "outputs", "verdict", "worst", "reason", "rerun",
        ] {
            assert!(case.get(key).is_some(), "{key}");
        }
        for key in ["ulp", "abs", "input", "got", "interval"] {
            assert!(case["worst"].get(key).is_some(), "worst.{key}");
        }
    }
    let failed = cases.iter().find(|case| case["verdict"] == "fail").unwrap();
    assert_eq!(failed["worst"]["got"], "NaN");
    assert_eq!(failed["worst"]["interval"][0], 0.9);
    assert_eq!(failed["worst"]["input"][1], "inf");
}

#[test]
fn no_cell_of_the_matrix_is_empty() {
    let matrix = Matrix::of(&sample());
    let labels: Vec<String> = matrix.columns.iter().map(|column| column.label()).collect();
    assert_eq!(
        labels,
        ["wgsl on llvmpipe <1>", "spirv on llvmpipe <1>", "glsl, not run"]
    );
    for row in &matrix.rows {
        assert_eq!(row.cells.len(), 3, "{}", row.technique);
        for cell in &row.cells {
            assert_eq!(cell.reason.is_none(), cell.verdict == Verdict::Pass, "{cell:?}");
            assert_eq!(cell.place.is_none(), cell.cases == 0, "{cell:?}");
        }
        assert_eq!(row.cells[2].reason.as_deref(), Some("get glslang"));
    }
}

#[test]
fn a_cell_names_the_worst_output_of_its_gravest_case() {
    let mut report = sample();
    let within = |edge: f32, technique: &str| CaseResult {
        id: CaseId::new(technique, Some("published"), "random").with("n", edge),
        worst: worst(edge),
        ..case(technique, Route::Wgsl, Verdict::Pass)
    };
    report.cases.extend([
        within(1.01, "dot3"),
        within(1.09, "blinn_phong"),
        within(1.02, "blinn_phong"),
    ]);
    let matrix = Matrix::of(&report);
    let at = |technique: &str| {
        let row = matrix.rows.iter().find(|row| row.technique == technique).unwrap();
        row.cells[0].clone()
    };
    let (passed, failed) = (at("blinn_phong"), at("dot3"));
    assert_eq!((passed.verdict, passed.cases), (Verdict::Pass, 3));
    assert_eq!(passed.place.unwrap().case, "blinn_phong/published/random:n=1.09");
    // 0.09 above 1, where an ULP is 2⁻²³.
    let ulps = f64::from(1.09f32 - 1.0) * 2f64.powi(23);
    assert!(
        (passed.worst_ulp.unwrap() - ulps).abs() < 1.0,
        "{:?}",
        passed.worst_ulp
    );
    assert_eq!(failed.verdict, Verdict::Fail);
    assert_eq!(failed.place.unwrap().case, "dot3/published/edge:fn=it's");
}

#[test]
fn junit_has_a_suite_a_route_and_one_failure() {
    let xml = junit::write(&sample()).unwrap();
    let (matrix, cases) = xml.split_once("</testsuite>").unwrap();
    assert_eq!(cases.matches("<testsuite ").count(), 2);
    assert_eq!(cases.matches("<testcase ").count(), 5);
    assert_eq!(cases.matches("<failure ").count(), 1);
    assert_eq!(cases.matches("<skipped ").count(), 1);
    // Four techniques on two routes and one that nothing runs: a failure, and skips but for the four that ran.
    assert_eq!(matrix.matches("<testcase ").count(), 12);
    assert_eq!(matrix.matches("<failure ").count(), 1);
    assert_eq!(matrix.matches("<skipped ").count(), 8);
    assert!(matrix.contains("glsl, not run") && matrix.contains("get glslang"));
    assert!(xml.contains("run again: bossage conform"));
}

#[test]
fn html_escapes_names_and_leaves_no_cell_empty() {
    let page = html::write(&sample());
    assert!(page.contains("llvmpipe &lt;1&gt;") && !page.contains("llvmpipe <1>"));
    assert!(
        page.contains("not run"),
        "the route on which dot3 did not run says so"
    );
    assert!(
        page.matches("get glslang").count() < 3,
        "the reason of a column that did not run stands at its head"
    );
    assert!(!page.contains("<td></td>") && !page.contains("<th scope=\"col\"></th>"));
    assert!(
        page.contains("bossage conform"),
        "a failure says how to run it again"
    );
    for verdict in Verdict::ALL {
        assert!(page.contains(verdict.label()), "{verdict:?}");
    }
}

#[test]
fn html_is_self_contained_and_accessible() {
    let page = html::write(&sample());
    for outside in ["http://", "https://", "<script", "<link", "<img", "url("] {
        assert!(!page.contains(outside), "{outside}");
    }
    assert!(page.starts_with("<!DOCTYPE html><html lang=\"en\">"));
    assert!(page.contains("color-scheme"));
    assert_eq!(page.matches("<table").count(), page.matches("<caption>").count());
    assert!(page.contains("<th scope=\"row\">") && page.contains("<th scope=\"col\">"));
    // Every link leads somewhere on the page.
    for link in page.split("href=\"#").skip(1) {
        let anchor = link.split('"').next().unwrap();
        assert!(page.contains(&format!("id=\"{anchor}\"")), "{anchor}");
    }
}
