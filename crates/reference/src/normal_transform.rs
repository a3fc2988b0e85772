//! `normal_transform`: the tangent frame of a vertex carried from local to world space.
//!
//! Source: the first article (*Parallax Bump Mapping*, the vertex shader listing) for the published form; for the hardened
//! one the theorem M a × M b = cof(M) (a × b), and cof(M) = det(M) · M⁻ᵀ.
//!
//! Spaces: `normal` and `tangent` in local space, results in world space, none normalised. `tangent.w` = ±1 is the
//! handedness: B = w · (N × T).
//!
//! Known faults of the published form: under non-uniform scale the normal is no longer perpendicular to the surface, and
//! under mirroring (det < 0) the bitangent points the wrong way.

use glam::{DMat3, DVec3, DVec4};

use crate::vector::sign_not_zero;

/// A tangent frame; vectors need not be unit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Frame {
    /// T, along +u.
    pub tangent: DVec3,
    /// B, along +v.
    pub bitangent: DVec3,
    /// N, out of the surface.
    pub normal: DVec3,
    /// The handedness after the transform, ±1.
    pub handedness: f64,
}

/// As published: everything by the same matrix.
#[must_use]
pub fn published(world_from_local: DMat3, normal: DVec3, tangent: DVec4) -> Frame {
    let normal = world_from_local * normal;
    let tangent_ws = world_from_local * tangent.truncate();
    let bitangent = normal.cross(tangent_ws) * tangent.w;
    Frame {
        tangent: tangent_ws,
        bitangent,
        normal,
        handedness: tangent.w,
    }
}

/// Hardened: the normal by the cofactor matrix, turned outward again where the transform mirrors, and the handedness
/// times the sign of the determinant.
#[must_use]
pub fn hardened(world_from_local: DMat3, normal: DVec3, tangent: DVec4) -> Frame {
    let mirror = sign_not_zero(world_from_local.determinant());
    let normal = mirror * (cofactor(world_from_local) * normal);
    let tangent_ws = world_from_local * tangent.truncate();
    let handedness = tangent.w * mirror;
    let bitangent = normal.cross(tangent_ws) * handedness;
    Frame {
        tangent: tangent_ws,
        bitangent,
        normal,
        handedness,
    }
}

/// The cofactor matrix: cof(M) (a × b) = M a × M b for all a and b, also where M has no inverse.
#[must_use]
pub fn cofactor(m: DMat3) -> DMat3 {
    DMat3::from_cols(
        m.y_axis.cross(m.z_axis),
        m.z_axis.cross(m.x_axis),
        m.x_axis.cross(m.y_axis),
    )
}

#[cfg(test)]
mod tests {
    use glam::{DMat3, DVec3};

    use super::{cofactor, hardened, published};

    #[test]
    fn cofactor_carries_cross_products() {
        let m = DMat3::from_cols_array(&[1.0, 2.0, 0.5, -3.0, 1.0, 4.0, 0.25, 0.0, -2.0]);
        let (a, b) = (DVec3::new(1.0, -2.0, 3.0), DVec3::new(0.5, 4.0, -1.0));
        // All values are dyadic with few bits: exact in f64.
        assert_eq!(cofactor(m) * a.cross(b), (m * a).cross(m * b));
    }

    #[test]
    fn scale_tilts_the_published_normal_only() {
        let stretch = DMat3::from_diagonal(DVec3::new(4.0, 1.0, 1.0));
        let (normal, tangent) = (DVec3::new(1.0, 0.0, 1.0), DVec3::new(1.0, 0.0, -1.0).extend(1.0));
        let (bad, good) = (
            published(stretch, normal, tangent),
            hardened(stretch, normal, tangent),
        );
        assert_eq!(bad.normal.dot(bad.tangent), 15.0);
        assert_eq!(good.normal.dot(good.tangent), 0.0);
    }

    #[test]
    fn mirroring_keeps_the_bitangent_on_the_surface_image() {
        let mirror = DMat3::from_diagonal(DVec3::new(-1.0, 1.0, 1.0));
        let tangent = DVec3::X.extend(1.0);
        // The image of the bitangent +y under the mirror is +y, and the outward normal stays +z.
        assert_eq!(hardened(mirror, DVec3::Z, tangent).bitangent, DVec3::Y);
        assert_eq!(hardened(mirror, DVec3::Z, tangent).normal, DVec3::Z);
        assert_eq!(published(mirror, DVec3::Z, tangent).bitangent, -DVec3::Y);
    }
}
