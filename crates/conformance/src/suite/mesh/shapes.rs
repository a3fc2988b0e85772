//! The meshes that the tangent kernels run on: good ones, and those that the published form fails on.

use bossage_assets::{Mesh, primitives};
use glam::{Vec2, Vec3};
use rand::RngExt;

use crate::generate::random::stream;

/// The meshes by name.
pub(in crate::suite) fn meshes() -> Vec<(&'static str, Mesh)> {
    let mut mirrored = primitives::plane(2.0, 2.0);
    mirrored.uvs.iter_mut().for_each(|uv| uv.x = (uv.x - 0.5).abs());
    let mut flat_uv = primitives::cube(1.0);
    flat_uv
        .uvs
        .iter_mut()
        .take(4)
        .for_each(|uv| *uv = Vec2::splat(0.25));
    let mut stretched = primitives::torus(1.0, 0.25, 24, 12);
    stretched
        .positions
        .iter_mut()
        .for_each(|p| *p *= Vec3::new(4.0, 0.25, 1.0));
    vec![
        ("cube", primitives::cube(1.0)),
        ("sphere", primitives::sphere(1.0, 24, 12)),
        ("torus", primitives::torus(1.0, 0.25, 24, 12)),
        ("stretched_torus", stretched),
        ("mirrored", butterfly()),
        ("folded_plane", mirrored),
        ("no_texture_area", flat_uv),
        ("degenerate", degenerate()),
        (
            "mirrored_torus",
            scaled(primitives::torus(1.0, 0.25, 24, 12), Vec3::new(-1.0, 1.0, 1.0)),
        ),
        (
            "scaled_cube",
            scaled(primitives::cube(1.0), Vec3::new(-4.0, 0.25, 1.0)),
        ),
        ("sliver", sliver()),
        ("soup", soup()),
        ("tiny_cube", scaled(primitives::cube(1.0), Vec3::splat(1e-4))),
        ("nearly_cancelled", opposed(1.005)),
        ("cancelled", opposed(0.995)),
    ]
}

/// Whether the published form has an answer at every vertex of the mesh of that name: no triangle without area in space or in
/// texture, and no tangents that cancel.
pub(super) fn is_good(name: &str) -> bool {
    [
        "cube",
        "torus",
        "stretched_torus",
        "mirrored_torus",
        "scaled_cube",
        "tiny_cube",
    ]
    .contains(&name)
}

/// A mesh scaled along its axes, its normals kept at right angles to it and outward, and its triangles wound that way.
fn scaled(mut mesh: Mesh, scale: Vec3) -> Mesh {
    for position in &mut mesh.positions {
        *position *= scale;
    }
    for normal in &mut mesh.normals {
        *normal = (*normal / scale).normalize();
    }
    if scale.element_product() < 0.0 {
        mesh.indices
            .chunks_exact_mut(3)
            .for_each(|corners| corners.swap(1, 2));
    }
    mesh
}

/// A good triangle beside a needle without area and one whose texture is a needle.
fn sliver() -> Mesh {
    let positions = vec![Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::new(0.5, 1e-9, 0.0), Vec3::ONE];
    let uvs = vec![
        Vec2::ZERO,
        Vec2::X,
        Vec2::Y,
        Vec2::new(0.5, 0.5),
        Vec2::new(0.5, 1e-8),
    ];
    Mesh {
        normals: vec![Vec3::Z; 5],
        positions,
        uvs,
        tangents: Vec::new(),
        indices: vec![0, 1, 2, 0, 1, 3, 0, 1, 4],
    }
}

/// Triangles that share vertices at random, with texture coordinates of one byte: many are degenerate in one way or another.
fn soup() -> Mesh {
    let mut rng = stream("soup", 1);
    let mut coordinate = move |steps: u32| rng.random_range(0..=steps) as f32 / steps as f32;
    let positions: Vec<Vec3> = (0..64)
        .map(|_| Vec3::new(coordinate(7), coordinate(7), coordinate(7)))
        .collect();
    let uvs = (0..64)
        .map(|_| Vec2::new(coordinate(15), coordinate(15)))
        .collect();
    let normals = (0..64)
        .map(|_| (Vec3::new(coordinate(255), coordinate(255), coordinate(255)) - 0.5).normalize_or(Vec3::Z))
        .collect();
    let indices = (0..3 * 128).map(|_| (coordinate(63) * 63.0) as u32).collect();
    Mesh {
        positions,
        normals,
        uvs,
        tangents: Vec::new(),
        indices,
    }
}

/// Two triangles that share an edge, the second's texture mirrored: at the shared vertices T cancels.
pub(super) fn butterfly() -> Mesh {
    let positions = vec![Vec3::ZERO, Vec3::Y, -Vec3::X, Vec3::X];
    let uvs = vec![Vec2::ZERO, Vec2::Y, Vec2::X, Vec2::X];
    Mesh {
        normals: vec![Vec3::Z; 4],
        positions,
        uvs,
        tangents: Vec::new(),
        indices: vec![0, 1, 2, 0, 3, 1],
    }
}

/// A good triangle, one without area in space, and one that names a vertex twice.
pub(super) fn degenerate() -> Mesh {
    let positions = vec![Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::X * 0.5];
    let uvs = vec![Vec2::ZERO, Vec2::X, Vec2::Y, Vec2::new(0.5, 0.25)];
    let indices = vec![0, 1, 2, 0, 1, 3, 0, 0, 2];
    Mesh {
        normals: vec![Vec3::Z; 4],
        positions,
        uvs,
        tangents: Vec::new(),
        indices,
    }
}

/// Two triangles at a vertex, the second turned by half a turn and a little: what is left of their tangents' sum there is
/// `times` the share of 1/4096 of what went in, below which the hardened form takes it for noise.
fn opposed(times: f64) -> Mesh {
    // Two unit vectors at an angle of π − θ leave 2 sin(θ/2) of 2.
    let (sin, cos) = (2.0 * (times / 4096.0).asin()).sin_cos();
    let turned = |x: f64, y: f64| -Vec3::new((cos * x - sin * y) as f32, (sin * x + cos * y) as f32, 0.0);
    Mesh {
        positions: vec![Vec3::ZERO, Vec3::X, Vec3::Y, turned(1.0, 0.0), turned(0.0, 1.0)],
        normals: vec![Vec3::Z; 5],
        uvs: vec![Vec2::ZERO, Vec2::X, Vec2::Y, Vec2::X, Vec2::Y],
        tangents: Vec::new(),
        indices: vec![0, 1, 2, 0, 3, 4],
    }
}

#[cfg(test)]
mod tests {
    use super::meshes;

    #[test]
    fn every_mesh_is_well_formed() {
        for (name, mesh) in meshes() {
            assert!(mesh.validate().is_ok(), "{name}");
            assert_eq!(mesh.normals.len(), mesh.positions.len(), "{name}");
        }
    }
}
