//! A tangent and bitangent for a normal alone: the fallback where texture coordinates say nothing.
//!
//! Hardened form: Duff et al., "Building an Orthonormal Basis, Revisited", JCGT 6(1), 2017, with the sign selected by
//! `z >= 0` (a `sign` function that answers 0 for 0 breaks the formula at the equator). No branches, no square root, no
//! division by less than 1. The result is right-handed: B = cross(N, T), so w = +1.
//!
//! Published form (the article on parallax bump mapping): A = (n.y, −n.z, n.x), T = N × A, B = T × N, lengths and all. Its
//! faults, kept: for N along (−1, 1, 1) A = −N and T = 0, a vertex without a frame; T is no unit vector; and B = T × N is
//! −cross(N, T), so w = −1.

use glam::Vec3;

use crate::{Error, Mesh};

/// Tangent and bitangent of a unit normal.
///
/// Both are unit length and orthogonal to within a few ulps for |n| = 1; errors in the length of `n` carry over.
#[inline]
#[must_use]
pub fn hardened(n: Vec3) -> (Vec3, Vec3) {
    let sign = if n.z >= 0.0 { 1.0 } else { -1.0 };
    let a = -1.0 / (sign + n.z);
    let b = n.x * n.y * a;
    let tangent = Vec3::new(1.0 + sign * n.x * n.x * a, sign * b, -sign * n.x);
    let bitangent = Vec3::new(b, sign + n.y * n.y * a, -n.y);
    (tangent, bitangent)
}

/// Tangent and bitangent as published: not of unit length, and zero for N along (−1, 1, 1).
#[inline]
#[must_use]
pub fn published(n: Vec3) -> (Vec3, Vec3) {
    let tangent = n.cross(Vec3::new(n.y, -n.z, n.x));
    (tangent, tangent.cross(n))
}

/// Fills in every vertex' tangent in the hardened form, whatever its texture coordinates.
///
/// # Errors
/// [`Error::Mesh`] when the mesh is not valid to begin with.
pub fn generate_hardened(mesh: &mut Mesh) -> Result<(), Error> {
    generate(mesh, |n| hardened(n).0.extend(1.0))
}

/// Fills in every vertex' tangent as published: T as it comes, w = −1.
///
/// # Errors
/// [`Error::Mesh`] when the mesh is not valid to begin with.
pub fn generate_published(mesh: &mut Mesh) -> Result<(), Error> {
    generate(mesh, |n| published(n).0.extend(-1.0))
}

fn generate(mesh: &mut Mesh, tangent: impl Fn(Vec3) -> glam::Vec4) -> Result<(), Error> {
    if mesh.normals.is_empty() {
        mesh.smooth_normals();
    }
    mesh.validate()?;
    mesh.tangents = mesh.normals.iter().map(|&n| tangent(n)).collect();
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::{generate_hardened, generate_published, hardened, published};
    use crate::primitives;
    use glam::{DVec3, Vec3};
    use proptest::prelude::*;

    fn worst_error(n: Vec3) -> f64 {
        let (t, b) = hardened(n);
        let (n, t, b): (DVec3, DVec3, DVec3) = (n.as_dvec3(), t.as_dvec3(), b.as_dvec3());
        let lengths = [(t.length() - 1.0).abs(), (b.length() - 1.0).abs()];
        let angles = [
            n.dot(t).abs(),
            n.dot(b).abs(),
            t.dot(b).abs(),
            (n.cross(t) - b).length(),
        ];
        lengths.into_iter().chain(angles).fold(0.0, f64::max)
    }

    /// Each component takes at most 5 roundings of terms no larger than 1 (the quotient a is in [−1, −1/2]) plus the rounding
    /// of n itself; three components a dot product: 3·(5 + 1)·2⁻²⁴, and as much again for the cross product.
    const BOUND: f64 = 36.0 * 5.960_464_5e-8;

    #[test]
    fn the_poles_and_the_equator() {
        for n in [
            Vec3::X,
            -Vec3::X,
            Vec3::Y,
            -Vec3::Y,
            Vec3::Z,
            -Vec3::Z,
            Vec3::new(0.6, 0.8, 0.0),
            Vec3::new(0.6, 0.8, -0.0),
        ] {
            assert!(worst_error(n) <= BOUND, "{n}: {}", worst_error(n));
        }
    }

    #[test]
    fn published_frames_are_left_handed_short_and_missing_on_an_axis() {
        let n = Vec3::new(0.6, 0.0, 0.8);
        let (t, b) = published(n);
        // A = (0, −0.8, 0.6): T = N × A = (0.64, −0.36, −0.48), |T|² = 1 − (N·A)² = 1 − 0.48².
        assert!((t - Vec3::new(0.64, -0.36, -0.48)).length() < 1e-6 && t.length() < 0.9);
        assert!((b + n.cross(t)).length() < 1e-6);
        assert_eq!(published(Vec3::new(-1.0, 1.0, 1.0)).0, Vec3::ZERO);
    }

    #[test]
    fn meshes_get_a_frame_at_every_vertex() {
        let mut mesh = primitives::sphere(1.0, 12, 6);
        generate_hardened(&mut mesh).unwrap();
        assert!(
            mesh.tangents
                .iter()
                .zip(&mesh.normals)
                .all(|(t, n)| t.w == 1.0 && t.truncate().dot(*n).abs() < 1e-6)
        );
        generate_published(&mut mesh).unwrap();
        assert!(mesh.tangents.iter().all(|t| t.w == -1.0));
    }

    proptest! {
        #[test]
        fn orthonormal_everywhere(x in -1.0f32..1.0, y in -1.0f32..1.0, z in -1.0f32..1.0) {
            let v = DVec3::new(f64::from(x), f64::from(y), f64::from(z));
            prop_assume!(v.length() > 1e-3);
            prop_assert!(worst_error(v.normalize().as_vec3()) <= BOUND);
        }

        #[test]
        fn orthonormal_around_the_south_pole(x in -1e-3f32..1e-3, y in -1e-3f32..1e-3) {
            let v = DVec3::new(f64::from(x), f64::from(y), -1.0).normalize();
            prop_assert!(worst_error(v.as_vec3()) <= BOUND);
        }
    }
}
