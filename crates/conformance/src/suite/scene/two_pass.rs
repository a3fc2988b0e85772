//! `dot3` in one pass and in two, drawn to a target of bytes: the third article's cube, both ways, and what the second pass costs.
//!
//! What is judged, channel by channel of every covered pixel:
//!
//! - the colours that the three shaders write (one pass, first, second), taken from float targets, against the f64 surface and the
//!   acceptance intervals of the three fragment stages' own IR, as in any scene;
//! - the bytes of one pass: the nearest code of the colour that the shader wrote;
//! - the bytes of two: the first pass' code times the second's colour, as the reference's `second_pass` has it, with the liberties
//!   of a blending unit: it may round its source first, and take either code around the product;
//! - both pictures against each other: at most `LARGEST_DIFFERENCE_CODES`.
//!
//! Maps are in floats or 16 bits, so that filtering them is not what is measured. The cost is counted from the code (operations and
//! texture reads a pixel) and, on a machine whose clock says something, timed: 9 runs in turns.

use std::collections::BTreeMap;
use std::sync::Arc;

use bossage_assets::normal_mips::NormalMips;
use bossage_assets::normalisation_cube_map::{Depth as Bits, NormalisationCubeMap};
use bossage_assets::{ColorMap, NormalCodec, NormalMap};
use bossage_reference::dot3_two_pass::{Blender, LARGEST_DIFFERENCE_CODES, Target, first_pass, second_pass};
use bossage_runner::{Blend, Depth, Picture, RenderTarget, TimedJob, Timing, TimingOptions};
use bossage_scene::{Draw, NormalSource, Normaliser, Scene};
use bossage_shaders::{FeatureSet, Shading, Stage};
use glam::{DVec2, DVec3};

use super::expected::{Fragment, fragments};
use super::interpolants::Interpolants;
use super::judge::colours;
use super::rig::{Rig, job, render};
use super::specimen::floats;
use crate::bench::Bench;
use crate::bound::Bound;
use crate::case::{Case, Outcome, with_causes};
use crate::case_id::CaseId;
use crate::compare::{Comparison, Expected};
use crate::module::Module;
use crate::tolerance::UNDECIDED_LIMIT;
use crate::verdict::Verdict;

/// Pixels along a side.
const SIZE: [u32; 2] = [160, 120];

/// Texels along a side of the maps: smooth ones, a whole number of waves.
const MAP_SIDE: u32 = 128;
const CUBE_SIDE: u32 = 64;

/// The third article's cube at one angle, without its maps.
const SCENE: &str = r#"
schema = 1
ambient = [0.08, 0.06, 0.1]

[camera]
position = [0.0, 0.0, 0.0]
target = [0.0, 0.0, -6.0]
fov_deg = 45.0
near = 0.1
far = 100.0
size = [160, 120]

[[lights]]
name = "white"
kind = "point"
position = [1.5, 2.0, -1.0]

[[materials]]
name = "plate"
lighting_space = "object"

[[objects]]
name = "cube"
shape = "cube"
size = 2.0
material = "plate"
translate = [0.0, 0.0, -6.0]
rotate = [{ axis = [0.1, 0.3, 0.0], angle_deg = 40.0 }, { axis = [1.0, 0.0, 0.0], angle_deg = 25.0 }]
"#;

/// Both ways with one normaliser.
struct TwoPassCase {
    id: CaseId,
    cube: bool,
}

/// One case a normaliser.
pub fn cases() -> impl Iterator<Item = Box<dyn Case>> {
    let case = |(name, cube)| {
        let id = CaseId::new("dot3_two_pass", None, "passes")
            .with("against", "dot3_single_pass")
            .with("normaliser", name);
        Box::new(TwoPassCase { id, cube }) as Box<dyn Case>
    };
    [("arithmetic", false), ("cube", true)].into_iter().map(case)
}

/// A wave over the map, in [−1, 1].
fn wave(x: u32, y: u32, along: DVec2) -> f64 {
    let place = DVec2::new(f64::from(x), f64::from(y)) / f64::from(MAP_SIDE);
    (std::f64::consts::TAU * place.dot(along)).sin()
}

