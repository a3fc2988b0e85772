//! Cube maps in float64: which texel of which face a direction meets, and bilinear filtering.
//!
//! Source: the cube map tables of the graphics interfaces (Vulkan, D3D, OpenGL, WebGPU), the same in all of them. Faces in
//! the order +X, −X, +Y, −Y, +Z, −Z; on each face s runs along the columns and t along the rows:
//!
//! | face | s grows along | t grows along |
//! |---|---|---|
//! | +X | −z | −y |
//! | −X | +z | −y |
//! | +Y | +x | +z |
//! | −Y | +x | −z |
//! | +Z | +x | −y |
//! | −Z | −x | −y |
//!
//! A direction belongs to the face of its largest component; where two are equally large z goes before y and y before x
//! (Vulkan's rule; the others leave it open). Its place there is s = (sc/|ma| + 1)/2, t = (tc/|ma| + 1)/2.
//!
//! Limits: one mip level. [`Seams::Face`] filters within a face, clamped to its border texels' centres, as a shader does that
//! loads four texels; [`Seams::Seamless`] goes on into the neighbouring face, as hardware does, with the mean of the three
//! texels at a corner. Real samplers keep 8 bits of the fraction; this keeps all.

use glam::{DVec2, DVec3, DVec4};

/// How bilinear filtering treats the border of a face.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Seams {
    /// Stay within the face.
    Face,
    /// Go on into the neighbouring face.
    Seamless,
}

/// The vectors along which the major axis, s and t grow.
const AXES: [[DVec3; 3]; 6] = [
    [DVec3::X, DVec3::NEG_Z, DVec3::NEG_Y],
    [DVec3::NEG_X, DVec3::Z, DVec3::NEG_Y],
    [DVec3::Y, DVec3::X, DVec3::Z],
    [DVec3::NEG_Y, DVec3::X, DVec3::NEG_Z],
    [DVec3::Z, DVec3::X, DVec3::NEG_Y],
    [DVec3::NEG_Z, DVec3::NEG_X, DVec3::NEG_Y],
];

/// The face of a direction, 0 to 5. The zero vector is given to +Z.
#[must_use]
pub fn face_of(direction: DVec3) -> usize {
    let size = direction.abs();
    let (axis, component) = if size.z >= size.y && size.z >= size.x {
        (4, direction.z)
    } else if size.y >= size.x {
        (2, direction.y)
    } else {
        (0, direction.x)
    };
    axis + usize::from(component < 0.0)
}

/// The face of a direction and its (s, t) there, each in [0, 1]; NaN for the zero vector.
#[must_use]
pub fn face_and_st(direction: DVec3) -> (usize, DVec2) {
    let face = face_of(direction);
    let [major, s, t] = AXES[face].map(|axis| axis.dot(direction));
    (face, (DVec2::new(s, t) / major + 1.0) / 2.0)
}

/// The point of the cube [−1, 1]³ at (s, t) of a face. Outside of [0, 1] the face's plane goes on.
///
/// # Panics
/// For a face above 5.
#[must_use]
pub fn point(face: usize, st: DVec2) -> DVec3 {
    let [major, s, t] = AXES[face];
    let p = 2.0 * st - 1.0;
    major + p.x * s + p.y * t
}

/// The point of the cube at the centre of a texel, which may lie outside of the face.
#[must_use]
pub fn texel_centre(face: usize, x: i64, y: i64, size: u32) -> DVec3 {
    let st = (DVec2::new(x as f64, y as f64) + 0.5) / f64::from(size);
    point(face, st)
}

/// Bilinear lookup in a cube map of `size`² texels a face whose texels are `texel(face, x, y)`. The zero direction gives NaN.
#[must_use]
pub fn sample(direction: DVec3, size: u32, seams: Seams, texel: impl Fn(usize, u32, u32) -> DVec4) -> DVec4 {
    let (face, st) = face_and_st(direction);
    if !st.is_finite() {
        return DVec4::NAN;
    }
    let p = st * f64::from(size) - 0.5;
    let cell = p.floor();
    let (i, j) = (cell.x as i64, cell.y as i64);
    let corners = [(i, j), (i + 1, j), (i, j + 1), (i + 1, j + 1)];
    let [t00, t10, t01, t11] = match seams {
        Seams::Face => corners.map(|(x, y)| texel(face, clamp(x, size), clamp(y, size))),
        Seams::Seamless => seamless(face, corners, size, &texel),
    };
    let f = p - cell;
    t00.lerp(t10, f.x).lerp(t01.lerp(t11, f.x), f.y)
}

fn clamp(i: i64, size: u32) -> u32 {
    i.clamp(0, i64::from(size) - 1) as u32
}

/// Four texels, those beyond one border from the neighbouring face, the one beyond two as the mean of the other three.
fn seamless(
    face: usize,
    at: [(i64, i64); 4],
    size: u32,
    texel: &impl Fn(usize, u32, u32) -> DVec4,
) -> [DVec4; 4] {
    let found = at.map(|(x, y)| beyond(face, x, y, size).map(|(face, x, y)| texel(face, x, y)));
    let mean = found.iter().flatten().sum::<DVec4>() / 3.0;
    found.map(|texel| texel.unwrap_or(mean))
}

