//! Mesh cases: the tangent kernels, triangles first and then vertices, against the f64 reference and what the kernels' own IR
//! allows (`dispatch.rs`).
//!
//! All that they write is judged: the triangles' frames, the vertices' tangents, and the normals that the published form sums.
//! The vertex pass is given what the triangle pass left, on the adapter and as intervals; so the intervals of tangents hold what
//! both passes may lose.

mod shapes;

use std::collections::BTreeMap;

use bossage_assets::Mesh;
use bossage_reference::frame_from_uv;
use bossage_reference::vector::normalize;
use bossage_runner::{BufferData, Resources};
use bossage_shaders::{Form, Kernel};
use glam::{DVec2, DVec3, DVec4};

use crate::bench::Bench;
use crate::bound::Bound;
use crate::case::{Case, Outcome};
use crate::case_id::CaseId;
use crate::compare::{Comparison, Expected};
use crate::dispatch::{Accepted, Dispatch, Kept, float_bounds};
use crate::module::Module;
use crate::oracle::{self, Args};

pub(super) use shapes::meshes;

/// One mesh with one form.
pub(super) struct MeshCase {
    id: CaseId,
    form: Form,
    mesh: Mesh,
    /// Whether there must be an answer at every vertex.
    answers: bool,
    expected: Kept<Vec<Written<Expected>>>,
}

/// What the kernels write to one of their buffers.
struct Written<T> {
    buffer: &'static str,
    /// Numbers an item.
    stride: usize,
    values: Vec<T>,
}

