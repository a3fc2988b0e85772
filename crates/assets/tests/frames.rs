//! Tangent frames: the published form with its faults, the hardened form without, MikkTSpace.

use bossage_assets::{Mesh, frame_from_uv, frame_mikktspace, primitives};
use glam::{DVec3, Vec2, Vec3, Vec4};
use proptest::prelude::*;

fn bare(mut mesh: Mesh) -> Mesh {
    mesh.tangents.clear();
    mesh
}

/// Two triangles sharing an edge; `uvs` decide what is wrong.
fn two_triangles(uvs: [[f32; 2]; 4]) -> Mesh {
    Mesh {
        positions: vec![Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::new(1.0, 1.0, 0.0)],
        uvs: uvs.map(Vec2::from).to_vec(),
        indices: vec![0, 1, 2, 2, 1, 3],
        ..Mesh::default()
    }
}

/// T unit and orthogonal to N, w a sign. Normalising: 2⁻²² (root, division, 3 products); orthogonal: what Gram–Schmidt leaves,
/// 6 roundings of the parallel part, magnified by the shortening, at most `magnified`.
fn assert_frame(n: Vec3, t: Vec4, magnified: f64) {
    let (n, tangent): (DVec3, DVec3) = (n.as_dvec3(), t.truncate().as_dvec3());
    assert!((tangent.length() - 1.0).abs() <= 2f64.powi(-22), "{t}");
    assert!(
        n.dot(tangent).abs() <= 6.0 * 2f64.powi(-24) * magnified + 2f64.powi(-22),
        "{n} {t}"
    );
    assert!(t.w == 1.0 || t.w == -1.0, "{t}");
}

#[test]
fn published_and_hardened_find_the_frames_of_plane_and_cube() {
    for mesh in [primitives::plane(3.0, 2.0), primitives::cube(2.0)] {
        for generate in [frame_from_uv::published, frame_from_uv::hardened] {
            let mut made = bare(mesh.clone());
            generate(&mut made).unwrap();
            // All numbers involved are small integers and halves: nothing is rounded.
            assert_eq!(made.tangents, mesh.tangents);
            assert_eq!(made.normals, mesh.normals);
        }
    }
}

#[test]
fn hardened_frames_of_curved_bodies_are_near_the_exact_ones() {
    for mesh in [
        primitives::sphere(1.0, 96, 48),
        primitives::torus(2.0, 0.5, 96, 48),
    ] {
        let mut made = bare(mesh.clone());
        frame_from_uv::hardened(&mut made).unwrap();
        assert_eq!(made.normals, mesh.normals, "given normals are kept");
        for (i, (t, exact)) in made.tangents.iter().zip(&mesh.tangents).enumerate() {
            assert_frame(mesh.normals[i], *t, 4096.0);
            // A vertex averages triangles on the same side of a seam at worst: half a segment's turn, π/96, and rows of
            // pole triangles, whose T is that of the middle of their base.
            let angle = t.truncate().dot(exact.truncate()).clamp(-1.0, 1.0).acos();
            assert!(
                angle <= std::f32::consts::PI / 96.0 + 1e-3 && t.w == 1.0,
                "vertex {i}: {angle}"
            );
        }
    }
}

#[test]
fn mirrored_uvs_turn_the_sign() {
    let mut mesh = primitives::torus(2.0, 0.5, 24, 12);
    mesh.flip_v();
    let mut made = bare(mesh);
    frame_from_uv::hardened(&mut made).unwrap();
    assert!(made.tangents.iter().all(|t| t.w == -1.0));
    let mut mikk = bare(made);
    frame_mikktspace::generate(&mut mikk).unwrap();
    assert!(mikk.tangents.iter().all(|t| t.w == -1.0));
}

