//! Scene cases: the surface shaders that a scene calls for, rendered, and judged pixel by pixel.
//!
//! Three cases a scene. `planned` renders every object with the permutation of the plan, `all_effects` with every effect on;
//! each pixel of each pass is judged by the f64 surface and by the acceptance interval of the fragment stage's own IR, at the very
//! interpolants that the rasteriser chose (a capture variant of the same shader writes them out; it has no alpha test, so cut-out
//! pixels are known too). `agreement` judges the two pictures by each other: dropping effects must not show.
//!
//! A hardened surface promises an answer at every pixel: an open interval is a failure. Textures are given with one level, which is
//! what the reference models. Objects are rendered one by one.

pub mod displacement;
mod expected;
mod given_hit;
mod interpolants;
mod judge;
pub mod permutations;
mod pixels;
mod rig;
mod specimen;
mod truth;
pub mod two_pass;
mod upload;
pub mod vertices;
pub mod whole;

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::sync::OnceLock;

use bossage_runner::Filter;
use bossage_scene::{Draw, Plan, Scene, draws, draws_with};
use bossage_shaders::{Form, Stage};

use self::expected::Expectations;
use self::judge::{agreement, judged};
use self::pixels::{Drawn, Object, modules, passes};
use crate::bench::Bench;
use crate::case::{Case, Outcome, with_causes};
use crate::case_id::CaseId;
use crate::compare::Comparison;
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
    /// Kept between routes and adapters, as long as they run the same shaders at the same points.
    expectations: Expectations,
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
                expectations: Expectations::default(),
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
        let (mut comparison, mut inputs) = (Comparison::default(), 0);
        for (number, draw) in draws(scene, plan).iter().enumerate() {
            let full = everything(scene, plan, draw);
            let object = Object {
                bench,
                number,
                size: scene.camera.size,
                filter: Filter::Linear,
                expectations: &self.expectations,
            };
            for stage in passes(draw) {
                let start = demanding(draw);
                let (part, pixels) = match self.shaders {
                    Shaders::Planned => alone(&object.render(draw, stage)?, start),
                    Shaders::AllEffects => alone(&object.render(&full, stage)?, start),
                    Shaders::Agreement => together(&object, [draw, &full], stage, start)?,
                };
                comparison.merge(part);
                inputs += pixels;
            }
        }
        Ok(Outcome::of(inputs, comparison, UNDECIDED_LIMIT_FILTERED))
    }
}

/// One picture against the reference.
fn alone(drawn: &Drawn, start: Comparison) -> (Comparison, usize) {
    (judged(&drawn.pixels, start), drawn.pixels.len())
}

/// The planned picture and the full one against each other.
fn together(
    object: &Object<'_>,
    [planned, full]: [&Draw; 2],
    stage: Stage,
    start: Comparison,
) -> Result<(Comparison, usize), String> {
    let (ours, theirs) = (object.render(planned, stage)?, object.render(full, stage)?);
    let there = object.expected_at(planned, stage, &theirs.points)?;
    let comparison = agreement(&ours.pixels, &theirs.pixels, &there, start);
    Ok((comparison, theirs.pixels.len()))
}

/// A hardened surface promises an answer at every pixel. A search along the view ray does so too, but the evaluator follows a march whose
/// steps can all go either way only to its limits: such a pixel is counted as undecided.
fn demanding(draw: &Draw) -> Comparison {
    match draw.features.form {
        Form::Hardened if !draw.features.relief.is_search() => Comparison::demanding_answers(),
        Form::Hardened | Form::Published => Comparison::default(),
    }
}

/// The same object with every effect on.
fn everything(scene: &Scene, plan: &Plan, draw: &Draw) -> Draw {
    let all = draws_with(scene, |material| {
        (plan.everything(material), plan.settings(material))
    });
    all.into_iter()
        .find(|full| full.object == draw.object)
        .unwrap_or_else(|| draw.clone())
}

impl Case for SceneCase {
    fn id(&self) -> &CaseId {
        &self.id
    }

    fn basis(&self) -> Vec<&'static str> {
        match self.shaders {
            Shaders::Planned | Shaders::AllEffects => crate::oracle::BASIS.to_vec(),
            Shaders::Agreement => vec![
                "reference f64 of both shaders",
                "accuracy rules over both shaders' IR",
            ],
        }
    }

    fn arguments(&self) -> Vec<String> {
        vec!["--scene".to_owned(), self.path.display().to_string()]
    }

    fn modules(&self) -> Result<Vec<Module>, String> {
        let (scene, plan) = self.scene()?;
        let planned = draws(scene, plan);
        let full = draws_with(scene, |material| {
            (plan.everything(material), plan.settings(material))
        });
        let drawn = match self.shaders {
            Shaders::Planned => planned,
            Shaders::AllEffects => full,
            Shaders::Agreement => [planned, full].concat(),
        };
        let all = drawn.iter().flat_map(modules);
        Ok(all.collect::<BTreeSet<_>>().into_iter().collect())
    }

    fn run(&self, bench: &Bench<'_>) -> Outcome {
        self.judge(bench).unwrap_or_else(Outcome::failed)
    }
}