/// The scene with its maps, shaded in one pass or two.
fn scene(shading: Shading, cube: bool) -> Result<Scene, String> {
    let mut scene = bossage_scene::load_str("two_pass.toml", SCENE).map_err(|error| with_causes(&error))?;
    let material = scene.materials.first_mut().ok_or("the scene has a material")?;
    let places = || (0..MAP_SIDE * MAP_SIDE).map(|at| (at % MAP_SIDE, at / MAP_SIDE));
    let normal = |(x, y)| {
        let slope = DVec2::new(
            wave(x, y, DVec2::new(3.0, 1.0)),
            wave(x, y, DVec2::new(-1.0, 2.0)),
        );
        let n = slope.extend(1.5).normalize().as_vec3();
        let [r, g, b] = n.to_array().map(|c| NormalCodec::Unorm.encode(c));
        [r, g, b, 255]
    };
    let colour = |(x, y)| {
        let shares = [(2.0, 1.0), (1.0, -3.0), (0.0, 2.0)].map(|(u, v)| wave(x, y, DVec2::new(u, v)));
        let [r, g, b] = shares.map(|share| (160.0 + 90.0 * share) as u8);
        [r, g, b, 255]
    };
    material.normal = Some(NormalSource {
        path: "waves".into(),
        map: Arc::new(NormalMap {
            width: MAP_SIDE,
            height: MAP_SIDE,
            codec: NormalCodec::Unorm,
            texels: places().map(normal).collect(),
        }),
        mips: NormalMips::default(),
    });
    let map = ColorMap {
        width: MAP_SIDE,
        height: MAP_SIDE,
        texels: places().map(colour).collect(),
    };
    material.albedo.map = Some(("waves".into(), Arc::new(map)));
    material.shading = shading;
    if cube {
        let map =
            NormalisationCubeMap::generate(CUBE_SIDE, Bits::Sixteen).map_err(|error| with_causes(&error))?;
        material.normaliser = Normaliser::Cube(Arc::new(map));
    }
    Ok(scene)
}

/// The one draw of the scene, its normal map in floats.
fn draw(shading: Shading, cube: bool) -> Result<Draw, String> {
    let scene = scene(shading, cube)?;
    let plan = bossage_scene::plan(&scene);
    let mut draw = bossage_scene::draws(&scene, &plan)
        .pop()
        .ok_or("nothing is drawn")?;
    if draw.features.canonical().shading != shading {
        return Err(format!(
            "the planner left {shading:?} out: {}",
            draw.features.name()
        ));
    }
    for texture in draw.textures.values_mut() {
        *texture = Arc::new(floats(texture));
    }
    Ok(draw)
}

/// Everything that was drawn.
struct Drawn {
    /// What the three shaders wrote, in floats.
    single: Picture,
    first: Picture,
    second: Picture,
    /// What the three should have written, at the covered pixels in turn.
    expected: [Vec<Fragment>; 3],
    /// The targets of bytes.
    in_one: Vec<[u8; 4]>,
    in_two: Vec<[u8; 4]>,
}

/// Where a target of bytes was not drawn to.
const BACKGROUND: [u8; 4] = [51, 102, 153, 204];

impl Drawn {
    fn new(bench: &Bench<'_>, one: &Draw, two: &Draw) -> Result<Self, String> {
        let single = Rig::new(
            bench,
            one,
            &one.features,
            &[Stage::Fragment, Stage::FragmentCapture],
        )?;
        let double = Rig::new(bench, two, &two.features, &[Stage::Fragment, Stage::SecondPass])?;
        let floats = |rig: &Rig<'_>, stage| Ok::<_, String>(rig.floats(bench, stage, SIZE, 1)?.remove(0));
        let captured = single.floats(bench, Stage::FragmentCapture, SIZE, Interpolants::TARGETS)?;
        let covered = (0_usize..).zip(captured[0].covered());
        let points: Vec<Interpolants> = covered
            .filter(|(_, covered)| *covered)
            .map(|(at, _)| Interpolants::captured(&captured, at))
            .collect();
        let codes = |passes| {
            let target = RenderTarget::bytes(BACKGROUND.map(|code| f32::from(code) / 255.0));
            let picture = render(bench, &job("cube", SIZE, vec![target], passes))?.remove(0);
            picture
                .codes()
                .ok_or_else(|| "the target keeps no bytes".to_owned())
        };
        Ok(Self {
            single: floats(&single, Stage::Fragment)?,
            first: floats(&double, Stage::Fragment)?,
            second: floats(&double, Stage::SecondPass)?,
            expected: [
                fragments(&single, Stage::Fragment, &points)?,
                fragments(&double, Stage::Fragment, &points)?,
                fragments(&double, Stage::SecondPass, &points)?,
            ],
            in_one: codes(vec![vec![single.with(
                Stage::Fragment,
                Blend::Replace,
                Depth::TestAndWrite,
            )?]])?,
            in_two: codes(vec![
                vec![double.with(Stage::Fragment, Blend::Replace, Depth::TestAndWrite)?],
                vec![double.with(Stage::SecondPass, Blend::Multiply, Depth::Equal)?],
            ])?,
        })
    }
}

