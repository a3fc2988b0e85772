//! Ranges of inputs that nobody declared, from names and types.
//!
//! | an input called | is |
//! |---|---|
//! | `normal`, `tangent`, `bitangent`, `binormal`, `direction`, `dir`, `axis` (a vector of floats) | a unit vector; the fourth component of a tangent is −1 or 1, of others within [0, 1] |
//! | `sign`, `handedness` | −1 or 1 |
//! | `uv`, `st`, `texcoord`, `coord` | in [0, 1] |
//! | `color`, `colour`, `albedo`, `diffuse`, `specular`, `ambient`, `emissive`, `radiance`, `alpha`, `opacity`, `roughness`, `metallic`, `occlusion`, `ao`, `height`, `mask`, `cutoff`, `factor`, `weight` | in [0, 1] |
//! | `cos`, `cosine` | in [−1, 1] |
//! | `angle`, `phase`, `radians` | in [−π, π] |
//! | `shininess`, `exponent` | in [0, 4096] |
//! | `resolution`, `viewport`, `dimensions`, `extent`, `size` | in [1, 4096] |
//! | `time`, `seconds` | in [0, 86400] |
//! | `count`, `num`, `index`, `id` (integers) | in [0, 15] |
//!
//! The last name of a path decides, else the one before it. Words are what stands between underscores, digits and changes of
//! case; a plural counts as its singular. Names that speak of a vector's encoding or of its strength (`normal_scale`,
//! `tangent_matrix`) are not the vector. Everything else: floats in [−1000, 1000], signed integers alike, unsigned in [0, 1000].
//!
//! Built-ins: `position` of a fragment is within a 4096² target, depth in [0, 1], w in [0.001, 1000]; `vertex_index` and the other indices are in
//! [0, 15]; `front_facing` is either. Textures: [0, 1]; integers [0, 255] or [−128, 127]; a run-time sized array has as many elements as
//! the longest one whose size is declared, else [`DEFAULT_ELEMENTS`].

use super::Values;
use super::pattern::Step;
use crate::kind::Kind;
use crate::stage::Slot;
use std::f64::consts::PI;

/// Elements of run-time sized arrays of a shader for which nobody declared a size.
pub const DEFAULT_ELEMENTS: u32 = 16;

/// Bound of the magnitude of numbers about which nothing is known.
const ANYTHING: f64 = 1000.0;

const DIRECTIONS: &[&str] = &[
    "normal",
    "tangent",
    "bitangent",
    "binormal",
    "direction",
    "dir",
    "axis",
];
const NOT_THE_VECTOR: &[&str] = &[
    "scale",
    "strength",
    "matrix",
    "map",
    "decode",
    "encode",
    "count",
    "index",
    "weight",
    "bias",
    "intensity",
];
const FRACTIONS: &[&str] = &[
    "uv",
    "st",
    "texcoord",
    "coord",
    "color",
    "colour",
    "albedo",
    "diffuse",
    "specular",
    "ambient",
    "emissive",
    "radiance",
    "alpha",
    "opacity",
    "roughness",
    "metallic",
    "occlusion",
    "ao",
    "height",
    "mask",
    "cutoff",
    "factor",
    "weight",
];

/// What a name says about numbers.
#[derive(Clone, Copy, PartialEq)]
enum Meaning {
    Direction { tangent: bool },
    Sign,
    Between(f64, f64),
    Small,
}

/// Values of one vector, scalar or matrix column, in parts that together have its length.
pub(super) fn values(path: &[Step], kind: Kind, n: usize) -> Vec<(usize, Values)> {
    let names = path.iter().rev().filter_map(|step| match step {
        Step::Name(name) => Some(name.as_str()),
        Step::Index(_) | Step::Component(_) => None,
    });
    match names.map(words).find_map(|words| meaning(&words, kind)) {
        Some(Meaning::Direction { tangent }) if n >= 2 => direction(n, tangent),
        Some(Meaning::Direction { .. }) => between(n, -1.0, 1.0),
        Some(Meaning::Sign) => vec![(n, Values::OneOf(vec![-1.0, 1.0]))],
        Some(Meaning::Between(lo, hi)) => between(n, lo, hi),
        Some(Meaning::Small) => between(n, 0.0, f64::from(DEFAULT_ELEMENTS - 1)),
        None => anything(kind, n),
    }
}

fn direction(n: usize, tangent: bool) -> Vec<(usize, Values)> {
    if n < 4 {
        return vec![(n, Values::Unit)];
    }
    let fourth = if tangent {
        Values::OneOf(vec![-1.0, 1.0])
    } else {
        Values::Between(vec![(0.0, 1.0)])
    };
    vec![(3, Values::Unit), (1, fourth)]
}

fn between(n: usize, lo: f64, hi: f64) -> Vec<(usize, Values)> {
    vec![(n, Values::Between(vec![(lo, hi); n]))]
}

fn anything(kind: Kind, n: usize) -> Vec<(usize, Values)> {
    match kind {
        Kind::Float(_) => between(n, -ANYTHING, ANYTHING),
        Kind::Int(t) if t.signed => between(n, -ANYTHING, ANYTHING),
        Kind::Int(_) => between(n, 0.0, ANYTHING),
        Kind::Bool => between(n, 0.0, 1.0),
    }
}

