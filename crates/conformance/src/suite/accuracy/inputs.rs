//! Arguments, random and adversarial: half of them within the function's domain, evenly or by magnitude; an eighth each hard values,
//! neighbours of these, neighbours of the domain's zeros, poles and steps, and any bits. A fourth of the second arguments are made
//! for the first one: equal, opposite, reciprocal or a multiple, give or take a few steps of the format.

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
        let x = argument(function.domain, &mut rng);
        let y = match rng.random_range(0..4_u32) {
            0 => partner(x, &mut rng),
            _ => argument(second(function.domain), &mut rng),
        };
        values.extend([x, y]);
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
    match rng.random_range(0..8_u32) {
        0 => hard(rng),
        1 => beside(hard(rng), rng),
        2 => beside(edge(domain, rng), rng),
        3 => finite(rng),
        _ => within(domain, rng),
    }
}

fn hard(rng: &mut Pcg64Mcg) -> f32 {
    HARD[rng.random_range(0..HARD.len())]
}

/// Another argument that makes trouble together with this one: cancels, divides to one, to a power of two or to a quarter turn.
fn partner(x: f32, rng: &mut Pcg64Mcg) -> f32 {
    let y = match rng.random_range(0..5_u32) {
        0 => x,
        1 => -x,
        2 => x.recip(),
        3 => x * rng.random_range(-30.0_f32..30.0).round().exp2(),
        _ => x * rng.random_range(-9.0_f32..9.0).round() / 2.0,
    };
    beside(if y.is_finite() { y } else { x }, rng)
}

/// A neighbour within four steps of the format, as often as not the number itself.
fn beside(x: f32, rng: &mut Pcg64Mcg) -> f32 {
    let steps = rng.random_range(-8..=8_i32);
    let step = if steps < 0 { f32::next_down } else { f32::next_up };
    let count = if steps.abs() > 4 { 0 } else { steps.abs() };
    let y = (0..count).fold(x, |y, _| step(y));
    if y.is_finite() { y } else { x }
}

/// A number at which functions of the domain have a zero, a pole, a step, or change from one formula to another.
fn edge(domain: Domain, rng: &mut Pcg64Mcg) -> f32 {
    let sign = if rng.random() { 1.0 } else { -1.0 };
    let half_steps = rng.random_range(0..=512_u32) as f32 / 2.0;
    let power = rng.random_range(-126..=127_i32) as f32;
    match domain {
        Domain::Any if rng.random() => sign * half_steps,
        Domain::Any => sign * power.exp2(),
        Domain::Unit => {
            sign * [0.0, 0.25, 0.5, std::f32::consts::FRAC_1_SQRT_2, 0.75, 1.0][rng.random_range(0..6)]
        }
        Domain::Angle => sign * rng.random_range(0..=8_u32) as f32 * std::f32::consts::FRAC_PI_4,
        Domain::Positive | Domain::Power if rng.random() => half_steps * half_steps,
        Domain::Positive | Domain::Power => power.exp2(),
        Domain::Exponent => sign * half_steps.min(88.5),
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::suite::accuracy::functions::ALL;

    #[test]
    fn arguments_are_finite_the_same_each_time_and_differ_between_parts() {
        for function in ALL {
            let values = generate(function, 5_000, 3, 9);
            assert!(values.iter().all(|x| x.is_finite()), "{}", function.name);
            let bits = |values: &[f32]| values.iter().map(|x| x.to_bits()).collect::<Vec<_>>();
            assert_eq!(bits(&values), bits(&generate(function, 5_000, 3, 9)));
            assert_ne!(bits(&values), bits(&generate(function, 5_000, 4, 9)));
        }
    }

    /// What the description above promises is really there.
    #[test]
    fn adversarial_pairs_occur() {
        let add = ALL.iter().find(|function| function.name == "add").unwrap();
        let values = generate(add, 20_000, 0, 1);
        let count = |holds: &dyn Fn(f32, f32) -> bool| {
            values
                .chunks_exact(2)
                .filter(|pair| holds(pair[0], pair[1]))
                .count()
        };
        assert!(count(&|x, y| x + y == 0.0 && x != 0.0) > 100);
        assert!(count(&|x, y| x != -y && (x + y).abs() < 1e-6 * x.abs() && x.is_normal()) > 50);
        assert!(count(&|x, _| x.is_subnormal()) > 100);
        assert!(count(&|x, _| x != x.round() && (x - x.round()).abs() < 1e-6 * x.abs()) > 50);
        assert!(count(&|x, _| x.abs() > 1e30) > 100);
    }
}
