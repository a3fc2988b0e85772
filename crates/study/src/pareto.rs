//! Which points nothing beats: the Pareto front of cost and error.
//!
//! A point is on the front when no other point is at least as good in both and better in one. Equal points share their
//! place: all of them are on the front or none is. A point without a cost is never on it.

use std::collections::BTreeMap;

use crate::record::Point;

/// Marks [`Point::pareto`] by median time and p99 error, each map and view angle for itself.
pub fn mark(points: &mut [Point]) {
    let mut groups: BTreeMap<(String, u64), Vec<usize>> = BTreeMap::new();
    for (index, point) in points.iter().enumerate() {
        let group = (point.map.clone(), point.view_deg.to_bits());
        groups.entry(group).or_default().push(index);
    }
    for indices in groups.values() {
        let costs: Vec<Option<[f64; 2]>> = indices
            .iter()
            .map(|&index| time_and_error(&points[index]))
            .collect();
        for (&index, on_front) in indices.iter().zip(front(&costs)) {
            points[index].pareto = on_front;
        }
    }
}

/// Median time and p99 error; none without a time, or where some answers are no numbers: what is left of such a point flatters it.
fn time_and_error(point: &Point) -> Option<[f64; 2]> {
    with_error(point, point.time_ms?.median)
}

/// A cost beside the p99 error of a point whose answers are all numbers.
pub(crate) fn with_error(point: &Point, cost: f64) -> Option<[f64; 2]> {
    (point.disagreement.lost == 0.0).then_some([cost, point.error_texels.p99])
}

/// For each pair of a cost and an error whether it is on the front. What is absent or not a number is not.
///
/// ```
/// use bossage_study::pareto::front;
///
/// let points = [Some([1.0, 8.0]), Some([2.0, 3.0]), Some([2.0, 4.0]), None];
/// assert_eq!(front(&points), [true, true, false, false]);
/// ```
#[must_use]
pub fn front(points: &[Option<[f64; 2]>]) -> Vec<bool> {
    let mut order: Vec<(usize, [f64; 2])> = points
        .iter()
        .enumerate()
        .filter_map(|(index, point)| Some((index, (*point)?)))
        .filter(|(_, [cost, error])| !cost.is_nan() && !error.is_nan())
        .collect();
    order.sort_by(|(_, a), (_, b)| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])));
    let mut on_front = vec![false; points.len()];
    let mut best: Option<[f64; 2]> = None;
    for (index, point) in order {
        let is_better = best.is_none_or(|best| point[1] < best[1]);
        if is_better {
            best = Some(point);
        }
        on_front[index] = is_better || best == Some(point);
    }
    on_front
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::record::{ErrorTexels, Time};
    use crate::sample;

    /// The definition, word by word.
    fn by_definition(points: &[Option<[f64; 2]>]) -> Vec<bool> {
        let beats = |a: [f64; 2], b: [f64; 2]| a[0] <= b[0] && a[1] <= b[1] && a != b;
        let is_on_front = |point: &Option<[f64; 2]>| {
            point.is_some_and(|point| !points.iter().flatten().any(|other| beats(*other, point)))
        };
        points.iter().map(is_on_front).collect()
    }

    /// Few distinct values, so that ties and equal points are common.
    fn cost() -> impl Strategy<Value = Option<[f64; 2]>> {
        proptest::option::weighted(0.9, [0..6, 0..6].prop_map(|pair| pair.map(f64::from)))
    }

    proptest! {
        #[test]
        fn the_front_is_what_its_definition_says(points in proptest::collection::vec(cost(), 0..40)) {
            prop_assert_eq!(front(&points), by_definition(&points));
        }
    }

    #[test]
    fn ties_and_equal_points() {
        let points = [
            [1.0, 5.0],
            [1.0, 4.0],
            [1.0, 4.0],
            [2.0, 4.0],
            [3.0, 0.0],
            [3.0, -0.0],
        ]
        .map(Some);
        assert_eq!(front(&points), [false, true, true, false, true, true]);
        assert_eq!(front(&[None, Some([1.0, f64::NAN])]), [false, false]);
        assert_eq!(front(&[]), [false; 0]);
    }

    #[test]
    fn maps_and_angles_have_fronts_of_their_own_and_untimed_points_none() {
        let point = |map: &str, view_deg: f64, time: Option<f64>, p99: f64| {
            let mut point = sample::point("exact", map, view_deg);
            point.time_ms = time.map(|median| Time {
                median,
                min: median,
                max: median,
                runs: 9,
            });
            point.error_texels = ErrorTexels {
                p99,
                ..ErrorTexels::default()
            };
            point.pareto = true;
            point
        };
        let mut points = [
            point("bricks", 60.0, Some(1.0), 1.0),
            point("bricks", 60.0, Some(2.0), 2.0),
            point("bricks", 75.0, Some(2.0), 2.0),
            point("dunes", 60.0, Some(2.0), 2.0),
            point("dunes", 60.0, None, 0.0),
            point("dunes", 60.0, Some(1.0), 0.0),
        ];
        points[5].disagreement.lost = 0.1;
        mark(&mut points);
        assert_eq!(
            points.map(|point| point.pareto),
            [true, false, true, true, false, false]
        );
    }
}
