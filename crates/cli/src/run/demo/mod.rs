//! `bossage demo`: the road of one scene, end to end, and a page that shows every stop of it.
//!
//! Pictures and conformance need an adapter. Where no driver brings one, `embedded` takes over, and the page says which routes
//! are left out. A failed check or case makes the exit code 1.

mod page;

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use bossage_conformance::{Report, Selection, run_cases};
use bossage_runner::{AdapterInfo, Machine};
use bossage_shaders::Library;
use bossage_translate::external::{self, Validator};
use bossage_translate::{EmitOptions, Target, lint};

use crate::Verdict;
use crate::args::{Global, demo::Demo};
use crate::bundle::BRICK_WALL;
use crate::console::{self, Console};
use crate::error::{Error, Result};
use crate::inputs::{self, Inputs, Planned};
use crate::numeric::Finding;
use crate::output::Outputs;
use crate::picture::{Linear, difference};
use crate::run::check::{self, Checker, InputReport};
use crate::run::conform::Watch;
use crate::run::emit::{Done, Job};
use crate::run::{plan, render};
use crate::stamp::Stamp;
use crate::{machine, technique};

/// Everything the page shows.
struct Story {
    inputs: Inputs,
    done: Done,
    validators: Vec<Validator>,
    check: InputReport,
    executed: Executed,
    times: Vec<(&'static str, Duration)>,
}

/// What was executed, and by whom.
struct Executed {
    machine: AdapterInfo,
    pictures: Vec<Shot>,
    conformance: Report,
}

/// One picture with what it shows.
struct Shot {
    file: &'static str,
    title: String,
    caption: String,
    png: Vec<u8>,
}

pub(crate) fn run(args: &Demo, global: &Global, console: Console) -> Result<Verdict> {
    let folder = &args.output;
    let mut clock = Clock::new(console);
    let (library, _) = inputs::library(global)?;
    let path = BRICK_WALL.unpack(&folder.join("scene"))?;
    let mut inputs = inputs::gather(std::slice::from_ref(&path), None, global)?;
    for planned in &mut inputs.scenes {
        plan::add_costs(&mut planned.plan, &library)?;
    }
    clock.lap(
        "plan",
        &format!(
            "{} permutation(s)",
            inputs
                .scenes
                .iter()
                .map(|s| s.plan.permutations.len())
                .sum::<usize>()
        ),
    );

    let options = EmitOptions::default();
    let job = Job {
        targets: &Target::ALL,
        options: &options,
        folder: &folder.join("shaders"),
    };
    let done = job.write(&inputs, Some(("demo".to_owned(), Stamp::load(job.folder))))?;
    clock.lap(
        "emit",
        &format!(
            "{} shaders in {} languages",
            inputs.modules.len(),
            Target::ALL.len()
        ),
    );

    let validators = external::detect();
    console.note(check::banner(&validators).trim_end());
    let checker = Checker {
        options: &options,
        validators: &validators,
        cache: check::cache_folder(None),
    };
    let mut check = checker.check_translations(&path, &done.translations);
    check.lints = inputs.parse()?.iter().flat_map(lint).map(Finding::from).collect();
    clock.lap("check", if check.ok { "nothing failed" } else { "FAILED" });

    let executed = execute(&inputs, &library, &mut clock)?;
    let story = Story {
        inputs,
        done,
        validators,
        check,
        executed,
        times: clock.laps,
    };
    story.finish(folder)
}

/// Draws and compares, on a driver's adapter or without any on our own evaluator.
fn execute(inputs: &Inputs, library: &Library, clock: &mut Clock) -> Result<Executed> {
    let machine = machine::open(None, clock.console)?;
    let planned = inputs
        .scenes
        .first()
        .ok_or_else(|| Error::Call("the demo has no scene".to_owned()))?;
    let pictures = pictures(machine.as_ref(), planned, library)?;
    clock.lap("render", &describe(machine.info()));
    let conformance = conform(planned, library, clock.console)?;
    let totals = conformance.totals();
    clock.lap(
        "conform",
        &format!("{} results, {} failed", totals.cases, totals.fail),
    );
    Ok(Executed {
        machine: machine.info().clone(),
        pictures,
        conformance,
    })
}

impl Story {
    fn is_fine(&self) -> bool {
        self.check.ok && self.done.failures().next().is_none() && self.executed.conformance.is_ok()
    }

