//! Soundness by adversarial machines: an implementation that keeps the rules but picks its roundings, its order of sums, its
//! fused operations and its flushes by chance must never leave the bound. And negative controls: a machine that breaks a
//! rule must leave it.

use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;

use super::vector::{cross, dot, normalize};
use super::{Bounded, Decision};
use crate::ulp::{MIN_NORMAL, ulp};

/// A machine that errs as much as the rules let it, in random directions.
struct Adversary {
    rng: Pcg64Mcg,
    /// Multiplies every allowed error; above 1 it breaks the rules.
    excess: f64,
}

impl Adversary {
    fn new(seed: u64) -> Self {
        Self {
            rng: Pcg64Mcg::seed_from_u64(seed),
            excess: 1.0,
        }
    }

    /// An f32 on either side of the exact result, or a zero for a subnormal.
    fn round(&mut self, exact: f64) -> f32 {
        let near = exact as f32;
        let other = match f64::from(near).total_cmp(&exact) {
            std::cmp::Ordering::Less => near.next_up(),
            std::cmp::Ordering::Greater => near.next_down(),
            std::cmp::Ordering::Equal => near,
        };
        let picked = if self.rng.random() { near } else { other };
        let wrong = f64::from(picked) + (self.excess - 1.0) * 2.0 * ulp(exact);
        self.flush(if self.excess > 1.0 { wrong as f32 } else { picked })
    }

    fn flush(&mut self, x: f32) -> f32 {
        if x.is_subnormal() && self.rng.random() {
            0.0
        } else {
            x
        }
    }

    /// A result that is off by up to `ulps`, rounded toward the exact result so that the total stays inside.
    fn off_by(&mut self, exact: f64, ulps: f64) -> f32 {
        let error = (2.0 * self.rng.random::<f64>() - 1.0) * ulps * ulp(exact);
        let wanted = exact + error;
        let near = wanted as f32;
        let inside = (f64::from(near) - exact).abs() <= ulps * ulp(exact);
        let result = if inside { near } else { exact as f32 };
        self.flush(result)
    }

    fn add(&mut self, a: f32, b: f32) -> f32 {
        let (a, b) = (self.flush(a), self.flush(b));
        self.round(f64::from(a) + f64::from(b))
    }

    fn mul(&mut self, a: f32, b: f32) -> f32 {
        let (a, b) = (self.flush(a), self.flush(b));
        self.round(f64::from(a) * f64::from(b))
    }

    fn fma(&mut self, a: f32, b: f32, c: f32) -> f32 {
        if self.rng.random() {
            let product = self.mul(a, b);
            return self.add(product, c);
        }
        self.round(f64::from(a) * f64::from(b) + f64::from(c))
    }

    fn div(&mut self, a: f32, b: f32) -> f32 {
        self.off_by(f64::from(a) / f64::from(b), 2.5)
    }

    fn inverse_sqrt(&mut self, a: f32) -> f32 {
        self.off_by(f64::from(a).sqrt().recip(), 2.0)
    }

    fn dot(&mut self, a: &[f32; 3], b: &[f32; 3]) -> f32 {
        let first = self.rng.random_range(0..3usize);
        let order = [first, (first + 1) % 3, (first + 2) % 3];
        let start = self.mul(a[order[0]], b[order[0]]);
        let middle = self.fma(a[order[1]], b[order[1]], start);
        self.fma(a[order[2]], b[order[2]], middle)
    }

    fn pow(&mut self, x: f32, y: f32) -> f32 {
        let exact = f64::from(x).log2();
        let log = if (0.5..=2.0).contains(&x) {
            let error = (2.0 * self.rng.random::<f64>() - 1.0) * 2f64.powi(-21);
            // Rounding the perturbed value must not leave the allowance.
            let near = (exact + error) as f32;
            if (f64::from(near) - exact).abs() <= 2f64.powi(-21) {
                near
            } else {
                exact as f32
            }
        } else {
            self.off_by(exact, 3.0)
        };
        let power = self.mul(y, log);
        self.off_by(f64::from(power).exp2(), 3.0 + 2.0 * f64::from(power.abs()))
    }
}

