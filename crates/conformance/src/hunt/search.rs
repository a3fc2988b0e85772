//! The guided search: a pool of the best inputs for each output and goal, and children of them.
//!
//! Children differ from a parent in one way: a number moved by some ULPs, scaled by a power of two, negated, or set beside another number
//! of the same input (where differences cancel); a vector taken over from another input or from another place of the same one (where
//! parallel vectors are); a point between two parents; a group drawn anew.

use bossage_bounds::ranges::{Point, Seed};

use super::{Budget, Goal, Measured, Subject, is_over, slot};

/// Inputs that are evaluated at a time.
const BATCH: usize = 128;
/// The best inputs that are kept for an output and a goal.
const POOL: usize = 6;
/// The way of a child that draws a group anew.
const WHOLE: usize = 7;
/// The share of the evaluations that are drawn, not bred.
const DRAWN: usize = 3;

/// The best inputs of an output and a goal, best first.
#[derive(Clone, Debug, Default)]
pub(super) struct Pool(pub(super) Vec<(f64, usize, Point)>);

/// What a search has found.
#[derive(Debug)]
pub(super) struct Found {
    /// By [`slot`].
    pub(super) pools: Vec<Pool>,
    /// The first output that was refused, with its value and inputs.
    pub(super) refused: Option<(usize, f64, Point)>,
    pub(super) evaluated: usize,
}

impl Pool {
    fn keep(&mut self, ulps: f64, output: usize, point: &Point) {
        if self.0.iter().any(|(_, _, kept)| kept == point) {
            return;
        }
        let at = self.0.partition_point(|(kept, _, _)| *kept >= ulps);
        if at < POOL {
            self.0.insert(at, (ulps, output, point.clone()));
            self.0.truncate(POOL);
        }
    }
}

impl Found {
    /// Nothing yet.
    pub(super) fn new(subject: &dyn Subject) -> Self {
        Self {
            pools: vec![Pool::default(); 2 * subject.keys()],
            refused: None,
            evaluated: 0,
        }
    }

    /// Whether anything is to be reported.
    pub(super) fn reaches(&self, threshold: f64) -> bool {
        let best = |pool: &Pool| pool.0.first().is_some_and(|(ulps, _, _)| *ulps >= threshold);
        self.refused.is_some() || self.pools.iter().any(best)
    }

    /// Searches on until the budget is spent, to the very evaluation, or something is refused.
    pub(super) fn search(
        &mut self,
        subject: &dyn Subject,
        budget: &Budget,
        seed: &mut Seed,
    ) -> Result<(), String> {
        let groups = subject.groups();
        let mut round = 0;
        while self.refused.is_none() && (self.evaluated == 0 || !is_over(budget.until)) {
            let size = BATCH.min(budget.left(self.evaluated));
            if size == 0 {
                break;
            }
            let points: Vec<Point> = (0..size)
                .map(|_| {
                    let parent = parent(subject, self, seed).filter(|_| round % DRAWN != 0);
                    match parent {
                        Some(parent) => child(subject, &groups, self, parent, seed),
                        None => subject.sample(seed),
                    }
                })
                .collect();
            self.try_all(subject, &points)?;
            round += 1;
        }
        Ok(())
    }

    /// Measures inputs and keeps the best.
    pub(super) fn try_all(
        &mut self,
        subject: &dyn Subject,
        points: &[Point],
    ) -> Result<Vec<Measured>, String> {
        let measured = subject.measure(points)?;
        self.evaluated += points.len();
        for (point, measured) in points.iter().zip(&measured) {
            for (pool, score) in self.pools.iter_mut().zip(&measured.scores) {
                if let Some(score) = score {
                    pool.keep(score.ulps, score.output, point);
                }
            }
            if let (None, Some((output, got))) = (&self.refused, measured.refused) {
                self.refused = Some((output, got, point.clone()));
            }
        }
        Ok(measured)
    }
}

/// One of the best of any output and goal.
fn parent(subject: &dyn Subject, found: &Found, seed: &mut Seed) -> Option<Point> {
    let key = seed.below(subject.keys());
    let goal = Goal::ALL[seed.below(2)];
    let pool = &found.pools[slot(key, goal)].0;
    // The better the likelier.
    let at = seed.below(pool.len()).min(seed.below(pool.len()));
    pool.get(at).map(|(_, _, point)| point.clone())
}

