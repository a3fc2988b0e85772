//! The numeric lint over the library: every numerical defect of the published forms is named at its line with a witness, and
//! hardened forms are clean over their documented domains.
//!
//! `defects` is the list: what is named, and why the rest is no matter of numbers. `domain` has the inputs' ranges, `linted` runs the lint, `shows` looks at
//! witnesses.

mod defects;
mod domain;
mod linted;
mod shows;

use bossage_bounds::lint::{Finding, Options, Rule};
use bossage_shaders::{Form, Library, PROBES, Probe};
use defects::{FORMULAS, Named, named, of_technique};
use linted::{Linted, kernel, probe};

/// Counts end the work, not the clock.
fn options() -> Options {
    Options {
        time: std::time::Duration::from_secs(600),
        ..Options::default()
    }
}

fn found<'l>(linted: &'l Linted, named: &Named) -> Option<&'l Finding> {
    linted.report.findings.iter().find(|finding| {
        finding.rule == named.rule
            && finding.witness.is_some()
            && linted.line(finding.span).starts_with(named.line)
    })
}

#[test]
fn published_defects_are_named_at_their_lines_with_a_witness() {
    let library = Library::embedded().unwrap();
    let mut shaders: Vec<&str> = named().map(|named| named.shader).collect();
    shaders.dedup();
    let mut missing = Vec::new();
    for shader in shaders {
        let linted = linted::published(&library, shader, &options());
        for named in named().filter(|named| named.shader == shader) {
            match found(&linted, &named) {
                Some(finding) => (named.shows)(&linted, finding),
                None => missing.push(format!(
                    "{shader}: {} at `{}` ({}) is not named: {:#?}",
                    named.rule.id(),
                    named.line,
                    named.case,
                    linted.told()
                )),
            }
        }
    }
    assert!(missing.is_empty(), "{}", missing.join("\n"));
}

/// The conformance suite's defects, technique and case, as `docs/numerics.md` lists them; a test of that suite holds the list.
fn known_defects() -> Vec<(String, String)> {
    let document = include_str!("../../docs/numerics.md");
    let table = document
        .split("<!-- hard cases")
        .nth(1)
        .and_then(|rest| rest.split("<!-- end of hard cases").next())
        .expect("the table of hard cases");
    let rows = table.lines().filter(|line| line.starts_with("| `"));
    rows.map(|row| {
        let mut marks = row.split('`').skip(1).step_by(2).map(str::to_owned);
        (marks.next().unwrap(), marks.next().unwrap())
    })
    .collect()
}

#[test]
fn every_known_defect_is_named_or_is_no_matter_of_numbers() {
    let known = known_defects();
    assert!(known.len() > 40, "{known:?}");
    let is_named =
        |technique: &str, case: &str| named().any(|n| n.case == case && of_technique(n.shader, technique));
    for (technique, case) in &known {
        let formula = FORMULAS.iter().any(|f| f.0 == technique && f.1 == case);
        assert!(
            is_named(technique, case) != formula,
            "{technique}, {case}: either in FINDINGS or, with a reason, in FORMULAS"
        );
    }
    for (technique, case, _) in FORMULAS {
        let listed = known.iter().any(|(t, c)| t == technique && c == case);
        assert!(listed, "{technique}, {case} is in FORMULAS, but is no defect");
    }
    for named in named() {
        let listed = known
            .iter()
            .any(|(t, c)| c == named.case && of_technique(named.shader, t));
        assert!(
            listed,
            "{}, {} is in FINDINGS, but is no defect",
            named.shader, named.case
        );
    }
}

#[test]
fn hardened_forms_are_clean() {
    let library = Library::embedded().unwrap();
    let mut found = Vec::new();
    let mut note = |name: &str, linted: &Linted| {
        found.extend(linted.told().into_iter().map(|told| format!("{name}: {told}")));
        if linted.report.unfinished {
            found.push(format!("{name}: not seen to the end"));
        }
    };
    for hardened in PROBES.iter().filter(|probe| probe.form == Form::Hardened) {
        note(hardened.function(), &probe(&library, hardened, &options()));
    }
    let vertices = kernel(&library, "frame_from_uv_vertices", &options());
    note("frame_from_uv_vertices", &vertices);
    assert!(found.is_empty(), "{}", found.join("\n"));
}

/// A hardened form without its guard is not clean.
#[test]
fn a_guard_taken_out_is_seen() {
    let library = Library::embedded().unwrap();
    for (id, guard, without) in [
        ("normalise", "(largest < SMALLEST_NORMAL)", "(largest < 0.0)"),
        ("highlight_power", "(base < SMALLEST_NORMAL)", "(base < 0.0)"),
        (
            "parallax_offset",
            "max(view_dir_ts.z, MIN_VIEW_Z)",
            "view_dir_ts.z",
        ),
        ("half_vector", "(largest < SMALLEST_NORMAL)", "(largest < 0.0)"),
        (
            "codec_octahedral_encode",
            "(largest < SMALLEST_NORMAL)",
            "(largest < 0.0)",
        ),
        (
            "codec_two_channel_decode",
            "(left < SMALLEST_NORMAL)",
            "(left < -2.0)",
        ),
    ] {
        let probe = Probe::find(id).unwrap_or_else(|| panic!("no probe {id}"));
        let text = linted::text(&library, probe);
        assert!(text.contains(guard), "{id} has no `{guard}`:\n{text}");
        let linted = linted::of_text(
            probe.entry,
            text.replace(guard, without),
            &domain::sidecar(probe),
            &options(),
        );
        let shown = linted.report.findings.iter().any(|f| f.witness.is_some());
        assert!(shown, "{id} without `{guard}`: {:?}", linted.told());
    }
}

/// The vertex kernel without its guards has the defects of the published one: what is left of a tangent is nothing, or rounding.
#[test]
fn a_guard_of_the_summed_tangent_taken_out_is_seen() {
    let library = Library::embedded().unwrap();
    let (text, ranges) = linted::kernel_text(&library, "frame_from_uv_vertices");
    let (guard, without) = (
        "(left <= CANCELLED_SHARE * weight || left < SMALLEST_NORMAL)",
        "(left < 0.0)",
    );
    let unguarded = "(largest < SMALLEST_NORMAL)";
    assert!(text.contains(guard) && text.contains(unguarded), "{text}");
    let text = text.replace(guard, without).replace(unguarded, "(largest < 0.0)");
    let linted = linted::of_text("frame_from_uv_vertices", text, &ranges, &options());
    for (rule, line) in [
        (Rule::VanishingSum, "sum.tangent += frames["),
        (
            Rule::VanishingSum,
            "let projected = tangent_sum - normal * dot(normal, tangent_sum);",
        ),
        (
            Rule::Cancellation,
            "let projected = tangent_sum - normal * dot(normal, tangent_sum);",
        ),
    ] {
        let mut findings = linted.report.findings.iter();
        let named =
            findings.any(|f| f.rule == rule && f.witness.is_some() && linted.line(f.span).starts_with(line));
        assert!(named, "{} at `{line}`: {:#?}", rule.id(), linted.told());
    }
}
