//! The table of built-in functions in `docs/numerics.md`: what the last full run measured, function by function and machine by machine.
//!
//! A full run takes long, so the table is not measured again here; it is written from the run's own report:
//!
//! ```text
//! bossage conform accuracy/ --full --route wgsl,spirv,embedded --json accuracy.json
//! BOSSAGE_UPDATE_DOCS=1 BOSSAGE_ACCURACY_REPORT=accuracy.json cargo test -p bossage-conformance --test accuracy_table
//! ```
//!
//! Checked always: every function of the suite has its row, each machine has run the full number of inputs, and deviations are just
//! those that the code knows.

use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::path::{Path, PathBuf};

use bossage_conformance::deviation;
use bossage_conformance::suite::accuracy::{FULL, functions};
use serde_json::Value;

const BEGIN: &str = "<!-- accuracy: written by crates/conformance/tests/accuracy_table.rs -->\n";
const END: &str = "<!-- end of accuracy -->";

/// Machines by a part of the adapter's name, as the columns have them.
const MACHINES: [(&str, &str); 3] = [
    ("embedded", "embedded"),
    ("llvmpipe", "lavapipe"),
    ("SwiftShader", "SwiftShader"),
];

fn document() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/numerics.md")
}

/// The part of the document between the marks.
fn table_in(document: &str) -> &str {
    let start = document.find(BEGIN).expect("the document has the table's mark") + BEGIN.len();
    let end = start + document[start..].find(END).expect("the table has an end");
    document[start..end].trim()
}

fn with_table(document: &str, table: &str) -> String {
    let start = document.find(BEGIN).expect("the document has the table's mark") + BEGIN.len();
    let end = start + document[start..].find(END).expect("the table has an end");
    format!("{}\n{table}\n{}", &document[..start], &document[end..])
}

/// The results of one function on one machine, over all routes.
#[derive(Default)]
struct Cell {
    ulp: f64,
    share: f64,
    evaluations: u64,
    undecided: u64,
    refused: u64,
    failed: bool,
    deviates: bool,
}

impl Cell {
    fn add(&mut self, case: &Value) {
        let number = |key: &str| case[key].as_u64().unwrap_or(0);
        self.evaluations += number("outputs");
        self.undecided += number("undecided");
        self.refused += number("refused");
        self.failed |= case["verdict"] == "fail" || case["verdict"] == "skip";
        self.deviates |= case["verdict"] == "expected_fail";
        let worst = |key: &str| case["worst"][key].as_f64().unwrap_or(0.0);
        if worst("of_bound") >= self.share {
            self.share = worst("of_bound");
            self.ulp = worst("ulp");
        }
    }

    fn text(&self) -> String {
        if self.failed {
            return "FAILS".to_owned();
        }
        if self.deviates {
            return format!("deviates at {}", self.refused);
        }
        format!("{} ULP, {:.0} %", short(self.ulp), 100.0 * self.share)
    }
}

/// Three digits.
fn short(x: f64) -> String {
    if x == 0.0 || (0.01..1e4).contains(&x) {
        format!("{x:.2}")
    } else {
        format!("{x:.1e}")
    }
}

/// The table of a report in JSON.
fn table(report: &Value) -> String {
    let mut cells: BTreeMap<(String, &str), Cell> = BTreeMap::new();
    for case in report["cases"].as_array().expect("a report has cases") {
        let id = case["id"].as_str().unwrap_or_default();
        let Some(function) = id
            .strip_prefix("accuracy/")
            .and_then(|rest| parameter(rest, "fn"))
        else {
            continue;
        };
        let adapter = case["adapter"].as_str().unwrap_or_default();
        for (part, machine) in MACHINES {
            if adapter.contains(part) {
                cells.entry((function.to_owned(), machine)).or_default().add(case);
            }
        }
    }
    let mut text = String::from("| function | of | evaluations | undecided |");
    for (_, machine) in MACHINES {
        let _ = write!(text, " {machine} |");
    }
    let _ = writeln!(text, "\n|---|---|---|---|{}", "---|".repeat(MACHINES.len()));
    for function in functions::ALL {
        let of = |machine| cells.get(&(function.name.to_owned(), machine));
        let all = MACHINES.iter().filter_map(|(_, machine)| of(*machine));
        let (evaluations, undecided) = all.fold((0, 0), |sum, cell| {
            (sum.0 + cell.evaluations, sum.1 + cell.undecided)
        });
        let expression = function.expression.replace('|', "\\|");
        let share = 100.0 * undecided as f64 / (evaluations as f64).max(1.0);
        let _ = write!(
            text,
            "| `{}` | `{expression}` | {:.0e} | {share:.0} % |",
            function.name, evaluations as f64
        );
        for (_, machine) in MACHINES {
            let _ = write!(
                text,
                " {} |",
                of(machine).map_or("not run".to_owned(), Cell::text)
            );
        }
        text.push('\n');
    }
    let adapters = report["environment"]["adapters"].as_array().into_iter().flatten();
    for adapter in adapters {
        let word = |key: &str| adapter[key].as_str().unwrap_or_default().trim().to_owned();
        let _ = write!(text, "\n- {}: {}", word("name"), word("driver"));
    }
    let environment = |key: &str| report["environment"][key].as_str().unwrap_or_default().to_owned();
    let _ = writeln!(
        text,
        "\n- {}, {}, {}",
        environment("cpu"),
        environment("platform"),
        environment("time")
    );
    text
}

