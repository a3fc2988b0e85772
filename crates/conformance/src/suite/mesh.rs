//! Mesh cases: the tangent kernels, triangles first and then vertices, against the f64 reference and the bound of the sums.
//!
//! A vertex gathers its triangles in ascending order, so the bound follows the same sums. Besides good meshes there are those
//! that the published form fails on: no texture area, triangles without area, mirrored halves that share vertices.

use std::collections::BTreeMap;

use bossage_assets::{Mesh, primitives};
use bossage_reference::frame_from_uv;
use bossage_reference::vector::normalize;
use bossage_runner::{BufferData, ComputeJob, Resources};
use bossage_shaders::{Form, Kernel};
use glam::{DVec2, DVec3, DVec4, Vec2, Vec3};
use rand::RngExt;

use crate::bench::Bench;
use crate::bounded::Bounded;
use crate::bounded::vector::{Vec3 as Bounded3, add, normalize as bounded_normalize, subtract};
use crate::case::{Case, Outcome, with_causes};
use crate::case_id::CaseId;
use crate::compare::{Comparison, Expected};
use crate::generate::random::stream;
use crate::module::Module;
use crate::oracle::Args;
use crate::tolerance;

/// One mesh with one form.
pub(super) struct MeshCase {
    id: CaseId,
    form: Form,
    mesh: Mesh,
}

