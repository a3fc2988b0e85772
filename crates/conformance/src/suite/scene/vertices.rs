//! The vertex stage: every module of it, on the specimen, vertex by vertex and as it arrives in the picture.
//!
//! For each vertex the f64 truth of what the stage returns must lie in the acceptance interval of the stage's own IR, at the vertex' attributes
//! and with the draw's uniforms and height map. What a machine makes of the vertices is seen in the picture: the capture variant of the
//! fragment stage writes its interpolated inputs, and each of them must lie between the corners' intervals, weighted as the pixel's
//! centre lies between the true corners. Where no triangle is, nothing may be drawn; where one is, something must be.
//!
//! A rasteriser keeps some bits (`subpixel_bits`) of a corner's place, so what is interpolated may be taken that share of a pixel beside the centre;
//! and it interpolates in f32, by plane equations whose largest term is the value at the picture's corner. Pixels whose centre lies within
//! that share of a pixel of a triangle's edge are left out.

use std::collections::BTreeMap;

use bossage_bounds::Slot;
use bossage_reference::displacement::{self, Tile};
use bossage_runner::{AdapterInfo, AdapterSelector, Picture};
use bossage_scene::Draw;
use bossage_shaders::{FeatureSet, LightingSpace, Stage, Transform, VertexKey};
use glam::{DMat3, DMat4, DVec2, DVec3, DVec4};

use super::interpolants::Interpolants;
use super::rig::Rig;
use super::specimen::{self, SIZE};
use super::truth::{plane, uniform};
use crate::bench::Bench;
use crate::bound::Bound;
use crate::case::{Case, Outcome};
use crate::case_id::CaseId;
use crate::compare::{Comparison, Expected};
use crate::module::Module;
use crate::oracle::stages::Outputs;
use crate::tolerance::UNDECIDED_LIMIT;

/// Bits of a vertex' place in pixels that an adapter keeps, Vulkan's `subPixelPrecisionBits`: 4 on SwiftShader, the fewest that are
/// lawful, and 8 on every other rasteriser here.
pub(super) fn subpixel_bits(info: &AdapterInfo) -> i32 {
    if AdapterSelector::named("swiftshader").matches(info) {
        4
    } else {
        8
    }
}

/// How far beside a pixel's centre an interpolant may be taken, in pixels: a corner's place rounded, and what a place in clip space may be
/// off in f32, which is less by far.
fn beside(info: &AdapterInfo) -> f64 {
    1.125 * 2f64.powi(-subpixel_bits(info))
}

/// Roundings of 2⁻²⁴ of the largest term that an interpolation may take: a plane's two gradients of differences and products over an area
/// (7 each), two products and two sums, the same for 1/w, and a division.
const ROUNDINGS: f64 = 48.0;

/// All vertex modules.
struct VertexCase {
    id: CaseId,
    sets: Vec<FeatureSet>,
}

/// The one case.
pub fn cases() -> impl Iterator<Item = Box<dyn Case>> {
    let sets = modules_of_all();
    let id = CaseId::new("surface", None, "vertices").with("n", sets.len());
    std::iter::once(Box::new(VertexCase { id, sets }) as Box<dyn Case>)
}

/// The first feature set for each vertex module.
fn modules_of_all() -> Vec<FeatureSet> {
    let mut first: BTreeMap<VertexKey, FeatureSet> = BTreeMap::new();
    for set in FeatureSet::reachable() {
        first.entry(set.vertex()).or_insert(set);
    }
    first.into_values().collect()
}

/// What the vertex stage returns for one vertex.
#[derive(Clone, Copy, Debug)]
pub(super) struct Vertex<T> {
    pub(super) clip: [T; 4],
    /// Position, normal, tangent and texture coordinate, where the stage returns them.
    pub(super) varyings: [Option<T>; COMPONENTS],
}

/// Components of all varyings, in the order of [`Interpolants::numbers`].
pub(super) const COMPONENTS: usize = 12;

/// The locations of the varyings, and where among the components each begins and ends.
const LOCATIONS: [(u32, std::ops::Range<usize>); 4] = [(0, 0..3), (1, 3..6), (2, 6..10), (3, 10..12)];