/// A parameter of a case's name.
fn parameter<'a>(rest: &'a str, name: &str) -> Option<&'a str> {
    let (_, parameters) = rest.split_once(':')?;
    parameters
        .split(';')
        .find_map(|pair| pair.strip_prefix(name)?.strip_prefix('='))
}

/// What is wrong with a table; nothing when it is as it should be.
fn mistakes(table: &str) -> Vec<String> {
    let rows: Vec<Vec<&str>> = table
        .lines()
        .filter(|line| line.starts_with("| `"))
        .map(|line| {
            line.split(" | ")
                .map(|cell| cell.trim_matches(['|', ' ', '`']))
                .collect()
        })
        .collect();
    let mut wrong = Vec::new();
    let names: Vec<&str> = rows.iter().map(|row| row[0]).collect();
    let wanted: Vec<&str> = functions::ALL.iter().map(|function| function.name).collect();
    if names != wanted {
        wrong.push(format!("the rows are {names:?}, the functions {wanted:?}"));
    }
    for row in &rows {
        let evaluations: f64 = row[2].parse().unwrap_or(0.0);
        if evaluations < FULL as f64 {
            wrong.push(format!(
                "{}: {} evaluations, fewer than a full run",
                row[0], row[2]
            ));
        }
        for ((_, machine), cell) in MACHINES.iter().zip(&row[row.len() - MACHINES.len()..]) {
            let known = deviation::ALL.iter().any(|known| {
                known.subject == format!("accuracy/{}", row[0])
                    && known.driver.eq_ignore_ascii_case(machine)
                    && known.routes.is_empty()
            });
            if cell.starts_with("deviates") != known || !(known || cell.ends_with('%')) {
                wrong.push(format!(
                    "{} on {machine}: `{cell}`, known to deviate: {known}",
                    row[0]
                ));
            }
        }
    }
    wrong
}

#[test]
fn the_table_of_functions_is_whole_and_agrees_with_what_is_known() {
    let path = document();
    let mut text = std::fs::read_to_string(&path).unwrap_or_else(|why| panic!("{}: {why}", path.display()));
    let report = std::env::var_os("BOSSAGE_ACCURACY_REPORT");
    if let (Some(_), Some(report)) = (std::env::var_os("BOSSAGE_UPDATE_DOCS"), report) {
        let json =
            std::fs::read_to_string(&report).unwrap_or_else(|why| panic!("{}: {why}", report.display()));
        let report = serde_json::from_str(&json).unwrap_or_else(|why| panic!("{why}"));
        text = with_table(&text, &table(&report));
        std::fs::write(&path, &text).unwrap_or_else(|why| panic!("{}: {why}", path.display()));
    }
    let wrong = mistakes(table_in(&text));
    assert!(wrong.is_empty(), "docs/numerics.md: {wrong:#?}");
}

/// A report with one entry a function and machine.
fn report(verdict: impl Fn(&str, &str) -> &'static str) -> Value {
    let of = |function: &str, adapter: &str| {
        serde_json::json!({
            "id": format!("accuracy/random:fn={function};n={FULL};seed=1"), "adapter": adapter, "outputs": FULL,
            "undecided": FULL / 4, "refused": 3, "verdict": verdict(function, adapter),
            "worst": { "ulp": 0.5, "of_bound": 0.25 },
        })
    };
    let all = functions::ALL.iter().flat_map(|function| {
        ["embedded", "llvmpipe (LLVM)", "SwiftShader Device"].map(|adapter| of(function.name, adapter))
    });
    serde_json::json!({ "cases": all.collect::<Vec<_>>(), "environment": { "adapters": [] } })
}

fn as_known(function: &str, adapter: &str) -> &'static str {
    if function == "atan2" && adapter.starts_with("SwiftShader") {
        "expected_fail"
    } else {
        "pass"
    }
}

#[test]
fn a_report_becomes_a_table_without_mistakes() {
    let table = table(&report(as_known));
    assert_eq!(mistakes(&table), [""; 0], "{table}");
    assert!(
        table.contains("| `add` | `x + y` | 3e7 | 25 % | 0.50 ULP, 25 % |"),
        "{table}"
    );
    let document = format!("before\n{BEGIN}\n| old |\n\n{END}\nafter\n");
    assert_eq!(table_in(&with_table(&document, &table)), table.trim());
}

/// Negative controls: a row that is missing, a run that was cut short, a deviation that nobody knows, one that is not there.
#[test]
fn a_table_that_is_wrong_is_seen() {
    let good = table(&report(as_known));
    let without: String = good
        .lines()
        .filter(|line| !line.contains("`add`"))
        .map(|line| format!("{line}\n"))
        .collect();
    assert_eq!(mistakes(&without).len(), 1);
    assert_eq!(mistakes(&good.replacen("3e7", "3e5", 1)).len(), 1);
    let unknown = table(&report(|function, adapter| match function {
        "add" => "expected_fail",
        _ => as_known(function, adapter),
    }));
    assert_eq!(mistakes(&unknown).len(), 3);
    assert_eq!(mistakes(&table(&report(|_, _| "pass"))).len(), 1);
    assert_eq!(
        mistakes(&table(&report(|_, _| "fail"))).len(),
        3 * functions::ALL.len()
    );
}
