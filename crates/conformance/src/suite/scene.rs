//! Scene cases: the surface shaders that a scene calls for, rendered, and judged pixel by pixel.
//!
//! Three cases a scene. `planned` renders every object with the permutation of the plan, `all_effects` with every effect on;
//! each pixel is compared with the f64 surface and its bound at the very interpolants that the rasteriser chose (a capture
//! variant of the same shader writes them out; it has no alpha test, so cut-out pixels are known too). `agreement` compares the
//! two pictures: dropping effects must not change more than the two bounds allow.
//!
//! Textures are given with one level, which is what the reference models. Objects are rendered one by one.

pub mod displacement;
mod pixels;
mod rig;
mod surface;
mod truth;
pub mod two_pass;
mod upload;

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};
use std::sync::OnceLock;

use bossage_scene::{Draw, Plan, Scene, draws, draws_with};
use bossage_shaders::Relief;

use self::pixels::{Pixel, modules, render};
use self::surface::is_bounded;
use crate::bench::Bench;
use crate::bounded::{Bounded, Decision};
use crate::case::{Case, Outcome, with_causes};
use crate::case_id::CaseId;
use crate::compare::{Comparison, Expected};
use crate::module::Module;
use crate::tolerance::UNDECIDED_LIMIT_FILTERED;

/// Which shaders a case renders.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Shaders {
    Planned,
    AllEffects,
    Agreement,
}

/// One scene with one choice of shaders.
struct SceneCase {
    id: CaseId,
    path: PathBuf,
    shaders: Shaders,
    loaded: OnceLock<Result<(Scene, Plan), String>>,
}

/// Three cases a scene file.
pub fn cases(scenes: &[PathBuf]) -> impl Iterator<Item = Box<dyn Case>> {
    let variants = [
        (Shaders::Planned, "planned"),
        (Shaders::AllEffects, "all_effects"),
        (Shaders::Agreement, "agreement"),
    ];
    scenes.iter().flat_map(move |path| {
        variants.map(|(shaders, generator)| {
            let id = CaseId::new("scene", None, generator).with("scene", name(path));
            Box::new(SceneCase {
                id,
                path: path.clone(),
                shaders,
                loaded: OnceLock::new(),
            }) as Box<dyn Case>
        })
    })
}

fn name(path: &Path) -> String {
    path.file_stem()
        .map_or_else(|| "scene".to_owned(), |stem| stem.to_string_lossy().into_owned())
}

/// The scene files of a folder, sorted: what ends in `.toml`.
///
/// # Errors
/// [`crate::Error::Scenes`] when the folder cannot be read.
pub fn files_in(folder: &Path) -> Result<Vec<PathBuf>, crate::Error> {
    let failed = |source| crate::Error::Scenes {
        path: folder.to_owned(),
        source,
    };
    let entries = std::fs::read_dir(folder).map_err(failed)?;
    let paths = entries
        .map(|entry| entry.map(|entry| entry.path()))
        .collect::<Result<Vec<_>, _>>()
        .map_err(failed)?;
    let mut scenes: Vec<PathBuf> = paths
        .into_iter()
        .filter(|path| path.extension().is_some_and(|e| e == "toml"))
        .collect();
    scenes.sort();
    Ok(scenes)
}

impl SceneCase {
    fn scene(&self) -> Result<&(Scene, Plan), String> {
        let load = || {
            let scene = bossage_scene::load(&self.path).map_err(|error| with_causes(&error))?;
            let plan = bossage_scene::plan(&scene);
            Ok((scene, plan))
        };
        self.loaded.get_or_init(load).as_ref().map_err(Clone::clone)
    }

    fn judge(&self, bench: &Bench<'_>) -> Result<Outcome, String> {
        let (scene, plan) = self.scene()?;
        let planned = draws(scene, plan);
        if let Some(draw) = planned.iter().find(|draw| !is_bounded(draw)) {
            let name = draw.features.name();
            return Ok(Outcome::skipped(format!(
                "no bound is known yet for {name}; its formulas are judged one by one by the cases of its techniques"
            )));
        }
        if self.shaders == Shaders::Agreement && planned.iter().any(is_displaced) {
            return Ok(Outcome::skipped(
                "the two vertex stages round displaced vertices differently, and what that moves in the pixels' inputs has no \
                 bound yet; `planned` and `all_effects` judge either picture",
            ));
        }
        let (mut comparison, mut inputs) = (Comparison::default(), 0);
        for draw in &planned {
            let full = everything(scene, plan, draw);
            let size = scene.camera.size;
            let (part, pixels) = match self.shaders {
                Shaders::Planned => judged(&render(bench, draw, size)?),
                Shaders::AllEffects => judged(&render(bench, &full, size)?),
                Shaders::Agreement => agreement(&render(bench, draw, size)?, &render(bench, &full, size)?),
            };
            comparison.merge(part);
            inputs += pixels;
        }
        Ok(Outcome::of(inputs, comparison, UNDECIDED_LIMIT_FILTERED))
    }
}

