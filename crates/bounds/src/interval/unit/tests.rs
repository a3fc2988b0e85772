//! Machines that err as much as the table lets them, against the derived bounds.

use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;

use super::{Entries, TABLE, correlated};
use crate::domain::{Component, OverLength};
use crate::interval::{Interval, arithmetic};
use crate::width::Width;

const W: Width = Width::F32;

/// A machine that picks each result among those it may return, the extreme ones two times in three.
struct Machine(Pcg64Mcg);

impl Machine {
    /// A number of the format between two, which lie a few steps apart.
    fn pick(&mut self, lo: f64, hi: f64) -> f64 {
        let x = match self.0.random_range(0..3u32) {
            0 => lo,
            1 => hi,
            _ => lo + (hi - lo) * self.0.random::<f64>(),
        };
        let (first, last) = (W.round_up(lo, 0.0), W.round_down(hi, 0.0));
        W.round(x).clamp(first, last)
    }

    /// The real number `x` within so many ULPs.
    fn within(&mut self, x: f64, ulps: f64) -> f64 {
        let room = ulps * W.ulp(x);
        self.pick(x - room, x + room)
    }

    /// The real number `x` rounded in either direction.
    fn rounded(&mut self, x: f64) -> f64 {
        self.pick(W.round_down(x, 0.0), W.round_up(x, 0.0))
    }

    fn sum(&mut self, mut terms: Vec<f64>) -> f64 {
        while terms.len() > 1 {
            let a = terms.swap_remove(self.0.random_range(0..terms.len()));
            let b = terms.swap_remove(self.0.random_range(0..terms.len()));
            let fused = a + b;
            terms.push(self.rounded(fused));
        }
        terms[0]
    }

    fn over_length(&mut self, s: &[f64], at: usize) -> f64 {
        let squares = s.iter().map(|x| self.rounded(x * x)).collect();
        let d = self.sum(squares);
        let inverse = self.within(1.0 / d.sqrt(), 2.0);
        let root = self.within(1.0 / inverse, 2.5);
        self.within(s[at] / root, 2.5)
    }
}

/// A vector of intervals, and its divisor.
struct Vector {
    whole: Vec<Interval>,
    divisor: Option<Interval>,
}

impl Vector {
    fn random(rng: &mut Pcg64Mcg) -> Self {
        let n = rng.random_range(2..=4usize);
        let spread = [0.0, 1e-7, 1e-5, 1e-2, 0.5, 3.0][rng.random_range(0..6usize)];
        let scale = f64::from(rng.random_range(-8..8i32)).exp2();
        let number = |rng: &mut Pcg64Mcg| {
            let small = [1.0, 1.0, 1e-3, 1e-25][rng.random_range(0..4usize)];
            W.round(small * scale * (2.0 * rng.random::<f64>() - 1.0))
        };
        let interval = |x: f64, rng: &mut Pcg64Mcg| {
            let width = spread * x.abs() * rng.random::<f64>();
            Interval::new(W.round_down(x - width, 0.0), W.round_up(x + width, 0.0))
        };
        let whole: Vec<Interval> = (0..n)
            .map(|_| {
                let x = number(rng);
                interval(x, rng)
            })
            .collect();
        let divisor = rng.random::<bool>().then(|| {
            let sign = if rng.random::<bool>() { 1.0 } else { -1.0 };
            interval(W.round(sign * scale * (0.5 + rng.random::<f64>())), rng)
        });
        Self { whole, divisor }
    }

    fn scaled(&self) -> Vec<Interval> {
        let divide = |x: &Interval| match self.divisor {
            Some(m) => arithmetic::divide::<true>(W, *x, m),
            None => *x,
        };
        self.whole.iter().map(divide).collect()
    }

    fn bounds(&self, at: usize, entries: Entries) -> Option<Interval> {
        let scaled = self.scaled();
        let squares: Vec<Interval> = scaled.iter().map(|s| arithmetic::square::<true>(W, *s)).collect();
        let components: Vec<Component<Interval>> = scaled
            .iter()
            .zip(&self.whole)
            .map(|(&scaled, &whole)| Component {
                scaled,
                whole,
                product: false,
            })
            .collect();
        let vector = OverLength {
            sum: crate::interval::orders::of_four::<true>(W, &squares),
            components: &components,
            divisor: self.divisor,
            at,
        };
        correlated(W, &vector, entries)
    }

    fn run(&self, machine: &mut Machine, at: usize) -> f64 {
        let m = self.divisor.map(|m| machine.pick(m.lo, m.hi));
        let s: Vec<f64> = self
            .whole
            .iter()
            .map(|x| {
                let x = machine.pick(x.lo, x.hi);
                m.map_or(x, |m| machine.within(x / m, 2.5))
            })
            .collect();
        machine.over_length(&s, at)
    }
}

/// How many of so many machines leave the bounds, and how many vectors the bounds say anything about.
fn escapes(entries: Entries) -> (usize, usize) {
    let mut machine = Machine(Pcg64Mcg::seed_from_u64(11));
    let (mut outside, mut judged) = (0, 0);
    for _ in 0..20_000 {
        let vector = Vector::random(&mut machine.0);
        let at = machine.0.random_range(0..vector.whole.len());
        let Some(bounds) = vector.bounds(at, entries).filter(|b| b.flags.is_none()) else {
            continue;
        };
        judged += 1;
        for _ in 0..10 {
            let got = vector.run(&mut machine, at);
            outside += usize::from(!bounds.contains(got));
        }
    }
    (outside, judged)
}

#[test]
fn no_machine_that_keeps_the_table_leaves_the_bounds() {
    let (outside, judged) = escapes(TABLE);
    assert_eq!(outside, 0);
    assert!(judged > 15_000, "{judged}");
}

#[test]
fn each_entry_is_needed() {
    let without = [
        Entries { divide: 1.0, ..TABLE },
        Entries {
            inverse_sqrt: 0.0,
            ..TABLE
        },
        Entries { round: 0.0, ..TABLE },
    ];
    for (k, entries) in without.into_iter().enumerate() {
        assert!(
            escapes(entries).0 > 0,
            "entry {k} was taken away and nothing escaped"
        );
    }
}

#[test]
fn wider_components_give_wider_bounds() {
    let mut rng = Pcg64Mcg::seed_from_u64(12);
    for _ in 0..20_000 {
        let narrow = Vector::random(&mut rng);
        let widen = |x: &Interval, rng: &mut Pcg64Mcg| {
            let by = x.hi.abs().max(x.lo.abs()) * 0.1 * rng.random::<f64>();
            Interval::new(W.round_down(x.lo - by, 0.0), W.round_up(x.hi + by, 0.0))
        };
        let wide = Vector {
            whole: narrow.whole.iter().map(|x| widen(x, &mut rng)).collect(),
            divisor: narrow.divisor.map(|m| widen(&m, &mut rng)),
        };
        if let (Some(a), Some(b)) = (narrow.bounds(0, TABLE), wide.bounds(0, TABLE)) {
            assert!(b.lo <= a.lo && a.hi <= b.hi, "{a:?} is not within {b:?}");
        }
    }
}
