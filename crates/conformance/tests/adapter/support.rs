//! Runs a selection, or says that the test is skipped.

use std::io::Write;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicUsize, Ordering};

use bossage_conformance::{Report, Route, Selection, Silent, Verdict, run};
use bossage_shaders::Library;

static SKIPPED: AtomicUsize = AtomicUsize::new(0);

/// The report, or `None` after saying that the test is skipped.
pub(crate) fn report(test: &str, selection: &Selection, library: &Library) -> Option<Report> {
    let required = is_required("lavapipe");
    match run(selection, library, &mut Silent) {
        Ok(report) => {
            for left_out in &report.environment.not_run {
                let needs = left_out.route.tool().unwrap_or("lavapipe");
                // An adapter that does not take a route is no missing tool.
                let allowed = left_out.adapter.is_some() || !is_required(needs);
                assert!(allowed, "{needs} is required, but: {left_out:?}");
                skip(test, &format!("route {}: {}", left_out.route, left_out.reason));
            }
            let seen = |name: &str| {
                report
                    .environment
                    .adapters
                    .iter()
                    .any(|adapter| adapter.name.contains(name))
            };
            // The evaluator alone has no driver to be missed.
            let draws = selection.routes != [Route::Embedded];
            assert!(
                !draws || !is_required("swiftshader") || seen("SwiftShader"),
                "swiftshader is required, but only these are here: {:?}",
                report.environment.adapters
            );
            Some(report)
        }
        Err(error) if error.is_missing_environment() => {
            assert!(!required, "lavapipe is required, but: {error}");
            skip(test, &error.to_string());
            None
        }
        Err(error) => panic!("{test}: {error}"),
    }
}

/// Whether `BOSSAGE_REQUIRE` (`lavapipe,dxc`, say) lists a tool or driver, by the start of its name.
fn is_required(needed: &str) -> bool {
    let list = std::env::var("BOSSAGE_REQUIRE").unwrap_or_default();
    list.split(',')
        .map(str::trim)
        .any(|item| !item.is_empty() && needed.starts_with(item))
}

/// Says that something is skipped, and counts it.
fn skip(test: &str, reason: &str) {
    let count = SKIPPED.fetch_add(1, Ordering::Relaxed) + 1;
    writeln!(std::io::stderr(), "SKIP {count}: {test}: {reason}").expect("standard error can be written");
}

/// The cases with a verdict, each with its reason and worst output.
pub(crate) fn listed(report: &Report, verdict: Verdict) -> String {
    let cases = report.cases.iter().filter(|case| case.verdict == verdict);
    let line = |case: &bossage_conformance::CaseResult| {
        let worst = case.worst.as_ref().map(ToString::to_string).unwrap_or_default();
        format!(
            "{} ({}): {}\n{worst}\n",
            case.id,
            case.route,
            case.reason.as_deref().unwrap_or_default()
        )
    };
    cases.map(line).collect()
}

/// The repository's root.
pub(crate) fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}