/// The true vertices, in f64, of a draw's numbers.
pub(super) fn truths(draw: &Draw) -> Vec<Vertex<f64>> {
    let stage = VertexTruth::new(draw);
    (0..draw.mesh.positions.len()).map(|at| stage.of(at)).collect()
}

/// A draw's vertex stage in f64.
struct VertexTruth<'a> {
    draw: &'a Draw,
    key: VertexKey,
    clip_from_local: DMat4,
    world_from_local: DMat4,
    cofactor: DMat3,
    mirror: f64,
}

impl<'a> VertexTruth<'a> {
    fn new(draw: &'a Draw) -> Self {
        let matrix = |name: &str| DMat4::from_cols_array(&uniform::<16>(draw, name).map(f64::from));
        let [mirror, ..] = uniform::<4>(draw, "object.handedness_sign");
        Self {
            draw,
            key: draw.features.vertex(),
            clip_from_local: matrix("object.clip_from_local"),
            world_from_local: matrix("object.world_from_local"),
            cofactor: DMat3::from_mat4(matrix("object.cofactor")),
            mirror: f64::from(mirror),
        }
    }

    fn of(&self, at: usize) -> Vertex<f64> {
        let mesh = &self.draw.mesh;
        let (position, normal) = if self.key.displacement {
            self.displaced(at)
        } else {
            (mesh.positions[at].as_dvec3(), mesh.normals[at].as_dvec3())
        };
        let tangent = mesh.tangents[at].as_dvec4();
        let lit = |local: DVec3| match self.key.space {
            LightingSpace::Object => local,
            LightingSpace::World => self.world_from_local.transform_point3(local),
        };
        let tangent = self
            .tangent(tangent.truncate())
            .extend(self.handedness(tangent.w));
        let uv = mesh.uvs[at].as_dvec2();
        let groups: [(bool, &[f64]); 4] = [
            (self.key.position, &lit(position).to_array()),
            (self.key.normal, &self.normal(normal).to_array()),
            (self.key.tangent, &tangent.to_array()),
            (self.key.uv, &uv.to_array()),
        ];
        let components: Vec<Option<f64>> = groups
            .iter()
            .flat_map(|(there, values)| values.iter().map(move |value| there.then_some(*value)))
            .collect();
        Vertex {
            clip: (self.clip_from_local * position.extend(1.0)).to_array(),
            varyings: std::array::from_fn(|i| components[i]),
        }
    }

    fn linear(&self) -> DMat3 {
        DMat3::from_mat4(self.world_from_local)
    }

    fn normal(&self, local: DVec3) -> DVec3 {
        match (self.key.space, self.key.transform) {
            (LightingSpace::Object, _) => local,
            (LightingSpace::World, Transform::Rigid) => self.linear() * local,
            (LightingSpace::World, Transform::General) => (self.mirror * (self.cofactor * local)).normalize(),
        }
    }

    fn tangent(&self, local: DVec3) -> DVec3 {
        match (self.key.space, self.key.transform) {
            (LightingSpace::Object, _) => local,
            (LightingSpace::World, Transform::Rigid) => self.linear() * local,
            (LightingSpace::World, Transform::General) => (self.linear() * local).normalize(),
        }
    }

    /// 1 where the stage returns none: that is what the capture writes then.
    fn handedness(&self, local: f64) -> f64 {
        match (self.key.transform, self.key.mirrored_uv) {
            (Transform::General, true) => local * self.mirror,
            (Transform::General, false) => self.mirror,
            (Transform::Rigid, true) => local,
            (Transform::Rigid, false) => 1.0,
        }
    }

