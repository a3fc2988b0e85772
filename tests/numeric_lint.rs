//! The numeric lint over the library: every numerical defect of the published forms is named at its line with a witness, and
//! hardened forms are clean over their documented domains.

use bossage_bounds::Program;
use bossage_bounds::lint::{self, Options, Report, Rule};
use bossage_bounds::ranges::{Declared, Inputs};
use bossage_shaders::{Field, Form, Library, PROBES, Probe, Role};

/// Reach of vectors of any length, where the function's document allows all that can be normalised.
const ANY_LENGTH: &str = "8.5e37";

/// Reach of vectors where products of several must stay finite.
const FINITE_PRODUCTS: &str = "1e9";

/// Functions whose document admits components up to 2^126.
const TAKES_ANY_LENGTH: &[&str] = &[
    "largest_component",
    "normalise",
    "normalise_published",
    "length_of",
    "dot3",
    "dot3_published",
    "light_to_colour",
    "light_to_colour_published",
    "cube_place",
    "codec_octahedral_encode",
    "codec_octahedral_encode_published",
];

/// The range of a field, for its floats from `at` on.
fn range(field: &Field, at: usize, reach: &str) -> Vec<String> {
    let n = field.shape.floats();
    let key = |from: usize, to: usize| format!("\"inputs[{from}..{to}]\"");
    let all = key(at, at + n);
    let one = |lo: &str, hi: &str| vec![format!("{all} = {{ lo = {lo}, hi = {hi} }}")];
    match field.role {
        Role::Vector => one(&format!("-{reach}"), reach),
        Role::Unit => vec![format!("{all} = {{ unit = true }}")],
        Role::MapNormal => one("-1.5", "1.5"),
        Role::Unorm | Role::Height => one("0", "1"),
        Role::Snorm => one("-1", "1"),
        Role::Scale => one("-64", "64"),
        Role::Slope => one("-1e9", "1e9"),
        Role::Weight => one("0", "1e18"),
        Role::Elevation => one("-1", "1"),
        Role::Uv => one("-1e6", "1e6"),
        Role::UvEdge => one("-64", "64"),
        Role::Edge => one("-1024", "1024"),
        Role::Colour => one("0", "65504"),
        Role::Cosine => one("-1.0000001", "1.0000001"),
        Role::Exponent => one("0.001", "4096"),
        Role::Sign => vec![format!("{all} = {{ one_of = [-1, 1] }}")],
        Role::Tangent => vec![
            format!("{} = {{ unit = true }}", key(at, at + 3)),
            format!("{} = {{ one_of = [-1, 1] }}", key(at + 3, at + 4)),
        ],
        Role::Matrix => one("-1e6", "1e6"),
        Role::Rigid => one("-1000", "1000"),
        Role::Position => one("-1000", "1000"),
        Role::Byte => one("0", "255"),
        Role::Index => one("-70000", "70000"),
        Role::Size => one("1", "16384"),
        Role::Texel => one("0", "16383"),
        Role::Face => vec![format!("{all} = {{ one_of = [0, 1, 2, 3, 4, 5] }}")],
        Role::Gain => one("-64", "64"),
        Role::Length => one("1.1754944e-38", "8.5e37"),
        Role::SnormOne => vec![format!("{all} = {{ one_of = [127, 32767] }}")],
        Role::SnormCode => one("-32768", "32767"),
        Role::UnormOne => vec![format!("{all} = {{ one_of = [255, 65535] }}")],
        Role::UnormCode => one("0", "65535"),
        Role::Codec => vec![format!("{all} = {{ one_of = [0, 1] }}")],
        Role::EdgeMode => vec![format!("{all} = {{ one_of = [0, 1, 2] }}")],
        Role::Output | Role::Direction => Vec::new(),
    }
}

fn sidecar(probe: &Probe) -> String {
    let reach = if TAKES_ANY_LENGTH.contains(&probe.function()) {
        ANY_LENGTH
    } else {
        FINITE_PRODUCTS
    };
    let mut text = format!(
        "schema = 1\n[ranges]\ninputs = {{ size = {} }}\noutputs = {{ size = {} }}\n",
        probe.input_floats, probe.output_floats
    );
    let mut at = 0;
    for field in probe.inputs {
        for line in range(field, at, reach) {
            text.push_str(&line);
            text.push('\n');
        }
        at += field.shape.floats();
    }
    text
}

struct Linted {
    text: String,
    report: Report,
}

impl Linted {
    /// The line a span starts on.
    fn line(&self, span: naga::Span) -> &str {
        let at = span.location(&self.text).line_number as usize;
        self.text.lines().nth(at - 1).unwrap_or("").trim()
    }

    /// All findings, a line each.
    fn told(&self) -> Vec<String> {
        let told = |f: &lint::Finding| {
            let witness = f.witness.as_ref().map_or("no witness".to_owned(), |w| {
                format!("{} {:?}", w.operands, w.inputs)
            });
            format!("{} at `{}` ({witness})", f.rule.id(), self.line(f.span))
        };
        self.report.findings.iter().map(told).collect()
    }
}

fn linted(library: &Library, probe: &Probe, options: &Options) -> Linted {
    let assembled = library.assemble_probe(probe.id).unwrap_or_else(|e| panic!("{e}"));
    linted_text(probe, assembled.wgsl, options)
}

