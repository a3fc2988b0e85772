//! What the eye does to a picture before it compares: contrast sensitivity, and the finding of edges and points.
//!
//! All kernels are products of a kernel along rows and one along columns, or sums of such. At the picture's border the
//! outermost pixel goes on.

use std::f64::consts::PI;

/// One channel, row by row.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Plane {
    width: usize,
    height: usize,
    pub(super) values: Vec<f64>,
}

/// Strengths at a pixel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Features {
    pub(super) edge: f64,
    pub(super) point: f64,
}

/// Terms `a·√(π/b)·exp(−π²x²/b)` of the contrast sensitivity of luminance, red–green and blue–yellow; x in degrees.
const SENSITIVITY: [&[[f64; 2]]; 3] = [&[[1.0, 0.0047]], &[[1.0, 0.0053]], &[[34.1, 0.04], [13.5, 0.025]]];

/// Width of the features that the eye sees best, degrees.
const FEATURE_WIDTH: f64 = 0.082;

impl Plane {
    pub(super) const fn new(width: usize, height: usize, values: Vec<f64>) -> Self {
        Self {
            width,
            height,
            values,
        }
    }

    /// Along rows with one kernel, then along columns with the other.
    fn filtered(&self, along_rows: &[f64], along_columns: &[f64]) -> Self {
        let half = self.along(along_rows, |x, y, offset| (clamped(x, offset, self.width), y));
        half.along(along_columns, |x, y, offset| (x, clamped(y, offset, self.height)))
    }

    fn along(&self, kernel: &[f64], at: impl Fn(usize, usize, isize) -> (usize, usize)) -> Self {
        let radius = (kernel.len() / 2) as isize;
        let mut values = Vec::with_capacity(self.values.len());
        for y in 0..self.height {
            for x in 0..self.width {
                let sum = kernel.iter().zip(-radius..).map(|(weight, offset)| {
                    let (x, y) = at(x, y, offset);
                    weight * self.values[y * self.width + x]
                });
                values.push(sum.sum());
            }
        }
        Self { values, ..*self }
    }
}

fn clamped(place: usize, offset: isize, length: usize) -> usize {
    place.saturating_add_signed(offset).min(length - 1)
}

/// The channels as the eye passes them on.
pub(super) fn contrast_sensitivity(channels: &[Plane; 3], pixels_per_degree: f64) -> [Plane; 3] {
    let widest = SENSITIVITY
        .iter()
        .copied()
        .flatten()
        .map(|[_, b]| *b)
        .fold(0.0, f64::max);
    let radius = (3.0 * (widest / (2.0 * PI * PI)).sqrt() * pixels_per_degree).ceil() as i32;
    [0, 1, 2].map(|channel| {
        let terms: Vec<(f64, Vec<f64>)> = SENSITIVITY[channel]
            .iter()
            .map(|[a, b]| {
                let gauss = |x: i32| {
                    let degrees = f64::from(x) / pixels_per_degree;
                    (-PI * PI * degrees * degrees / b).exp()
                };
                (a * (PI / b).sqrt(), (-radius..=radius).map(gauss).collect())
            })
            .collect();
        sum_of(&channels[channel], &terms)
    })
}

/// A sum of products of kernels, scaled so that all weights sum to 1.
fn sum_of(plane: &Plane, terms: &[(f64, Vec<f64>)]) -> Plane {
    let total: f64 = terms
        .iter()
        .map(|(factor, kernel)| factor * kernel.iter().sum::<f64>().powi(2))
        .sum();
    let mut values = vec![0.0; plane.values.len()];
    for (factor, kernel) in terms {
        let part = plane.filtered(kernel, kernel);
        for (value, part) in values.iter_mut().zip(part.values) {
            *value += factor / total * part;
        }
    }
    Plane { values, ..*plane }
}

/// Edges and points of the luminance channel of YCxCz.
pub(super) fn features(luminance: &Plane, pixels_per_degree: f64) -> Vec<Features> {
    let grey = Plane {
        values: luminance.values.iter().map(|y| (y + 16.0) / 116.0).collect(),
        ..*luminance
    };
    let deviation = 0.5 * FEATURE_WIDTH * pixels_per_degree;
    let radius = (3.0 * deviation).ceil() as i32;
    let kernel = |weight: &dyn Fn(f64) -> f64| -> Vec<f64> {
        (-radius..=radius).map(|x| weight(f64::from(x))).collect()
    };
    let gauss = |x: f64| (-x * x / (2.0 * deviation * deviation)).exp();
    let smooth = balanced(kernel(&gauss));
    let slope = balanced(kernel(&|x| -x * gauss(x)));
    let bend = balanced(kernel(&|x| (x * x / (deviation * deviation) - 1.0) * gauss(x)));
    let strengths = |across: &[f64]| -> Vec<f64> {
        let along_x = grey.filtered(across, &smooth).values;
        let along_y = grey.filtered(&smooth, across).values;
        along_x.iter().zip(along_y).map(|(x, y)| x.hypot(y)).collect()
    };
    let (edges, points) = (strengths(&slope), strengths(&bend));
    edges
        .into_iter()
        .zip(points)
        .map(|(edge, point)| Features { edge, point })
        .collect()
}

/// Scaled so that positive weights sum to 1 and negative ones to −1.
fn balanced(kernel: Vec<f64>) -> Vec<f64> {
    let positive: f64 = kernel.iter().filter(|weight| **weight > 0.0).sum();
    let negative: f64 = -kernel.iter().filter(|weight| **weight < 0.0).sum::<f64>();
    let scaled = |weight: f64| {
        if weight > 0.0 {
            weight / positive
        } else if weight < 0.0 {
            weight / negative
        } else {
            0.0
        }
    };
    kernel.into_iter().map(scaled).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn plane(value: impl Fn(usize, usize) -> f64) -> Plane {
        let values = (0..30 * 20).map(|index| value(index % 30, index / 30)).collect();
        Plane::new(30, 20, values)
    }

    #[test]
    fn what_is_even_stays_as_it_is_and_has_no_features() {
        let even = || plane(|_, _| 42.0);
        for filtered in contrast_sensitivity(&[even(), even(), even()], 67.0) {
            assert!(filtered.values.iter().all(|value| (value - 42.0).abs() < 1e-9));
        }
        assert!(
            features(&even(), 67.0)
                .iter()
                .all(|found| found.edge < 1e-12 && found.point < 1e-12)
        );
    }

    #[test]
    fn edges_and_points_are_found_where_they_are() {
        // An edge from black to white is strongest beside it: half of the weights see white, and they sum to 1.
        let edge = features(&plane(|x, _| if x < 15 { -16.0 } else { 100.0 }), 67.0);
        assert!(edge[10 * 30 + 15].edge > 0.8 && edge[10 * 30].edge < 0.01);
        let dot = features(
            &plane(|x, y| if (x, y) == (15, 10) { 100.0 } else { -16.0 }),
            67.0,
        );
        let strongest = (0..dot.len())
            .max_by(|a, b| dot[*a].point.total_cmp(&dot[*b].point))
            .unwrap();
        assert_eq!((strongest % 30, strongest / 30), (15, 10));
    }
}
