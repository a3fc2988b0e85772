//! `bossage study`: what accuracy costs, measured, and kept as it is finished.

mod cells;
mod pictures;
mod prices;
mod table;

use std::fs;
use std::path::Path;

use bossage_conformance::Route;
use bossage_conformance::bench::Bench;
use bossage_conformance::environment::Environment;
use bossage_runner::{Machine, TimingOptions};
use bossage_shaders::Library;
use bossage_study::calibrate;
use bossage_study::sweep::journal::Journal;
use bossage_study::sweep::ladder::{self, Chosen};
use bossage_study::sweep::subject::Subject;
use bossage_study::sweep::{Cell, Options, Sweep, Watch};
use bossage_study::{pareto, record, report, versus};

use crate::Verdict;
use crate::args::Global;
use crate::args::study::{RouteName, Study};
use crate::console::{self, Bar, Console};
use crate::error::{Error, Result};
use crate::nearest::suggestion;
use crate::output::{Outputs, check_writable};
use crate::{inputs, machine};
use cells::Views;

/// What is written for machines.
const FILE: &str = "study.json";
/// Rays whose operations are counted.
const COUNTED: usize = 4096;

pub(crate) fn run(args: &Study, global: &Global, console: Console) -> Result<Verdict> {
    let (library, _) = inputs::library(global)?;
    let charts = prices::charts(args)?;
    let chosen = chosen(args)?;
    let Views { cells, scenes } = cells::of(args)?;
    let measured = &args.measured;
    check_writable(&args.output.join(FILE))?;
    measured.calibrate.as_deref().map_or(Ok(()), check_writable)?;
    let machine = machine::open(measured.adapter.as_deref(), console)?;
    if measured.calibrate.is_some() && machine::is_embedded(machine.info()) {
        return Err(Error::Environment(format!(
            "--calibrate needs a driver: `{}` has times of its own only; {}",
            machine.info().name,
            bossage_runner::HOW_TO_GET_AN_ADAPTER
        )));
    }
    let route = route(args, machine.as_ref());
    let points = if args.price.is_empty() {
        let subjects = subjects(args, &library, &chosen, route)?;
        console.note(format_args!(
            "{} techniques, {} views on {}",
            subjects.len(),
            cells.len(),
            machine.info()
        ));
        measure(args, machine.as_ref(), &subjects, &cells, console)?
    } else {
        Vec::new()
    };
    let mut study = record::Study {
        environment: environment(machine.as_ref()),
        points,
        prices: prices::measure(&charts, args, machine.as_ref(), &library, console)?,
        ..record::Study::default()
    };
    pareto::mark(&mut study.points);
    study.exact_against_marching = versus::all(&study);
    let pairs = pictures::pairs(
        &scenes,
        &mut study,
        &Bench::new(machine.as_ref(), route, &library),
        console,
    )?;
    let mut outputs = Outputs::default();
    for (name, bytes) in report::files(&study, &pairs)? {
        outputs.add(args.output.join(name), "the report", bytes)?;
    }
    outputs.add(
        args.output.join(FILE),
        "the study",
        console::json_text(&study)?.into_bytes(),
    )?;
    if let Some(path) = &measured.calibrate {
        outputs.add(
            path.clone(),
            "--calibrate",
            profile(&study, path, machine.as_ref())?.into_bytes(),
        )?;
    }
    outputs.commit()?;
    console::print(&table::of(&study))?;
    Ok(Verdict::Fine)
}

/// Techniques with settings; a typo is answered with the nearest name.
fn chosen(args: &Study) -> Result<Vec<Chosen>> {
    if args.technique.is_empty() && args.shader.is_empty() {
        return Ok(ladder::default_choice(args.measured.quick));
    }
    let mut all: Vec<Chosen> = Vec::new();
    for text in &args.technique {
        for one in ladder::parse(text).map_err(explained)? {
            // What is named twice is measured once.
            if !all.contains(&one) {
                all.push(one);
            }
        }
    }
    Ok(all)
}