/// An output between two numbers.
fn between(truth: f64, low: f64, high: f64) -> Expected {
    Expected {
        truth,
        // Around the middle: a bound is as wide on both sides of its value.
        bound: Bound::between(low, high),
    }
}

/// The codes that a colour may be kept as: the nearest, where the conversion's own rounding (2⁻²² of at most 255) leaves no choice.
fn kept(colour: f64) -> [f64; 2] {
    let exact = 255.0 * colour.clamp(0.0, 1.0);
    let slack = 255.0 * 2f64.powi(-22);
    [exact - slack, exact + slack].map(|code| code.clamp(0.0, 255.0).round())
}

/// The code of one pass.
fn code_of_one(colour: f64) -> Expected {
    let [low, high] = kept(colour);
    between(Target::Unorm8.store(DVec3::splat(colour)).x * 255.0, low, high)
}

/// The code of two: a kept code times a colour, the colour rounded first or not, and either code around the product.
fn code_of_two(light: f64, colour: f64) -> Expected {
    let destinations = kept(light);
    let [least, most] = kept(colour);
    let sources = [255.0 * colour.clamp(0.0, 1.0), least, most];
    let products = destinations
        .into_iter()
        .flat_map(|destination| sources.map(|source| destination * source / 255.0));
    let (low, high) = products.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), product| {
        (low.min(product), high.max(product))
    });
    let destination = first_pass(light, Target::Unorm8);
    let truth = second_pass(
        destination,
        DVec3::splat(colour),
        Target::Unorm8,
        Blender::TakesSource,
    );
    // A product that is a code is that code: what f64 adds to it is no reason for another.
    let ulp = 255.0 * 4.0 * f64::EPSILON;
    between(truth.x * 255.0, (low + ulp).floor(), (high - ulp).ceil())
}

/// What was found, and how far apart the two ways are.
#[derive(Default)]
struct Found {
    comparison: Comparison,
    pixels: usize,
    /// Channels that differ between the two ways, and of how many.
    apart: usize,
    channels: usize,
}

impl Found {
    /// The bytes of one pixel, given what the shaders wrote there.
    fn bytes(&mut self, place: &[f32], [single, first, second]: [[f32; 4]; 3], one: [u8; 4], two: [u8; 4]) {
        for channel in 0..4 {
            let [single, first, second] = [single, first, second].map(|colour| f64::from(colour[channel]));
            let codes = [one, two].map(|pixel| f32::from(pixel[channel]));
            let apart = codes[1] - codes[0];
            let most = f64::from(LARGEST_DIFFERENCE_CODES);
            let expected = [
                code_of_one(single),
                code_of_two(first, second),
                between(0.0, -most, most),
            ];
            self.comparison
                .item(place, &[codes[0], codes[1], apart], &expected);
            self.apart += usize::from(apart != 0.0);
            self.channels += 1;
        }
    }
}

impl TwoPassCase {
    fn draws(&self) -> Result<[Draw; 2], String> {
        let one = draw(Shading::Dot3SinglePass, self.cube)?;
        Ok([one, draw(Shading::Dot3TwoPass, self.cube)?])
    }

    fn judge(&self, bench: &Bench<'_>) -> Result<Outcome, String> {
        let [one, two] = self.draws()?;
        let drawn = Drawn::new(bench, &one, &two)?;
        let covered = drawn.single.covered();
        let mut found = Found::default();
        for (at, covered) in covered.into_iter().enumerate() {
            let place = [at as u32 % SIZE[0], at as u32 / SIZE[0]].map(|side| side as f32);
            if !covered {
                let kept = [drawn.in_one[at], drawn.in_two[at]] == [BACKGROUND; 2];
                let got = f32::from(u8::from(kept));
                found.comparison.item(&place, &[got], &[between(1.0, 1.0, 1.0)]);
                continue;
            }
            let written = [&drawn.single, &drawn.first, &drawn.second].map(|picture| picture.pixels[at]);
            for (got, expected) in written.iter().zip(&drawn.expected) {
                let fragment = expected[found.pixels];
                let truth = fragment.truth.ok_or("the reference discards what has no mask")?;
                found
                    .comparison
                    .item(&place, got, &colours(truth, fragment.color));
            }
            found.pixels += 1;
            found.bytes(&place, written, drawn.in_one[at], drawn.in_two[at]);
        }
        let note = self.note(bench, &found, &one, &two)?;
        let outcome = Outcome::of(found.pixels, found.comparison, UNDECIDED_LIMIT);
        let passed = outcome.verdict == Verdict::Pass;
        Ok(Outcome {
            reason: if passed { Some(note) } else { outcome.reason },
            ..outcome
        })
    }

