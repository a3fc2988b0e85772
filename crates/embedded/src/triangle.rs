//! A triangle in clip space, and what its corners weigh at a point of the picture.
//!
//! Weights come from the whole triangle in homogeneous coordinates (Olano and Greer, *Triangle Scan Conversion using 2D
//! Homogeneous Coordinates*, 1997), so that clipping does not touch them. At a point (X, Y) of the picture, with
//! aᵢ = (xᵢ − X·wᵢ, yᵢ − Y·wᵢ) and cᵢ = aⱼ × aₖ: the perspective weight of corner i is cᵢ / Σc, and 1/w = Σc / Σ(c·w). All in f64,
//! where the relative error is about 2⁻⁵⁰ for triangles that are not needles, far below the f32 that a result is rounded to.

use crate::clip::Clip;

/// A triangle that faces somewhere.
#[derive(Clone, Debug)]
pub(crate) struct Triangle {
    /// Numbers of its corners.
    pub(crate) corners: [u32; 3],
    /// Positions of its corners.
    pub(crate) clip: [Clip; 3],
    /// Whether it is seen from its front, counter-clockwise.
    pub(crate) is_front: bool,
    /// Its number in the draw.
    pub(crate) number: u32,
}

/// Weights of the corners at a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Weights {
    /// With perspective.
    pub(crate) perspective: [f64; 3],
    /// Linear in the picture.
    pub(crate) linear: [f64; 3],
    /// z / w there.
    pub(crate) depth: f64,
    /// 1 / w there.
    pub(crate) inverse_w: f64,
}

fn cross(a: [f64; 2], b: [f64; 2]) -> f64 {
    a[0] * b[1] - a[1] * b[0]
}

/// cᵢ at a point.
fn crosses(clip: &[Clip; 3], [px, py]: [f64; 2]) -> [f64; 3] {
    let [a, b, c] = clip.map(|[x, y, _, w]| [x - px * w, y - py * w]);
    [cross(b, c), cross(c, a), cross(a, b)]
}

/// The sum of products.
fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

impl Triangle {
    /// A triangle of a draw; `None` without area or with a position that is no number.
    pub(crate) fn new(number: u32, corners: [u32; 3], clip: [Clip; 3]) -> Option<Self> {
        let area = dot(crosses(&clip, [0.0, 0.0]), clip.map(|corner| corner[3]));
        (area.is_finite() && area != 0.0).then_some(Self {
            corners,
            clip,
            is_front: area > 0.0,
            number,
        })
    }

    /// The weights at a point, in normalised device coordinates.
    pub(crate) fn weights(&self, point: [f64; 2]) -> Weights {
        let c = crosses(&self.clip, point);
        let part = |k: usize| self.clip.map(|corner| corner[k]);
        let (sum, area) = (c[0] + c[1] + c[2], dot(c, part(3)));
        Weights {
            perspective: c.map(|c| c / sum),
            linear: std::array::from_fn(|i| c[i] * self.clip[i][3] / area),
            depth: dot(c, part(2)) / area,
            inverse_w: sum / area,
        }
    }
}

impl Weights {
    /// A value that the corners have, here, rounded to f32.
    pub(crate) fn mix(weights: [f64; 3], values: [f64; 3]) -> f64 {
        f64::from(dot(weights, values) as f32)
    }

    /// The depth that the depth buffer takes.
    pub(crate) fn depth(&self) -> f32 {
        self.depth.clamp(0.0, 1.0) as f32
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Equal up to some roundings of f64.
    fn close(a: [f64; 3], b: [f64; 3]) -> bool {
        a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-14)
    }

    fn triangle(clip: [Clip; 3]) -> Triangle {
        Triangle::new(0, [0, 1, 2], clip).unwrap()
    }

    #[test]
    fn corners_weigh_one_at_their_place() {
        let clip = [[-1.0, -1.0, 0.2, 2.0], [3.0, 0.0, 0.9, 3.0], [0.0, 0.5, 0.1, 0.5]];
        let triangle = triangle(clip);
        for (i, [x, y, z, w]) in clip.into_iter().enumerate() {
            let weights = triangle.weights([x / w, y / w]);
            let expected = std::array::from_fn(|k| f64::from(u8::from(i == k)));
            assert!(close(weights.perspective, expected), "{weights:?}");
            assert!(close(weights.linear, expected), "{weights:?}");
            assert!((weights.depth - z / w).abs() < 1e-14);
            assert!((weights.inverse_w - 1.0 / w).abs() < 1e-14);
        }
    }

    /// A point of the triangle in space is seen where it projects to; the weights there are those it was made with.
    #[test]
    fn perspective_undoes_the_projection() {
        let clip = [
            [-1.0, -1.0, 0.5, 1.0],
            [4.0, -4.0, 3.5, 4.0],
            [0.0, 9.0, 8.5, 9.0],
        ];
        let triangle = triangle(clip);
        for weights in [[0.2, 0.3, 0.5], [0.9, 0.05, 0.05], [1.0 / 3.0; 3]] {
            let at = |k: usize| dot(weights, clip.map(|corner| corner[k]));
            let seen = triangle.weights([at(0) / at(3), at(1) / at(3)]);
            assert!(close(seen.perspective, weights), "{seen:?}");
            assert!((seen.depth - at(2) / at(3)).abs() < 1e-14);
            // Negative control: weights without perspective are others here.
            assert!(!close(seen.linear, weights));
        }
    }

    #[test]
    fn a_corner_behind_the_eye_does_not_spoil_the_weights() {
        let clip = [
            [-1.0, -1.0, 0.5, 1.0],
            [1.0, -1.0, 0.5, 1.0],
            [0.0, 4.0, -3.0, -1.0],
        ];
        let triangle = triangle(clip);
        let weights = [0.4, 0.4, 0.2];
        let at = |k: usize| dot(weights, clip.map(|corner| corner[k]));
        let seen = triangle.weights([at(0) / at(3), at(1) / at(3)]);
        assert!(close(seen.perspective, weights), "{seen:?}");
    }

    #[test]
    fn facing_is_counter_clockwise_and_no_area_is_no_triangle() {
        let [a, b, c] = [[0.0, 0.0, 0.0, 1.0], [1.0, 0.0, 0.0, 1.0], [0.0, 1.0, 0.0, 1.0]];
        assert!(triangle([a, b, c]).is_front);
        assert!(!triangle([a, c, b]).is_front);
        assert!(Triangle::new(0, [0, 1, 2], [a, b, b]).is_none());
        assert!(Triangle::new(0, [0, 1, 2], [a, b, [f64::NAN, 0.0, 0.0, 1.0]]).is_none());
    }

    #[test]
    fn equal_values_stay_equal_and_sums_are_rounded_once() {
        let weights = [1.0 / 3.0, 1.0 / 3.0, 1.0 / 3.0];
        assert_eq!(
            Weights::mix(weights, [0.1_f32; 3].map(f64::from)),
            f64::from(0.1_f32)
        );
        assert_eq!(Weights::mix([0.5, 0.25, 0.25], [1.0, 2.0, 4.0]), 2.0);
    }
}