/// Whether the vertex stage moves the vertices.
fn is_displaced(draw: &Draw) -> bool {
    draw.features.relief == Relief::Displacement
}

/// The same object with every effect on.
fn everything(scene: &Scene, plan: &Plan, draw: &Draw) -> Draw {
    let all = draws_with(scene, |material| plan.everything(material));
    all.into_iter()
        .find(|full| full.object == draw.object)
        .unwrap_or_else(|| draw.clone())
}

/// Every pixel against the reference: the four channels, and whether the alpha test kept it.
fn judged(pixels: &[Pixel]) -> (Comparison, usize) {
    let mut comparison = Comparison::default();
    for pixel in pixels {
        comparison.item(
            &pixel.place,
            &[f32::from(u8::from(pixel.got.is_some()))],
            &[kept(pixel)],
        );
        if let (Some(got), Some(truth)) = (pixel.got, pixel.truth) {
            let expected: Vec<Expected> = (0..4)
                .map(|i| Expected {
                    truth: truth[i],
                    bound: pixel.bound.color[i].into(),
                })
                .collect();
            comparison.item(&pixel.place, &got, &expected);
        }
    }
    (comparison, pixels.len())
}

/// 1 where the alpha test keeps the pixel, 0 where it cuts it out.
fn kept(pixel: &Pixel) -> Expected {
    let truth = f64::from(u8::from(pixel.truth.is_some()));
    let bound = Bounded::select(pixel.bound.discarded, Bounded::exact(0.0), Bounded::exact(1.0));
    Expected {
        truth,
        bound: bound.into(),
    }
}

/// The planned picture against the one with all effects: each within the sum of both bounds of the other.
fn agreement(planned: &[Pixel], full: &[Pixel]) -> (Comparison, usize) {
    let mut comparison = Comparison::default();
    let mut pairs = 0;
    let key = |pixel: &Pixel| (pixel.place[0] as u32, pixel.place[1] as u32);
    let full: BTreeMap<(u32, u32), &Pixel> = full.iter().map(|pixel| (key(pixel), pixel)).collect();
    for planned in planned {
        let Some(full) = full.get(&key(planned)) else {
            continue;
        };
        pairs += 1;
        let decided = |pixel: &Pixel| !matches!(pixel.bound.discarded, Decision::Either { .. });
        let (Some(got), Some(other)) = (planned.got, full.got) else {
            let same = planned.got.is_some() == full.got.is_some();
            let bound = Bounded {
                forked: !decided(planned) || !decided(full),
                ..Bounded::exact(1.0)
            };
            let bound = if bound.forked {
                Bounded { error: 1.0, ..bound }
            } else {
                bound
            };
            comparison.item(
                &planned.place,
                &[f32::from(u8::from(same))],
                &[Expected {
                    truth: 1.0,
                    bound: bound.into(),
                }],
            );
            continue;
        };
        let expected = |i: usize| {
            let (a, b) = (planned.bound.color[i], full.bound.color[i]);
            let bound = Bounded::within(f64::from(other[i]), a.error + b.error).marked(&[a, b]);
            Expected {
                truth: f64::from(other[i]),
                bound: bound.into(),
            }
        };
        comparison.item(&planned.place, &got, &(0..4).map(expected).collect::<Vec<_>>());
    }
    (comparison, pairs)
}

impl Case for SceneCase {
    fn id(&self) -> &CaseId {
        &self.id
    }

    fn basis(&self) -> Vec<&'static str> {
        match self.shaders {
            Shaders::Planned | Shaders::AllEffects => crate::oracle::BASIS.to_vec(),
            Shaders::Agreement => vec!["shader with all effects", "accuracy rules at the input"],
        }
    }

    fn arguments(&self) -> Vec<String> {
        vec!["--scene".to_owned(), self.path.display().to_string()]
    }

    fn modules(&self) -> Result<Vec<Module>, String> {
        let (scene, plan) = self.scene()?;
        let planned = draws(scene, plan);
        let full = draws_with(scene, |material| plan.everything(material));
        let drawn = match self.shaders {
            Shaders::Planned => planned,
            Shaders::AllEffects => full,
            Shaders::Agreement => [planned, full].concat(),
        };
        let all = drawn.iter().flat_map(|draw| modules(&draw.features));
        Ok(all.collect::<BTreeSet<_>>().into_iter().collect())
    }

    fn run(&self, bench: &Bench<'_>) -> Outcome {
        self.judge(bench).unwrap_or_else(Outcome::failed)
    }
}
