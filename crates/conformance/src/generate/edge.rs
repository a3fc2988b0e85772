//! The hard values of each role, and their combinations.
//!
//! Where the combinations of all fields' hard values are few, all of them are made; otherwise each field's values are all
//! used, in combinations drawn from a fixed seed.

use bossage_shaders::{Field, Probe, Role, Shape};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;

use super::Inputs;

/// At most so many combinations.
pub const LIMIT: usize = 4096;

/// The seed of the drawn combinations.
const SEED: u64 = 0xb055_a6e0;

/// The hard inputs of a probe.
#[must_use]
pub fn generate(probe: &Probe) -> Inputs {
    let values: Vec<Vec<Vec<f32>>> = probe.inputs.iter().map(hard_values).collect();
    let all: usize = values.iter().map(Vec::len).fold(1, usize::saturating_mul);
    let mut inputs = Inputs::of(probe);
    if all <= LIMIT {
        for index in 0..all {
            inputs.push(combination(&values, index));
        }
    } else {
        drawn(&values, &mut inputs);
    }
    inputs
}

/// The combination of that number, the first field's values turning fastest.
fn combination(values: &[Vec<Vec<f32>>], mut index: usize) -> Vec<Vec<f32>> {
    let pick = |field: &Vec<Vec<f32>>| {
        let value = field[index % field.len()].clone();
        index /= field.len();
        value
    };
    values.iter().map(pick).collect()
}

/// `LIMIT` combinations: field k goes through its own values in order, the others are drawn; k takes turns.
fn drawn(values: &[Vec<Vec<f32>>], inputs: &mut Inputs) {
    let mut rng = Pcg64Mcg::seed_from_u64(SEED);
    for index in 0..LIMIT {
        let (turn, step) = (index % values.len(), index / values.len());
        let pick = |(place, field): (usize, &Vec<Vec<f32>>)| {
            let at = if place == turn {
                step % field.len()
            } else {
                rng.random_range(0..field.len())
            };
            field[at].clone()
        };
        inputs.push(values.iter().enumerate().map(pick));
    }
}

/// The hard values of a field, each as its floats.
#[must_use]
pub fn hard_values(field: &Field) -> Vec<Vec<f32>> {
    match field.role {
        Role::Vector => vectors().into_iter().map(|v| v.to_vec()).collect(),
        Role::Unit => units().into_iter().map(|v| v.to_vec()).collect(),
        Role::MapNormal => map_normals().into_iter().map(|v| v.to_vec()).collect(),
        Role::Tangent => tangents(),
        Role::Matrix => matrices().into_iter().map(|m| m.to_vec()).collect(),
        Role::Rigid => rigids(),
        Role::Position => edges().into_iter().map(|v| v.to_vec()).collect(),
        Role::Weight => vec![vec![0.0], vec![1.0], vec![1e-10], vec![100.0], vec![8e37]],
        Role::Edge => edges().into_iter().map(|v| v.to_vec()).collect(),
        Role::Layer => layers(),
        role => spread(scalars(role), field.shape),
    }
}

/// Scalars laid out in a shape: each in every component, and each in one component beside its neighbour in the list.
fn spread(scalars: Vec<f32>, shape: Shape) -> Vec<Vec<f32>> {
    let n = shape.floats();
    let mut values: Vec<Vec<f32>> = scalars.iter().map(|&x| vec![x; n]).collect();
    if n > 1 {
        let count = scalars.len();
        values.extend((0..count).map(|i| (0..n).map(|k| scalars[(i + k * (k + 1) / 2) % count]).collect()));
    }
    values
}

