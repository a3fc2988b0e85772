//! The bodies a scene can name: plane, its grid, cube, sphere, torus.
//!
//! All of them: counter-clockwise seen from outside, unit normals outward, tangents along +u with w = +1 (B = cross(N, T)
//! runs along +v), y up. Since v grows upward and row 0 of an image lies at v = 0, an image shows its first row at the
//! bottom; [`Mesh::flip_v`] turns it upright, at the price of left-handed frames.
//!
//! Frames are exact formulas, not estimates, so these meshes double as test cases for the frame generators. Counts are
//! raised to the least that makes a closed body; sizes are taken as they are.

mod curved;
mod flat;

pub use curved::{sphere, torus};
pub use flat::{cube, grid, plane};

use glam::{Vec2, Vec3};

use crate::Mesh;

/// A vertex on its way into a mesh, w = +1.
struct Vertex {
    position: Vec3,
    normal: Vec3,
    tangent: Vec3,
    uv: Vec2,
}

impl Mesh {
    fn push(&mut self, v: Vertex) -> u32 {
        let index = self.positions.len() as u32;
        self.positions.push(v.position);
        self.normals.push(v.normal);
        self.uvs.push(v.uv);
        self.tangents.push(v.tangent.extend(1.0));
        index
    }

    /// Two triangles, counter-clockwise: low left, low right, high right, high left.
    fn quad(&mut self, [a, b, c, d]: [u32; 4]) {
        self.indices.extend([a, b, c, a, c, d]);
    }
}
