//! `frame_mikktspace`: the tangent frames of MikkTSpace, the standard of glTF and of map bakers, through the maintained
//! crate `bevy_mikktspace`, which is bit for bit the reference implementation.
//!
//! MikkTSpace works on corners, not on vertices: corners that share a vertex but belong to charts of opposite handedness,
//! or apart in tangent, get different tangents. The mesh is therefore re-indexed: a vertex is duplicated for each further
//! tangent it needs, new vertices following the old ones in the order of the triangles. Nothing else changes.
//!
//! Convention (MikkTSpace's own): B = w·cross(N, T); interpolate N and T, and use them unnormalised in the pixel shader.

use std::collections::BTreeMap;

use bevy_mikktspace::{Geometry, TangentSpace};
use glam::{Vec3, Vec4};

use crate::{Error, Mesh, frame_from_normal};

/// Replaces the tangents of a mesh, and duplicates vertices where corners differ. Missing normals are made smooth first.
///
/// Corners for which the algorithm finds nothing (a degenerate triangle without neighbours) get the tangent of
/// [`frame_from_normal`], w = +1.
///
/// # Errors
/// [`Error::Mesh`] when the mesh is not valid to begin with.
pub fn generate(mesh: &mut Mesh) -> Result<(), Error> {
    mesh.validate()?;
    if mesh.normals.is_empty() {
        mesh.smooth_normals();
    }
    let mut corners = Corners {
        mesh,
        tangents: vec![None; mesh.indices.len()],
    };
    // The crate's error type has no values today; it is marked as open.
    if bevy_mikktspace::generate_tangents(&mut corners).is_err() {
        corners.tangents.fill(None);
    }
    let tangents = corners.tangents;
    reindex(mesh, &tangents);
    Ok(())
}

struct Corners<'a> {
    mesh: &'a Mesh,
    tangents: Vec<Option<Vec4>>,
}

impl Corners<'_> {
    fn vertex(&self, face: usize, vert: usize) -> usize {
        self.mesh.indices[face * 3 + vert] as usize
    }
}

impl Geometry for Corners<'_> {
    fn num_faces(&self) -> usize {
        self.mesh.indices.len() / 3
    }

    fn num_vertices_of_face(&self, _face: usize) -> usize {
        3
    }

    fn position(&self, face: usize, vert: usize) -> [f32; 3] {
        self.mesh.positions[self.vertex(face, vert)].to_array()
    }

    fn normal(&self, face: usize, vert: usize) -> [f32; 3] {
        self.mesh.normals[self.vertex(face, vert)].to_array()
    }

    fn tex_coord(&self, face: usize, vert: usize) -> [f32; 2] {
        self.mesh.uvs[self.vertex(face, vert)].to_array()
    }

    fn set_tangent(&mut self, tangent_space: Option<TangentSpace>, face: usize, vert: usize) {
        self.tangents[face * 3 + vert] = tangent_space.map(|t| Vec4::from(t.tangent_encoded()));
    }
}

fn reindex(mesh: &mut Mesh, corner_tangents: &[Option<Vec4>]) {
    let old_vertices = mesh.positions.len();
    let mut tangents: Vec<Option<Vec4>> = vec![None; old_vertices];
    let mut duplicates = BTreeMap::<(u32, [u32; 4]), u32>::new();
    for (corner, tangent) in corner_tangents.iter().enumerate() {
        let vertex = mesh.indices[corner];
        let tangent = usable(*tangent, mesh.normals[vertex as usize]);
        let first = *tangents[vertex as usize].get_or_insert(tangent);
        if bits(first) != bits(tangent) {
            let next = tangents.len() as u32;
            let copy = *duplicates.entry((vertex, bits(tangent))).or_insert(next);
            if copy == next {
                duplicate(mesh, vertex as usize);
                tangents.push(Some(tangent));
            }
            mesh.indices[corner] = copy;
        }
    }
    let or_fallback = |(t, &n): (Option<Vec4>, &Vec3)| usable(t, n);
    mesh.tangents = tangents.into_iter().zip(&mesh.normals).map(or_fallback).collect();
}

fn usable(tangent: Option<Vec4>, normal: Vec3) -> Vec4 {
    tangent
        .filter(|t| t.is_finite() && t.truncate() != Vec3::ZERO)
        .unwrap_or_else(|| frame_from_normal::hardened(normal).0.extend(1.0))
}

fn bits(v: Vec4) -> [u32; 4] {
    v.to_array().map(f32::to_bits)
}

fn duplicate(mesh: &mut Mesh, vertex: usize) {
    mesh.positions.push(mesh.positions[vertex]);
    mesh.normals.push(mesh.normals[vertex]);
    mesh.uvs.push(mesh.uvs[vertex]);
}
