//! `displacement` drawn: the vertices of a grid and their normals against the reference, the silhouette, and what a finer grid costs.
//!
//! - `grid`: a square grid seen from above through an orthographic camera under which every vertex falls on a pixel's centre. There
//!   a captured interpolant is the vertex' own value: position and normal are compared with the reference's.
//! - `silhouette`: the same grid seen along its plane. On the columns of pixels that lie on grid lines the highest and the lowest covered
//!   pixel are those of the highest and the lowest displaced vertex; the flat plane, whatever its fragment stage shifts, covers none.
//!
//! What is allowed besides f32: a sampler keeps `SUBTEXEL_BITS` bits of its weights, a rasteriser keeps `SUBPIXEL_BITS` bits of a
//! vertex' place in the picture, so an interpolant may be taken that share of a pixel beside the vertex.

use std::sync::Arc;

use bossage_assets::{EdgeMode, HeightField};
use bossage_reference::displacement::{Tile, height, normal, position, slope};
use bossage_runner::{Blend, Clear, Depth, RenderTarget, TimedJob, TimingOptions};
use bossage_scene::{Draw, Elevation, HeightSource, TechniquePin};
use bossage_shaders::{Relief, Stage};
use glam::{DMat4, DVec2, DVec3, DVec4};

use super::rig::{Rig, job, render};
use super::truth::uniform;
use crate::bench::Bench;
use crate::bound::Bound;
use crate::case::{Case, Outcome, with_causes};
use crate::case_id::CaseId;
use crate::compare::{Comparison, Expected};
use crate::module::Module;
use crate::tolerance::{SUBTEXEL_BITS, UNDECIDED_LIMIT};
use crate::verdict::Verdict;

/// Bits of a vertex' place in pixels that every rasteriser here keeps (Vulkan's `subPixelPrecisionBits`).
const SUBPIXEL_BITS: i32 = 8;

/// Rectangles along a side; one vertex more, one pixel a vertex.
const SEGMENTS: u32 = 63;
/// Texels along a side of the height map.
const FIELD_SIDE: u32 = 48;
/// Elevation of h = 1 over h = 0 and of h = 0, in tiles.
const SCALE: f64 = 0.08;
const BIAS: f64 = -0.03;
/// Half the height of the silhouette's picture in the mesh's units: above the largest elevation of two tile lengths.
const HALF_HEIGHT: f64 = 0.125;
/// Rectangles along a side of the grids that are timed.
const TIMED_SEGMENTS: [u32; 3] = [16, 64, 256];

/// A plane of 2 by 2, one tile over the whole, lit so that position and normal reach the fragment stage.
const SCENE: &str = r#"
schema = 1

[camera]
position = [0.0, 0.0, 3.0]
target = [0.0, 0.0, 0.0]
fov_deg = 45.0
near = 0.1
far = 100.0
size = [64, 64]

[[lights]]
name = "lamp"
kind = "point"
position = [0.5, 0.5, 2.0]

[[materials]]
name = "waves"
specular = [0.3, 0.3, 0.3]

[[objects]]
name = "grid"
shape = "plane"
size = [2.0, 2.0]
segments = [63, 63]
material = "waves"
"#;

/// What a case looks at.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum View {
    Grid,
    Silhouette,
}

struct DisplacementCase {
    id: CaseId,
    view: View,
}

/// Both views.
pub fn cases() -> impl Iterator<Item = Box<dyn Case>> {
    let case = |(name, view)| {
        let id = CaseId::new("displacement", None, name).with("segments", SEGMENTS);
        Box::new(DisplacementCase { id, view }) as Box<dyn Case>
    };
    [("grid", View::Grid), ("silhouette", View::Silhouette)]
        .into_iter()
        .map(case)
}

fn field() -> HeightField {
    let turn = |i: u32| std::f32::consts::TAU * (i as f32 + 0.5) / FIELD_SIDE as f32;
    HeightField::from_fn(FIELD_SIDE, FIELD_SIDE, |x, y| {
        0.5 + 0.25 * (2.0 * turn(x)).sin() + 0.2 * (turn(x) + 3.0 * turn(y)).cos()
    })
}

/// The one draw, with so many rectangles along a side.
fn draw(technique: TechniquePin, segments: u32) -> Result<Draw, String> {
    let text = SCENE.replace("[63, 63]", &format!("[{segments}, {segments}]"));
    let mut scene =
        bossage_scene::load_str("displacement.toml", &text).map_err(|error| with_causes(&error))?;
    let material = scene.materials.first_mut().ok_or("the scene has a material")?;
    material.height = Some(HeightSource {
        path: "waves".into(),
        field: Arc::new(field()),
        elevation: Elevation {
            scale: DVec2::splat(SCALE),
            bias: DVec2::splat(BIAS),
        },
    });
    material.technique = technique;
    let plan = bossage_scene::plan(&scene);
    bossage_scene::draws(&scene, &plan)
        .pop()
        .ok_or_else(|| "nothing is drawn".to_owned())
}