    /// How far apart the ways are, and what the second pass costs.
    fn note(&self, bench: &Bench<'_>, found: &Found, one: &Draw, two: &Draw) -> Result<String, String> {
        let single = Rig::new(bench, one, &one.features, &[Stage::Fragment])?;
        let double = Rig::new(bench, two, &two.features, &[Stage::Fragment, Stage::SecondPass])?;
        let counted = |rig: &Rig<'_>, stage| {
            let cost = rig.entry(stage)?.cost;
            Ok::<_, String>(format!("{} operations and {} reads", cost.ops, cost.samples))
        };
        let share = 100.0 * found.apart as f64 / found.channels.max(1) as f64;
        let note = format!(
            "{share:.1} % of the bytes differ, by at most one; a pixel takes {} in one pass, {} in the first of two, {} in the second",
            counted(&single, Stage::Fragment)?,
            counted(&double, Stage::Fragment)?,
            counted(&double, Stage::SecondPass)?,
        );
        Ok(match times(bench, &single, &double)? {
            None => format!("{note}; no times from this machine"),
            Some(times) => format!("{note}; {times}"),
        })
    }
}

/// The times of one pass, two draws in a pass, and two passes.
fn times(bench: &Bench<'_>, single: &Rig<'_>, double: &Rig<'_>) -> Result<Option<String>, String> {
    let target = || vec![RenderTarget::bytes([0.0; 4])];
    let one = single.with(Stage::Fragment, Blend::Replace, Depth::TestAndWrite)?;
    let light = double.with(Stage::Fragment, Blend::Replace, Depth::TestAndWrite)?;
    let colour = double.with(Stage::SecondPass, Blend::Multiply, Depth::Equal)?;
    let jobs = [
        job("one pass", SIZE, target(), vec![vec![one]]),
        job(
            "two draws",
            SIZE,
            target(),
            vec![vec![light.clone(), colour.clone()]],
        ),
        job("two passes", SIZE, target(), vec![vec![light], vec![colour]]),
    ];
    let timed: Vec<TimedJob<'_>> = jobs.iter().map(TimedJob::Render).collect();
    let Some(times) = bench.device.time(&timed, &TimingOptions::default()) else {
        return Ok(None);
    };
    let times = times.map_err(|error| with_causes(&error))?;
    Ok(said(&times))
}

fn said(times: &[Timing]) -> Option<String> {
    let [one, draws, passes] = times else { return None };
    let said = |timing: &Timing| {
        format!(
            "{:.3} ms (spread {:.0} %)",
            timing.median_ms,
            100.0 * timing.spread
        )
    };
    let factor = |timing: &Timing| timing.median_ms / one.median_ms;
    Some(format!(
        "medians of {} runs: one pass {}, two draws in a pass {} ({:.2} times), two passes {} ({:.2} times)",
        one.runs_ms.len(),
        said(one),
        said(draws),
        factor(draws),
        said(passes),
        factor(passes),
    ))
}

impl Case for TwoPassCase {
    fn id(&self) -> &CaseId {
        &self.id
    }

    fn basis(&self) -> Vec<&'static str> {
        vec![
            "reference f64",
            "accuracy rules over the shaders' IR",
            "the target's quantum",
            "liberties of a blending unit",
        ]
    }

    fn modules(&self) -> Result<Vec<Module>, String> {
        let [one, two] = self.draws()?;
        let of = |features: FeatureSet, stages: &[Stage]| -> Vec<Module> {
            stages
                .iter()
                .map(|&stage| Module::Surface { features, stage })
                .collect()
        };
        let single = of(
            one.features,
            &[Stage::Vertex, Stage::Fragment, Stage::FragmentCapture],
        );
        let double = of(two.features, &[Stage::Vertex, Stage::Fragment, Stage::SecondPass]);
        let all: BTreeMap<Module, ()> = single
            .into_iter()
            .chain(double)
            .map(|module| (module, ()))
            .collect();
        Ok(all.into_keys().collect())
    }

    fn run(&self, bench: &Bench<'_>) -> Outcome {
        self.judge(bench).unwrap_or_else(Outcome::failed)
    }
}

#[cfg(test)]
mod tests;