#[test]
fn witness_a_triangle_without_uv_area_divides_by_zero() {
    // The second triangle's UVs lie on one line.
    let mesh = two_triangles([[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [0.5, 0.5]]);
    let mut published = mesh.clone();
    frame_from_uv::published(&mut published).unwrap();
    assert!(published.tangents[3].truncate().is_nan() && published.tangents[1].truncate().is_nan());
    let mut hardened = mesh;
    frame_from_uv::hardened(&mut hardened).unwrap();
    assert_eq!(hardened.tangents[..3], [Vec4::new(1.0, 0.0, 0.0, 1.0); 3]);
    assert_frame(hardened.normals[3], hardened.tangents[3], 1.0);
}

#[test]
fn witness_a_triangle_without_area_spoils_its_neighbours() {
    let mut mesh = two_triangles([[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0]]);
    mesh.positions[3] = Vec3::new(0.5, 0.5, 0.0);
    let mut published = mesh.clone();
    frame_from_uv::published(&mut published).unwrap();
    assert!(published.normals[1].is_nan());
    frame_from_uv::hardened(&mut mesh).unwrap();
    assert_eq!(mesh.normals[1], Vec3::Z);
    assert_eq!(mesh.tangents[1], Vec4::new(1.0, 0.0, 0.0, 1.0));
}

#[test]
fn witness_mirrored_neighbours_cancel() {
    // u grows to the edge and falls after it: T is +x on one side, −x on the other.
    let mesh = Mesh {
        positions: vec![Vec3::ZERO, Vec3::Y, Vec3::X, -Vec3::X],
        uvs: vec![Vec2::ZERO, Vec2::Y, Vec2::X, Vec2::X],
        indices: vec![0, 2, 1, 0, 1, 3],
        ..Mesh::default()
    };
    let mut published = mesh.clone();
    frame_from_uv::published(&mut published).unwrap();
    assert!(published.tangents[0].truncate().is_nan(), "0/0");
    let mut hardened = mesh.clone();
    frame_from_uv::hardened(&mut hardened).unwrap();
    assert_frame(hardened.normals[0], hardened.tangents[0], 1.0);
    // MikkTSpace splits the vertices of the mirror line instead, and both sides are right.
    let mut mikk = mesh;
    frame_mikktspace::generate(&mut mikk).unwrap();
    assert_eq!(mikk.positions.len(), 6);
    let corner = |i: usize| mikk.tangents[mikk.indices[i] as usize];
    assert_eq!(
        [corner(0), corner(3)],
        [Vec4::new(1.0, 0.0, 0.0, 1.0), Vec4::new(-1.0, 0.0, 0.0, -1.0)]
    );
}

#[test]
fn witness_small_charts_outweigh_large_ones_as_published() {
    // Both triangles have T of unit direction, the second in a chart 1000 times smaller: its T is 1000 times longer.
    let mut mesh = two_triangles([[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0]]);
    mesh.uvs[3] = Vec2::new(0.5005, 0.5005);
    let mut published = mesh.clone();
    frame_from_uv::published(&mut published).unwrap();
    frame_from_uv::hardened(&mut mesh).unwrap();
    // Triangle 1 has T = +x. Triangle 2, by its own equations, T ∝ (999, −1001)/…: 45° off.
    let angle = |m: &Mesh| m.tangents[1].y.atan2(m.tangents[1].x).abs().to_degrees();
    assert!(angle(&published) > 44.0, "{}", angle(&published));
    // Equal areas: the mean direction of 0° and 45°.
    assert!((angle(&mesh) - 22.5).abs() < 0.1, "{}", angle(&mesh));
}

#[test]
fn a_mesh_that_says_nothing_about_direction_still_gets_frames() {
    let mut mesh = two_triangles([[0.25; 2]; 4]);
    frame_from_uv::hardened(&mut mesh).unwrap();
    for (n, t) in mesh.normals.iter().zip(&mesh.tangents) {
        assert_frame(*n, *t, 1.0);
    }
    let mut mikk = bare(mesh);
    frame_mikktspace::generate(&mut mikk).unwrap();
    for (n, t) in mikk.normals.iter().zip(&mikk.tangents) {
        assert_frame(*n, *t, 1.0);
    }
}

#[test]
fn invalid_meshes_are_refused_and_left_alone() {
    let mut mesh = primitives::cube(1.0);
    mesh.indices[0] = 99;
    let before = mesh.clone();
    for generate in [
        frame_from_uv::published,
        frame_from_uv::hardened,
        frame_mikktspace::generate,
    ] {
        assert!(generate(&mut mesh).is_err());
        assert_eq!(mesh, before);
    }
}

#[test]
fn mikktspace_keeps_the_triangles_and_matches_the_exact_frames_of_flat_bodies() {
    for mesh in [primitives::plane(3.0, 2.0), primitives::cube(2.0)] {
        let mut mikk = bare(mesh.clone());
        frame_mikktspace::generate(&mut mikk).unwrap();
        assert_eq!(mikk, mesh);
    }
    let mesh = primitives::sphere(1.0, 24, 12);
    let mut mikk = bare(mesh.clone());
    frame_mikktspace::generate(&mut mikk).unwrap();
    mikk.validate().unwrap();
    let corners = |m: &Mesh| {
        m.indices
            .iter()
            .map(|&i| (m.positions[i as usize], m.normals[i as usize], m.uvs[i as usize]))
            .collect::<Vec<_>>()
    };
    assert_eq!(corners(&mikk), corners(&mesh));
}

/// The corners of a mesh as the reference algorithm gives them, unindexed: no re-indexing of ours in between.
struct Unindexed<'a>(&'a Mesh, Vec<Vec4>);

