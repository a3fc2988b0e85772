//! Arguments: a fourth hard values, a fourth any bits, the rest within the function's domain, evenly or by magnitude.

use rand::RngExt;
use rand_pcg::Pcg64Mcg;

use super::functions::{Domain, Function};
use crate::generate::random::stream;

/// Values at which rules change: zeros, subnormals, the ends of the format, powers of two, the ends of stated domains.
const HARD: &[f32] = &[
    0.0,
    -0.0,
    1.0,
    -1.0,
    0.5,
    -0.5,
    2.0,
    -2.0,
    3.0,
    0.1,
    f32::MIN_POSITIVE,
    -f32::MIN_POSITIVE,
    f32::MIN_POSITIVE / 4.0,
    f32::from_bits(1),
    f32::MAX,
    -f32::MAX,
    1.0 - f32::EPSILON / 2.0,
    1.0 + f32::EPSILON,
    1e-20,
    1e20,
    1e-7,
    16_777_216.0,
    std::f32::consts::PI,
    -std::f32::consts::PI,
    std::f32::consts::FRAC_PI_2,
    std::f32::consts::FRAC_PI_4,
    126.9,
    -126.9,
    88.7,
    0.75,
    -0.75,
    2_147_483_520.0,
];

/// Pairs of arguments, one after the other: part `part` of as many as are wanted.
#[must_use]
pub fn generate(function: &Function, count: usize, part: usize, seed: u64) -> Vec<f32> {
    let mut rng = stream(&format!("accuracy/{}#{part}", function.name), seed);
    let mut values = Vec::with_capacity(2 * count);
    for _ in 0..count {
        values.push(argument(function.domain, &mut rng));
        values.push(argument(second(function.domain), &mut rng));
    }
    values
}

/// The domain of the second argument.
const fn second(domain: Domain) -> Domain {
    match domain {
        Domain::Power => Domain::Exponent,
        Domain::Any | Domain::Unit | Domain::Angle | Domain::Positive | Domain::Exponent => domain,
    }
}

fn argument(domain: Domain, rng: &mut Pcg64Mcg) -> f32 {
    match rng.random_range(0..4_u32) {
        0 => HARD[rng.random_range(0..HARD.len())],
        1 => finite(rng),
        _ => within(domain, rng),
    }
}

fn finite(rng: &mut Pcg64Mcg) -> f32 {
    loop {
        let x = f32::from_bits(rng.random::<u32>());
        if x.is_finite() {
            return x;
        }
    }
}

fn within(domain: Domain, rng: &mut Pcg64Mcg) -> f32 {
    let unorm = rng.random::<f32>();
    let both = 2.0 * unorm - 1.0;
    let magnitude = |exponent: f32| (exponent * both).exp2();
    match domain {
        Domain::Any if rng.random::<bool>() => 8.0 * both,
        Domain::Any if rng.random::<bool>() => -magnitude(40.0),
        Domain::Any => magnitude(40.0),
        Domain::Unit => both,
        Domain::Angle => both * std::f32::consts::PI,
        Domain::Positive if rng.random::<bool>() => 4.0 * unorm,
        Domain::Positive | Domain::Power => magnitude(20.0),
        Domain::Exponent if rng.random::<bool>() => both,
        Domain::Exponent => 80.0 * both,
    }
}