/// The hard scalars of a role.
fn scalars(role: Role) -> Vec<f32> {
    const SUBNORMAL: f32 = 1e-40;
    match role {
        Role::Unorm | Role::Height => {
            vec![
                0.0,
                1.0,
                0.5,
                128.0 / 255.0,
                127.0 / 255.0,
                1.0 / 255.0,
                1.0f32.next_down(),
                1e-20,
                SUBNORMAL,
                0.25,
            ]
        }
        Role::Snorm => {
            let unit = [
                0.0,
                1.0,
                0.5,
                1.0 / 127.0,
                0.5 / 127.0,
                1.0 / 255.0,
                1.0f32.next_down(),
                1e-20,
                SUBNORMAL,
                // Outside: what clamps, and what lets the line go on.
                1.5,
            ];
            unit.iter().flat_map(|&x| [x, -x]).collect()
        }
        Role::Slope => vec![0.0, 1.0, -1.0, 0.04, 20.48, -4096.0, 1e9, 1e-6, SUBNORMAL],
        Role::Scale => vec![0.0, 0.04, -0.02, -0.04, 1.0, -1.0, 1e-6, 64.0, SUBNORMAL],
        Role::Elevation => vec![0.0, 0.02, -0.02, 0.05, -0.05, 1.0, 1e-6, SUBNORMAL],
        Role::Uv => vec![0.0, 1.0, 0.5, -0.0, -3.25, 0.999_999_9, 1000.7, 1e6, SUBNORMAL],
        Role::UvEdge => vec![0.0, 1.0, -1.0, 1e-3, -1e-3, 1e-7, 0.5, 64.0],
        Role::Colour => vec![0.0, 1.0, 0.5, 10.0, 1e-6, 65_504.0, SUBNORMAL],
        Role::Cosine => vec![
            0.0,
            1.0,
            -1.0,
            1.0f32.next_up(),
            1.0f32.next_down(),
            0.5,
            1e-3,
            1e-20,
            f32::MIN_POSITIVE,
            SUBNORMAL,
            -1e-20,
            // Normals that are not unit.
            2.0,
            -2.0,
        ],
        // Below 0 counts as 0.
        Role::Exponent => vec![0.0, -1.0, 1.0, 1e-3, 0.5, 2.0, 16.0, 64.0, 256.0, 4096.0],
        Role::Sign => vec![-1.0, 1.0],
        Role::Byte => vec![0.0, 1.0, 2.0, 126.0, 127.0, 128.0, 129.0, 254.0, 255.0],
        Role::Index => vec![
            0.0, -1.0, 1.0, -2.0, 254.0, 255.0, 256.0, 511.0, 512.0, -255.0, -256.0, -257.0, 40_000.0,
        ],
        Role::Size => vec![1.0, 2.0, 3.0, 255.0, 256.0, 16_384.0],
        Role::EdgeMode => vec![0.0, 1.0, 2.0],
        Role::Texel => vec![0.0, 1.0, 2.0, 63.0, 64.0, 127.0, 255.0, 16_383.0],
        Role::Codec => vec![0.0, 1.0],
        Role::Face => vec![0.0, 1.0, 2.0, 3.0, 4.0, 5.0],
        Role::Gain => vec![0.0, 1.0, 40.0, 1e-6, 1000.0, SUBNORMAL],
        Role::Length => vec![1.0, 0.5, 1e-10, 1e10, f32::MIN_POSITIVE, 8e37],
        Role::Above => vec![-1.0, -0.5, -1.0 / 255.0, -f32::EPSILON, -0.25],
        Role::SnormOne => vec![127.0, 32_767.0],
        Role::SnormCode => vec![
            0.0, 1.0, -1.0, 127.0, -127.0, -128.0, 32_767.0, -32_767.0, -32_768.0,
        ],
        Role::UnormOne => vec![255.0, 65_535.0],
        Role::UnormCode => vec![
            0.0, 1.0, 127.0, 128.0, 254.0, 255.0, 32_767.0, 32_768.0, 65_534.0, 65_535.0,
        ],
        Role::Vector
        | Role::Unit
        | Role::MapNormal
        | Role::Tangent
        | Role::Matrix
        | Role::Rigid
        | Role::Edge
        | Role::Position
        | Role::Layer
        | Role::Weight => Vec::new(),
        Role::Output | Role::Direction => vec![0.0],
    }
}

