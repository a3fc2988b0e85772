//! Triangle meshes with one index list: positions, normals, texture coordinates, tangents.
//!
//! Conventions, the same everywhere in this project: triangles counter-clockwise seen from outside; T along +u, B along +v,
//! N outward; `tangent.w` = ±1 and **B = w · cross(N, T)**; row 0 of an image lies at v = 0.
//!
//! `normals` and `tangents` may be empty until something fills them; every other list has one entry a vertex.

use glam::{Vec2, Vec3, Vec4};

use crate::MeshDefect;

/// A triangle mesh.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Mesh {
    /// Where the vertices are.
    pub positions: Vec<Vec3>,
    /// Unit normals, or empty.
    pub normals: Vec<Vec3>,
    /// Texture coordinates.
    pub uvs: Vec<Vec2>,
    /// Unit tangents with the handedness in w, or empty.
    pub tangents: Vec<Vec4>,
    /// Three vertices a triangle.
    pub indices: Vec<u32>,
}

impl Mesh {
    /// Checks all that the rest of the project relies on.
    ///
    /// # Errors
    /// The first defect found: no faces, no UVs, lists of unequal lengths, indices out of range, numbers that are not finite.
    pub fn validate(&self) -> Result<(), MeshDefect> {
        if self.indices.is_empty() {
            return Err(MeshDefect::NoFaces);
        }
        if !self.indices.len().is_multiple_of(3) {
            return Err(MeshDefect::PartialTriangle {
                count: self.indices.len(),
            });
        }
        self.validate_indices()?;
        if self.uvs.is_empty() {
            return Err(MeshDefect::NoUvs);
        }
        self.validate_counts()?;
        self.validate_numbers()
    }

    fn validate_indices(&self) -> Result<(), MeshDefect> {
        let vertices = self.positions.len();
        match self.indices.iter().position(|&i| i as usize >= vertices) {
            Some(at) => Err(MeshDefect::IndexOutOfRange {
                triangle: at / 3,
                index: self.indices[at],
                vertices,
            }),
            None => Ok(()),
        }
    }

    fn validate_counts(&self) -> Result<(), MeshDefect> {
        let vertices = self.positions.len();
        let lists = [
            ("UVs", self.uvs.len(), false),
            ("normals", self.normals.len(), true),
            ("tangents", self.tangents.len(), true),
        ];
        for (attribute, count, optional) in lists {
            if count != vertices && !(optional && count == 0) {
                return Err(MeshDefect::AttributeCount {
                    attribute,
                    count,
                    vertices,
                });
            }
        }
        Ok(())
    }

    fn validate_numbers(&self) -> Result<(), MeshDefect> {
        finite("position", &self.positions, |v| v.is_finite())?;
        finite("normal", &self.normals, |v| v.is_finite())?;
        finite("UV", &self.uvs, |v| v.is_finite())?;
        finite("tangent", &self.tangents, |v| v.is_finite())
    }

    /// The vertices of every triangle.
    pub fn triangles(&self) -> impl Iterator<Item = [usize; 3]> + '_ {
        self.indices
            .chunks_exact(3)
            .map(|t| [t[0] as usize, t[1] as usize, t[2] as usize])
    }

    /// Whether some triangle's texture coordinates run the other way round than its vertices, so that its frame is
    /// left-handed (w = −1).
    #[must_use]
    pub fn has_mirrored_uvs(&self) -> bool {
        self.triangles().any(|[a, b, c]| {
            let (p, q) = (self.uvs[b] - self.uvs[a], self.uvs[c] - self.uvs[a]);
            p.x * q.y - q.x * p.y < 0.0
        })
    }

    /// Turns the texture upside down (v becomes 1 − v) and the handedness with it. Images then stand upright on the
    /// primitives, whose own v grows upward.
    pub fn flip_v(&mut self) {
        self.uvs.iter_mut().for_each(|uv| uv.y = 1.0 - uv.y);
        self.tangents.iter_mut().for_each(|t| t.w = -t.w);
    }

    /// Smallest box around the vertices, low corner and high corner; zeros for a mesh without vertices.
    #[must_use]
    pub fn bounds(&self) -> (Vec3, Vec3) {
        let mut points = self.positions.iter().copied();
        let Some(first) = points.next() else {
            return (Vec3::ZERO, Vec3::ZERO);
        };
        points.fold((first, first), |(low, high), p| (low.min(p), high.max(p)))
    }

    /// Sets smooth normals: at each **place**, the sum of the triangle normals weighted by area, made a unit vector. Vertices
    /// that share a place (split along a texture seam) get the same normal. Where the sum vanishes, (0, 0, 1).
    pub fn smooth_normals(&mut self) {
        let key = |p: Vec3| (p + Vec3::ZERO).to_array().map(f32::to_bits);
        let mut sums = std::collections::BTreeMap::<[u32; 3], Vec3>::new();
        for [a, b, c] in self.triangles() {
            let [pa, pb, pc] = [a, b, c].map(|i| self.positions[i]);
            let area_normal = (pb - pa).cross(pc - pa);
            [pa, pb, pc]
                .into_iter()
                .for_each(|p| *sums.entry(key(p)).or_default() += area_normal);
        }
        let normal = |p: &Vec3| {
            sums.get(&key(*p))
                .and_then(|&n| crate::scaled::direction(n))
                .unwrap_or(Vec3::Z)
        };
        self.normals = self.positions.iter().map(normal).collect();
    }
}

fn finite<T: std::fmt::Display>(
    attribute: &'static str,
    list: &[T],
    ok: impl Fn(&T) -> bool,
) -> Result<(), MeshDefect> {
    match list.iter().position(|v| !ok(v)) {
        Some(vertex) => Err(MeshDefect::NonFinite {
            attribute,
            vertex,
            value: list[vertex].to_string(),
        }),
        None => Ok(()),
    }
}
