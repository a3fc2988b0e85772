//! `displacement` drawn: the vertices of a grid and their normals against the reference, the silhouette, and what a finer grid costs.
//!
//! - `grid`: a square grid seen from above, vertices and pixels judged as those of any vertex stage (see `vertices`): position and
//!   normal of every vertex against the reference and the interval of the stage's IR, and what arrives in the picture against both.
//! - `silhouette`: the same grid seen along its plane. On the columns of pixels that lie on grid lines the highest and the lowest covered
//!   pixel are those of the highest and the lowest displaced vertex; the flat plane, whatever its fragment stage shifts, covers none.

use std::sync::Arc;

use bossage_assets::HeightField;
use bossage_runner::{Blend, Clear, Depth, RenderTarget, TimedJob, TimingOptions};
use bossage_scene::{Draw, Elevation, HeightSource, TechniquePin};
use bossage_shaders::{Relief, Stage};
use glam::{DMat4, DVec2, DVec4};

use super::interpolants::Interpolants;
use super::rig::{Rig, job, render};
use super::vertices::{Sheet, Vertices, subpixel_bits};
use crate::bench::Bench;
use crate::bound::Bound;
use crate::case::{Case, Outcome, with_causes};
use crate::case_id::CaseId;
use crate::compare::{Comparison, Expected};
use crate::module::Module;
use crate::tolerance::UNDECIDED_LIMIT;
use crate::verdict::Verdict;

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

/// Pixels along a side of the picture from above: more than one a triangle, and no whole number of them.
const ABOVE: u32 = 100;

/// Pixels along a side of the silhouette: one a vertex.
const PIXELS: u32 = SEGMENTS + 1;

/// From x in [−1, 1] to clip space such that vertex i lies on the centre of pixel i of the silhouette.
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

impl DisplacementCase {
    fn camera(&self) -> DMat4 {
        match self.view {
            View::Grid => from_above(),
            View::Silhouette => from_the_side(),
        }
    }

    fn judge(&self, bench: &Bench<'_>) -> Result<Outcome, String> {
        let draw = displaced(SEGMENTS, self.camera())?;
        let (comparison, inputs, note) = match self.view {
            View::Grid => grid(bench, &draw)?,
            View::Silhouette => silhouette(bench, &draw)?,
        };
        let outcome = Outcome::of(inputs, comparison, UNDECIDED_LIMIT);
        let passed = outcome.verdict == Verdict::Pass;
        Ok(Outcome {
            reason: if passed { Some(note) } else { outcome.reason },
            ..outcome
        })
    }
}

/// Every vertex, and every pixel between them.
fn grid(bench: &Bench<'_>, draw: &Draw) -> Result<(Comparison, usize, String), String> {
    let rig = Rig::new(bench, draw, &draw.features, &[Stage::FragmentCapture])?;
    let vertices = Vertices::new(&rig)?;
    let mut comparison = Comparison::demanding_answers();
    vertices.agree(&mut comparison);
    let captured = rig.floats(bench, Stage::FragmentCapture, [ABOVE; 2], Interpolants::TARGETS)?;
    let seen = Sheet::new(draw, &vertices, [ABOVE; 2], bench.device.info()).judge(&captured, &mut comparison);
    let note = format!(
        "{} vertices in {seen} pixels; {}",
        vertices.truths.len(),
        cost(bench)?
    );
    Ok((comparison, seen, note))
}

/// The highest and the lowest covered pixel of each column of pixels on a grid line.
fn silhouette(bench: &Bench<'_>, draw: &Draw) -> Result<(Comparison, usize, String), String> {
    let rig = Rig::new(bench, draw, &draw.features, &[Stage::Fragment])?;
    let covered = |rig: &Rig<'_>| -> Result<Vec<bool>, String> {
        Ok(rig
            .floats(bench, Stage::Fragment, [PIXELS; 2], 1)?
            .remove(0)
            .covered())
    };
    let vertices = Vertices::new(&rig)?;
    let (side, pixel) = (PIXELS as usize, 2.0 * HALF_HEIGHT / f64::from(PIXELS));
    let drawn = covered(&rig)?;
    let elevation = |row: usize| HALF_HEIGHT - pixel * (row as f64 + 0.5);
    let mut comparison = Comparison::demanding_answers();
    for column in 1..side - 1 {
        let rows: Vec<usize> = (0..side).filter(|row| drawn[row * side + column]).collect();
        // Clip space is as high as the picture, and w is 1.
        let of_column = (0..side).map(|row| row * side + column);
        let (highest, lowest) = (
            edge(&vertices, of_column.clone(), f64::max),
            edge(&vertices, of_column, f64::min),
        );
        let (Some(top), Some(bottom)) = (rows.first(), rows.last()) else {
            return Err(format!("column {column} is empty"));
        };
        // The outermost covered centre lies within a pixel inside of the outermost vertex.
        let slack = pixel * 2f64.powi(-subpixel_bits(bench.device.info()));
        let got = [elevation(*top), elevation(*bottom)].map(|z| z as f32);
        let expected = [(highest, -pixel, 0.0), (lowest, 0.0, pixel)].map(|(edge, below, above)| Expected {
            truth: edge.truth + 0.5 * (below + above),
            bound: Bound::between(edge.low + below - slack, edge.high + above + slack),
        });
        comparison.item(&[column as f32], &got, &expected);
    }
    let flat = through(
        self::draw(TechniquePin::ParallaxOffsetLimited, SEGMENTS)?,
        from_the_side(),
    );
    let flat = covered(&Rig::new(bench, &flat, &flat.features, &[Stage::Fragment])?)?;
    let count = flat.into_iter().filter(|covered| *covered).count();
    let none = Expected {
        truth: 0.0,
        bound: Bound::exactly(0.0),
    };
    comparison.item(&[], &[count as f32], &[none]);
    let shown = drawn.iter().filter(|covered| **covered).count();
    let note = format!("seen along its plane the displaced grid covers {shown} pixels, the flat one {count}");
    Ok((comparison, side - 2, note))
}

/// The outermost elevation of some vertices: the true one, and what it may be.
#[derive(Clone, Copy, Debug)]
struct Outermost {
    truth: f64,
    low: f64,
    high: f64,
}

fn edge(
    vertices: &Vertices,
    of: impl Iterator<Item = usize> + Clone,
    further: fn(f64, f64) -> f64,
) -> Outermost {
    let most =
        |height: &dyn Fn(usize) -> f64| HALF_HEIGHT * of.clone().map(height).reduce(further).unwrap_or(0.0);
    Outermost {
        truth: most(&|at| vertices.truths[at].clip[1]),
        low: most(&|at| vertices.bounds[at].clip[1].low()),
        high: most(&|at| vertices.bounds[at].clip[1].high()),
    }
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
        vec![
            "reference f64",
            "accuracy rules over the shader's IR",
            "bits of the rasteriser",
        ]
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
