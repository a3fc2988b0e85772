//! Are the derived tolerances useful? Every interval's width, held as a reviewed table, and the goal that hardened functions meet.
//!
//! No adapter is needed: intervals come from the shaders' IR. The table is `snapshots/widths@bounds.snap`; after a change that is meant,
//! `INSTA_UPDATE=always cargo test -p bossage-conformance --test widths`, then read `git diff snapshots/`.

use std::path::Path;
use std::sync::LazyLock;

use bossage_conformance::Route;
use bossage_conformance::oracle;
use bossage_conformance::route::Prepared;
use bossage_conformance::width::{self, FieldWidths, GOAL, MISSED, golden};
use bossage_shaders::{Form, Library, PROBES, Probe};

/// A probe, its module and its widths.
struct Measured {
    probe: &'static Probe,
    module: Prepared,
    fields: Vec<FieldWidths>,
}

impl Measured {
    fn of(probe: &'static Probe, module: Prepared) -> Self {
        let program = module.program(probe.entry).unwrap_or_else(|why| panic!("{why}"));
        let expected =
            oracle::expected(probe, &program, &width::inputs(probe)).unwrap_or_else(|why| panic!("{why}"));
        let fields = width::measure(probe, &expected);
        Self {
            probe,
            module,
            fields,
        }
    }

    /// `pow` inherits exp2(y · log2(x)): its width is stated, not limited.
    fn has_pow(&self) -> bool {
        self.module.text().contains("pow(")
    }

    fn worst(&self) -> f64 {
        width::worst_median(&self.fields)
    }
}

static ALL: LazyLock<Vec<Measured>> = LazyLock::new(|| {
    let library = Library::embedded().unwrap();
    let measure = |probe: &'static Probe| {
        let assembled = library.assemble_probe(probe.id).unwrap();
        Measured::of(probe, Route::Wgsl.prepare(&assembled).unwrap())
    };
    PROBES.iter().map(measure).collect()
});

fn hardened() -> impl Iterator<Item = &'static Measured> {
    ALL.iter().filter(|one| one.probe.form == Form::Hardened)
}

/// Where the list of missed goals and the measurement disagree.
fn disagreements<'a>(measured: impl Iterator<Item = &'a Measured>, missed: &[(&str, &str)]) -> Vec<String> {
    let judged = measured.filter(|one| !one.has_pow());
    judged
        .filter_map(|one| {
            let name = one.probe.function();
            let listed = missed.iter().any(|(function, _)| *function == name);
            match (one.worst() <= GOAL, listed) {
                (true, false) | (false, true) => None,
                (false, false) => Some(format!(
                    "{name}: median {} ULP, and no reason is given",
                    one.worst()
                )),
                (true, true) => Some(format!("{name} meets the goal: strike it off the list")),
            }
        })
        .collect()
}

/// Outputs of hardened functions, and of those the open and the forked ones.
fn undecided() -> (f64, f64, f64) {
    let fields = hardened().flat_map(|one| &one.fields);
    fields.fold((0.0, 0.0, 0.0), |(outputs, open, forked), field| {
        let n = (width::ITEMS * field.medians.len()) as f64;
        (outputs + n, open + n * field.open, forked + n * field.forked)
    })
}

/// What stands below the table: the goal, function by function where there is something to say.
fn goals() -> String {
    let plain: Vec<&Measured> = hardened().filter(|one| !one.has_pow()).collect();
    let met = plain.iter().filter(|one| one.worst() <= GOAL).count();
    let mut lines = vec![format!(
        "goal: a median of at most {GOAL} ULP of the truth, each output of a hardened function; met by {met} of {}",
        plain.len()
    )];
    let (outputs, open, forked) = undecided();
    lines.push(format!(
        "undecided: {:.2} % open and {:.2} % forked of all outputs of hardened functions",
        100.0 * open / outputs,
        100.0 * forked / outputs
    ));
    for one in hardened().filter(|one| one.has_pow()) {
        lines.push(format!("with pow: {} {:.0}", one.probe.function(), one.worst()));
    }
    for (function, reason) in MISSED {
        let worst = plain
            .iter()
            .find(|one| one.probe.function() == *function)
            .map(|one| one.worst());
        lines.push(format!(
            "missed: {function} {:.0}: {reason}",
            worst.unwrap_or(f64::NAN)
        ));
    }
    lines.join("\n")
}