    /// Writes pictures and page, and names them.
    fn finish(self, folder: &Path) -> Result<Verdict> {
        let page = folder.join("report.html");
        let mut outputs = Outputs::default();
        outputs.add(page.clone(), "the report", page::write(&self)?.into_bytes())?;
        for shot in &self.executed.pictures {
            outputs.add(folder.join(shot.file), "a picture", shot.png.clone())?;
        }
        outputs.commit()?;
        for shot in self.executed.pictures.iter().take(1) {
            console::print(&format!(
                "picture: {}
",
                folder.join(shot.file).display()
            ))?;
        }
        console::print(&format!(
            "report:  {}
",
            page.display()
        ))?;
        Ok(if self.is_fine() {
            Verdict::Fine
        } else {
            Verdict::Failed
        })
    }
}

fn describe(info: &AdapterInfo) -> String {
    let by_whom = if machine::is_embedded(info) {
        " (no driver: the evaluator's time, not a GPU's)"
    } else {
        ""
    };
    format!("on {}{by_whom}", info.name)
}

/// The wall as planned; and what its relief adds to the same wall without it.
fn pictures(machine: &dyn Machine, planned: &Planned, library: &Library) -> Result<Vec<Shot>> {
    let with = render::picture(machine, &planned.scene, library)?;
    let without = render::picture(machine, &technique::pinned(&planned.scene, "none")?, library)?;
    let difference = difference(&without, &with);
    let chosen = planned
        .plan
        .materials
        .first()
        .map_or("none", |material| material.technique);
    Ok(vec![
        Shot {
            file: "brick_wall.png",
            title: "The scene as planned".to_owned(),
            caption: format!(
                "A flat brick wall, {} x {} pixels, drawn with technique {chosen}.",
                with.width, with.height
            ),
            png: with.png()?,
        },
        Shot {
            file: "brick_wall_compare.png",
            title: "What the relief does".to_owned(),
            caption: format!(
                "Left: without relief. Middle: as planned. Right: the absolute difference, times {:.2} (in linear light at most \
                 {:.4}, mean {:.4}).",
                difference.amplification, difference.max, difference.mean
            ),
            png: Linear::beside(&[without, with, difference.picture]).png()?,
        },
    ])
}

/// The scene itself, and every technique whose code is in its shaders or whose data it reads.
fn conform(planned: &Planned, library: &Library, console: Console) -> Result<Report> {
    let selection = Selection {
        scenes: vec![planned.scene.path.clone()],
        ..Selection::default()
    };
    let mut wanted = techniques(planned, library)?;
    wanted.insert("scene".to_owned());
    let mut cases = selection.cases()?;
    cases.retain(|case| wanted.contains(&case.id().technique));
    Ok(run_cases(cases, &selection, library, &mut Watch::new(console))?)
}

fn techniques(planned: &Planned, library: &Library) -> Result<BTreeSet<String>> {
    let mut ids = BTreeSet::new();
    for assembled in inputs::assemble(library, &planned.plan)? {
        ids.extend(assembled.modules.iter().filter_map(|module| technique_of(module)));
    }
    for material in &planned.scene.materials {
        let codec = material.normal.as_ref().map(|normal| normal.map.codec);
        ids.extend(codec.map(|codec| format!("codec_{}", codec.name())));
        let has_tangents = planned
            .plan
            .materials
            .iter()
            .any(|plan| plan.name == material.name && plan.features.has_tangent());
        ids.extend(has_tangents.then(|| tangents(material.tangents).to_owned()));
    }
    Ok(ids)
}

/// `techniques/NAME.wesl` → NAME.
fn technique_of(module: &str) -> Option<String> {
    let path = PathBuf::from(module);
    let is_technique = path.parent().is_some_and(|folder| folder.ends_with("techniques"));
    is_technique
        .then(|| path.file_stem().map(|stem| stem.to_string_lossy().into_owned()))
        .flatten()
}

const fn tangents(tangents: bossage_scene::Tangents) -> &'static str {
    match tangents {
        bossage_scene::Tangents::MikkTSpace => "frame_mikktspace",
        bossage_scene::Tangents::FromUv => "frame_from_uv",
        bossage_scene::Tangents::FromNormal => "frame_from_normal",
    }
}

/// Tells how long each stop took.
struct Clock {
    console: Console,
    last: Instant,
    laps: Vec<(&'static str, Duration)>,
}

impl Clock {
    fn new(console: Console) -> Self {
        Self {
            console,
            last: Instant::now(),
            laps: Vec::new(),
        }
    }

    fn lap(&mut self, name: &'static str, what: &str) {
        let time = self.last.elapsed();
        self.console
            .note(format_args!("{name:8} {:6.2} s  {what}", time.as_secs_f64()));
        self.laps.push((name, time));
        self.last = Instant::now();
    }
}
