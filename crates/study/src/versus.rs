//! What exactness costs beside marching, from a study's own points: at equal error how much faster `exact` is, and at equal time how much
//! smaller its error. Figures are given whichever way they come out.
//!
//! - **At equal error**: the fastest marching point whose p99 error is at most [`EQUAL_ERROR_TEXELS`]. Where none gets there the nearest to it
//!   stands in, named as such: then the factor is no bound of anything.
//! - **At equal time**: the least p99 error of the marching points that take at most as long as `exact`. Where none is as fast, the fastest
//!   stands in.
//!
//! Both come from one cell of the sweep, whose points were timed in turns.

use std::collections::BTreeMap;
use std::fmt;

use crate::pareto;
use crate::record::{Point, Rival, Study, Versus};

/// The p99 error at which times are compared, texels.
pub const EQUAL_ERROR_TEXELS: f64 = 0.5;
/// The view angle from the normal for which the goals are, degrees.
pub const GOAL_DEG: f64 = 75.0;
/// At equal error `exact` is to be so many times as fast.
pub const GOAL_FASTER: f64 = 3.0;
/// At equal time the error of `exact` is to be so many times smaller.
pub const GOAL_SMALLER: f64 = 10.0;

/// Techniques that go along the ray step by step.
const MARCHING: [&str; 5] = [
    "steep_parallax",
    "parallax_occlusion",
    "relief",
    "cone_step",
    "relaxed_cone_step",
];

/// The comparisons of every map and angle, in the order of the points, where both `exact` and a marching technique were timed.
#[must_use]
pub fn all(study: &Study) -> Vec<Versus> {
    let mut cells: Vec<Vec<&Point>> = Vec::new();
    let mut places: BTreeMap<(&str, u64, bool), usize> = BTreeMap::new();
    for point in &study.points {
        let cell = (
            point.map.as_str(),
            point.view_deg.to_bits(),
            point.scene.is_some(),
        );
        let place = *places.entry(cell).or_insert(cells.len());
        if place == cells.len() {
            cells.push(Vec::new());
        }
        cells[place].push(point);
    }
    cells.iter().filter_map(|points| of(points)).collect()
}

/// One cell.
fn of(points: &[&Point]) -> Option<Versus> {
    let exact = points.iter().find(|point| point.technique == "exact")?;
    let ours = rival(exact)?;
    let marching: Vec<Rival> = points
        .iter()
        .filter(|point| MARCHING.contains(&point.technique.as_str()))
        .filter_map(|point| rival(point))
        .collect();
    let (as_exact, gets_there) = at_equal_error(&marching)?;
    let (as_fast, is_as_fast) = at_equal_time(&marching, ours.ms)?;
    Some(Versus {
        map: exact.map.clone(),
        view_deg: exact.view_deg,
        error_texels: EQUAL_ERROR_TEXELS,
        times_faster: as_exact.ms / ours.ms,
        times_smaller: (ours.p99 > 0.0).then(|| as_fast.p99 / ours.p99),
        exact_gets_there: ours.p99 <= EQUAL_ERROR_TEXELS,
        exact: ours,
        at_equal_error: as_exact.clone(),
        gets_there,
        at_equal_time: as_fast.clone(),
        is_as_fast,
    })
}

/// A point as a rival; none without a time, or where some answers are no numbers.
fn rival(point: &Point) -> Option<Rival> {
    let [ms, p99] = pareto::with_error(point, point.time_ms?.median)?;
    Some(Rival {
        technique: point.technique.clone(),
        settings: point.settings.clone(),
        p99,
        ms,
    })
}

/// The fastest that is exact enough, or else the most exact; and whether it is exact enough.
fn at_equal_error(marching: &[Rival]) -> Option<(&Rival, bool)> {
    let there = marching.iter().filter(|rival| rival.p99 <= EQUAL_ERROR_TEXELS);
    let fastest = there
        .min_by(|a, b| a.ms.total_cmp(&b.ms))
        .map(|rival| (rival, true));
    let by_error = |a: &&Rival, b: &&Rival| a.p99.total_cmp(&b.p99).then(a.ms.total_cmp(&b.ms));
    fastest.or_else(|| Some((marching.iter().min_by(by_error)?, false)))
}

/// The most exact that takes no longer, or else the fastest; and whether it takes no longer.
fn at_equal_time(marching: &[Rival], ms: f64) -> Option<(&Rival, bool)> {
    let as_fast = marching.iter().filter(|rival| rival.ms <= ms);
    let best = as_fast
        .min_by(|a, b| a.p99.total_cmp(&b.p99))
        .map(|rival| (rival, true));
    best.or_else(|| Some((marching.iter().min_by(|a, b| a.ms.total_cmp(&b.ms))?, false)))
}

impl Versus {
    /// Whether the goals are for this cell.
    #[must_use]
    pub fn has_goals(&self) -> bool {
        self.view_deg == GOAL_DEG
    }

    /// Whether `exact` is as much faster as the goal says. Where no marching technique gets there, it is not: there is nothing to be faster
    /// than.
    #[must_use]
    pub fn is_faster(&self) -> bool {
        self.gets_there && self.exact_gets_there && self.times_faster >= GOAL_FASTER
    }

    /// Whether its error is as much smaller as the goal says; an error of nothing is.
    #[must_use]
    pub fn is_smaller(&self) -> bool {
        self.is_as_fast && self.times_smaller.is_none_or(|times| times >= GOAL_SMALLER)
    }

