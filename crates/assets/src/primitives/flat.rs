//! Plane, grid and cube.

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

/// The plane of [`plane`], cut into `columns` by `rows` rectangles with shared vertices, row by row from v = 0: fine enough to
/// have its vertices displaced. Counts of 0 become 1. Corners and edges are those of the plane, to the bit.
#[must_use]
pub fn grid(width: f32, height: f32, columns: u32, rows: u32) -> Mesh {
    let (columns, rows) = (columns.max(1), rows.max(1));
    let mut mesh = Mesh::default();
    for j in 0..=rows {
        for i in 0..=columns {
            let uv = Vec2::new(i as f32 / columns as f32, j as f32 / rows as f32);
            let (s, t) = (2.0 * uv.x - 1.0, 2.0 * uv.y - 1.0);
            mesh.push(Vertex {
                position: Vec3::X * (width * 0.5) * s + Vec3::Y * (height * 0.5) * t,
                normal: Vec3::Z,
                tangent: Vec3::X,
                uv,
            });
        }
    }
    let at = |j: u32, i: u32| j * (columns + 1) + i;
    for (j, i) in (0..rows).flat_map(|j| (0..columns).map(move |i| (j, i))) {
        mesh.quad([at(j, i), at(j, i + 1), at(j + 1, i + 1), at(j + 1, i)]);
    }
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