fn number(rng: &mut Pcg64Mcg, range: f64) -> f32 {
    let sign = if rng.random() { 1.0 } else { -1.0 };
    (sign * (range * (2.0 * rng.random::<f64>() - 1.0)).exp2() * (1.0 + rng.random::<f64>())) as f32
}

fn vector(rng: &mut Pcg64Mcg, range: f64) -> [f32; 3] {
    std::array::from_fn(|_| number(rng, range))
}

/// Runs a machine and the bounds beside each other; returns how many results left their bound, and how many were decided.
fn trials(
    adversary: &mut Adversary,
    count: usize,
    trial: impl Fn(&mut Adversary, &mut Pcg64Mcg) -> (f32, Bounded),
) -> (usize, usize) {
    let mut rng = Pcg64Mcg::seed_from_u64(42);
    let (mut outside, mut decided) = (0, 0);
    for _ in 0..count {
        let (got, bound) = trial(adversary, &mut rng);
        decided += usize::from(bound.is_decided());
        outside += usize::from(!bound.contains(f64::from(got)));
    }
    (outside, decided)
}

const COUNT: usize = 100_000;

fn b(x: f32) -> Bounded {
    Bounded::input(x)
}

#[test]
fn sums_and_products_of_any_size_stay_inside() {
    let (outside, decided) = trials(&mut Adversary::new(1), COUNT, |machine, rng| {
        let (x, y, z) = (number(rng, 60.0), number(rng, 60.0), number(rng, 120.0));
        let got = machine.fma(x, y, z);
        (machine.add(got, -z), (b(x) * b(y) + b(z)) - b(z))
    });
    assert_eq!(outside, 0);
    assert!(decided > COUNT / 2, "the bounds must decide something: {decided}");
}

#[test]
fn results_in_the_subnormal_range_stay_inside() {
    let (outside, _) = trials(&mut Adversary::new(2), COUNT, |machine, rng| {
        let (x, y) = (number(rng, 8.0) * 1e-20, number(rng, 8.0) * 1e-19);
        let product = machine.mul(x, y);
        (machine.mul(product, 1e10), b(x) * b(y) * b(1e10))
    });
    assert_eq!(outside, 0);
}

#[test]
fn quotients_stay_inside() {
    let (outside, decided) = trials(&mut Adversary::new(3), COUNT, |machine, rng| {
        let (x, y, z) = (number(rng, 30.0), number(rng, 30.0), number(rng, 30.0));
        let sum = machine.add(x, y);
        (machine.div(sum, z), (b(x) + b(y)) / b(z))
    });
    assert_eq!(outside, 0);
    assert!(decided > COUNT / 2);
}

#[test]
fn dot_and_normalize_by_either_recipe_stay_inside() {
    let (outside, decided) = trials(&mut Adversary::new(4), COUNT, |machine, rng| {
        let v = vector(rng, 10.0);
        let squared = machine.dot(&v, &v);
        let got = if rng.random() {
            let inverse = machine.inverse_sqrt(squared);
            machine.mul(v[0], inverse)
        } else {
            let inverse = machine.inverse_sqrt(squared);
            let length = machine.div(1.0, inverse);
            machine.div(v[0], length)
        };
        (got, normalize(&v.map(b))[0])
    });
    assert_eq!(outside, 0);
    assert_eq!(decided, COUNT);
}

#[test]
fn cross_products_that_cancel_stay_inside() {
    let (outside, _) = trials(&mut Adversary::new(5), COUNT, |machine, rng| {
        let a = vector(rng, 2.0);
        // Nearly parallel: the differences cancel.
        let c: [f32; 3] = std::array::from_fn(|i| a[i] * (1.0 + 1e-6 * number(rng, 1.0)));
        let product = machine.mul(a[2], c[1]);
        (machine.fma(a[1], c[2], -product), cross(&a.map(b), &c.map(b))[0])
    });
    assert_eq!(outside, 0);
}

#[test]
fn powers_stay_inside() {
    let (outside, decided) = trials(&mut Adversary::new(6), COUNT, |machine, rng| {
        let (x, y) = (rng.random::<f32>().max(1e-3), number(rng, 8.0).abs());
        (machine.pow(x, y), b(x).pow(b(y)))
    });
    assert_eq!(outside, 0);
    assert!(decided > COUNT / 2);
}