    /// The comparison at equal error, in a sentence.
    #[must_use]
    pub fn error_words(&self) -> String {
        let Self {
            exact,
            at_equal_error: rival,
            times_faster,
            error_texels,
            ..
        } = self;
        let times = factor(*times_faster);
        if self.gets_there {
            format!(
                "at p99 of at most {error_texels} texel: {rival} takes {:.3} ms, exact {:.3} ms, {times} times as fast",
                rival.ms, exact.ms
            )
        } else {
            format!(
                "no marching technique has a p99 of at most {error_texels} texel; the nearest, {rival}, has {:.3} and takes {:.3} ms, exact {:.3} ms, {times} times as fast",
                rival.p99, rival.ms, exact.ms
            )
        }
    }

    /// The comparison at equal time, in a sentence.
    #[must_use]
    pub fn time_words(&self) -> String {
        let Self {
            exact,
            at_equal_time: rival,
            ..
        } = self;
        let times = self.times_smaller.map_or_else(
            || "without error".to_owned(),
            |times| format!("{} times smaller", factor(times)),
        );
        if self.is_as_fast {
            format!(
                "in the {:.3} ms of exact: {rival} has a p99 of {:.4} texel, exact {:.2e}, {times}",
                exact.ms, rival.p99, exact.p99
            )
        } else {
            format!(
                "no marching technique takes only the {:.3} ms of exact; the fastest, {rival}, takes {:.3} ms with a p99 of {:.4} texel, exact has {:.2e}, {times}",
                exact.ms, rival.ms, rival.p99, exact.p99
            )
        }
    }
}

/// With as many digits as a ratio of times deserves.
fn factor(value: f64) -> String {
    if value < 100.0 {
        format!("{value:.2}")
    } else {
        format!("{value:.0}")
    }
}

impl fmt::Display for Rival {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let words = format!("{} {}", self.technique, self.settings);
        f.write_str(words.trim_end())
    }
}

#[cfg(test)]
mod tests {
    use super::all;
    use crate::record::{Point, Settings, Study, Versus};
    use crate::sample::{around, errors, point};

    fn timed(technique: &str, layers: f64, ms: f64, p99: f64) -> Point {
        Point {
            settings: Settings::of([("layers", layers)]),
            time_ms: Some(around(ms)),
            error_texels: errors(p99),
            ..point(technique, "bricks", 75.0)
        }
    }

    fn only(points: Vec<Point>) -> Versus {
        let study = Study {
            points,
            ..Study::default()
        };
        let [versus] = all(&study).try_into().unwrap();
        versus
    }

    #[test]
    fn both_factors_come_from_the_points() {
        let versus = only(vec![
            timed("exact", 0.0, 2.0, 0.001),
            timed("parallax_occlusion", 64.0, 1.0, 3.0),
            timed("parallax_occlusion", 128.0, 1.9, 0.6),
            timed("parallax_occlusion", 256.0, 7.0, 0.4),
            timed("relief", 128.0, 9.0, 0.1),
            // It does not march.
            timed("parallax_offset", 0.0, 0.1, 0.1),
        ]);
        assert_eq!(versus.times_faster, 3.5);
        assert!((versus.times_smaller.unwrap() - 600.0).abs() < 1e-9);
        assert!(versus.gets_there && versus.is_as_fast && versus.has_goals());
        assert!(versus.is_faster() && versus.is_smaller());
        assert_eq!(versus.at_equal_error.to_string(), "parallax_occlusion layers=256");
        assert!(
            versus.error_words().contains("3.50 times as fast"),
            "{}",
            versus.error_words()
        );
        assert!(
            versus.time_words().contains("600 times smaller"),
            "{}",
            versus.time_words()
        );
    }

    #[test]
    fn goals_that_are_missed_are_missed() {
        let versus = only(vec![
            timed("exact", 0.0, 4.0, 0.1),
            timed("parallax_occlusion", 64.0, 3.0, 0.5),
        ]);
        assert_eq!((versus.times_faster, versus.times_smaller), (0.75, Some(5.0)));
        assert!(!versus.is_faster() && !versus.is_smaller());
    }

    #[test]
    fn who_does_not_get_there_is_no_proof() {
        let versus = only(vec![
            timed("exact", 0.0, 1.0, 0.0),
            timed("parallax_occlusion", 64.0, 30.0, 0.7),
            timed("parallax_occlusion", 16.0, 10.0, 9.0),
        ]);
        assert!(
            !versus.gets_there && !versus.is_faster(),
            "thirty times slower, and not there"
        );
        assert!(versus.error_words().starts_with("no marching technique has"));
        assert!(!versus.is_as_fast && !versus.is_smaller());
        assert_eq!(versus.at_equal_time.ms, 10.0);
        assert_eq!(versus.times_smaller, None);
        assert!(
            versus
                .time_words()
                .starts_with("no marching technique takes only")
        );
    }

    #[test]
    fn what_was_not_timed_or_lost_rays_is_not_compared() {
        let mut untimed = timed("exact", 0.0, 1.0, 0.0);
        untimed.time_ms = None;
        let mut lost = timed("relief", 16.0, 1.0, 0.0);
        lost.disagreement.lost = 0.01;
        let study = |points| Study {
            points,
            ..Study::default()
        };
        assert!(all(&study(vec![untimed, timed("relief", 16.0, 1.0, 0.0)])).is_empty());
        assert!(all(&study(vec![timed("exact", 0.0, 1.0, 0.0), lost])).is_empty());
        // Another angle is another cell.
        let mut elsewhere = timed("relief", 16.0, 1.0, 0.0);
        elsewhere.view_deg = 60.0;
        assert!(all(&study(vec![timed("exact", 0.0, 1.0, 0.0), elsewhere])).is_empty());
    }
}
