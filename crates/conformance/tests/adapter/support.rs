//! Runs a selection, or says that the test is skipped.

use std::io::Write;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicUsize, Ordering};

use bossage_conformance::{Report, Selection, Silent, Verdict, run};
use bossage_shaders::Library;

static SKIPPED: AtomicUsize = AtomicUsize::new(0);

/// The report, or `None` after saying that the test is skipped.
pub(crate) fn report(test: &str, selection: &Selection, library: &Library) -> Option<Report> {
    let required = std::env::var("BOSSAGE_REQUIRE").is_ok_and(|list| list.contains("lavapipe"));
    match run(selection, library, &mut Silent) {
        Ok(report) => {
            let left_out = &report.environment.not_run;
            assert!(
                !required || left_out.is_empty(),
                "lavapipe is required, but: {left_out:?}"
            );
            Some(report)
        }
        Err(error) if error.is_missing_environment() => {
            assert!(!required, "lavapipe is required, but: {error}");
            let count = SKIPPED.fetch_add(1, Ordering::Relaxed) + 1;
            writeln!(std::io::stderr(), "SKIP {count}: {test}: {error}")
                .expect("standard error can be written");
            None
        }
        Err(error) => panic!("{test}: {error}"),
    }
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