/// Relief layers: as the articles have them, hanging below the polygon, standing on it, without thickness, tiles that are not square.
fn layers() -> Vec<Vec<f32>> {
    [
        [0.04, -0.02, 1.0],
        [0.05, -0.05, 1.0],
        [0.05, 0.0, 2.0],
        [0.0, 0.0, 1.0],
        [0.0, 0.1, 1.0],
        [1e-6, -1e-6, 1.0],
        [1.0, -0.5, 0.125],
    ]
    .map(Vec::from)
    .to_vec()
}

/// Unit vectors: the axes, the axis (−1, 1, 1) of the published frame, and grazing angles on both sides.
#[must_use]
pub fn units() -> Vec<[f32; 3]> {
    let third = (1.0f64 / 3.0).sqrt() as f32;
    let mut units = axes();
    units.extend([
        [-third, third, third],
        [third, -third, -third],
        [0.6, 0.0, 0.8],
        [0.0, 0.6, -0.8],
        [0.48, 0.6, 0.64],
    ]);
    for z in [1e-2f32, 1e-4, 1e-7, 1e-20, 1e-38, -1e-2, -1e-7] {
        let across = (1.0 - f64::from(z) * f64::from(z)).sqrt() as f32;
        units.extend([[across, 0.0, z], [-0.6 * across, 0.8 * across, z]]);
    }
    units
}

fn axes() -> Vec<[f32; 3]> {
    let mut axes = Vec::new();
    for axis in 0..3 {
        for sign in [1.0, -1.0] {
            let mut v = [0.0; 3];
            v[axis] = sign;
            axes.push(v);
        }
    }
    axes
}

/// Vectors of every length that f32 can hold: zero, tiny, huge.
fn vectors() -> Vec<[f32; 3]> {
    let directions = [
        [0.0f32, 0.0, 1.0],
        [1.0, 0.0, 0.0],
        [-1.0, 1.0, 1.0],
        [0.48, -0.6, 0.64],
        [1e-6, 0.0, 1.0],
    ];
    let lengths = [
        1.0f32, 0.5, 100.0, 1e-10, 1e-19, 1e-23, 1e-37, 1e-42, 1e10, 2e19, 8e37,
    ];
    let mut vectors = vec![[0.0; 3], [-0.0, 0.0, -0.0]];
    for length in lengths {
        vectors.extend(directions.map(|d| d.map(|x| x * length)));
    }
    vectors.push([1e-30, 1e30, 0.0]);
    vectors.push([f32::MIN_POSITIVE, f32::MIN_POSITIVE, f32::MIN_POSITIVE]);
    vectors
}

/// What normal maps hold: flat (with and without the half-byte tilt), steep, too short, too long.
fn map_normals() -> Vec<[f32; 3]> {
    let tilt = 1.0 / 255.0;
    let mut normals = vec![
        [0.0, 0.0, 1.0],
        [tilt, tilt, 1.0],
        [-tilt, -tilt, 1.0],
        [0.8, 0.0, 0.6],
        [0.0, -0.8, 0.6],
    ];
    normals.extend([
        [0.07, -0.05, 0.07],
        [0.9, 0.9, 0.8],
        [1.0, 0.0, 0.0],
        [0.0, 1.0, 0.0],
        [-1.0, -1.0, 1.0],
    ]);
    normals
}

/// Tangents with both signs, none parallel to a fixed axis only.
fn tangents() -> Vec<Vec<f32>> {
    let mut tangents = Vec::new();
    for [x, y, z] in axes().into_iter().chain([[0.6, 0.0, 0.8], [-0.48, 0.64, 0.6]]) {
        tangents.extend([vec![x, y, z, 1.0], vec![x, y, z, -1.0]]);
    }
    tangents
}

/// Differences of positions: axis-aligned, needle-shaped, tiny and large.
fn edges() -> Vec<[f32; 3]> {
    let mut edges = vec![[0.0; 3], [1.0, 1.0, 0.0], [0.3, -0.4, 1.2], [-2.0, 0.5, 0.1]];
    edges.extend(axes());
    edges.extend([
        [1e-5, 0.0, 0.0],
        [0.0, 1e-5, 1e-5],
        [1e4, 0.0, 1.0],
        [1.0, 1e-7, 0.0],
        [1e-15, 1e-15, 0.0],
    ]);
    edges
}

