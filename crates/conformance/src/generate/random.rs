//! Random inputs from a seed: the whole domain of each role, with a share of extreme values.
//!
//! The generator is PCG (Melissa O'Neill, 2014; here the 64-bit output, multiplicative one), seeded by the case's `seed`
//! parameter and the probe's name, so each probe has its own stream and adding a probe changes no other.

use bossage_shaders::{Field, Probe, Role};
use glam::{DMat3, DMat4, DQuat, DVec3};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;

use super::{Inputs, item};

/// The seed of ordinary runs. It is part of every random case's name.
pub const SEED: u64 = 1;

/// `count` random items: part `part` of as many as are wanted. Each part has its own stream, so a long run begins with the
/// items of a short one and never has to be held in memory as a whole.
#[must_use]
pub fn generate(probe: &Probe, count: usize, part: usize, seed: u64) -> Inputs {
    let mut rng = stream(&format!("{}#{part}", probe.id), seed);
    let mut inputs = Inputs::of(probe);
    for _ in 0..count {
        inputs.push(item(probe.inputs, |_, field| value(field, &mut rng)));
    }
    inputs
}

/// The stream of a name and a seed (the name enters by FNV-1a).
#[must_use]
pub fn stream(name: &str, seed: u64) -> Pcg64Mcg {
    let hash = name.bytes().fold(0xcbf2_9ce4_8422_2325_u64, |h, b| {
        (h ^ u64::from(b)).wrapping_mul(0x100_0000_01b3)
    });
    Pcg64Mcg::seed_from_u64(hash ^ seed)
}

fn value(field: &Field, rng: &mut Pcg64Mcg) -> Vec<f32> {
    match field.role {
        Role::Vector => vector(rng).to_vec(),
        Role::Unit => unit(rng).to_vec(),
        Role::MapNormal => map_normal(rng).to_vec(),
        Role::Tangent => {
            let [x, y, z] = unit(rng);
            vec![x, y, z, sign(rng)]
        }
        Role::Matrix => matrix(rng),
        Role::Rigid => rigid(rng),
        Role::Position => scaled(unit64(rng), log_uniform(rng, -4.0, 8.0)).to_vec(),
        Role::Weight => vec![weight(rng)],
        Role::Layer => layer(rng),
        Role::Edge => scaled(unit64(rng), log_uniform(rng, -10.0, 10.0)).to_vec(),
        role => (0..field.shape.floats()).map(|_| scalar(role, rng)).collect(),
    }
}

fn scalar(role: Role, rng: &mut Pcg64Mcg) -> f32 {
    let unorm = rng.random::<f32>();
    match role {
        // Half of the texels come as bytes, as they do from images.
        Role::Unorm | Role::Height if rng.random::<bool>() => (unorm * 255.0).round() / 255.0,
        Role::Unorm | Role::Height => unorm,
        Role::Snorm | Role::Cosine => 2.0 * unorm - 1.0,
        Role::Scale => 0.5 * (2.0 * unorm - 1.0),
        Role::Slope => 64.0 * (2.0 * unorm - 1.0),
        Role::Elevation => 0.1 * (2.0 * unorm - 1.0),
        Role::Uv => 8.0 * (2.0 * unorm - 1.0),
        Role::UvEdge => 2.0 * unorm - 1.0,
        Role::Colour => 4.0 * unorm,
        Role::Exponent => log_uniform(rng, -2.0, 12.0) as f32,
        Role::Above => -(unorm.max(1.0 / 65_536.0)),
        Role::Sign => sign(rng),
        Role::Byte => rng.random_range(0..=255u32) as f32,
        Role::Index => rng.random_range(-70_000..=70_000i32) as f32,
        Role::Size => rng.random_range(1..=16_384u32) as f32,
        Role::EdgeMode => rng.random_range(0..3u32) as f32,
        Role::Texel => rng.random_range(0..16_384u32) as f32,
        Role::Codec => rng.random_range(0..2u32) as f32,
        Role::Face => rng.random_range(0..6u32) as f32,
        Role::Gain => 64.0 * unorm,
        Role::Length => log_uniform(rng, -8.0, 8.0) as f32,
        Role::SnormOne => [127.0, 32_767.0][usize::from(rng.random::<bool>())],
        Role::SnormCode => rng.random_range(-32_768..=32_767i32) as f32,
        Role::UnormOne => [255.0, 65_535.0][usize::from(rng.random::<bool>())],
        Role::UnormCode => rng.random_range(0..=65_535u32) as f32,
        Role::Vector
        | Role::Unit
        | Role::MapNormal
        | Role::Tangent
        | Role::Matrix
        | Role::Rigid
        | Role::Edge
        | Role::Position
        | Role::Layer
        | Role::Weight => unorm,
        Role::Output | Role::Direction => 0.0,
    }
}

