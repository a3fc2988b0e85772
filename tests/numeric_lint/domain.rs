//! What goes into the library's functions: the ranges of their documented domains.

use bossage_shaders::{Field, Probe, Role};

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

/// Functions whose length is that of a tile in the scene, whose products must stay finite.
const MEASURES_TILES: &[&str] = &["relief_place"];

/// The range of a field, for its floats from `at` on: vectors reach as far as `reach`, lengths as far as `longest`.
fn range(field: &Field, at: usize, reach: &str, longest: &str) -> Vec<String> {
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
        Role::Layer => vec![
            format!("{} = {{ lo = 0, hi = 1 }}", key(at, at + 1)),
            format!("{} = {{ lo = -1, hi = 1 }}", key(at + 1, at + 2)),
            format!("{} = {{ lo = 0.015625, hi = 64 }}", key(at + 2, at + 3)),
        ],
        Role::Above => one("-1", "-1e-9"),
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
        Role::Length => one("1.1754944e-38", longest),
        Role::SnormOne => vec![format!("{all} = {{ one_of = [127, 32767] }}")],
        Role::SnormCode => one("-32768", "32767"),
        Role::UnormOne => vec![format!("{all} = {{ one_of = [255, 65535] }}")],
        Role::UnormCode => one("0", "65535"),
        Role::Codec => vec![format!("{all} = {{ one_of = [0, 1] }}")],
        Role::EdgeMode => vec![format!("{all} = {{ one_of = [0, 1, 2] }}")],
        Role::Output | Role::Direction => Vec::new(),
    }
}

pub(crate) fn sidecar(probe: &Probe) -> String {
    let reach = if TAKES_ANY_LENGTH.contains(&probe.function()) {
        ANY_LENGTH
    } else {
        FINITE_PRODUCTS
    };
    let longest = if MEASURES_TILES.contains(&probe.function()) {
        FINITE_PRODUCTS
    } else {
        ANY_LENGTH
    };
    let mut text = format!(
        "schema = 1\n[ranges]\ninputs = {{ size = {} }}\noutputs = {{ size = {} }}\n",
        probe.input_floats, probe.output_floats
    );
    let mut at = 0;
    for field in probe.inputs {
        for line in range(field, at, reach, longest) {
            text.push_str(&line);
            text.push('\n');
        }
        at += field.shape.floats();
    }
    text
}

/// Two triangles that meet in one vertex: unit normals, tangents and bitangents of any length, and for the hardened kernel a vertex normal.
pub(crate) const ONE_VERTEX: &str = r#"schema = 1
[ranges]
adjacency_offsets = { size = 2 }
"adjacency_offsets[0]" = { lo = 0, hi = 0 }
"adjacency_offsets[1]" = { lo = 2, hi = 2 }
adjacency_triangles = { size = 2 }
"adjacency_triangles[0]" = { lo = 0, hi = 0 }
"adjacency_triangles[1]" = { lo = 1, hi = 1 }
frames = { size = 6, lo = 0, hi = 8 }
"frames[0].xyz" = { unit = true }
"frames[1].xyz" = { lo = -8, hi = 8 }
"frames[2].xyz" = { lo = -8, hi = 8 }
"frames[3].xyz" = { unit = true }
"frames[4].xyz" = { lo = -8, hi = 8 }
"frames[5].xyz" = { lo = -8, hi = 8 }
tangents = { size = 1 }
"#;
