//! From answers and truths to the numbers of a point.
//!
//! Errors are distances in texels to the nearest hit that counts. Percentiles are values of the sample: the smallest that so many per cent do
//! not exceed. An answer that is NaN or infinite has no distance: it is counted as *lost* and left out of the rest.

use bossage_reference::relief_ray::Status;
use glam::DVec2;

use super::truth::Truth;
use crate::record::{Disagreement, ErrorTexels, Spread};

/// What a technique answered for one ray.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Answer {
    /// Where it says that the surface is met, in UV, not wrapped.
    pub uv: DVec2,
    /// How it says that its search ended; none where it says nothing that is known.
    pub status: Option<Status>,
}

/// The numbers of a point that come from its answers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Summary {
    /// Distances to the nearest hit that counts.
    pub error_texels: ErrorTexels,
    /// Where answers and truth differ in kind.
    pub disagreement: Disagreement,
    /// Share of rays that have more than one hit that counts.
    pub grazing: f64,
}

/// Sums up. Both lists have the rays' order and length.
#[must_use]
pub fn summarise(truths: &[Truth], answers: &[Answer]) -> Summary {
    let total = truths.len().max(1) as f64;
    let mut errors = Vec::with_capacity(answers.len());
    let mut counts = [0_u64; 4];
    let [missed, early, lost, status] = &mut counts;
    for (truth, answer) in truths.iter().zip(answers) {
        *status += u64::from(answer.status != Some(truth.status));
        if !answer.uv.is_finite() {
            *lost += 1;
            continue;
        }
        errors.push(truth.answers.error_texels(answer.uv));
        let ahead = ahead_texels(truth, answer.uv);
        *missed += u64::from(ahead > 1.0);
        *early += u64::from(ahead < -1.0);
    }
    let share = |count: u64| count as f64 / total;
    let grazing = truths.iter().filter(|truth| truth.answers.is_grazing()).count();
    Summary {
        error_texels: error_texels(errors, truths.len()),
        disagreement: Disagreement {
            missed: share(*missed),
            early: share(*early),
            lost: share(*lost),
            status: share(*status),
        },
        grazing: share(grazing as u64),
    }
}

/// How far an answer lies behind the nearest hit that counts, along the ray, in texels; negative before it.
fn ahead_texels(truth: &Truth, uv: DVec2) -> f64 {
    let answers = &truth.answers;
    let sides = answers.sides();
    let hits = std::iter::once(&answers.truth).chain(&answers.others);
    let offsets = hits.map(|hit| (uv - hit.uv) * sides);
    let nearest = offsets.min_by(|a, b| a.length().total_cmp(&b.length()));
    nearest.map_or(0.0, |offset| offset.dot(truth.travel_texels.normalize_or_zero()))
}

fn error_texels(mut errors: Vec<f64>, rays: usize) -> ErrorTexels {
    let over_1 = errors.iter().filter(|error| **error > 1.0).count();
    let spread = spread(&mut errors);
    ErrorTexels {
        mean: spread.mean,
        p50: spread.p50,
        p99: spread.p99,
        max: spread.max,
        over_1: over_1 as f64 / rays.max(1) as f64,
    }
}

/// Mean, percentiles and greatest of values, which it sorts. Zeros without any.
#[must_use]
pub fn spread(values: &mut [f64]) -> Spread {
    values.sort_by(f64::total_cmp);
    Spread {
        mean: values.iter().sum::<f64>() / values.len().max(1) as f64,
        p50: percentile(values, 0.5),
        p99: percentile(values, 0.99),
        max: values.last().copied().unwrap_or(0.0),
    }
}

/// The smallest of sorted values that at least this share of them does not exceed; 0 without any.
fn percentile(sorted: &[f64], share: f64) -> f64 {
    // The product may come out a rounding above a whole number, which would skip a value.
    let rank = (sorted.len() as f64 * share - 1e-9).ceil().max(1.0) as usize;
    sorted.get(rank - 1).copied().unwrap_or(0.0)
}

#[cfg(test)]
mod tests {
    use bossage_assets::EdgeMode;
    use bossage_reference::relief_ray::Status;
    use glam::DVec2;

    use super::super::map::Map;
    use super::super::rays::seeded;
    use super::super::truth::{Truth, trace};
    use super::{Answer, percentile, spread, summarise};

    /// Rays at 60° over level ground of 16×16 texels, and answers that are off by so many texels along each ray.
    fn off_by(texels: &[f64]) -> (Vec<Truth>, Vec<Answer>) {
        let map = Map::of("level", 16, 16, |_, _| 0.5, EdgeMode::Wrap);
        let rays = seeded(60.0, texels.len(), 1);
        let truths = trace(&map, &rays);
        let answers = truths.iter().zip(texels).map(|(truth, off)| Answer {
            uv: truth.answers.truth.uv + *off * truth.travel_texels.normalize() / 16.0,
            status: Some(Status::Hit),
        });
        let answers = answers.collect();
        (truths, answers)
    }

    #[test]
    fn known_distances_give_known_numbers() {
        let mut texels = vec![0.0; 98];
        texels.extend([2.0, -3.0]);
        let (truths, answers) = off_by(&texels);
        let found = summarise(&truths, &answers);
        let error = found.error_texels;
        let near = |a: f64, b: f64| (a - b).abs() < 1e-9;
        assert!(
            near(error.mean, 0.05) && near(error.p50, 0.0) && near(error.p99, 2.0) && near(error.max, 3.0)
        );
        assert!(near(error.over_1, 0.02));
        let kinds = found.disagreement;
        assert_eq!(
            (kinds.missed, kinds.early, kinds.lost, kinds.status),
            (0.01, 0.01, 0.0, 0.0)
        );
    }

    #[test]
    fn right_answers_have_no_error_and_wrong_ones_are_seen() {
        let (truths, answers) = off_by(&[0.0; 64]);
        let right = summarise(&truths, &answers);
        assert!(right.error_texels.max < 1e-12);
        // The answers of other rays.
        let mut turned = answers;
        turned.rotate_left(1);
        let wrong = summarise(&truths, &turned);
        assert!(wrong.error_texels.p50 > 1.0 && wrong.error_texels.over_1 > 0.5);
    }

    #[test]
    fn an_answer_that_is_no_number_is_lost_and_not_near() {
        let (truths, mut answers) = off_by(&[0.0; 4]);
        answers[1].uv = DVec2::NAN;
        answers[2].status = Some(Status::CapReached);
        answers[3].status = None;
        let found = summarise(&truths, &answers);
        assert_eq!((found.disagreement.lost, found.disagreement.status), (0.25, 0.5));
        assert!(found.error_texels.max < 1e-12);
    }

    #[test]
    fn percentiles_are_values_of_the_sample() {
        let hundred: Vec<f64> = (1..=100).map(f64::from).collect();
        assert_eq!(
            (percentile(&hundred, 0.5), percentile(&hundred, 0.99)),
            (50.0, 99.0)
        );
        assert_eq!(percentile(&[7.0], 0.99), 7.0);
        assert_eq!(spread(&mut []), crate::record::Spread::default());
        let both = spread(&mut [3.0, 1.0]);
        assert_eq!((both.mean, both.p50, both.p99, both.max), (2.0, 1.0, 3.0, 3.0));
    }
}