fn sign(rng: &mut Pcg64Mcg) -> f32 {
    if rng.random::<bool>() { 1.0 } else { -1.0 }
}

/// 2 to a power that is uniform between two.
fn log_uniform(rng: &mut Pcg64Mcg, low: f64, high: f64) -> f64 {
    (low + (high - low) * rng.random::<f64>()).exp2()
}

/// Uniform on the sphere (Archimedes: z is uniform).
fn unit64(rng: &mut Pcg64Mcg) -> DVec3 {
    let z = 2.0 * rng.random::<f64>() - 1.0;
    let (sin, cos) = (std::f64::consts::TAU * rng.random::<f64>()).sin_cos();
    let across = (1.0 - z * z).sqrt();
    DVec3::new(across * cos, across * sin, z)
}

fn unit(rng: &mut Pcg64Mcg) -> [f32; 3] {
    unit64(rng).as_vec3().to_array()
}

fn scaled(direction: DVec3, length: f64) -> [f32; 3] {
    (length * direction).as_vec3().to_array()
}

/// Seven in eight near unit length, as interpolation leaves vectors; the rest of any length that squares without overflow
/// and beyond.
fn vector(rng: &mut Pcg64Mcg) -> [f32; 3] {
    let direction = unit64(rng);
    let length = match rng.random_range(0..8u32) {
        0 => log_uniform(rng, -120.0, 120.0),
        1..=3 => log_uniform(rng, -3.0, 8.0),
        _ => 0.5 + 0.5 * rng.random::<f64>(),
    };
    scaled(direction, length)
}

/// Unit, or of the lengths that real maps hold: 0.11 to 1.50.
fn map_normal(rng: &mut Pcg64Mcg) -> [f32; 3] {
    let v = unit64(rng);
    let upward = DVec3::new(v.x, v.y, v.z.abs());
    scaled(
        upward,
        if rng.random::<bool>() {
            1.0
        } else {
            0.11 + 1.39 * rng.random::<f64>()
        },
    )
}

fn rotation(rng: &mut Pcg64Mcg) -> DMat3 {
    let axis = unit64(rng);
    DMat3::from_quat(DQuat::from_axis_angle(
        axis,
        std::f64::consts::TAU * rng.random::<f64>(),
    ))
}

/// Two rotations around a stretch of 1/8 to 8 an axis, one in four mirrored: every condition number up to 64.
fn matrix(rng: &mut Pcg64Mcg) -> Vec<f32> {
    let mut stretch = DVec3::from_array(std::array::from_fn(|_| log_uniform(rng, -3.0, 3.0)));
    if rng.random_range(0..4u32) == 0 {
        stretch.x = -stretch.x;
    }
    floats(rotation(rng) * DMat3::from_diagonal(stretch) * rotation(rng))
}

/// A rotation and a translation.
fn rigid(rng: &mut Pcg64Mcg) -> Vec<f32> {
    let shift = log_uniform(rng, -4.0, 8.0) * unit64(rng);
    DMat4::from_mat3_translation(rotation(rng), shift)
        .to_cols_array()
        .map(|x| x as f32)
        .to_vec()
}

/// A sum of areas, of the size that the vectors beside it have for the most part.
fn weight(rng: &mut Pcg64Mcg) -> f32 {
    log_uniform(rng, -3.0, 8.0) as f32
}

/// A thickness of up to half a tile, its bottom up to half a tile below or above the polygon, on tiles of any sides.
fn layer(rng: &mut Pcg64Mcg) -> Vec<f32> {
    let (scale, bias) = (0.5 * rng.random::<f32>(), rng.random::<f32>() - 0.5);
    vec![scale, bias, log_uniform(rng, -3.0, 3.0) as f32]
}

fn floats(m: DMat3) -> Vec<f32> {
    m.to_cols_array().map(|x| x as f32).to_vec()
}

#[cfg(test)]
mod tests {
    use bossage_shaders::PROBES;

    use super::generate;

    #[test]
    fn same_seed_same_inputs_and_each_probe_its_own() {
        let bits = |i: super::Inputs| i.values.iter().map(|x| x.to_bits()).collect::<Vec<_>>();
        for probe in PROBES {
            assert_eq!(bits(generate(probe, 10, 0, 3)), bits(generate(probe, 10, 0, 3)));
            assert_ne!(bits(generate(probe, 10, 0, 3)), bits(generate(probe, 10, 0, 4)));
            assert_ne!(bits(generate(probe, 10, 0, 3)), bits(generate(probe, 10, 1, 3)));
        }
    }

    #[test]
    fn every_value_is_finite_and_in_its_place() {
        for probe in PROBES {
            let inputs = generate(probe, 100, 0, 1);
            assert_eq!(inputs.len(), 100);
            assert!(inputs.values.iter().all(|x| x.is_finite()), "{}", probe.id);
        }
    }
}