fn explained(error: bossage_study::Error) -> Error {
    match error {
        bossage_study::Error::UnknownTechnique { given, known } => Error::Call(format!(
            "unknown technique `{given}`; {}",
            suggestion(&given, &known)
        )),
        other => other.into(),
    }
}

fn route(args: &Study, machine: &dyn Machine) -> Route {
    match args.measured.route {
        _ if machine::is_embedded(machine.info()) => Route::Embedded,
        RouteName::Spirv => Route::Spirv,
        RouteName::Wgsl => Route::Wgsl,
    }
}

/// Who takes part: the library's techniques, then the user's shaders.
fn subjects(args: &Study, library: &Library, chosen: &[Chosen], route: Route) -> Result<Vec<Subject>> {
    let mut subjects = Subject::of_library(library, chosen, route)?;
    for file in &args.shader {
        subjects.push(of_user(file, library, route)?);
    }
    Ok(subjects)
}

fn of_user(file: &Path, library: &Library, route: Route) -> Result<Subject> {
    let (shown, name) = (file.display().to_string(), file.file_stem().unwrap_or_default());
    let is = |wanted: &str| file.extension().is_some_and(|extension| extension == wanted);
    let text = if is("wesl") {
        library.assemble_user_file(file)?.wgsl
    } else if is("wgsl") {
        String::from_utf8(crate::error::read(file)?)
            .map_err(|_| Error::Call(format!("{shown} is no text in UTF-8")))?
    } else {
        return Err(Error::Call(format!(
            "--shader {shown}: a study takes .wgsl and .wesl files"
        )));
    };
    Ok(Subject::of_user(&name.to_string_lossy(), &shown, text, route)?)
}

fn measure(
    args: &Study,
    machine: &dyn Machine,
    subjects: &[Subject],
    cells: &[Cell],
    console: Console,
) -> Result<Vec<record::Point>> {
    let sweep = Sweep {
        machine,
        subjects,
        cells,
        options: Options {
            counted: COUNTED,
            timing: TimingOptions::default(),
        },
    };
    fs::create_dir_all(&args.output).map_err(|source| Error::Write {
        path: args.output.clone(),
        source,
    })?;
    let mut journal = Journal::open(&args.output)?;
    if args.measured.fresh {
        journal.clear()?;
    }
    if journal.damaged() > 0 {
        console::warn(format_args!(
            "{} finished points could not be read and are measured again",
            journal.damaged()
        ));
    }
    Ok(sweep.run(
        &mut journal,
        &mut Progress {
            console,
            bar: None,
            kept: 0,
        },
    )?)
}

fn environment(machine: &dyn Machine) -> std::collections::BTreeMap<String, String> {
    let environment = Environment::of(std::slice::from_ref(machine.info()));
    environment
        .rows()
        .into_iter()
        .filter(|(name, _)| !["seed", "inputs"].contains(&name.as_str()))
        .collect()
}

fn profile(study: &record::Study, path: &Path, machine: &dyn Machine) -> Result<String> {
    let name = path.file_stem().unwrap_or_default().to_string_lossy();
    let profile = calibrate::profile(study, &name, machine.info())?;
    Ok(calibrate::text(&profile)?)
}

/// Cells that are done, and how many points had been measured before.
struct Progress {
    console: Console,
    bar: Option<Bar>,
    kept: usize,
}

impl Watch for Progress {
    fn start(&mut self, cells: usize) {
        self.bar = Some(self.console.bar(cells as u64, "study"));
    }

    fn begin(&mut self, cell: &Cell) {
        if let Some(Bar(bar)) = &self.bar {
            bar.set_message(format!("{} at {}°", cell.map.name, cell.view_deg));
        }
    }

    fn done(&mut self, measured: usize) {
        if measured == 0 {
            self.kept += 1;
        }
        if let Some(Bar(bar)) = &self.bar {
            bar.inc(1);
        }
    }
}