/// The texel that stands for (x, y) of a face, which may lie one step outside; `None` for the missing one at a corner.
fn beyond(face: usize, x: i64, y: i64, size: u32) -> Option<(usize, u32, u32)> {
    let inside = |i: i64| (0..i64::from(size)).contains(&i);
    if inside(x) && inside(y) {
        return Some((face, x as u32, y as u32));
    }
    if !inside(x) && !inside(y) {
        return None;
    }
    let (neighbour, st) = face_and_st(texel_centre(face, x, y, size));
    let p = (st * f64::from(size)).floor();
    Some((neighbour, clamp(p.x as i64, size), clamp(p.y as i64, size)))
}

#[cfg(test)]
mod tests {
    use glam::{DVec2, DVec3, DVec4};

    use super::{AXES, Seams, beyond, face_and_st, face_of, point, sample, texel_centre};
    use crate::sphere::fibonacci;

    #[test]
    fn every_face_is_seen_right_way_round_from_inside() {
        // The cube map's handedness: s × t points inward on all faces, that is, along −major.
        assert!(
            AXES.iter()
                .all(|[major, s, t]| s.cross(*t) == *major * AXES[0][1].cross(AXES[0][2]).x)
        );
        assert!((0..6).all(|face| face_of(AXES[face][0]) == face));
    }

    #[test]
    fn known_answers() {
        // The table of the specifications, row by row: a direction a little along +x, +y and +z of each major axis.
        let st = |d| face_and_st(d);
        assert_eq!(st(DVec3::new(1.0, 0.5, 0.25)), (0, DVec2::new(0.375, 0.25)));
        assert_eq!(st(DVec3::new(-1.0, 0.5, 0.25)), (1, DVec2::new(0.625, 0.25)));
        assert_eq!(st(DVec3::new(0.5, 1.0, 0.25)), (2, DVec2::new(0.75, 0.625)));
        assert_eq!(st(DVec3::new(0.5, -1.0, 0.25)), (3, DVec2::new(0.75, 0.375)));
        assert_eq!(st(DVec3::new(0.5, 0.25, 1.0)), (4, DVec2::new(0.75, 0.375)));
        assert_eq!(st(DVec3::new(0.5, 0.25, -1.0)), (5, DVec2::new(0.25, 0.375)));
        assert_eq!([face_of(DVec3::ONE), face_of(DVec3::new(1.0, 1.0, 0.5))], [4, 2]);
    }

    #[test]
    fn points_and_places_are_inverse() {
        for d in fibonacci(1000) {
            let (face, st) = face_and_st(d);
            let back = point(face, st);
            // Four roundings of 2^-53 on numbers up to 2, and the length of the point is at most √3.
            assert!((back.normalize() - d).length() < 2e-15, "{d}");
        }
    }

    #[test]
    fn one_step_beyond_a_border_lies_next_to_it() {
        let size = 8;
        for (face, along) in (0..6).flat_map(|f| (0..8).map(move |i| (f, i))) {
            for (x, y) in [(-1, along), (8, along), (along, -1), (along, 8)] {
                let (neighbour, i, j) = beyond(face, x, y, size).unwrap();
                assert_ne!(neighbour, face);
                let here = texel_centre(face, x.clamp(0, 7), y.clamp(0, 7), size);
                let there = texel_centre(neighbour, i64::from(i), i64::from(j), size);
                // Both are half a texel (1/8 of the cube's half edge) from the edge, and at the same place along it.
                assert!(
                    (here - there).length() <= 2f64.sqrt() / 8.0 + 1e-15,
                    "{face} {x} {y}"
                );
            }
        }
        assert_eq!(beyond(0, -1, -1, size), None);
    }

    #[test]
    fn seamless_lookups_are_continuous_and_clamped_ones_are_not() {
        let texel = |face: usize, x: u32, y: u32| {
            texel_centre(face, i64::from(x), i64::from(y), 4).extend(face as f64)
        };
        let step = |seams, at: DVec3| {
            let across = |side: f64| sample(at + side * 1e-9 * DVec3::X, 4, seams, texel);
            (across(1.0) - across(-1.0)).length()
        };
        // Across the edge of +X and +Z, away from the corners.
        let edge = DVec3::new(1.0, 0.25, 1.0);
        assert!(step(Seams::Seamless, edge) < 1e-6);
        assert!(step(Seams::Face, edge) > 0.1);
        // A cube of one colour has it everywhere, the corners included.
        let plain = |_: usize, _: u32, _: u32| DVec4::splat(0.5);
        assert!(fibonacci(1000).all(|d| (sample(d, 3, Seams::Seamless, plain) - 0.5).length() < 1e-15));
        assert!(sample(DVec3::ZERO, 3, Seams::Face, plain).is_nan());
    }
}