impl bevy_mikktspace::Geometry for Unindexed<'_> {
    fn num_faces(&self) -> usize {
        self.0.indices.len() / 3
    }
    fn num_vertices_of_face(&self, _: usize) -> usize {
        3
    }
    fn position(&self, face: usize, vert: usize) -> [f32; 3] {
        self.0.positions[self.0.indices[face * 3 + vert] as usize].into()
    }
    fn normal(&self, face: usize, vert: usize) -> [f32; 3] {
        self.0.normals[self.0.indices[face * 3 + vert] as usize].into()
    }
    fn tex_coord(&self, face: usize, vert: usize) -> [f32; 2] {
        self.0.uvs[self.0.indices[face * 3 + vert] as usize].into()
    }
    fn set_tangent(&mut self, t: Option<bevy_mikktspace::TangentSpace>, face: usize, vert: usize) {
        self.1[face * 3 + vert] = Vec4::from(t.unwrap_or_default().tangent_encoded());
    }
}

#[test]
fn every_corner_keeps_the_tangent_the_algorithm_gave_it() {
    let mut half_mirrored = primitives::torus(2.0, 0.5, 16, 12);
    // Fold the texture at v = 1/2, as artists do with symmetric bodies.
    half_mirrored
        .uvs
        .iter_mut()
        .for_each(|uv| uv.y = 0.5 - (uv.y - 0.5).abs());
    for mesh in [primitives::sphere(1.0, 16, 9), half_mirrored] {
        let mut expected = Unindexed(&mesh, vec![Vec4::ZERO; mesh.indices.len()]);
        bevy_mikktspace::generate_tangents(&mut expected).unwrap();
        let mut mikk = mesh.clone();
        frame_mikktspace::generate(&mut mikk).unwrap();
        let corners: Vec<Vec4> = mikk.indices.iter().map(|&i| mikk.tangents[i as usize]).collect();
        assert_eq!(corners, expected.1);
    }
}

prop_compose! {
    /// Soups of triangles over few vertices with few different coordinates: full of slivers, folds and repeated vertices.
    fn soups()(
        vertices in proptest::collection::vec(((-3i8..=3, -3i8..=3, -3i8..=3), (-2i8..=2, -2i8..=2)), 3..9),
        triangles in proptest::collection::vec((any::<u8>(), any::<u8>(), any::<u8>()), 1..12),
        scale in prop_oneof![Just(1.0f32), Just(1e-12), Just(1e12)],
    ) -> Mesh {
        let count = vertices.len() as u32;
        let pick = |i: u8| u32::from(i) % count;
        Mesh {
            positions: vertices.iter().map(|((x, y, z), _)| Vec3::new(f32::from(*x), f32::from(*y), f32::from(*z)) * scale).collect(),
            uvs: vertices.iter().map(|(_, (u, v))| Vec2::new(f32::from(*u), f32::from(*v)) * 0.37).collect(),
            indices: triangles.iter().flat_map(|(a, b, c)| [pick(*a), pick(*b), pick(*c)]).collect(),
            ..Mesh::default()
        }
    }
}

proptest! {
    #[test]
    fn hardened_frames_are_always_frames(mut mesh in soups()) {
        frame_from_uv::hardened(&mut mesh).unwrap();
        for (n, t) in mesh.normals.iter().zip(&mesh.tangents) {
            assert_frame(*n, *t, 4096.0);
        }
    }

    #[test]
    fn mikktspace_always_gives_finite_tangents_and_a_valid_mesh(mut mesh in soups()) {
        let before = mesh.indices.len();
        frame_mikktspace::generate(&mut mesh).unwrap();
        prop_assert!(mesh.validate().is_ok());
        prop_assert_eq!(mesh.indices.len(), before);
        prop_assert_eq!(mesh.tangents.len(), mesh.positions.len());
    }

    #[test]
    fn the_order_of_vertices_in_a_triangle_does_not_matter(mesh in soups()) {
        let turned = |m: &Mesh| {
            let mut m = m.clone();
            m.indices.chunks_exact_mut(3).for_each(|t| t.rotate_left(1));
            m
        };
        let (mut a, mut b) = (mesh.clone(), turned(&mesh));
        frame_from_uv::hardened(&mut a).unwrap();
        frame_from_uv::hardened(&mut b).unwrap();
        // Normals are sums of the same cross products, exact for small integers, at scale 1.
        if mesh.positions.iter().all(|p| p.abs().max_element() <= 3.0) && mesh.positions.iter().any(|p| p.abs().max_element() >= 1.0) {
            prop_assert_eq!(a.normals, b.normals);
        }
    }
}