#[test]
fn a_machine_that_rounds_four_ulps_off_is_caught() {
    let mut cheat = Adversary {
        excess: 3.0,
        ..Adversary::new(7)
    };
    let (outside, _) = trials(&mut cheat, 1000, |machine, rng| {
        let (x, y) = (number(rng, 10.0), number(rng, 10.0));
        (machine.mul(x, y), b(x) * b(y))
    });
    assert!(outside > 900, "{outside}");
}

#[test]
fn a_constant_that_is_one_per_cent_off_is_caught() {
    let (outside, _) = trials(&mut Adversary::new(8), 1000, |machine, rng| {
        let v = vector(rng, 2.0);
        let dotted = machine.dot(&v, &v);
        (machine.mul(dotted, 1.01), dot(&v.map(b), &v.map(b)))
    });
    assert_eq!(outside, 1000);
}

#[test]
fn exact_results_have_no_error() {
    for (got, value) in [
        (b(1.5) + b(2.25), 3.75),
        (b(0.5) * b(-3.0), -1.5),
        (b(0.0) / b(3.0), 0.0),
        (b(-2.0).abs(), 2.0),
        (b(3.7).trunc(), 3.0),
        (b(1.5).saturate(), 1.0),
        (dot(&[b(0.0), b(0.0), b(1.0)], &[b(9.0), b(8.0), b(0.25)]), 0.25),
    ] {
        assert_eq!((got.value, got.error), (value, 0.0));
    }
    // 1 + 2^-100 is 1 in f64 but not in exact arithmetic: rounding upward is allowed.
    assert!((b(1.0) + b(2f32.powi(-100))).error > 0.0);
}

#[test]
fn what_the_rules_leave_open_is_open() {
    let huge = b(3e38);
    for open in [
        huge + huge,
        huge * huge,
        b(1.0) / b(0.0),
        b(1.0) / b(1e-40),
        b(1.0) / huge,
        b(0.0).inverse_sqrt(),
        b(-1.0).sqrt(),
        b(0.0).log2(),
        b(0.0).pow(b(2.0)),
        b(200.0).exp2(),
        Bounded::OPEN.saturate(),
        dot(&[huge; 3], &[b(1.0), b(-1.0), b(1.0)]),
        normalize(&[b(1e-23); 3])[0],
        normalize(&[b(2e19); 3])[0],
    ] {
        assert!(!open.is_decided(), "{open:?}");
    }
}

#[test]
fn subnormals_may_be_flushed() {
    let tiny = b(1e-40);
    assert!(tiny.contains(0.0) && tiny.contains(1e-40));
    let product = b(1e-20) * b(1e-20);
    assert!(product.contains(0.0) && product.error <= 2.0 * MIN_NORMAL);
}

#[test]
fn undecided_comparisons_join_and_mark() {
    let x = Bounded::within(0.0, 1.0);
    assert_eq!(x.less(b(2.0)), Decision::Always);
    assert_eq!(x.less(b(-1.0)), Decision::Never);
    assert_eq!(x.less(b(0.5)), Decision::Either { nominal: true });
    let sign = Bounded::select(x.less(b(0.0)), b(-1.0), b(1.0));
    assert!(sign.forked && sign.contains(1.0) && sign.contains(-1.0));
    assert_eq!(sign.value, 1.0);
    assert!(
        !Bounded::select(x.less(b(0.0)), b(1.0), b(1.0)).forked,
        "equal results leave nothing undecided"
    );
    let step = Bounded::within(3.0, 1e-6).floor();
    assert!(step.forked && step.contains(2.0) && step.contains(3.0));
}

#[test]
fn decisions_combine() {
    let either = Decision::Either { nominal: true };
    assert_eq!(either.and(Decision::Never), Decision::Never);
    assert_eq!(either.and(Decision::Always), either);
    assert_eq!(either.or(Decision::Always), Decision::Always);
    assert_eq!(either.negated(), Decision::Either { nominal: false });
}
