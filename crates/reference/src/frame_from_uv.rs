//! `frame_from_uv`: tangents of a mesh from its texture coordinates.
//!
//! Source: the first article, *Parallax Bump Mapping*. Per triangle, with edges P, Q and their texture differences (s₁, t₁),
//! (s₂, t₂): (T; B) = 1/(s₁t₂ − s₂t₁) · [[t₂, −t₁], [−s₂, s₁]] · (P; Q). T and B are summed per vertex; then Gram–Schmidt
//! T' = T − (N·T)·N and w = (N × T)·B < 0 ? −1 : 1.
//!
//! Spaces: local; N is the vertex' own unit normal. Results: T' in xyz and w.
//!
//! Known faults of the published form: zero UV area (division by 0), a sum that cancels where mirrored halves meet, T ∥ N after
//! summing, T' not unit. Hardened: a triangle without area, or whose texture area cannot be told from f32 rounding
//! ([`UV_AREA_NOISE`]), is left out; the others' T and B are unit vectors weighted by area; T' is unit; a vertex for which
//! less than [`CANCELLED_SHARE`] of what went in remains gets a tangent from its normal alone, with w = +1.

use glam::{DVec2, DVec3, DVec4};

use crate::vector::{SMALLEST_NORMAL_F32, normalize};

/// The two tangents of a triangle, in the units of position per unit of texture coordinate.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tangents {
    /// T, along +u.
    pub tangent: DVec3,
    /// B, along +v.
    pub bitangent: DVec3,
}

/// Below this share of |s₁t₂| + |s₂t₁| the sign of their difference is not known in f32: each of the two products and the
/// difference is off by up to 2⁻²⁴ of itself in the worst rounding, with a factor of two to spare.
pub const UV_AREA_NOISE: f64 = 1.0 / 4_194_304.0;

/// A tangent left shorter than this share of the weights that went in has lost half of f32's 24 bits to cancellation.
pub const CANCELLED_SHARE: f64 = 1.0 / 4096.0;

/// The texture area s₁t₂ − s₂t₁ of a triangle, twice and signed.
#[must_use]
pub fn uv_determinant(uvs: [DVec2; 3]) -> f64 {
    (uvs[1] - uvs[0]).perp_dot(uvs[2] - uvs[0])
}

/// One triangle as published: not finite where the texture area is zero.
#[must_use]
pub fn triangle(positions: [DVec3; 3], uvs: [DVec2; 3]) -> Tangents {
    let Tangents { tangent, bitangent } = scaled_triangle(positions, uvs);
    let determinant = uv_determinant(uvs);
    Tangents {
        tangent: tangent / determinant,
        bitangent: bitangent / determinant,
    }
}

/// One triangle without the division: [[t₂, −t₁], [−s₂, s₁]] · (P; Q).
#[must_use]
pub fn scaled_triangle(positions: [DVec3; 3], uvs: [DVec2; 3]) -> Tangents {
    let (p, q) = (positions[1] - positions[0], positions[2] - positions[0]);
    let (e1, e2) = (uvs[1] - uvs[0], uvs[2] - uvs[0]);
    Tangents {
        tangent: e2.y * p - e1.y * q,
        bitangent: e1.x * q - e2.x * p,
    }
}

/// Gram–Schmidt and the handedness as published: T − (N·T)·N, not normalised.
#[must_use]
pub fn orthogonalise(normal: DVec3, sum: Tangents) -> DVec4 {
    let tangent = sum.tangent - normal.dot(sum.tangent) * normal;
    tangent.extend(handedness(normal, sum))
}

/// (N × T)·B < 0 ? −1 : 1.
#[must_use]
pub fn handedness(normal: DVec3, sum: Tangents) -> f64 {
    if normal.cross(sum.tangent).dot(sum.bitangent) < 0.0 {
        -1.0
    } else {
        1.0
    }
}