/// The displaced draw, seen through a camera of ours.
fn displaced(segments: u32, camera: DMat4) -> Result<Draw, String> {
    let draw = draw(TechniquePin::Displacement, segments)?;
    if draw.features.canonical().relief != Relief::Displacement {
        return Err(format!(
            "the planner left the displacement out: {}",
            draw.features.name()
        ));
    }
    Ok(through(draw, camera))
}

fn through(mut draw: Draw, camera: DMat4) -> Draw {
    let columns = camera.as_mat4().to_cols_array().to_vec();
    draw.uniforms.insert("object.clip_from_local".to_owned(), columns);
    draw
}

/// Pixels along a side: one a vertex.
const PIXELS: u32 = SEGMENTS + 1;

/// From x in [−1, 1] to clip space such that vertex i lies on the centre of pixel i.
fn spread() -> f64 {
    f64::from(SEGMENTS) / f64::from(PIXELS)
}

/// Seen from above: x to the right, y up, depth ½ − z.
fn from_above() -> DMat4 {
    DMat4::from_cols(
        DVec4::X * spread(),
        DVec4::Y * spread(),
        DVec4::Z * -1.0,
        DVec4::new(0.0, 0.0, 0.5, 1.0),
    )
}

/// Seen along +y: x to the right, z up, depth ½ + y/4.
fn from_the_side() -> DMat4 {
    DMat4::from_cols(
        DVec4::X * spread(),
        DVec4::Z * 0.25,
        DVec4::Y / HALF_HEIGHT,
        DVec4::new(0.0, 0.0, 0.5, 1.0),
    )
}

/// The reference's vertices, and how far the drawn ones may be off.
struct Truth {
    /// Position and normal of vertex (i, j), row by row from v = 0.
    vertices: Vec<[DVec3; 2]>,
    allowed: [f64; 2],
}

impl Truth {
    /// The height of a vertex is off by twice the sampler's share of a texel of the largest step between texels, and 8 roundings of a
    /// height of at most 1. Elevation is `scale` times that. A slope is a difference of two heights over two texels, in the mesh's
    /// units over a tile of `side`; a unit normal turns by no more than the slopes change, by √2 for both. Twenty roundings each.
    fn new(draw: &Draw) -> Self {
        let [scale, bias, along_u, along_v] = uniform(draw, "object.displacement").map(f64::from);
        let vertices: Vec<[DVec3; 2]> = (0..draw.mesh.positions.len())
            .map(|at| vertex(draw, at, [scale, bias], DVec2::new(along_u, along_v)))
            .collect();
        let height_error = 2.0 * 2f64.powi(-SUBTEXEL_BITS) * largest_step(&field()) + 8.0 * 2f64.powi(-24);
        let slope_error = 2.0 * height_error * scale * 0.5 * f64::from(FIELD_SIDE) / along_u.min(along_v);
        let rounding = 20.0 * 2f64.powi(-24);
        let beside = 2.0 * 2f64.powi(-SUBPIXEL_BITS);
        let apart = |which: usize| beside * neighbours_apart(&vertices, which);
        let allowed = [
            scale * height_error + rounding + apart(0),
            2f64.sqrt() * slope_error + rounding + apart(1),
        ];
        Self { vertices, allowed }
    }
}

/// Position and normal of one displaced vertex.
fn vertex(draw: &Draw, at: usize, [scale, bias]: [f64; 2], side: DVec2) -> [DVec3; 2] {
    let (field, edge) = (field(), draw.edge);
    let (place, flat) = (
        draw.mesh.positions[at].as_dvec3(),
        draw.mesh.normals[at].as_dvec3(),
    );
    let (uv, tangent) = (draw.mesh.uvs[at].as_dvec2(), draw.mesh.tangents[at].as_dvec4());
    let step = 1.0 / f64::from(FIELD_SIDE);
    let near = |du: f64, dv: f64| height(&field, edge, uv + step * DVec2::new(du, dv));
    let heights = [near(-1.0, 0.0), near(1.0, 0.0), near(0.0, -1.0), near(0.0, 1.0)];
    let slopes = slope(heights, DVec2::splat(0.5 * scale * f64::from(FIELD_SIDE)));
    let tile = Tile {
        normal: flat,
        along_u: side.x * tangent.truncate(),
        along_v: side.y * tangent.w * flat.cross(tangent.truncate()),
    };
    [
        position(place, flat, near(0.0, 0.0), scale, bias, 1.0),
        normal(&tile, slopes),
    ]
}