#[test]
fn widths_are_as_reviewed() {
    let lines = ALL
        .iter()
        .flat_map(|one| one.fields.iter().map(|field| golden::line(one.probe, field)));
    let table: Vec<String> = std::iter::once(golden::HEAD.to_owned()).chain(lines).collect();
    let mut settings = insta::Settings::clone_current();
    settings.set_snapshot_path(Path::new(env!("CARGO_MANIFEST_DIR")).join("../../snapshots"));
    settings.set_prepend_module_to_snapshot(false);
    settings.set_omit_expression(true);
    let text = format!("{}\n\n{}", table.join("\n"), goals());
    settings.bind(|| insta::assert_snapshot!("widths@bounds", text));
}

#[test]
fn the_goal_is_met_or_its_miss_has_a_reason() {
    assert_eq!(disagreements(hardened(), MISSED), Vec::<String>::new());
    for (function, _) in MISSED {
        assert!(
            hardened().any(|one| one.probe.function() == *function),
            "no function {function}"
        );
    }
}

#[test]
fn a_missed_goal_without_a_reason_and_a_stale_reason_are_caught() {
    assert_eq!(disagreements(hardened(), MISSED), [""; 0]);
    let blurred = [changed("elevation", "return ", BLURRED)];
    let missed = disagreements(blurred.iter(), &[]);
    assert!(
        matches!(&missed[..], [one] if one.contains("no reason is given")),
        "{missed:?}"
    );
    let listed = disagreements(blurred.iter(), &[("elevation", "blurred on purpose")]);
    assert_eq!(listed, [""; 0]);
    let stale = [MISSED, &[("elevation", "no reason at all")]].concat();
    let found = disagreements(hardened(), &stale);
    assert_eq!(found, ["elevation meets the goal: strike it off the list"]);
}

/// Right on paper, and right within its own interval: a detour that loses digits.
const BLURRED: &str = "return (height - 1024.0 + 1024.0 - height) + ";

/// The library's text with one place changed.
fn changed(function: &str, from: &str, to: &str) -> Measured {
    let probe = Probe::find(function).unwrap();
    let mut assembled = Library::embedded().unwrap().assemble_probe(probe.id).unwrap();
    assert!(assembled.wgsl.contains(from), "the control needs `{from}`");
    assembled.wgsl = assembled.wgsl.replacen(from, to, 1);
    Measured::of(probe, Route::Wgsl.prepare(&assembled).unwrap())
}

#[test]
fn a_shader_that_only_blurs_its_result_is_caught() {
    let blurred = changed(
        "elevation",
        "return ",
        "return (1024.0 - 1024.0) * height_scale + ",
    );
    assert_eq!(
        golden::wider(blurred.probe, &blurred.fields),
        None,
        "a zero that is exact costs nothing"
    );
    let blurred = changed("elevation", "return ", BLURRED);
    let wider = golden::wider(blurred.probe, &blurred.fields).expect("caught");
    assert!(wider.contains("wider than reviewed"), "{wider}");
    let as_reviewed = ALL
        .iter()
        .find(|one| one.probe.function() == "elevation")
        .unwrap();
    assert_eq!(golden::wider(as_reviewed.probe, &as_reviewed.fields), None);
}

#[test]
fn hardened_functions_are_decided_on_their_domain() {
    let (outputs, open, forked) = undecided();
    assert!(
        open == 0.0 && forked <= 0.01 * outputs,
        "{open} open, {forked} forked of {outputs}"
    );
}