fn linted_text(probe: &Probe, text: String, options: &Options) -> Linted {
    let module =
        naga::front::wgsl::parse_str(&text).unwrap_or_else(|e| panic!("{}", e.emit_to_string(&text)));
    let flags = naga::valid::ValidationFlags::all();
    let info = naga::valid::Validator::new(flags, naga::valid::Capabilities::all())
        .validate(&module)
        .unwrap_or_else(|e| panic!("{}", e.emit_to_string(&text)));
    let program = Program::new(&module, &info, probe.entry).unwrap_or_else(|e| panic!("{e}"));
    let declared = Declared::parse(probe.entry, &sidecar(probe)).unwrap_or_else(|e| panic!("{e}"));
    let inputs = Inputs::new(&module, &info, probe.entry, Some(&declared)).unwrap_or_else(|e| panic!("{e}"));
    let report = lint::lint(&program, &inputs, options);
    Linted { text, report }
}

/// The numerical defects of the published forms: probe, rule, and how the line of the operation begins.
const DEFECTS: &[(&str, Rule, &str)] = &[
    // Zero length, lengths beyond about 1e-19 and 1e19.
    ("normalise_published", Rule::NormaliseZero, "return normalize(v);"),
    ("normalise_published", Rule::Overflow, "return normalize(v);"),
    ("normalise_published", Rule::NanOutput, "return normalize(v);"),
    // L = −V.
    (
        "half_vector_published",
        Rule::NormaliseZero,
        "return normalize(v);",
    ),
    ("half_vector_published", Rule::NanOutput, "return normalize(v);"),
    (
        "blinn_phong_published",
        Rule::NormaliseZero,
        "return normalize(v);",
    ),
    // pow(0, p).
    (
        "highlight_power_published",
        Rule::PowerDomain,
        "return pow(saturate(n_dot_h), shininess);",
    ),
    (
        "blinn_phong_published",
        Rule::PowerDomain,
        "return pow(saturate(n_dot_h), shininess);",
    ),
    // The sum of components is zero.
    (
        "codec_octahedral_encode_published",
        Rule::DivisionByZero,
        "let p = direction.xy / ",
    ),
    // x² + y² > 1.
    (
        "codec_two_channel_decode_published",
        Rule::RootDomain,
        "return vec3f(xy, sqrt(",
    ),
    (
        "codec_two_channel_decode_published",
        Rule::NanOutput,
        "return vec3f(xy, sqrt(",
    ),
    // L = 0, and its length.
    ("dot3_published", Rule::NormaliseZero, "return normalize(v);"),
    ("dot3_published", Rule::Overflow, "return normalize(v);"),
    (
        "light_to_colour_published",
        Rule::NormaliseZero,
        "return normalize(v);",
    ),
    (
        "light_to_colour_published",
        Rule::Overflow,
        "return normalize(v);",
    ),
    // N ∝ (−1, 1, 1): the axis is parallel to the normal.
    (
        "frame_from_normal_unit_published",
        Rule::NormaliseZero,
        "return normalize(v);",
    ),
    (
        "frame_from_normal_unit_published",
        Rule::NanOutput,
        "return normalize(v);",
    ),
    // A triangle without texture area, and one without area.
    (
        "frame_from_uv_triangle_published",
        Rule::DivisionByZero,
        "let inverse_area = 1.0 / ",
    ),
    (
        "frame_from_uv_triangle_published",
        Rule::NanOutput,
        "let tangent = ",
    ),
    (
        "frame_from_uv_triangle_published",
        Rule::NormaliseZero,
        "return normalize(v);",
    ),
    // V.z = 0.
    (
        "parallax_offset_published",
        Rule::DivisionByZero,
        "return uv + z * view_dir_ts.xy / view_dir_ts.z;",
    ),
    (
        "parallax_offset_published",
        Rule::NanOutput,
        "return uv + z * view_dir_ts.xy / view_dir_ts.z;",
    ),
];

#[test]
fn published_defects_are_named_at_their_lines_with_a_witness() {
    let library = Library::embedded().unwrap();
    for (id, rule, line) in DEFECTS {
        let probe = Probe::find(id).unwrap_or_else(|| panic!("no probe {id}"));
        let linted = linted(&library, probe, &options());
        let named = linted.report.findings.iter().any(|finding| {
            finding.rule == *rule && finding.witness.is_some() && linted.line(finding.span).starts_with(line)
        });
        assert!(
            named,
            "{id}: {} at `{line}` is not named: {:?}",
            rule.id(),
            linted.told()
        );
    }
}

#[test]
fn hardened_forms_are_clean() {
    let library = Library::embedded().unwrap();
    let mut found = Vec::new();
    for probe in PROBES.iter().filter(|probe| probe.form == Form::Hardened) {
        let linted = linted(&library, probe, &options());
        found.extend(
            linted
                .told()
                .into_iter()
                .map(|told| format!("{}: {told}", probe.function())),
        );
        if linted.report.unfinished {
            found.push(format!("{}: not seen to the end", probe.function()));
        }
    }
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
    ] {
        let probe = Probe::find(id).unwrap_or_else(|| panic!("no probe {id}"));
        let text = library
            .assemble_probe(probe.id)
            .unwrap_or_else(|e| panic!("{e}"))
            .wgsl;
        assert!(text.contains(guard), "{id} has no `{guard}`:\n{text}");
        let linted = linted_text(probe, text.replace(guard, without), &options());
        let shown = linted.report.findings.iter().any(|f| f.witness.is_some());
        assert!(shown, "{id} without `{guard}`: {:?}", linted.told());
    }
}

/// Counts end the work, not the clock.
fn options() -> Options {
    Options {
        time: std::time::Duration::from_secs(600),
        ..Options::default()
    }
}