/// The largest difference between neighbouring texels.
fn largest_step(field: &HeightField) -> f64 {
    let at = |x: u32, y: u32| {
        let wrap = |i: u32| EdgeMode::Wrap.resolve(i64::from(i), FIELD_SIDE);
        f64::from(field.texel(wrap(x), wrap(y)))
    };
    let steps = (0..FIELD_SIDE * FIELD_SIDE).map(|i| {
        let (x, y) = (i % FIELD_SIDE, i / FIELD_SIDE);
        let here = at(x, y);
        (at(x + 1, y) - here).abs().max((at(x, y + 1) - here).abs())
    });
    steps.fold(0.0, f64::max)
}

/// The largest difference of a component between neighbouring vertices.
fn neighbours_apart(vertices: &[[DVec3; 2]], which: usize) -> f64 {
    let side = PIXELS as usize;
    let apart = |a: usize, b: usize| (vertices[a][which] - vertices[b][which]).abs().max_element();
    let steps = (0..vertices.len()).map(|at| {
        let right = if at % side + 1 < side {
            apart(at, at + 1)
        } else {
            0.0
        };
        let above = if at + side < vertices.len() {
            apart(at, at + side)
        } else {
            0.0
        };
        right.max(above)
    });
    steps.fold(0.0, f64::max)
}

fn within(truth: f64, allowed: f64) -> Expected {
    Expected {
        truth,
        bound: Bound::between(truth - allowed, truth + allowed),
    }
}

impl DisplacementCase {
    fn camera(&self) -> DMat4 {
        match self.view {
            View::Grid => from_above(),
            View::Silhouette => from_the_side(),
        }
    }

    fn judge(&self, bench: &Bench<'_>) -> Result<Outcome, String> {
        let draw = displaced(SEGMENTS, self.camera())?;
        let truth = Truth::new(&draw);
        let (comparison, inputs, note) = match self.view {
            View::Grid => grid(bench, &draw, &truth)?,
            View::Silhouette => silhouette(bench, &draw, &truth)?,
        };
        let outcome = Outcome::of(inputs, comparison, UNDECIDED_LIMIT);
        let passed = outcome.verdict == Verdict::Pass;
        Ok(Outcome {
            reason: if passed { Some(note) } else { outcome.reason },
            ..outcome
        })
    }
}

/// Every vertex whose pixel is covered: all but the last row and column, which lie on the border that triangles leave out.
fn grid(bench: &Bench<'_>, draw: &Draw, truth: &Truth) -> Result<(Comparison, usize, String), String> {
    let rig = Rig::new(bench, draw, &draw.features, &[Stage::FragmentCapture])?;
    let captured = rig.floats(bench, Stage::FragmentCapture, [PIXELS; 2], 5)?;
    let covered = captured[0].covered();
    let mut comparison = Comparison::default();
    let mut seen = 0;
    for (at, [place, bent]) in truth.vertices.iter().enumerate() {
        let (i, j) = (at as u32 % PIXELS, at as u32 / PIXELS);
        let pixel = ((PIXELS - 1 - j) * PIXELS + i) as usize;
        let inner = (1..SEGMENTS).contains(&i) && (1..SEGMENTS).contains(&j);
        if !covered[pixel] {
            let got = f32::from(u8::from(!inner));
            comparison.item(&[i as f32, j as f32], &[got], &[within(1.0, 0.0)]);
            continue;
        }
        seen += 1;
        for (which, expected) in [place, bent].into_iter().enumerate() {
            let [x, y, z, _] = captured[1 + which].pixels[pixel];
            let expected = expected
                .to_array()
                .map(|truth_of| within(truth_of, truth.allowed[which]));
            comparison.item(&[i as f32, j as f32], &[x, y, z], &expected);
        }
    }
    let note = format!(
        "{seen} of {} vertices seen; {}",
        truth.vertices.len(),
        cost(bench)?
    );
    Ok((comparison, seen, note))
}

