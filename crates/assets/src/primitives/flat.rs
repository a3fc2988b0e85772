//! Plane and cube.

use glam::{Vec2, Vec3};

use super::Vertex;
use crate::Mesh;

/// A rectangle in the xy plane, centred, facing +z; u along +x, v along +y, one image over the whole.
#[must_use]
pub fn plane(width: f32, height: f32) -> Mesh {
    let mut mesh = Mesh::default();
    face(
        &mut mesh,
        Vec3::ZERO,
        Vec3::X * (width * 0.5),
        Vec3::Y * (height * 0.5),
        [Vec3::X, Vec3::Z],
    );
    mesh
}

/// A cube, centred, one image over each side; on the four walls v grows upward.
#[must_use]
pub fn cube(side: f32) -> Mesh {
    let half = side * 0.5;
    let mut mesh = Mesh::default();
    // Along u, along v; u × v points outward.
    let sides = [
        (Vec3::X, Vec3::Y),
        (-Vec3::X, Vec3::Y),
        (-Vec3::Z, Vec3::Y),
        (Vec3::Z, Vec3::Y),
        (Vec3::X, -Vec3::Z),
        (Vec3::X, Vec3::Z),
    ];
    for (u, v) in sides {
        let n = u.cross(v);
        face(&mut mesh, n * half, u * half, v * half, [u, n]);
    }
    mesh
}

fn face(mesh: &mut Mesh, center: Vec3, u: Vec3, v: Vec3, [tangent, normal]: [Vec3; 2]) {
    let corners = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)];
    let indices = corners.map(|(s, t)| {
        let uv = Vec2::new(s, t) * 0.5 + Vec2::splat(0.5);
        mesh.push(Vertex {
            position: center + u * s + v * t,
            normal,
            tangent,
            uv,
        })
    });
    mesh.quad(indices);
}