/// The meshes by name.
pub(super) fn meshes() -> Vec<(&'static str, Mesh)> {
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
    ]
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
fn butterfly() -> Mesh {
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
fn degenerate() -> Mesh {
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

/// Every mesh in both forms.
pub fn cases() -> impl Iterator<Item = Box<dyn Case>> {
    let both = [Form::Published, Form::Hardened];
    meshes().into_iter().flat_map(move |(name, mesh)| {
        both.map(|form| {
            let id = CaseId::new("frame_from_uv", Some(form.as_str()), "mesh").with("mesh", name);
            Box::new(MeshCase::new(id, form, mesh.clone())) as Box<dyn Case>
        })
    })
}

/// For each vertex the triangles that name it, ascending, as often as they do: offsets and list.
fn adjacency(mesh: &Mesh) -> (Vec<u32>, Vec<u32>) {
    let mut of_vertex = vec![Vec::new(); mesh.positions.len()];
    for (corner, &vertex) in mesh.indices.iter().enumerate() {
        of_vertex[vertex as usize].push(corner as u32 / 3);
    }
    let ends = of_vertex.iter().scan(0, |end, triangles| {
        *end += triangles.len() as u32;
        Some(*end)
    });
    let offsets = std::iter::once(0).chain(ends).collect();
    (offsets, of_vertex.concat())
}

fn bytes<T: Copy, const N: usize>(items: &[T], to_bytes: impl Fn(T) -> [u8; N]) -> Vec<u8> {
    items.iter().flat_map(|&item| to_bytes(item)).collect()
}

fn float_bytes(values: impl IntoIterator<Item = f32>) -> Vec<u8> {
    bytes(&values.into_iter().collect::<Vec<_>>(), f32::to_le_bytes)
}

impl MeshCase {
    pub(super) fn new(id: CaseId, form: Form, mesh: Mesh) -> Self {
        Self { id, form, mesh }
    }

    pub(super) fn kernels(&self) -> [Kernel; 2] {
        match self.form {
            Form::Published => [
                Kernel::FrameFromUvTrianglesPublished,
                Kernel::FrameFromUvVerticesPublished,
            ],
            Form::Hardened => [Kernel::FrameFromUvTriangles, Kernel::FrameFromUvVertices],
        }
    }

    /// The buffers by name; `frames` and `tangents` are outputs.
    fn buffers(&self) -> BTreeMap<&'static str, Vec<u8>> {
        let (offsets, triangles) = adjacency(&self.mesh);
        let word = |words: &[u32]| bytes(words, u32::to_le_bytes);
        BTreeMap::from([
            (
                "positions",
                float_bytes(self.mesh.positions.iter().flat_map(|p| p.to_array())),
            ),
            (
                "uvs",
                float_bytes(self.mesh.uvs.iter().flat_map(|uv| uv.to_array())),
            ),
            ("indices", word(&self.mesh.indices)),
            ("adjacency_offsets", word(&offsets)),
            ("adjacency_triangles", word(&triangles)),
            (
                "normals",
                float_bytes(self.mesh.normals.iter().flat_map(|n| n.to_array())),
            ),
        ])
    }

    /// Runs one kernel; gives back all that it may write.
    fn dispatch(
        &self,
        bench: &Bench<'_>,
        kernel: Kernel,
        buffers: &BTreeMap<&'static str, Vec<u8>>,
        output: (&str, usize),
        items: usize,
    ) -> Result<BTreeMap<String, Vec<u8>>, String> {
        let module = bench.module(&Module::Kernel(kernel))?;
        let shader = module.shader(kernel.entry())?;
        let mut resources = Resources::default();
        for (name, bytes) in buffers.iter().filter(|(name, _)| shader.binding(name).is_some()) {
            resources
                .buffers
                .insert((*name).to_owned(), BufferData::Bytes(bytes));
        }
        resources
            .buffers
            .insert(output.0.to_owned(), BufferData::Output(output.1));
        let name = self.id.to_string();
        let workgroups = [(items as u32).div_ceil(kernel.workgroup_size()[0]), 1, 1];
        let job = ComputeJob {
            name: &name,
            shader,
            resources,
            workgroups,
        };
        Ok(job
            .run(bench.device)
            .map_err(|error| with_causes(&error))?
            .buffers)
    }

    /// The tangents, four floats a vertex.
    pub(super) fn tangents(&self, bench: &Bench<'_>) -> Result<Vec<f32>, String> {
        let [triangles, vertices] = self.kernels();
        let (triangle_count, vertex_count) = (self.mesh.indices.len() / 3, self.mesh.positions.len());
        let mut buffers = self.buffers();
        let written = self.dispatch(
            bench,
            triangles,
            &buffers,
            ("frames", 48 * triangle_count),
            triangle_count,
        )?;
        let frames = written
            .get("frames")
            .cloned()
            .ok_or("the triangle pass wrote no frames")?;
        buffers.insert("frames", frames);
        let written = self.dispatch(
            bench,
            vertices,
            &buffers,
            ("tangents", 16 * vertex_count),
            vertex_count,
        )?;
        let tangents = written
            .get("tangents")
            .ok_or("the vertex pass wrote no tangents")?;
        let (words, _) = tangents.as_chunks::<4>();
        Ok(words.iter().map(|word| f32::from_le_bytes(*word)).collect())
    }

    /// Truth by the reference's own mesh functions.
    fn truth(&self) -> Vec<DVec4> {
        let doubles = |vectors: &[Vec3]| vectors.iter().map(|v| v.as_dvec3()).collect::<Vec<DVec3>>();
        let positions = doubles(&self.mesh.positions);
        let uvs: Vec<DVec2> = self.mesh.uvs.iter().map(|uv| uv.as_dvec2()).collect();
        let normals = match self.form {
            Form::Hardened => doubles(&self.mesh.normals),
            Form::Published => frame_from_uv::summed_normals(&positions, &self.mesh.indices),
        };
        let mesh = frame_from_uv::Triangles {
            positions: &positions,
            normals: &normals,
            uvs: &uvs,
            indices: &self.mesh.indices,
        };
        match self.form {
            Form::Hardened => frame_from_uv::hardened(&mesh),
            Form::Published => {
                let unit = |t: DVec4| normalize(t.truncate()).extend(t.w);
                frame_from_uv::published(&mesh).into_iter().map(unit).collect()
            }
        }
    }

    /// One triangle's share: normal, tangent, bitangent, weight.
    fn share(&self, triangle: usize) -> Vec<Bounded> {
        let corner = |k: usize| self.mesh.indices[3 * triangle + k] as usize;
        let position = |k: usize| self.mesh.positions[corner(k)].to_array().map(Bounded::input);
        let uv = |k: usize| self.mesh.uvs[corner(k)].to_array().map(Bounded::input);
        let (p, q) = (
            subtract(&position(1), &position(0)),
            subtract(&position(2), &position(0)),
        );
        let (st1, st2) = (subtract(&uv(1), &uv(0)), subtract(&uv(2), &uv(0)));
        let arguments = [p.as_slice(), &q, &st1, &st2].concat();
        row(self.function("triangle"), &arguments)
    }

    fn function(&self, part: &str) -> String {
        match self.form {
            Form::Published => format!("frame_from_uv_{part}_published"),
            Form::Hardened => format!("frame_from_uv_{part}"),
        }
    }

    /// The bounds of every vertex' tangent.
    fn bounds(&self) -> Vec<Vec<Bounded>> {
        let shares: Vec<Vec<Bounded>> = (0..self.mesh.indices.len() / 3)
            .map(|triangle| self.share(triangle))
            .collect();
        let (offsets, triangles) = adjacency(&self.mesh);
        let vertex = |v: usize| {
            let of_vertex = &triangles[offsets[v] as usize..offsets[v + 1] as usize];
            let mut sum = [Bounded::exact(0.0); 10];
            for &triangle in of_vertex {
                if let Some(share) = shares[triangle as usize].first_chunk::<10>() {
                    sum = add(&sum, share);
                }
            }
            self.vertex(v, &sum)
        };
        (0..self.mesh.positions.len()).map(vertex).collect()
    }

    fn vertex(&self, v: usize, sum: &[Bounded; 10]) -> Vec<Bounded> {
        match self.form {
            Form::Hardened => {
                let normal = self.mesh.normals[v].to_array().map(Bounded::input);
                row(self.function("vertex"), &[normal.as_slice(), &sum[3..]].concat())
            }
            Form::Published => {
                let normal = bounded_normalize(&[sum[0], sum[1], sum[2]]);
                let tangent = row(self.function("vertex"), &[normal.as_slice(), &sum[3..9]].concat());
                let [x, y, z, w] = *tangent.first_chunk::<4>().unwrap_or(&[Bounded::OPEN; 4]);
                let unit: Bounded3 = bounded_normalize(&[x, y, z]);
                [unit.as_slice(), &[w]].concat()
            }
        }
    }

    fn judge(&self, bench: &Bench<'_>) -> Result<Outcome, String> {
        let got = self.tangents(bench)?;
        let (truth, bounds) = (self.truth(), self.bounds());
        let mut comparison = Comparison::default();
        for (v, (truth, bounds)) in truth.iter().zip(&bounds).enumerate() {
            let expected = truth
                .to_array()
                .into_iter()
                .zip(bounds)
                .map(|(truth, &bound)| Expected {
                    truth,
                    bound: bound.into(),
                });
            let tangent = got.get(4 * v..4 * v + 4).unwrap_or_default();
            comparison.item(&[v as f32], tangent, &expected.collect::<Vec<_>>());
        }
        Ok(Outcome::of(truth.len(), comparison, 1.0))
    }
}

/// The row of the tolerance table, evaluated.
fn row(function: String, arguments: &[Bounded]) -> Vec<Bounded> {
    tolerance::find(&function)
        .map(|row| (row.bound)(&mut Args::new(arguments)))
        .unwrap_or_default()
}

impl Case for MeshCase {
    fn id(&self) -> &CaseId {
        &self.id
    }

    fn basis(&self) -> Vec<&'static str> {
        crate::oracle::BASIS.to_vec()
    }

    fn modules(&self) -> Result<Vec<Module>, String> {
        Ok(self.kernels().map(Module::Kernel).to_vec())
    }

    fn run(&self, bench: &Bench<'_>) -> Outcome {
        self.judge(bench).unwrap_or_else(Outcome::failed)
    }
}

#[cfg(test)]
mod tests {
    use super::{adjacency, butterfly, degenerate, meshes};

    #[test]
    fn adjacency_lists_each_corner_once() {
        let (offsets, triangles) = adjacency(&butterfly());
        assert_eq!(offsets, [0, 2, 4, 5, 6]);
        assert_eq!(triangles, [0, 1, 0, 1, 0, 1]);
        // A triangle that names a vertex twice is listed twice.
        let (offsets, triangles) = adjacency(&degenerate());
        assert_eq!(&triangles[offsets[0] as usize..offsets[1] as usize], [0, 1, 2, 2]);
    }

    #[test]
    fn every_mesh_is_well_formed() {
        for (name, mesh) in meshes() {
            assert!(mesh.validate().is_ok(), "{name}");
            assert_eq!(mesh.normals.len(), mesh.positions.len(), "{name}");
        }
    }
}