fn child(
    subject: &dyn Subject,
    groups: &[std::ops::Range<usize>],
    found: &Found,
    mut point: Point,
    seed: &mut Seed,
) -> Point {
    if groups.is_empty() {
        return subject.sample(seed);
    }
    // Mostly one change, now and then a few.
    let changes = 1 + seed.below(4) / 3 * seed.below(3);
    for _ in 0..changes {
        let group = groups[seed.below(groups.len())].clone();
        let scalar = group.start + seed.below(group.len());
        let x = point.values[scalar];
        let way = if subject.is_free(&group) {
            seed.below(8)
        } else {
            WHOLE
        };
        match way {
            0 | 1 => point.values[scalar] = stepped(x, seed),
            2 => point.values[scalar] = x * f64::exp2((seed.below(9) as f64 - 4.0) / 2.0),
            3 => point.values[scalar] = -x,
            4 => {
                let other = point.values[seed.below(point.values.len())];
                point.values[scalar] = stepped(other, seed);
            }
            5 => within(&mut point, groups, &group, seed),
            6 => toward(subject, found, &mut point, &group, seed),
            _ => {
                let drawn = subject.sample(seed);
                point.values[group.clone()].copy_from_slice(&drawn.values[group]);
            }
        }
    }
    subject.mend(&mut point);
    point
}

/// A number some ULPs away: any power of two of them.
fn stepped(x: f64, seed: &mut Seed) -> f64 {
    let steps = 1_i64 << seed.below(24);
    let bits = (x as f32).to_bits();
    let magnitude = i64::from(bits & 0x7fff_ffff);
    let moved = if seed.below(2) == 0 {
        magnitude + steps
    } else {
        magnitude - steps
    };
    let sign = if (bits >> 31 == 1) != (moved < 0) {
        -1.0
    } else {
        1.0
    };
    let moved = f32::from_bits(moved.unsigned_abs().min(u64::from(f32::MAX.to_bits())) as u32);
    sign * f64::from(moved)
}

/// Takes over another group of the same input, or its opposite.
fn within(
    point: &mut Point,
    groups: &[std::ops::Range<usize>],
    group: &std::ops::Range<usize>,
    seed: &mut Seed,
) {
    let alike: Vec<_> = groups.iter().filter(|other| other.len() == group.len()).collect();
    let other = alike[seed.below(alike.len())].clone();
    let sign = if seed.below(2) == 0 { 1.0 } else { -1.0 };
    let values: Vec<f64> = point.values[other].iter().map(|x| sign * x).collect();
    point.values[group.clone()].copy_from_slice(&values);
}

/// A part of the way to another good input, or all of it.
fn toward(
    subject: &dyn Subject,
    found: &Found,
    point: &mut Point,
    group: &std::ops::Range<usize>,
    seed: &mut Seed,
) {
    let Some(other) = parent(subject, found, seed) else {
        return;
    };
    let share = [0.25, 0.5, 1.0, 2.0][seed.below(4)];
    for k in group.clone() {
        let (a, b) = (point.values[k], other.values[k]);
        point.values[k] = f64::from((a + share * (b - a)) as f32);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn steps_are_powers_of_two_of_ulps() {
        let mut seed = Seed::new(1);
        for _ in 0..1000 {
            let y = stepped(1.0, &mut seed) as f32;
            let distance = crate::ulp::ulp_distance(1.0, y).unwrap();
            assert!(distance.is_power_of_two() && distance < 1 << 24, "{y}");
        }
        assert!(stepped(0.0, &mut seed).abs() > 0.0, "zero is left");
    }

    #[test]
    fn pools_keep_the_best_in_order_and_each_once() {
        let point = |x: f64| Point {
            values: vec![x],
            texels: Vec::new(),
        };
        let mut pool = Pool::default();
        for x in [3.0, 9.0, 1.0, 9.0, 5.0, 7.0, 2.0, 8.0, 4.0] {
            pool.keep(x, 0, &point(x));
        }
        let kept: Vec<f64> = pool.0.iter().map(|(ulps, _, _)| *ulps).collect();
        assert_eq!(kept, [9.0, 8.0, 7.0, 5.0, 4.0, 3.0]);
    }
}