/// Two unit vectors perpendicular to a unit normal, right-handed with it.
///
/// Source: Duff et al., *Building an Orthonormal Basis, Revisited*, 2017, with the sign of zero taken as +1.
#[must_use]
pub fn frame_from_normal(n: DVec3) -> Tangents {
    let sign = crate::vector::sign_not_zero(n.z);
    let a = -1.0 / (sign + n.z);
    let b = n.x * n.y * a;
    Tangents {
        tangent: DVec3::new(1.0 + sign * n.x * n.x * a, sign * b, -sign * n.x),
        bitangent: DVec3::new(b, sign + n.y * n.y * a, -n.y),
    }
}

/// The normals of a mesh as published: the triangles' unit normals, summed per vertex and made unit. NaN where a triangle
/// without area takes part.
#[must_use]
pub fn summed_normals(positions: &[DVec3], indices: &[u32]) -> Vec<DVec3> {
    let mut sums = vec![DVec3::ZERO; positions.len()];
    for corners in indices.chunks_exact(3) {
        let [a, b, c] = [corners[0] as usize, corners[1] as usize, corners[2] as usize];
        let normal = normalize((positions[b] - positions[a]).cross(positions[c] - positions[a]));
        [a, b, c].into_iter().for_each(|i| sums[i] += normal);
    }
    sums.into_iter().map(normalize).collect()
}

/// The tangents of a whole mesh as published.
#[must_use]
pub fn published(mesh: &Triangles<'_>) -> Vec<DVec4> {
    let sums = mesh.sums(triangle);
    mesh.normals
        .iter()
        .zip(sums)
        .map(|(&normal, sum)| orthogonalise(normal, sum))
        .collect()
}

/// The tangents of a whole mesh, hardened.
#[must_use]
pub fn hardened(mesh: &Triangles<'_>) -> Vec<DVec4> {
    let sums = mesh.weighted_sums();
    mesh.normals
        .iter()
        .zip(sums)
        .map(|(&normal, (sum, weight))| hardened_vertex(normal, sum, weight))
        .collect()
}

/// One triangle's share in the hardened sum, and its weight (twice its area); nothing for a triangle that is left out.
/// P and Q are edges in space, `st1` and `st2` their texture edges.
#[must_use]
pub fn weighted_triangle(p: DVec3, q: DVec3, st1: DVec2, st2: DVec2) -> (Tangents, f64) {
    let nothing = (
        Tangents {
            tangent: DVec3::ZERO,
            bitangent: DVec3::ZERO,
        },
        0.0,
    );
    let (first, second) = (st1.x * st2.y, st2.x * st1.y);
    let (uv_area, area) = (first - second, p.cross(q).length());
    let raw = Tangents {
        tangent: st2.y * p - st1.y * q,
        bitangent: st1.x * q - st2.x * p,
    };
    let shortest = raw
        .tangent
        .abs()
        .max_element()
        .min(raw.bitangent.abs().max_element());
    let noise = UV_AREA_NOISE * (first.abs() + second.abs());
    if uv_area.abs() <= noise || area < SMALLEST_NORMAL_F32 || shortest < SMALLEST_NORMAL_F32 {
        return nothing;
    }
    let weight = uv_area.signum() * area;
    (
        Tangents {
            tangent: weight * normalize(raw.tangent),
            bitangent: weight * normalize(raw.bitangent),
        },
        area,
    )
}

/// One vertex, hardened: unit tangent perpendicular to the normal, whatever the sum. `weight` is the sum of the weights.
#[must_use]
pub fn hardened_vertex(normal: DVec3, sum: Tangents, weight: f64) -> DVec4 {
    let tangent = sum.tangent - normal.dot(sum.tangent) * normal;
    let left = tangent.length();
    if left <= CANCELLED_SHARE * weight || left < SMALLEST_NORMAL_F32 {
        return frame_from_normal(normal).tangent.extend(1.0);
    }
    normalize(tangent).extend(handedness(normal, sum))
}

/// An indexed triangle mesh, borrowed.
#[derive(Clone, Copy, Debug)]
pub struct Triangles<'a> {
    /// Positions, local space.
    pub positions: &'a [DVec3],
    /// Unit normals, one a position.
    pub normals: &'a [DVec3],
    /// Texture coordinates, one a position.
    pub uvs: &'a [DVec2],
    /// Three indices a triangle.
    pub indices: &'a [u32],
}

