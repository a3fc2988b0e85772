//! Pixels into comparisons: a picture against the reference, and two pictures of one surface against each other.

use std::collections::BTreeMap;

use super::expected::Fragment;
use super::pixels::Pixel;
use crate::bound::Bound;
use crate::compare::{Comparison, Expected};

/// Every pixel against both oracles: whether the alpha test kept it, and its four channels.
pub(super) fn judged(pixels: &[Pixel], mut comparison: Comparison) -> Comparison {
    for pixel in pixels {
        let Fragment {
            truth,
            color,
            kept,
            depth: expected,
        } = pixel.expected;
        comparison.item(
            &pixel.place,
            &[flag(pixel.got.is_some())],
            &[whether(truth.is_some(), kept)],
        );
        if let (Some(got), Some(truth)) = (pixel.got, truth) {
            comparison.item(&pixel.place, &got, &colours(truth, color));
            if let (Some(got), Some(expected)) = (pixel.depth, expected) {
                comparison.item(&pixel.place, &[got], &[depth(expected)]);
            }
        }
    }
    comparison
}

/// The planned picture and the one with all effects, which are one surface.
///
/// At the points of the full picture each shader's truth must lie in the interval of the other (`planned_there` is what the planned
/// shader should be at those points): both compute the same, so both truths are in both intervals. The pictures themselves may differ
/// by what the two intervals leave between them, each at its own points, since two vertex stages may round differently.
pub(super) fn agreement(
    planned: &[Pixel],
    full: &[Pixel],
    planned_there: &[Fragment],
    mut comparison: Comparison,
) -> Comparison {
    for (full, there) in full.iter().zip(planned_there) {
        crossed(full, there, &mut comparison);
    }
    let key = |pixel: &Pixel| (pixel.place[0] as u32, pixel.place[1] as u32);
    let full: BTreeMap<(u32, u32), &Pixel> = full.iter().map(|pixel| (key(pixel), pixel)).collect();
    for planned in planned {
        if let Some(full) = full.get(&key(planned)) {
            apart(planned, full, &mut comparison);
        }
    }
    comparison
}

/// The full picture's pixel with the planned shader's truth, and the full shader's truth in the planned shader's interval.
fn crossed(full: &Pixel, planned: &Fragment, comparison: &mut Comparison) {
    let other = full.expected;
    comparison.item(
        &full.place,
        &[flag(full.got.is_some()), flag(other.truth.is_some())],
        &[
            whether(planned.truth.is_some(), other.kept),
            whether(planned.truth.is_some(), planned.kept),
        ],
    );
    if let (Some(got), Some(other_truth), Some(truth)) = (full.got, other.truth, planned.truth) {
        comparison.item(&full.place, &got, &colours(truth, other.color));
        // The nearest float: an interval's ends are floats, so none lies outside that the truth is not.
        let nearest = other_truth.map(|channel| channel as f32);
        comparison.item(&full.place, &nearest, &colours(other_truth, planned.color));
        if let (Some(got), Some(expected)) = (full.depth, planned.depth) {
            comparison.item(&full.place, &[got], &[depth(expected)]);
        }
    }
}

/// How far apart two pixels of one place are.
fn apart(planned: &Pixel, full: &Pixel, comparison: &mut Comparison) {
    let (a, b) = (planned.expected, full.expected);
    let same = Bound::exactly(1.0);
    let either = Bound::between(0.0, 1.0).forked();
    let decided = !a.kept.is_forked() && !b.kept.is_forked();
    let alike = flag(planned.got.is_some() == full.got.is_some());
    comparison.item(
        &planned.place,
        &[alike],
        &[Expected {
            truth: 1.0,
            bound: if decided { same } else { either },
        }],
    );
    let (Some(got), Some(other), Some(truth), Some(other_truth)) = (planned.got, full.got, a.truth, b.truth)
    else {
        return;
    };
    let difference = |i: usize| Expected {
        truth: truth[i] - other_truth[i],
        bound: a.color[i].minus(b.color[i]),
    };
    let got: [f32; 4] = std::array::from_fn(|i| got[i] - other[i]);
    comparison.item(&planned.place, &got, &[0, 1, 2, 3].map(difference));
}

fn depth((truth, bound): (f64, Bound)) -> Expected {
    Expected { truth, bound }
}

pub(super) fn colours(truth: [f64; 4], bounds: [Bound; 4]) -> [Expected; 4] {
    std::array::from_fn(|i| Expected {
        truth: truth[i],
        bound: bounds[i],
    })
}

fn whether(truth: bool, bound: Bound) -> Expected {
    Expected {
        truth: f64::from(flag(truth)),
        bound,
    }
}

fn flag(is_so: bool) -> f32 {
    f32::from(u8::from(is_so))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::compare::Refusal;

    fn fragment(truth: f64, slack: f64) -> Fragment {
        Fragment {
            truth: Some([truth; 4]),
            color: [Bound::between(truth - slack, truth + slack); 4],
            kept: Bound::exactly(1.0),
            depth: None,
        }
    }

    fn pixel(got: Option<f32>, expected: Fragment) -> Pixel {
        Pixel {
            place: vec![3.0, 5.0],
            got: got.map(|x| [x; 4]),
            depth: None,
            expected,
        }
    }

    fn of(pixel: Pixel) -> Comparison {
        judged(&[pixel], Comparison::default())
    }

    #[test]
    fn a_colour_in_its_interval_passes_and_another_does_not() {
        assert_eq!(of(pixel(Some(0.5), fragment(0.5, 0.01))).refused, 0);
        assert_eq!(of(pixel(Some(0.52), fragment(0.5, 0.01))).refused, 4);
    }

    #[test]
    fn a_pixel_cut_out_that_should_be_there_is_refused_unless_that_is_undecided() {
        assert_eq!(of(pixel(None, fragment(0.5, 0.01))).refused, 1);
        let undecided = Fragment {
            kept: Bound::between(0.0, 1.0).forked(),
            ..fragment(0.5, 0.01)
        };
        let comparison = of(pixel(None, undecided));
        assert_eq!((comparison.refused, comparison.forked), (0, 1));
        let gone = Fragment {
            truth: None,
            kept: Bound::exactly(0.0),
            ..fragment(0.5, 0.01)
        };
        assert_eq!(of(pixel(Some(0.5), gone)).refused, 1);
    }

    #[test]
    fn a_depth_outside_of_its_interval_is_refused() {
        let deep = |depth: f32| {
            let expected = Fragment {
                depth: Some((0.5, Bound::between(0.49, 0.51))),
                ..fragment(0.5, 0.01)
            };
            of(Pixel {
                depth: Some(depth),
                ..pixel(Some(0.5), expected)
            })
        };
        assert_eq!((deep(0.5).refused, deep(0.52).refused), (0, 1));
    }

    #[test]
    fn the_truth_of_a_plan_that_drops_what_shows_lies_outside() {
        let full = [pixel(Some(0.5), fragment(0.5, 0.01))];
        let agree = |planned: Fragment| {
            let planned_pixel = [pixel(planned.truth.map(|t| t[0] as f32), planned)];
            agreement(&planned_pixel, &full, &[planned], Comparison::default())
        };
        assert_eq!(agree(fragment(0.505, 0.02)).refused, 0);
        // The sum of both bounds would have let this pass: the pictures are 0.015 apart, the bounds leave 0.03.
        let dropped = agree(fragment(0.515, 0.02));
        assert_eq!(dropped.refusal, Some(Refusal::OraclesDisagree));
        assert!(agree(fragment(0.6, 0.01)).refused > 4);
    }
}