    /// Position and normal of a displaced vertex, in the object's space.
    fn displaced(&self, at: usize) -> (DVec3, DVec3) {
        let draw = self.draw;
        let [scale, bias, along_u, along_v] = uniform::<4>(draw, "object.displacement").map(f64::from);
        let Some(heights) = plane(draw, "height_map") else {
            return (
                draw.mesh.positions[at].as_dvec3(),
                draw.mesh.normals[at].as_dvec3(),
            );
        };
        let side = DVec2::new(f64::from(heights.width), f64::from(heights.height));
        let (flat, tangent) = (
            draw.mesh.normals[at].as_dvec3(),
            draw.mesh.tangents[at].as_dvec4(),
        );
        let uv = draw.mesh.uvs[at].as_dvec2();
        let near = |du: f64, dv: f64| heights.sample(draw.edge, uv + DVec2::new(du, dv) / side).x;
        let around = [near(-1.0, 0.0), near(1.0, 0.0), near(0.0, -1.0), near(0.0, 1.0)];
        let slopes = displacement::slope(around, 0.5 * scale * side);
        let tile = Tile {
            normal: flat,
            along_u: along_u * tangent.truncate(),
            along_v: along_v * tangent.w * flat.cross(tangent.truncate()),
        };
        let place = draw.mesh.positions[at].as_dvec3();
        (
            displacement::position(place, flat, near(0.0, 0.0), scale, bias, 1.0),
            displacement::normal(&tile, slopes),
        )
    }
}

/// The intervals of the vertices.
pub(super) fn bounds(draw: &Draw, outputs: &Outputs) -> Result<Vec<Vertex<Bound>>, String> {
    let key = draw.features.vertex();
    let has_handedness = key.mirrored_uv || key.transform == Transform::General;
    let there = [key.position, key.normal, key.tangent, key.uv];
    let vertex = |at: usize| {
        let mut varyings = [None; COMPONENTS];
        for ((location, range), there) in LOCATIONS.into_iter().zip(there) {
            for (k, slot) in varyings[range].iter_mut().enumerate().filter(|_| there) {
                *slot = Some(match outputs.component(Slot::Location(location, 0), at, k) {
                    Some(bound) => bound,
                    None if location == 2 && k == 3 && !has_handedness => Bound::exactly(1.0),
                    None => {
                        return Err(format!(
                            "the vertex stage lacks component {k} of location {location}"
                        ));
                    }
                });
            }
        }
        Ok(Vertex {
            clip: outputs.slot(Slot::Position, at)?,
            varyings,
        })
    };
    (0..draw.mesh.positions.len()).map(vertex).collect()
}

/// Both oracles of the vertices of a draw.
pub(super) struct Vertices {
    pub(super) truths: Vec<Vertex<f64>>,
    pub(super) bounds: Vec<Vertex<Bound>>,
}

impl Vertices {
    pub(super) fn new(rig: &Rig<'_>) -> Result<Self, String> {
        Ok(Self {
            truths: truths(rig.draw()),
            bounds: bounds(rig.draw(), &rig.vertices()?)?,
        })
    }

    /// The truth of every output of every vertex in its interval.
    pub(super) fn agree(&self, comparison: &mut Comparison) {
        for (at, (truth, bound)) in self.truths.iter().zip(&self.bounds).enumerate() {
            let clip = truth.clip.into_iter().zip(bound.clip);
            let varyings = truth.varyings.into_iter().zip(bound.varyings);
            let both = clip.chain(varyings.filter_map(|(truth, bound)| truth.zip(bound)));
            let expected: Vec<Expected> = both.map(|(truth, bound)| Expected { truth, bound }).collect();
            // The nearest float: an interval's ends are floats, so none lies outside that the truth is not.
            let nearest: Vec<f32> = expected.iter().map(|expected| expected.truth as f32).collect();
            comparison.item(&[at as f32], &nearest, &expected);
        }
    }
}

/// A triangle in the picture.
struct Triangle {
    corners: [usize; 3],
    /// In pixels, y downward.
    places: [DVec2; 3],
    inverse_w: [f64; 3],
}

impl Triangle {
    fn new(vertices: &[Vertex<f64>], corners: [usize; 3], size: [u32; 2]) -> Self {
        let clips = corners.map(|corner| DVec4::from_array(vertices[corner].clip));
        let place = |clip: DVec4| {
            let ndc = clip.truncate().truncate() / clip.w;
            DVec2::new(0.5 + 0.5 * ndc.x, 0.5 - 0.5 * ndc.y) * DVec2::from_array(size.map(f64::from))
        };
        Self {
            corners,
            places: clips.map(place),
            inverse_w: clips.map(|clip| 1.0 / clip.w),
        }
    }

