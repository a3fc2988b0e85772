//! `frame_from_uv`: tangent frames from texture coordinates, triangle by triangle, gathered at the vertices.
//!
//! Published form (the article on parallax bump mapping): for each triangle with edges P, Q and UV edges (s₁,t₁), (s₂,t₂),
//! (T; B) = 1/(s₁t₂ − s₂t₁)·[[t₂, −t₁], [−s₂, s₁]]·(P; Q); N, T and B are summed over the triangles of a vertex; then
//! T' = T − (N·T)N and w = (N×T)·B < 0 ? −1 : 1. N of a triangle is its unit normal; the summed N is normalised before, T'
//! after the orthogonalisation, without which the article's formulas are no projection and no frame.
//! Faults, kept: a triangle without UV area divides by zero and one without area normalises a zero vector (NaN or infinity
//! spreads to all its vertices); large T of small UV triangles outweigh all others; mirrored neighbours cancel.
//!
//! Hardened form: triangles whose UV area cannot be told from zero, or without area, are skipped; N is weighted by area, T
//! and B are unit vectors weighted by area; normals that the mesh already has are kept; where no direction is left (all
//! skipped, cancelled, or parallel to N) the tangent is that of [`frame_from_normal`], w = +1.
//! Vertices are not split: for charts mirrored into each other use [`frame_mikktspace`](crate::frame_mikktspace).
//!
//! Sums run over triangles in their order in the mesh, so that a gather by vertex (triangles ascending) in a compute kernel
//! adds in the same order. Convention: B = w·cross(N, T).

use glam::{Vec2, Vec3};

use crate::scaled::{direction, length};
use crate::{Error, Mesh, frame_from_normal};

/// Where UV area, or what is left of a tangent, cannot be told from rounding noise.
mod limits {
    /// s₁t₂ − s₂t₁ in f32 is off by at most 2⁻²⁴ of each product and of the difference: below this share of
    /// |s₁t₂| + |s₂t₁| its sign is not known.
    pub(super) const UV_AREA: f32 = 2.0 * f32::EPSILON;
    /// A tangent left shorter than this share of what went in has lost 12 of its 24 bits to cancellation: its direction is
    /// uncertain by 2⁻¹⁰ or more.
    pub(super) const CANCELLED: f32 = 1.0 / 4096.0;
}

/// N, T and B of one triangle, or their sums at a vertex.
#[derive(Debug, Clone, Copy, Default)]
struct Frame {
    n: Vec3,
    t: Vec3,
    b: Vec3,
    /// Sum of the weights of T, to tell cancellation from small triangles.
    weight: f32,
}

impl std::ops::AddAssign for Frame {
    fn add_assign(&mut self, other: Frame) {
        self.n += other.n;
        self.t += other.t;
        self.b += other.b;
        self.weight += other.weight;
    }
}

/// Corner edges of a triangle.
struct Edges {
    p: Vec3,
    q: Vec3,
    st1: Vec2,
    st2: Vec2,
}

/// Fills in normals and tangents as published. The result may hold NaN and infinities: see the module's doc.
///
/// # Errors
/// [`Error::Mesh`] when the mesh is not valid to begin with.
pub fn published(mesh: &mut Mesh) -> Result<(), Error> {
    let sums = gather(mesh, published_triangle)?;
    mesh.normals = sums.iter().map(|sum| sum.n.normalize()).collect();
    let tangent = |(sum, &n): (&Frame, &Vec3)| {
        let t = sum.t - n * n.dot(sum.t);
        let w = if n.cross(sum.t).dot(sum.b) < 0.0 {
            -1.0
        } else {
            1.0
        };
        t.normalize().extend(w)
    };
    mesh.tangents = sums.iter().zip(&mesh.normals).map(tangent).collect();
    Ok(())
}

/// Fills in tangents, and normals where the mesh has none, in the hardened form. Every result is finite and orthonormal.
///
/// # Errors
/// [`Error::Mesh`] when the mesh is not valid to begin with.
pub fn hardened(mesh: &mut Mesh) -> Result<(), Error> {
    let sums = gather(mesh, hardened_triangle)?;
    if mesh.normals.is_empty() {
        mesh.normals = sums
            .iter()
            .map(|sum| direction(sum.n).unwrap_or(Vec3::Z))
            .collect();
    }
    mesh.tangents = sums
        .iter()
        .zip(&mesh.normals)
        .map(|(sum, &n)| hardened_vertex(sum, n))
        .collect();
    Ok(())
}

fn gather(mesh: &Mesh, frame: fn(&Edges) -> Frame) -> Result<Vec<Frame>, Error> {
    mesh.validate()?;
    let mut sums = vec![Frame::default(); mesh.positions.len()];
    for [a, b, c] in mesh.triangles() {
        let (p, uv) = (&mesh.positions, &mesh.uvs);
        let of_triangle = frame(&Edges {
            p: p[b] - p[a],
            q: p[c] - p[a],
            st1: uv[b] - uv[a],
            st2: uv[c] - uv[a],
        });
        [a, b, c].into_iter().for_each(|i| sums[i] += of_triangle);
    }
    Ok(sums)
}

fn published_triangle(e: &Edges) -> Frame {
    let inverse = 1.0 / (e.st1.x * e.st2.y - e.st2.x * e.st1.y);
    Frame {
        n: e.p.cross(e.q).normalize(),
        t: (e.p * e.st2.y - e.q * e.st1.y) * inverse,
        b: (e.q * e.st1.x - e.p * e.st2.x) * inverse,
        weight: 1.0,
    }
}

fn hardened_triangle(e: &Edges) -> Frame {
    let n = e.p.cross(e.q);
    let area = length(n);
    let (ad, bc) = (e.st1.x * e.st2.y, e.st2.x * e.st1.y);
    let uv_area = ad - bc;
    let no_direction = Frame {
        n,
        ..Frame::default()
    };
    // NaN, which overflowing products of huge coordinates give, is not known either.
    let sign_is_known = uv_area.abs() > limits::UV_AREA * (ad.abs() + bc.abs());
    if !sign_is_known || area == 0.0 {
        return no_direction;
    }
    let sign = uv_area.signum();
    let t = (e.p * e.st2.y - e.q * e.st1.y) * sign;
    let b = (e.q * e.st1.x - e.p * e.st2.x) * sign;
    match (direction(t), direction(b)) {
        (Some(t), Some(b)) => Frame {
            n,
            t: t * area,
            b: b * area,
            weight: area,
        },
        _ => no_direction,
    }
}

fn hardened_vertex(sum: &Frame, n: Vec3) -> glam::Vec4 {
    let t = sum.t - n * n.dot(sum.t);
    let left = length(t) > limits::CANCELLED * sum.weight;
    let Some(unit) = direction(t).filter(|_| left) else {
        return fallback(n);
    };
    let w = if n.cross(unit).dot(sum.b) < 0.0 { -1.0 } else { 1.0 };
    unit.extend(w)
}

fn fallback(n: Vec3) -> glam::Vec4 {
    frame_from_normal::hardened(n).0.extend(1.0)
}
