//! `frame_mikktspace`: the shader's side of the MikkTSpace convention: B = w · (N × T) from the interpolated vectors as
//! they arrive, unnormalised, and a tangent-space vector carried out by n = x·T + y·B + z·N, normalised at the very end.
//!
//! Source: Morten S. Mikkelsen, *Simulation of Wrinkled Surfaces Revisited*, 2008, and the notes in `mikktspace.h`: the
//! baker does it in this order, so the shader must. The tangents themselves are made by the mesh code.
//!
//! Spaces: N and T in one space (world or object), the result in that space.

use glam::{DVec3, DVec4};

use crate::vector::{normalize, normalize_or_zero};

/// B = w · (N × T).
#[must_use]
pub fn bitangent(normal: DVec3, tangent: DVec4) -> DVec3 {
    tangent.w * normal.cross(tangent.truncate())
}

/// The tangent-space vector in the frame's space, before normalising.
#[must_use]
pub fn combine(normal: DVec3, tangent: DVec4, vector_ts: DVec3) -> DVec3 {
    vector_ts.x * tangent.truncate() + vector_ts.y * bitangent(normal, tangent) + vector_ts.z * normal
}

/// The perturbed normal, unit; NaN where the combination vanishes.
#[must_use]
pub fn perturbed_normal(normal: DVec3, tangent: DVec4, vector_ts: DVec3) -> DVec3 {
    normalize(combine(normal, tangent, vector_ts))
}

/// The perturbed normal, unit, or zero where the combination vanishes.
#[must_use]
pub fn perturbed_normal_or_zero(normal: DVec3, tangent: DVec4, vector_ts: DVec3) -> DVec3 {
    normalize_or_zero(combine(normal, tangent, vector_ts))
}

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use super::{bitangent, combine};

    #[test]
    fn handedness_turns_the_bitangent() {
        assert_eq!(bitangent(DVec3::Z, DVec3::X.extend(1.0)), DVec3::Y);
        assert_eq!(bitangent(DVec3::Z, DVec3::X.extend(-1.0)), -DVec3::Y);
    }

    #[test]
    fn interpolants_are_used_as_they_are() {
        // Twice the tangent doubles both T and B: no hidden normalising.
        let v = combine(DVec3::Z, (2.0 * DVec3::X).extend(1.0), DVec3::ONE);
        assert_eq!(v, DVec3::new(2.0, 2.0, 1.0));
    }
}