fn meaning(words: &[String], kind: Kind) -> Option<Meaning> {
    let has = |list: &[&str]| words.iter().any(|word| list.contains(&word.as_str()));
    let float = matches!(kind, Kind::Float(_));
    if !float {
        return match kind {
            Kind::Int(_) if has(&["count", "num", "index", "id"]) => Some(Meaning::Small),
            Kind::Int(_)
                if has(&[
                    "resolution",
                    "viewport",
                    "dimensions",
                    "dimension",
                    "extent",
                    "size",
                ]) =>
            {
                Some(Meaning::Between(1.0, 4096.0))
            }
            Kind::Int(t) if t.signed && has(&["sign", "handedness"]) => Some(Meaning::Sign),
            Kind::Int(_) | Kind::Bool | Kind::Float(_) => None,
        };
    }
    if has(&["sign", "handedness"]) {
        return Some(Meaning::Sign);
    }
    if has(DIRECTIONS) && !has(NOT_THE_VECTOR) {
        return Some(Meaning::Direction {
            tangent: has(&["tangent"]),
        });
    }
    if has(NOT_THE_VECTOR) && has(DIRECTIONS) {
        return None;
    }
    [
        (FRACTIONS, 0.0, 1.0),
        (&["cos", "cosine"], -1.0, 1.0),
        (&["angle", "phase", "radians"], -PI, PI),
        (&["shininess", "exponent"], 0.0, 4096.0),
        (
            &["resolution", "viewport", "dimension", "extent", "size"],
            1.0,
            4096.0,
        ),
        (&["time", "seconds", "second"], 0.0, 86400.0),
    ]
    .into_iter()
    .find(|(list, ..)| has(list))
    .map(|(_, lo, hi)| Meaning::Between(lo, hi))
}

/// Lower-case words of an identifier, plurals as singulars.
fn words(name: &str) -> Vec<String> {
    let mut out = vec![String::new()];
    let mut lower = false;
    for c in name.chars() {
        let separates = !c.is_alphabetic() || (c.is_uppercase() && lower);
        if separates {
            out.push(String::new());
        }
        if c.is_alphabetic()
            && let Some(last) = out.last_mut()
        {
            last.extend(c.to_lowercase());
        }
        lower = c.is_lowercase();
    }
    out.retain(|word| !word.is_empty());
    let singular = |word: &String| match word.strip_suffix('s') {
        Some(stem) if stem.len() > 2 && word != "radians" && !stem.ends_with('s') => stem.to_owned(),
        Some(_) | None => word.clone(),
    };
    let singulars: Vec<String> = out
        .iter()
        .map(singular)
        .filter(|word| !out.contains(word))
        .collect();
    out.extend(singulars);
    out
}

/// A value for every pipeline-overridable constant that the module gives none: 1, which a size, a count and a switch can be.
pub fn constants(module: &naga::Module) -> naga::back::PipelineConstants {
    let open = module.overrides.iter().filter(|(_, o)| o.init.is_none());
    open.filter_map(|(_, o)| Some((o.id.map(|id| id.to_string()).or_else(|| o.name.clone())?, 1.0)))
        .collect()
}

/// Values of a built-in stage input.
pub(super) fn builtin(slot: Slot, kind: Kind, n: usize) -> Vec<(usize, Values)> {
    match slot {
        Slot::Position => vec![(
            4,
            Values::Between(vec![(0.5, 4095.5), (0.5, 4095.5), (0.0, 1.0), (0.001, ANYTHING)]),
        )],
        Slot::FrontFacing | Slot::Barycentric | Slot::FragDepth => between(n, 0.0, 1.0),
        Slot::SampleMask => between(n, 1.0, 15.0),
        Slot::SampleIndex => between(n, 0.0, 3.0),
        Slot::VertexIndex | Slot::InstanceIndex | Slot::PrimitiveIndex | Slot::ViewIndex => {
            between(n, 0.0, f64::from(DEFAULT_ELEMENTS - 1))
        }
        Slot::PointSize => between(n, 1.0, 64.0),
        Slot::ClipDistances | Slot::Location(..) => anything(kind, n),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::width::Width;

    const F32: Kind = Kind::Float(Width::F32);

    fn of(name: &str, n: usize) -> Vec<(usize, Values)> {
        values(&[Step::Name(name.to_owned())], F32, n)
    }

    #[test]
    fn directions_are_unit_vectors_and_their_strengths_are_not() {
        assert_eq!(of("normal_ws", 3), [(3, Values::Unit)]);
        assert_eq!(of("viewDir", 3), [(3, Values::Unit)]);
        assert_eq!(of("normals", 3), [(3, Values::Unit)]);
        assert_eq!(of("tangent", 4)[1].1, Values::OneOf(vec![-1.0, 1.0]));
        assert_eq!(
            of("normal_scale", 2)[0].1,
            Values::Between(vec![(-1000.0, 1000.0); 2])
        );
        assert_eq!(of("abnormal", 1)[0].1, Values::Between(vec![(-1000.0, 1000.0)]));
    }

    #[test]
    fn the_last_name_decides() {
        let path = |a: &str, b: &str| [Step::Name(a.to_owned()), Step::Index(2), Step::Name(b.to_owned())];
        assert_eq!(
            values(&path("colors", "shininess"), F32, 1)[0].1,
            Values::Between(vec![(0.0, 4096.0)])
        );
        assert_eq!(
            values(&path("colors", "x1"), F32, 1)[0].1,
            Values::Between(vec![(0.0, 1.0)])
        );
    }

    #[test]
    fn words_end_at_underscores_digits_and_capitals() {
        assert_eq!(words("lightDir_ws2")[..3], ["light", "dir", "ws"]);
    }
}
