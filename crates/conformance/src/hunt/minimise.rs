//! Found inputs made plain: the simplest bits, and as few numbers as possible away from plain values, while half of the score stays.
//!
//! All simplifications of one number are evaluated at once, and the simplest that keeps the score is taken; then the next number. It ends
//! when a whole pass changes nothing.

use bossage_bounds::ranges::Point;

use super::search::Found;
use super::{Budget, Goal, Prey, Score, Subject, is_over, slot};

/// The share of a score that has to stay.
const KEPT: f64 = 0.5;
/// Passes over all numbers.
const PASSES: usize = 3;
/// Inputs with more numbers are left as they are but for whole groups.
const MOST: usize = 256;

/// The best of each output and goal that reaches the threshold, made plain; and what was refused.
pub(super) fn plain(
    subject: &dyn Subject,
    found: &mut Found,
    threshold: f64,
    budget: &Budget,
) -> Result<Vec<Prey>, String> {
    let mut prey = Vec::new();
    if let Some((output, got, point)) = found.refused.clone() {
        prey.push(Prey {
            goal: Goal::Error,
            score: Score {
                ulps: f64::INFINITY,
                output,
            },
            point,
            refused: Some(got),
        });
    }
    for key in 0..subject.keys() {
        for goal in Goal::ALL {
            let slot = slot(key, goal);
            let Some((ulps, output, point)) = found.pools[slot].0.first().cloned() else {
                continue;
            };
            if ulps < threshold {
                continue;
            }
            let start = Score { ulps, output };
            let (score, point) = simplified(subject, found, slot, start, point, threshold, budget)?;
            prey.push(Prey {
                goal,
                score,
                point,
                refused: None,
            });
        }
    }
    Ok(prey)
}

fn simplified(
    subject: &dyn Subject,
    found: &mut Found,
    slot: usize,
    start: Score,
    mut point: Point,
    threshold: f64,
    budget: &Budget,
) -> Result<(Score, Point), String> {
    let least = (KEPT * start.ulps).max(threshold);
    let mut score = start;
    let groups = subject.groups().into_iter();
    let free: Vec<usize> = groups.filter(|group| subject.is_free(group)).flatten().collect();
    for _ in 0..PASSES {
        let before = point.clone();
        for scalar in free.iter().copied().take(MOST) {
            let mut candidates = candidates(subject, &point, scalar);
            candidates.truncate(budget.left(found.evaluated));
            if candidates.is_empty() || is_over(budget.until) {
                continue;
            }
            let measured = subject.measure(&candidates)?;
            found.evaluated += candidates.len();
            let simplest = candidates
                .into_iter()
                .zip(measured)
                .find_map(|(candidate, measured)| {
                    let score = measured.scores[slot].filter(|score| score.ulps >= least)?;
                    Some((score, candidate))
                });
            if let Some((kept, candidate)) = simplest {
                (score, point) = (kept, candidate);
            }
        }
        if point == before {
            break;
        }
    }
    Ok((score, point))
}

/// The same input with one number simpler, the simplest first; none where the domain does not admit it.
fn candidates(subject: &dyn Subject, point: &Point, scalar: usize) -> Vec<Point> {
    let x = point.values[scalar];
    let plain = [0.0, 1.0, -1.0, 0.5, -0.5, 2.0];
    let shorter = [0, 1, 2, 4, 8, 12, 16, 20].map(|bits| rounded(x, bits));
    let mut values: Vec<f64> = Vec::new();
    for value in plain.into_iter().chain(shorter) {
        let is_simpler = complexity(value) < complexity(x);
        if is_simpler && !values.contains(&value) {
            values.push(value);
        }
    }
    values.sort_by_key(|value| complexity(*value));
    let with = |value: f64| {
        let mut simpler = point.clone();
        simpler.values[scalar] = value;
        let mut mended = simpler.clone();
        subject.mend(&mut mended);
        (mended == simpler).then_some(simpler)
    };
    values.into_iter().filter_map(with).collect()
}

/// The number of significant bits after the first, with plain values before all others.
fn complexity(x: f64) -> u32 {
    if x == 0.0 {
        return 0;
    }
    let mantissa = (x as f32).to_bits() & 0x007f_ffff;
    let bits = if mantissa == 0 {
        0
    } else {
        23 - mantissa.trailing_zeros()
    };
    2 + 2 * bits + u32::from(x.abs() != 1.0) + u32::from(x < 0.0)
}

/// The number cut to so many bits after the first.
fn rounded(x: f64, bits: u32) -> f64 {
    let mask = !((1_u32 << (23 - bits)) - 1);
    f64::from(f32::from_bits((x as f32).to_bits() & mask))
}

#[cfg(test)]
mod tests {
    use super::{complexity, rounded};

    #[test]
    fn plain_numbers_are_simpler() {
        let order = [0.0, 1.0, -1.0, 1.5, 1.75, 1.000_000_1];
        assert!(
            order
                .windows(2)
                .all(|pair| complexity(pair[0]) < complexity(pair[1]))
        );
        assert!(complexity(0.5) < complexity(0.75));
    }

    #[test]
    fn numbers_are_cut_to_bits() {
        assert_eq!(rounded(1.99, 0), 1.0);
        assert_eq!(rounded(1.99, 1), 1.5);
        assert_eq!(rounded(-0.3, 2), -0.25);
        assert_eq!(rounded(0.0, 4), 0.0);
    }
}