/// Linear maps, column by column: rigid, stretched, mirrored, sheared, tiny, large.
fn matrices() -> Vec<[f32; 9]> {
    let diagonal = |x, y, z| [x, 0.0, 0.0, 0.0, y, 0.0, 0.0, 0.0, z];
    let mut matrices = vec![
        diagonal(1.0, 1.0, 1.0),
        diagonal(4.0, 1.0, 1.0),
        diagonal(1.0, 0.01, 1.0),
        diagonal(-1.0, 1.0, 1.0),
        diagonal(-2.0, -3.0, -0.5),
        diagonal(1e-4, 1e-4, 1e-4),
        diagonal(1e4, 1e4, 1e4),
        // Determinants and cofactors that would overflow or vanish, column by column and together.
        diagonal(1e-25, 1e-25, -1e-25),
        diagonal(-1e25, 1e25, 1e25),
        diagonal(1e-30, -1e30, 1.0),
        diagonal(1e30, 1.0, -1e-30),
        [1.0, 0.0, 0.0, 0.75, 1.0, 0.0, 0.0, -0.5, 1.0],
        [0.5, 1.0, -2.0, 3.0, 0.25, 1.0, -1.0, 2.0, 0.125],
    ];
    matrices.extend(rotations());
    matrices
}

/// Rotations with a translation, as 4×4 matrices.
fn rigids() -> Vec<Vec<f32>> {
    let shifts = [[0.0f32, 0.0, 0.0], [1.0, -2.0, 0.5], [1e4, 0.0, -1e-4]];
    let rigid = |m: [f32; 9], t: [f32; 3]| {
        let column = |c: usize| [m[3 * c], m[3 * c + 1], m[3 * c + 2], 0.0];
        [column(0), column(1), column(2), [t[0], t[1], t[2], 1.0]].concat()
    };
    rotations()
        .into_iter()
        .flat_map(|m| shifts.map(|t| rigid(m, t)))
        .collect()
}

/// Quarter turns and turns by angles whose sine and cosine are short fractions.
fn rotations() -> Vec<[f32; 9]> {
    vec![
        [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0],
        [0.0, 1.0, 0.0, -1.0, 0.0, 0.0, 0.0, 0.0, 1.0],
        [0.0, 0.0, -1.0, 0.0, 1.0, 0.0, 1.0, 0.0, 0.0],
        [0.6, 0.8, 0.0, -0.8, 0.6, 0.0, 0.0, 0.0, 1.0],
        [1.0, 0.0, 0.0, 0.0, 0.28, 0.96, 0.0, -0.96, 0.28],
        [0.36, 0.48, -0.8, -0.8, 0.6, 0.0, 0.48, 0.64, 0.6],
    ]
}

#[cfg(test)]
mod tests {
    use bossage_shaders::{PROBES, Role};

    use super::{LIMIT, generate, hard_values};

    #[test]
    fn every_hard_value_of_every_field_occurs() {
        for probe in PROBES {
            let inputs = generate(probe);
            assert!(!inputs.is_empty() && inputs.len() <= LIMIT, "{}", probe.id);
            let mut start = 0;
            for field in probe.inputs {
                let end = start + field.shape.floats();
                for value in hard_values(field) {
                    let bits = |v: &[f32]| v.iter().map(|x| x.to_bits()).collect::<Vec<_>>();
                    let found = inputs.items().any(|item| bits(&item[start..end]) == bits(&value));
                    assert!(found, "{}: {} never is {value:?}", probe.id, field.name);
                }
                start = end;
            }
        }
    }

    #[test]
    fn values_fit_their_shapes() {
        for probe in PROBES {
            for field in probe.inputs {
                assert!(
                    !matches!(field.role, Role::Output),
                    "{}: an input cannot be an output",
                    probe.id
                );
                assert!(
                    hard_values(field).iter().all(|v| v.len() == field.shape.floats()),
                    "{}",
                    probe.id
                );
            }
        }
    }
}