impl Triangles<'_> {
    /// The hardened sums of every vertex and the weights that went into them.
    fn weighted_sums(&self) -> Vec<(Tangents, f64)> {
        let mut sums = vec![
            (
                Tangents {
                    tangent: DVec3::ZERO,
                    bitangent: DVec3::ZERO
                },
                0.0
            );
            self.positions.len()
        ];
        for corners in self.indices.chunks_exact(3) {
            let [a, b, c] = [corners[0] as usize, corners[1] as usize, corners[2] as usize];
            let (p, q) = (
                self.positions[b] - self.positions[a],
                self.positions[c] - self.positions[a],
            );
            let (share, weight) =
                weighted_triangle(p, q, self.uvs[b] - self.uvs[a], self.uvs[c] - self.uvs[a]);
            for i in [a, b, c] {
                sums[i].0.tangent += share.tangent;
                sums[i].0.bitangent += share.bitangent;
                sums[i].1 += weight;
            }
        }
        sums
    }

    /// Sums what `of` gives for each triangle into its three vertices, in index order.
    fn sums(&self, of: impl Fn([DVec3; 3], [DVec2; 3]) -> Tangents) -> Vec<Tangents> {
        let mut sums = vec![
            Tangents {
                tangent: DVec3::ZERO,
                bitangent: DVec3::ZERO
            };
            self.positions.len()
        ];
        for corners in self.indices.chunks_exact(3) {
            let corner = [corners[0] as usize, corners[1] as usize, corners[2] as usize];
            let share = of(corner.map(|i| self.positions[i]), corner.map(|i| self.uvs[i]));
            for i in corner {
                sums[i].tangent += share.tangent;
                sums[i].bitangent += share.bitangent;
            }
        }
        sums
    }
}

#[cfg(test)]
mod tests {
    use glam::{DVec2, DVec3};

    use super::{Triangles, frame_from_normal, hardened, published, triangle};

    const CORNERS: [DVec3; 3] = [DVec3::ZERO, DVec3::X, DVec3::Y];
    const UVS: [DVec2; 3] = [DVec2::ZERO, DVec2::X, DVec2::Y];

    #[test]
    fn the_unit_triangle_has_the_unit_frame() {
        let frame = triangle(CORNERS, UVS);
        assert_eq!((frame.tangent, frame.bitangent), (DVec3::X, DVec3::Y));
    }

    #[test]
    fn no_texture_area_is_the_defect_and_its_cure() {
        let normals = [DVec3::Z; 3];
        let mesh = Triangles {
            positions: &CORNERS,
            normals: &normals,
            uvs: &[DVec2::ZERO; 3],
            indices: &[0, 1, 2],
        };
        assert!(published(&mesh).iter().all(|t| !t.is_finite()));
        for tangent in hardened(&mesh) {
            assert_eq!(tangent.truncate().dot(DVec3::Z), 0.0);
            assert_eq!(tangent.truncate().length(), 1.0);
        }
    }

    #[test]
    fn mirrored_texture_turns_the_handedness() {
        let mirrored = UVS.map(|uv| DVec2::new(-uv.x, uv.y));
        let normals = [DVec3::Z; 3];
        let mesh = Triangles {
            positions: &CORNERS,
            normals: &normals,
            uvs: &mirrored,
            indices: &[0, 1, 2],
        };
        assert!(published(&mesh).iter().all(|t| *t == (-DVec3::X).extend(-1.0)));
        assert!(hardened(&mesh).iter().all(|t| *t == (-DVec3::X).extend(-1.0)));
    }

    #[test]
    fn fallback_frames_are_orthonormal_everywhere() {
        for n in [
            DVec3::Z,
            -DVec3::Z,
            DVec3::X,
            DVec3::new(-1.0, 1.0, 1.0).normalize(),
            DVec3::new(0.6, 0.0, -0.8),
        ] {
            let frame = frame_from_normal(n);
            // About 6 operations on numbers below 2: 6 · 2 · 2^-53.
            assert!((frame.tangent.cross(frame.bitangent) - n).length() < 1.4e-15);
        }
    }
}
