//! Cube maps: faces from directions, and texels across edges.
//!
//! Source: the Vulkan specification, *Cube Map Face Selection and Transformations*. Filtering is seamless: a texel beyond an edge is
//! the one on the neighbouring face; beyond a corner, where no texel is, the three around it are averaged.

use super::Bounds;

/// The axis and the sign of the major direction of each face, and the axes and signs of its s and t coordinates.
const FACES: [Face; 6] = [
    Face {
        major: (0, 1.0),
        s: (2, -1.0),
        t: (1, -1.0),
    },
    Face {
        major: (0, -1.0),
        s: (2, 1.0),
        t: (1, -1.0),
    },
    Face {
        major: (1, 1.0),
        s: (0, 1.0),
        t: (2, 1.0),
    },
    Face {
        major: (1, -1.0),
        s: (0, 1.0),
        t: (2, -1.0),
    },
    Face {
        major: (2, 1.0),
        s: (0, 1.0),
        t: (1, -1.0),
    },
    Face {
        major: (2, -1.0),
        s: (0, -1.0),
        t: (1, -1.0),
    },
];

struct Face {
    major: (usize, f64),
    s: (usize, f64),
    t: (usize, f64),
}

/// A face and the bounds of the coordinates on it, in [0, 1].
pub(crate) type OnFace = (u32, [Bounds; 2]);

/// The faces that directions within the bounds may select.
pub(crate) fn faces(direction: [Bounds; 3], uncertain: bool) -> Vec<OnFace> {
    if !uncertain {
        return vec![point_face(direction.map(|b| b.0))];
    }
    (0..6u32)
        .filter_map(|face| bounded_face(face, direction))
        .collect()
}

/// The face of one direction; on a tie z goes before y, and y before x.
fn point_face(d: [f64; 3]) -> OnFace {
    let a = d.map(f64::abs);
    let axis = if a[2] >= a[0] && a[2] >= a[1] {
        2
    } else if a[1] >= a[0] {
        1
    } else {
        0
    };
    let face = 2 * axis as u32 + u32::from(d[axis] < 0.0);
    let f = &FACES[face as usize];
    let on = |(k, sign): (usize, f64)| 0.5 * (sign * d[k] / a[axis] + 1.0);
    let (s, t) = (on(f.s), on(f.t));
    (face, [(s, s), (t, t)])
}

fn bounded_face(face: u32, d: [Bounds; 3]) -> Option<OnFace> {
    let f = &FACES[face as usize];
    let along = |(k, sign): (usize, f64)| if sign > 0.0 { d[k] } else { (-d[k].1, -d[k].0) };
    let least = |b: Bounds| {
        if b.0 <= 0.0 && b.1 >= 0.0 {
            0.0
        } else {
            b.0.abs().min(b.1.abs())
        }
    };
    let (major, s, t) = (along(f.major), along(f.s), along(f.t));
    let floor = least(s).max(least(t)).max(major.0).max(0.0);
    if major.1 < floor || major.1 <= 0.0 {
        return None;
    }
    let on = |b: Bounds| {
        let low = if b.0 < 0.0 { b.0 / floor } else { b.0 / major.1 };
        let high = if b.1 > 0.0 { b.1 / floor } else { b.1 / major.1 };
        let clip = |x: f64, other: f64| if x.is_nan() { other } else { x.clamp(-1.0, 1.0) };
        (0.5 * (clip(low, -1.0) + 1.0), 0.5 * (clip(high, 1.0) + 1.0))
    };
    Some((face, [on(s), on(t)]))
}

/// The texels that the one at `(i, j)` of a face of `n` by `n` stands for, if `i` or `j` lies outside: one beyond an edge, three
/// around a corner.
pub(crate) fn across(face: u32, i: i64, j: i64, n: u32) -> Vec<(u32, u32, u32)> {
    let inside = |k: i64| (0..i64::from(n)).contains(&k);
    match (inside(i), inside(j)) {
        (true, true) => vec![(face, i as u32, j as u32)],
        (false, false) => {
            let (ci, cj) = (i.clamp(0, i64::from(n) - 1), j.clamp(0, i64::from(n) - 1));
            vec![
                (face, ci as u32, cj as u32),
                beyond(face, i, cj, n),
                beyond(face, ci, j, n),
            ]
        }
        (true, false) | (false, true) => vec![beyond(face, i, j, n)],
    }
}

/// The texel of the neighbouring face: the direction through the texel's centre, one step over the edge.
fn beyond(face: u32, i: i64, j: i64, n: u32) -> (u32, u32, u32) {
    let f = &FACES[face as usize];
    let centre = |k: i64| 2.0 * (k as f64 + 0.5) / f64::from(n) - 1.0;
    let mut d = [0.0; 3];
    d[f.major.0] = f.major.1;
    d[f.s.0] = f.s.1 * centre(i);
    d[f.t.0] = f.t.1 * centre(j);
    let (face, [s, t]) = point_face(d);
    let index = |x: f64| ((x * f64::from(n)).floor().max(0.0) as u32).min(n - 1);
    (face, index(s.0), index(t.0))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn exact(d: [f64; 3]) -> OnFace {
        faces(d.map(|x| (x, x)), false)[0]
    }

    #[test]
    fn axes_hit_the_centres_of_their_faces() {
        for (face, d) in [
            [1.0, 0.0, 0.0],
            [-1.0, 0.0, 0.0],
            [0.0, 1.0, 0.0],
            [0.0, -1.0, 0.0],
            [0.0, 0.0, 1.0],
            [0.0, 0.0, -1.0],
        ]
        .into_iter()
        .enumerate()
        {
            assert_eq!(exact(d), (face as u32, [(0.5, 0.5); 2]));
        }
        // +x face: s grows toward −z.
        assert_eq!(exact([1.0, 0.0, -0.5]).1[0], (0.75, 0.75));
    }

    #[test]
    fn bounds_cover_the_face_of_every_direction_inside() {
        let d = [(0.4, 0.8), (-0.1, 0.1), (0.5, 0.7)];
        let list = faces(d, true);
        for k in 0..=20 {
            for l in 0..=20 {
                let at = |b: Bounds, k: i32| b.0 + (b.1 - b.0) * f64::from(k) / 20.0;
                let (face, [s, t]) = exact([at(d[0], k), at(d[1], l), at(d[2], 20 - k)]);
                let inside = |b: Bounds, x: f64| b.0 - 1e-12 <= x && x <= b.1 + 1e-12;
                assert!(
                    list.iter()
                        .any(|(f, [bs, bt])| *f == face && inside(*bs, s.0) && inside(*bt, t.0))
                );
            }
        }
    }

    #[test]
    fn edges_lead_to_the_neighbouring_face() {
        // Leaving +x at its s = 1 edge leads onto −z.
        assert_eq!(across(0, 4, 1, 4)[0].0, 5);
        assert_eq!(across(0, 4, 4, 4).len(), 3);
    }
}