    /// The pixels that it may touch: columns and rows.
    fn pixels(&self, size: [u32; 2]) -> [std::ops::Range<usize>; 2] {
        let [a, b, c] = self.places;
        let (low, high) = (a.min(b).min(c) - 1.0, a.max(b).max(c) + 1.0);
        let range = |low: f64, high: f64, side: u32| {
            let within = |x: f64| x.clamp(0.0, f64::from(side)) as usize;
            within(low.floor())..within(high.ceil())
        };
        [range(low.x, high.x, size[0]), range(low.y, high.y, size[1])]
    }

    /// How far inside a point lies, in pixels: negative outside.
    fn depth_inside(&self, point: DVec2) -> f64 {
        let area = (self.places[1] - self.places[0]).perp_dot(self.places[2] - self.places[0]);
        let edge = |i: usize| {
            let (from, to) = (self.places[i], self.places[(i + 1) % 3]);
            area.signum() * (to - from).perp_dot(point - from) / (to - from).length()
        };
        (0..3).map(edge).fold(f64::INFINITY, f64::min)
    }

    /// The weights of the corners at a point, with perspective.
    fn weights(&self, point: DVec2) -> [f64; 3] {
        let [a, b, c] = self.places;
        let opposite = [(b, c), (c, a), (a, b)];
        let linear = opposite.map(|(from, to)| (to - from).perp_dot(point - from));
        let shares: [f64; 3] = std::array::from_fn(|i| linear[i] * self.inverse_w[i]);
        let sum: f64 = shares.iter().sum();
        shares.map(|share| share / sum)
    }
}

/// A draw's triangles over a picture.
pub(super) struct Sheet<'a> {
    vertices: &'a Vertices,
    triangles: Vec<Triangle>,
    /// The triangles near each pixel.
    near: Vec<Vec<usize>>,
    size: [u32; 2],
    /// What [`beside`] says of the adapter.
    beside: f64,
}

impl<'a> Sheet<'a> {
    pub(super) fn new(draw: &Draw, vertices: &'a Vertices, size: [u32; 2], info: &AdapterInfo) -> Self {
        let corners = draw.mesh.indices.as_chunks::<3>().0;
        let triangle =
            |corners: &[u32; 3]| Triangle::new(&vertices.truths, corners.map(|i| i as usize), size);
        let triangles: Vec<Triangle> = corners.iter().map(triangle).collect();
        let [width, height] = size.map(|side| side as usize);
        let mut near = vec![Vec::new(); width * height];
        for (number, triangle) in triangles.iter().enumerate() {
            let [columns, rows] = triangle.pixels(size);
            let all = rows.flat_map(|row| columns.clone().map(move |column| row * width + column));
            all.for_each(|pixel| near[pixel].push(number));
        }
        Self {
            vertices,
            triangles,
            near,
            size,
            beside: beside(info),
        }
    }

    /// Every pixel of a capture: covered or not, and by which interpolants. Gives back how many were compared.
    pub(super) fn judge(&self, captured: &[Picture], comparison: &mut Comparison) -> usize {
        let covered = captured[0].covered();
        let mut seen = 0;
        for (at, covered) in covered.into_iter().enumerate() {
            let place = [at as u32 % self.size[0], at as u32 / self.size[0]].map(|side| side as f32);
            let centre = DVec2::new(f64::from(place[0]), f64::from(place[1])) + 0.5;
            let near = || self.near[at].iter().map(|number| &self.triangles[*number]);
            let depths = || near().map(|triangle| (triangle, triangle.depth_inside(centre)));
            if depths().any(|(_, depth)| depth.abs() < self.beside) {
                continue;
            }
            let inside = depths().find(|(_, depth)| *depth > 0.0);
            let flag = f32::from(u8::from(covered == inside.is_some()));
            let same = Expected {
                truth: 1.0,
                bound: Bound::exactly(1.0),
            };
            comparison.item(&place, &[flag], &[same]);
            if let Some((triangle, _)) = inside.filter(|_| covered) {
                seen += 1;
                let got = Interpolants::captured(captured, at).numbers();
                let expected = self.expected(triangle, centre);
                let (got, expected): (Vec<f32>, Vec<Expected>) = got
                    .into_iter()
                    .zip(expected)
                    .filter_map(|(got, it)| Some((got, it?)))
                    .unzip();
                comparison.item(&place, &got, &expected);
            }
        }
        seen
    }

