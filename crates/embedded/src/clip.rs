//! Clipping of triangles in homogeneous coordinates (Sutherland and Hodgman, *Reentrant Polygon Clipping*, 1974), in f64.
//!
//! Clipped at the near plane (0 ≤ z), the far plane (z ≤ w) and a guard band far outside of the picture, which bounds window
//! coordinates. The sides of the picture itself need no clipping: coverage is asked for at its pixels alone.
//!
//! Where an edge crosses a plane, the crossing is computed from the end inside to the end outside. Two triangles that share an
//! edge therefore get the very same point, and no gap opens between them.

/// A position in clip space: x, y, z, w.
pub(crate) type Clip = [f64; 4];

/// Pixels from the picture's middle at which the guard band lies; pictures are at most half as wide.
const GUARD_PIXELS: f64 = 32_768.0;

/// How many half pictures from the middle the guard band is, along x and y.
pub(crate) fn guard_band(width: u32, height: u32) -> [f64; 2] {
    [width, height].map(|side| 2.0 * GUARD_PIXELS / f64::from(side))
}

/// Signed distances from the six planes; inside is not negative.
fn distances([x, y, z, w]: Clip, [gx, gy]: [f64; 2]) -> [f64; 6] {
    [z, w - z, gx * w + x, gx * w - x, gy * w + y, gy * w - y]
}

/// The convex polygon that is left of a triangle, in its order; empty where nothing is. Corners have w > 0.
pub(crate) fn clip(triangle: &[Clip; 3], guard: [f64; 2]) -> Vec<Clip> {
    let mut polygon = triangle.to_vec();
    if polygon.iter().flatten().any(|x| !x.is_finite()) {
        return Vec::new();
    }
    for plane in 0..6 {
        let distance = |corner: &Clip| distances(*corner, guard)[plane];
        if polygon.iter().all(|corner| distance(corner) >= 0.0) {
            continue;
        }
        polygon = clip_at(&polygon, distance);
    }
    if polygon.len() < 3 || polygon.iter().any(|corner| corner[3] <= 0.0) {
        return Vec::new();
    }
    polygon
}

fn clip_at(polygon: &[Clip], distance: impl Fn(&Clip) -> f64) -> Vec<Clip> {
    let mut left = Vec::with_capacity(polygon.len() + 1);
    for (at, a) in polygon.iter().enumerate() {
        let b = &polygon[(at + 1) % polygon.len()];
        let (da, db) = (distance(a), distance(b));
        if da >= 0.0 {
            left.push(*a);
        }
        if (da >= 0.0) != (db >= 0.0) {
            left.push(if da >= 0.0 {
                crossing(a, da, b, db)
            } else {
                crossing(b, db, a, da)
            });
        }
    }
    left
}

/// Where the edge from a corner inside to one outside meets the plane.
fn crossing(inside: &Clip, di: f64, outside: &Clip, d_outside: f64) -> Clip {
    let t = di / (di - d_outside);
    std::array::from_fn(|k| inside[k] + t * (outside[k] - inside[k]))
}

#[cfg(test)]
mod tests {
    use super::*;

    const GUARD: [f64; 2] = [100.0, 100.0];

    #[test]
    fn what_is_inside_stays_as_it_is() {
        let triangle = [
            [0.0, 0.0, 0.5, 1.0],
            [90.0, 0.0, 0.5, 1.0],
            [0.0, -90.0, 1.0, 1.0],
        ];
        assert_eq!(clip(&triangle, GUARD), triangle);
    }

    #[test]
    fn near_plane_cuts_one_corner_into_two_and_two_into_one() {
        let [a, b, c] = [[0.0, 0.0, 1.0, 2.0], [1.0, 0.0, 1.0, 2.0], [0.0, 1.0, -1.0, 0.5]];
        let four = clip(&[a, b, c], GUARD);
        assert_eq!(four.len(), 4);
        assert!(four.iter().all(|corner| corner[2] >= 0.0 && corner[3] > 0.0));
        // Half-way between z = 1 and z = −1.
        assert!(four.contains(&[0.0, 0.5, 0.0, 1.25]), "{four:?}");
        let three = clip(&[c, [1.0, 1.0, -1.0, 0.5], a], GUARD);
        assert_eq!(three.len(), 3);
    }

    #[test]
    fn what_lies_behind_the_eye_beyond_the_far_plane_or_nowhere_is_gone() {
        let at = |z: f64, w: f64| [[0.0, 0.0, z, w], [1.0, 0.0, z, w], [0.0, 1.0, z, w]];
        assert!(clip(&at(-0.5, -1.0), GUARD).is_empty());
        assert!(clip(&at(1.5, 1.0), GUARD).is_empty());
        assert!(clip(&at(0.0, 0.0), GUARD).is_empty());
        assert!(clip(&at(f64::NAN, 1.0), GUARD).is_empty());
        assert!(!clip(&at(0.5, 1.0), GUARD).is_empty());
    }

    #[test]
    fn a_shared_edge_is_cut_at_the_same_point_from_both_sides() {
        let (a, b) = ([0.3, 0.1, 0.7, 1.1], [-0.2, 0.9, -0.6, 0.4]);
        let (c, d) = ([1.0, 0.0, 0.5, 1.0], [-1.0, 0.0, 0.5, 1.0]);
        let (left, right) = (clip(&[a, b, c], GUARD), clip(&[b, a, d], GUARD));
        let shared: Vec<_> = left.iter().filter(|corner| right.contains(corner)).collect();
        assert_eq!(
            shared.len(),
            2,
            "the inner end and the crossing: {left:?} {right:?}"
        );
    }

    #[test]
    fn guard_band_bounds_window_coordinates() {
        let guard = guard_band(640, 480);
        let huge = [
            [-1e9, -1e9, 0.5, 1.0],
            [1e9, -1e9, 0.5, 1.0],
            [0.0, 1e9, 0.5, 1.0],
        ];
        let polygon = clip(&huge, guard);
        assert!(!polygon.is_empty());
        for [x, y, _, w] in polygon {
            assert!((x / w * 320.0).abs() <= GUARD_PIXELS + 1e-6, "{x} / {w}");
            assert!((y / w * 240.0).abs() <= GUARD_PIXELS + 1e-6, "{y} / {w}");
        }
    }
}