/// Every mesh in both forms.
pub fn cases() -> impl Iterator<Item = Box<dyn Case>> {
    let both = [Form::Published, Form::Hardened];
    meshes().into_iter().flat_map(move |(name, mesh)| {
        both.map(|form| {
            let id = CaseId::new("frame_from_uv", Some(form.as_str()), "mesh").with("mesh", name);
            Box::new(MeshCase::new(id, form, mesh.clone(), shapes::is_good(name))) as Box<dyn Case>
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
    pub(super) fn new(id: CaseId, form: Form, mesh: Mesh, answers: bool) -> Self {
        Self {
            id,
            form,
            mesh,
            answers,
            expected: Kept::default(),
        }
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

    fn triangles(&self) -> usize {
        self.mesh.indices.len() / 3
    }

    fn vertices(&self) -> usize {
        self.mesh.positions.len()
    }

    /// The buffers by name that both kernels read.
    fn inputs(&self) -> BTreeMap<&'static str, Vec<u8>> {
        let (offsets, triangles) = adjacency(&self.mesh);
        let word = |words: &[u32]| bytes(words, u32::to_le_bytes);
        let mesh = &self.mesh;
        BTreeMap::from([
            (
                "positions",
                float_bytes(mesh.positions.iter().flat_map(|p| p.to_array())),
            ),
            ("uvs", float_bytes(mesh.uvs.iter().flat_map(|uv| uv.to_array()))),
            ("indices", word(&mesh.indices)),
            ("adjacency_offsets", word(&offsets)),
            ("adjacency_triangles", word(&triangles)),
            (
                "normals",
                float_bytes(mesh.normals.iter().flat_map(|n| n.to_array())),
            ),
        ])
    }

    /// The first pass.
    fn triangle_pass<'a>(&self, name: &'a str, inputs: &'a BTreeMap<&'static str, Vec<u8>>) -> Dispatch<'a> {
        let mut resources = Resources::default();
        for buffer in ["positions", "uvs", "indices"] {
            let bytes = BufferData::Bytes(&inputs[buffer]);
            resources.buffers.insert(buffer.to_owned(), bytes);
        }
        let frames = BufferData::Output(48 * self.triangles());
        resources.buffers.insert("frames".to_owned(), frames);
        Dispatch {
            name,
            kernel: self.kernels()[0],
            resources,
            invocations: [self.triangles() as u32, 1, 1],
        }
    }

    /// The second pass, on frames that the first has left.
    fn vertex_pass<'a>(
        &self,
        name: &'a str,
        inputs: &'a BTreeMap<&'static str, Vec<u8>>,
        frames: &'a [u8],
    ) -> Dispatch<'a> {
        let mut resources = Resources::default();
        for buffer in ["adjacency_offsets", "adjacency_triangles"] {
            let bytes = BufferData::Bytes(&inputs[buffer]);
            resources.buffers.insert(buffer.to_owned(), bytes);
        }
        let normals = match self.form {
            Form::Hardened => BufferData::Bytes(&inputs["normals"]),
            Form::Published => BufferData::Output(12 * self.vertices()),
        };
        resources.buffers.extend([
            ("frames".to_owned(), BufferData::Bytes(frames)),
            ("normals".to_owned(), normals),
            ("tangents".to_owned(), BufferData::Output(16 * self.vertices())),
        ]);
        Dispatch {
            name,
            kernel: self.kernels()[1],
            resources,
            invocations: [self.vertices() as u32, 1, 1],
        }
    }

    /// What the adapter's passes leave.
    fn run_passes(&self, bench: &Bench<'_>) -> Result<Vec<Written<f32>>, String> {
        let (name, inputs) = (self.id.to_string(), self.inputs());
        let first = self.triangle_pass(&name, &inputs).run(bench)?;
        let frames = first
            .buffers
            .get("frames")
            .ok_or("the triangle pass wrote no frames")?;
        let second = self.vertex_pass(&name, &inputs, frames).run(bench)?;
        Ok(self.written(|buffer| match buffer {
            "frames" => first.floats(buffer),
            _ => second.floats(buffer),
        }))
    }

    /// The buffers that are judged, each filled by `of`.
    fn written<T>(&self, of: impl Fn(&str) -> Vec<T>) -> Vec<Written<T>> {
        let buffers: &[(&'static str, usize)] = match self.form {
            Form::Hardened => &[("frames", 12), ("tangents", 4)],
            Form::Published => &[("frames", 12), ("normals", 3), ("tangents", 4)],
        };
        let one = |&(buffer, stride)| Written {
            buffer,
            stride,
            values: of(buffer),
        };
        buffers.iter().map(one).collect()
    }

    /// The tangents, four floats a vertex.
    pub(super) fn tangents(&self, bench: &Bench<'_>) -> Result<Vec<f32>, String> {
        let written = self.run_passes(bench)?;
        let tangents = written.into_iter().find(|written| written.buffer == "tangents");
        tangents
            .map(|written| written.values)
            .ok_or_else(|| "the vertex pass wrote no tangents".to_owned())
    }

    /// What the passes may leave, from their own IR.
    fn intervals(&self, bench: &Bench<'_>) -> Result<Vec<Written<Bound>>, String> {
        let (name, inputs) = (self.id.to_string(), self.inputs());
        let [first, second] = self.kernels().map(|kernel| bench.module(&Module::Kernel(kernel)));
        let frames = self
            .triangle_pass(&name, &inputs)
            .accepted(&*first?, &BTreeMap::new())?;
        // Stands for the buffer's size; its contents are the intervals.
        let place = vec![0; 48 * self.triangles()];
        let left = self
            .vertex_pass(&name, &inputs, &place)
            .accepted(&*second?, &frames)?;
        let of = |written: Option<&Accepted>| written.map(|it| float_bounds(it)).unwrap_or_default();
        Ok(self.written(|buffer| match buffer {
            "frames" => of(frames.get(buffer)),
            _ => of(left.get(buffer)),
        }))
    }

    /// The frames by the reference: normal and weight, tangent, bitangent of each triangle, in fours.
    fn frames_truth(&self) -> Vec<f64> {
        let function = match self.form {
            Form::Published => "frame_from_uv_triangle_published",
            Form::Hardened => "frame_from_uv_triangle",
        };
        let frame = |corners: &[u32]| {
            let position = |k: usize| self.mesh.positions[corners[k] as usize].as_dvec3();
            let uv = |k: usize| self.mesh.uvs[corners[k] as usize].as_dvec2();
            let (p, q) = (position(1) - position(0), position(2) - position(0));
            let (st1, st2) = (uv(1) - uv(0), uv(2) - uv(0));
            let arguments = [&p.to_array()[..], &q.to_array(), &st1.to_array(), &st2.to_array()].concat();
            let truth = oracle::truth::find(function).map(|truth| truth(&mut Args::new(&arguments)));
            match truth.as_deref() {
                Some(&[nx, ny, nz, tx, ty, tz, bx, by, bz, weight]) => {
                    vec![nx, ny, nz, weight, tx, ty, tz, 0.0, bx, by, bz, 0.0]
                }
                _ => Vec::new(),
            }
        };
        self.mesh.indices.chunks_exact(3).flat_map(frame).collect()
    }

    /// The normals that the published form sums; the hardened one keeps the mesh's.
    fn normals_truth(&self) -> Vec<DVec3> {
        match self.form {
            Form::Hardened => self.mesh.normals.iter().map(|n| n.as_dvec3()).collect(),
            Form::Published => {
                let positions: Vec<DVec3> = self.mesh.positions.iter().map(|p| p.as_dvec3()).collect();
                frame_from_uv::summed_normals(&positions, &self.mesh.indices)
            }
        }
    }

    /// The tangents by the reference's own mesh functions.
    fn tangents_truth(&self) -> Vec<DVec4> {
        let positions: Vec<DVec3> = self.mesh.positions.iter().map(|p| p.as_dvec3()).collect();
        let uvs: Vec<DVec2> = self.mesh.uvs.iter().map(|uv| uv.as_dvec2()).collect();
        let normals = self.normals_truth();
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

    fn expectations(&self, bench: &Bench<'_>) -> Result<Vec<Written<Expected>>, String> {
        let truth = self.written(|buffer| match buffer {
            "frames" => self.frames_truth(),
            "normals" => self.normals_truth().iter().flat_map(|n| n.to_array()).collect(),
            _ => self.tangents_truth().iter().flat_map(|t| t.to_array()).collect(),
        });
        let pair = |(truth, bounds): (Written<f64>, Written<Bound>)| {
            let (given, wanted) = (bounds.values.len(), truth.values.len());
            if given != wanted {
                let buffer = truth.buffer;
                return Err(format!("`{buffer}` has {given} numbers, the reference {wanted}"));
            }
            let both = truth.values.into_iter().zip(bounds.values);
            Ok(Written {
                buffer: truth.buffer,
                stride: truth.stride,
                values: both.map(|(truth, bound)| Expected { truth, bound }).collect(),
            })
        };
        truth.into_iter().zip(self.intervals(bench)?).map(pair).collect()
    }

    fn judge(&self, bench: &Bench<'_>) -> Result<Outcome, String> {
        let texts = self.kernels().map(|kernel| bench.module(&Module::Kernel(kernel)));
        let [first, second] = texts;
        let text = [first?.text(), second?.text()].concat();
        let expected = self.expected.for_text(&text, || self.expectations(bench))?;
        let got = self.run_passes(bench)?;
        let mut comparison = if self.answers {
            Comparison::demanding_answers()
        } else {
            Comparison::default()
        };
        for (got, expected) in got.iter().zip(&*expected) {
            let items = expected.values.chunks(expected.stride);
            for (item, expected) in items.enumerate() {
                let start = item * expected.len();
                let got = got.values.get(start..start + expected.len()).unwrap_or_default();
                comparison.item(&[item as f32], got, expected);
            }
        }
        Ok(Outcome::of(self.vertices(), comparison, 1.0))
    }
}

impl Case for MeshCase {
    fn id(&self) -> &CaseId {
        &self.id
    }

    fn basis(&self) -> Vec<&'static str> {
        oracle::BASIS.to_vec()
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
    use super::adjacency;
    use super::shapes::{butterfly, degenerate};

    #[test]
    fn adjacency_lists_each_corner_once() {
        let (offsets, triangles) = adjacency(&butterfly());
        assert_eq!(offsets, [0, 2, 4, 5, 6]);
        assert_eq!(triangles, [0, 1, 0, 1, 0, 1]);
        // A triangle that names a vertex twice is listed twice.
        let (offsets, triangles) = adjacency(&degenerate());
        assert_eq!(&triangles[offsets[0] as usize..offsets[1] as usize], [0, 1, 2, 2]);
    }
}