    /// What the interpolants should be at a point of a triangle.
    fn expected(&self, triangle: &Triangle, centre: DVec2) -> [Option<Expected>; COMPONENTS] {
        let square = [(-1.0, -1.0), (1.0, -1.0), (-1.0, 1.0), (1.0, 1.0)];
        let around = square.map(|(x, y)| triangle.weights(centre + self.beside * DVec2::new(x, y)));
        let here = triangle.weights(centre);
        // One pixel to the right and one down, for the plane's gradients.
        let beside = [DVec2::X, DVec2::Y].map(|step| triangle.weights(centre + step));
        std::array::from_fn(|component| {
            let truths = self.corners(triangle, component, &self.vertices.truths)?;
            let bounds = self.corners(triangle, component, &self.vertices.bounds)?;
            if bounds.iter().any(|bound| !bound.is_decided()) {
                return Some(Expected {
                    truth: mixed(here, truths),
                    bound: Bound::OPEN,
                });
            }
            let value = mixed(here, truths);
            let gradient: f64 = beside
                .iter()
                .map(|weights| (mixed(*weights, truths) - value).abs())
                .sum();
            let side = f64::from(self.size[0].max(self.size[1]));
            let most = truths.iter().fold(0.0, |most: f64, truth| most.max(truth.abs()));
            let slack = ROUNDINGS * 2f64.powi(-24) * (most + gradient * side);
            let ends = around.map(|weights| {
                (
                    mixed(weights, bounds.map(|bound| bound.low())),
                    mixed(weights, bounds.map(|bound| bound.high())),
                )
            });
            let low = ends
                .iter()
                .fold(f64::INFINITY, |low, end| low.min(end.0.min(end.1)));
            let high = ends
                .iter()
                .fold(f64::NEG_INFINITY, |high, end| high.max(end.0.max(end.1)));
            let bound = Bound::between(low - slack, high + slack);
            let forked = bounds.iter().any(Bound::is_forked);
            Some(Expected {
                truth: value,
                bound: if forked { bound.forked() } else { bound },
            })
        })
    }

    fn corners<T: Copy>(&self, triangle: &Triangle, component: usize, of: &[Vertex<T>]) -> Option<[T; 3]> {
        let [a, b, c] = triangle.corners.map(|corner| of[corner].varyings[component]);
        Some([a?, b?, c?])
    }
}

fn mixed(weights: [f64; 3], values: [f64; 3]) -> f64 {
    weights
        .into_iter()
        .zip(values)
        .map(|(weight, value)| weight * value)
        .sum()
}

impl VertexCase {
    fn judge(&self, bench: &Bench<'_>) -> Result<Outcome, String> {
        let mut comparison = Comparison::demanding_answers();
        let mut inputs = 0;
        for features in &self.sets {
            let draw = specimen::draw(features)?;
            let rig = Rig::new(bench, &draw, features, &[Stage::FragmentCapture])?;
            let vertices = Vertices::new(&rig)?;
            vertices.agree(&mut comparison);
            let captured = rig.floats(bench, Stage::FragmentCapture, SIZE, Interpolants::TARGETS)?;
            inputs +=
                Sheet::new(&draw, &vertices, SIZE, bench.device.info()).judge(&captured, &mut comparison);
        }
        Ok(Outcome::of(inputs, comparison, UNDECIDED_LIMIT))
    }
}

impl Case for VertexCase {
    fn id(&self) -> &CaseId {
        &self.id
    }

    fn basis(&self) -> Vec<&'static str> {
        vec![
            "reference f64",
            "accuracy rules over the shader's IR",
            "bits of the rasteriser",
        ]
    }

    fn modules(&self) -> Result<Vec<Module>, String> {
        let stages = [Stage::Vertex, Stage::FragmentCapture];
        let of = |&features: &FeatureSet| stages.map(|stage| Module::Surface { features, stage });
        Ok(self.sets.iter().flat_map(of).collect())
    }

    fn run(&self, bench: &Bench<'_>) -> Outcome {
        self.judge(bench).unwrap_or_else(Outcome::failed)
    }
}
