//! Sphere and torus: grids over longitude and latitude, the seams with their own vertices.

use std::f64::consts::TAU;

use glam::{DVec3, Vec2};

use super::Vertex;
use crate::Mesh;

/// A sphere around the origin, `segments` round the equator, `rings` from pole to pole. u runs east from +z, v from the south
/// pole to the north pole. At the poles each segment has a vertex of its own, at the middle of its u.
#[must_use]
pub fn sphere(radius: f32, segments: u32, rings: u32) -> Mesh {
    let (segments, rings) = (segments.max(3), rings.max(2));
    let mut mesh = Mesh::default();
    let vertex = |u: f64, v: f64| {
        let (sin, cos) = ((v - 0.5) * TAU * 0.5).sin_cos();
        let out = outward(u);
        // Exact at the poles, where the cosine of a rounded angle is not quite 0.
        let cos = if v == 0.0 || v == 1.0 { 0.0 } else { cos };
        surface(DVec3::ZERO, radius, out * cos + DVec3::Y * sin, u, v)
    };
    let along_u = |i: u32| f64::from(i) / f64::from(segments);
    let along_v = |j: u32| f64::from(j) / f64::from(rings);
    let inner = |j: u32, i: u32| (j - 1) * (segments + 1) + i;
    for j in 1..rings {
        for i in 0..=segments {
            mesh.push(vertex(along_u(i), along_v(j)));
        }
    }
    for i in 0..segments {
        let middle = (f64::from(i) + 0.5) / f64::from(segments);
        let south = mesh.push(vertex(middle, 0.0));
        mesh.indices.extend([south, inner(1, i + 1), inner(1, i)]);
        for j in 1..rings - 1 {
            mesh.quad([inner(j, i), inner(j, i + 1), inner(j + 1, i + 1), inner(j + 1, i)]);
        }
        let north = mesh.push(vertex(middle, 1.0));
        mesh.indices
            .extend([inner(rings - 1, i), inner(rings - 1, i + 1), north]);
    }
    mesh
}

/// A torus around the y axis: `major` from the axis to the middle of the tube, `minor` the tube's radius; `segments` round
/// the axis, `sides` round the tube. u runs round the axis from +z, v round the tube from its outer equator upward.
#[must_use]
pub fn torus(major: f32, minor: f32, segments: u32, sides: u32) -> Mesh {
    let (segments, sides) = (segments.max(3), sides.max(3));
    let mut mesh = Mesh::default();
    for j in 0..=sides {
        for i in 0..=segments {
            let (u, v) = (
                f64::from(i) / f64::from(segments),
                f64::from(j) / f64::from(sides),
            );
            let (sin, cos) = turn(v);
            let out = outward(u);
            mesh.push(surface(
                out * f64::from(major),
                minor,
                out * cos + DVec3::Y * sin,
                u,
                v,
            ));
        }
    }
    let at = |j: u32, i: u32| j * (segments + 1) + i;
    for j in 0..sides {
        for i in 0..segments {
            mesh.quad([at(j, i), at(j, i + 1), at(j + 1, i + 1), at(j + 1, i)]);
        }
    }
    mesh
}

/// Sine and cosine of a share of a full turn, exactly the same at 0 and 1 so that seams close.
fn turn(share: f64) -> (f64, f64) {
    if share == 1.0 {
        (0.0, 1.0)
    } else {
        (share * TAU).sin_cos()
    }
}

fn outward(u: f64) -> DVec3 {
    let (sin, cos) = turn(u);
    DVec3::new(sin, 0.0, cos)
}

fn surface(center: DVec3, radius: f32, normal: DVec3, u: f64, v: f64) -> Vertex {
    let (sin, cos) = turn(u);
    Vertex {
        position: (center + normal * f64::from(radius)).as_vec3(),
        normal: normal.as_vec3(),
        tangent: DVec3::new(cos, 0.0, -sin).as_vec3(),
        uv: Vec2::new(u as f32, v as f32),
    }
}