/// The highest and the lowest covered pixel of each column of pixels on a grid line.
fn silhouette(bench: &Bench<'_>, draw: &Draw, truth: &Truth) -> Result<(Comparison, usize, String), String> {
    let covered = |draw: &Draw| -> Result<Vec<bool>, String> {
        let rig = Rig::new(bench, draw, &draw.features, &[Stage::Fragment])?;
        Ok(rig
            .floats(bench, Stage::Fragment, [PIXELS; 2], 1)?
            .remove(0)
            .covered())
    };
    let (side, pixel) = (PIXELS as usize, 2.0 * HALF_HEIGHT / f64::from(PIXELS));
    let drawn = covered(draw)?;
    let elevation = |row: usize| HALF_HEIGHT - pixel * (row as f64 + 0.5);
    let mut comparison = Comparison::default();
    for column in 1..side - 1 {
        let rows: Vec<usize> = (0..side).filter(|row| drawn[row * side + column]).collect();
        let heights = (0..side).map(|row| truth.vertices[row * side + column][0].z);
        let (low, high) = heights.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), z| {
            (low.min(z), high.max(z))
        });
        let (Some(top), Some(bottom)) = (rows.first(), rows.last()) else {
            return Err(format!("column {column} is empty"));
        };
        // The outermost covered centre lies within a pixel inside of the outermost vertex.
        let slack = truth.allowed[0] + pixel * 2f64.powi(-SUBPIXEL_BITS);
        let got = [elevation(*top), elevation(*bottom)].map(|z| z as f32);
        let expected = [
            within(high - 0.5 * pixel, 0.5 * pixel + slack),
            within(low + 0.5 * pixel, 0.5 * pixel + slack),
        ];
        comparison.item(&[column as f32], &got, &expected);
    }
    let flat = through(
        self::draw(TechniquePin::ParallaxOffsetLimited, SEGMENTS)?,
        from_the_side(),
    );
    let count = covered(&flat)?.into_iter().filter(|covered| *covered).count();
    comparison.item(&[], &[count as f32], &[within(0.0, 0.0)]);
    let shown = drawn.iter().filter(|covered| **covered).count();
    let note = format!("seen along its plane the displaced grid covers {shown} pixels, the flat one {count}");
    Ok((comparison, side - 2, note))
}

/// What a picture takes with grids of several sizes.
fn cost(bench: &Bench<'_>) -> Result<String, String> {
    let draws = TIMED_SEGMENTS
        .iter()
        .map(|segments| displaced(*segments, from_above()))
        .collect::<Result<Vec<_>, String>>()?;
    let rigs = draws
        .iter()
        .map(|draw| Rig::new(bench, draw, &draw.features, &[Stage::Fragment]))
        .collect::<Result<Vec<_>, String>>()?;
    let jobs = rigs
        .iter()
        .map(|rig| {
            let target = RenderTarget::floats(Clear::Colour([0.0; 4]));
            let draw = rig.with(Stage::Fragment, Blend::Replace, Depth::TestAndWrite)?;
            Ok(job("grid", [PIXELS; 2], vec![target], vec![vec![draw]]))
        })
        .collect::<Result<Vec<_>, String>>()?;
    let counts: Vec<usize> = draws.iter().map(|draw| draw.mesh.positions.len()).collect();
    let timed: Vec<TimedJob<'_>> = jobs.iter().map(TimedJob::Render).collect();
    let Some(times) = bench.device.time(&timed, &TimingOptions::default()) else {
        for one in &jobs {
            render(bench, one)?;
        }
        return Ok(format!(
            "{counts:?} vertices to a picture; no times from this machine"
        ));
    };
    let times = times.map_err(|error| with_causes(&error))?;
    let said = counts.iter().zip(&times).map(|(vertices, timing)| {
        let (median, spread) = (timing.median_ms, 100.0 * timing.spread);
        format!("{vertices} vertices {median:.3} ms (spread {spread:.0} %)")
    });
    Ok(format!(
        "medians of 9 runs: {}",
        said.collect::<Vec<_>>().join(", ")
    ))
}

impl Case for DisplacementCase {
    fn id(&self) -> &CaseId {
        &self.id
    }

    fn basis(&self) -> Vec<&'static str> {
        vec!["reference f64", "bits of sampler and rasteriser"]
    }

    fn modules(&self) -> Result<Vec<Module>, String> {
        let features = displaced(SEGMENTS, self.camera())?.features;
        let flat = draw(TechniquePin::ParallaxOffsetLimited, SEGMENTS)?.features;
        let module = |features, stage| Module::Surface { features, stage };
        let mut all = vec![module(features, Stage::Vertex), module(features, Stage::Fragment)];
        match self.view {
            View::Grid => all.push(module(features, Stage::FragmentCapture)),
            View::Silhouette => all.extend([module(flat, Stage::Vertex), module(flat, Stage::Fragment)]),
        }
        all.sort();
        all.dedup();
        Ok(all)
    }

    fn run(&self, bench: &Bench<'_>) -> Outcome {
        self.judge(bench).unwrap_or_else(Outcome::failed)
    }
}
