//! From arguments to exit code.

use std::ffi::OsString;
use std::io::Write;
use std::path::Path;
use std::process::ExitCode;
use std::time::Instant;

use bossage_runner::{AdapterInfo, AdapterSelector, Device};
use clap::Parser;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

use crate::args::{Args, ledger_folder};
use crate::equivalent::List;
use crate::error::Error;
use crate::fate::Fate;
use crate::folder::Sources;
use crate::ground::scenes_folder;
use crate::ledger::{Ledger, state};
use crate::mutant::Mutant;
use crate::pool::Pool;
use crate::report::Report;
use crate::sample::Part;
use crate::{generate, worker};

/// Without a terminal there is a line of progress after so many mutants.
const LINE_EVERY: usize = 50;

/// Runs the command.
pub fn run(args: impl IntoIterator<Item = OsString>) -> ExitCode {
    let args = match Args::try_parse_from(args) {
        Ok(args) => args,
        // Help goes to standard output and is fine; mistakes are 2.
        Err(error) => {
            let _ = error.print();
            return ExitCode::from(u8::try_from(error.exit_code()).unwrap_or(2));
        }
    };
    let adapter = selector(&args);
    if args.worker {
        // A parent that is gone needs no answer.
        return worker::serve(&args.shader_dir(), !args.without_scenes, &adapter)
            .map_or(ExitCode::FAILURE, |()| ExitCode::SUCCESS);
    }
    match command(&args, &adapter) {
        Ok(true) => ExitCode::SUCCESS,
        Ok(false) => ExitCode::FAILURE,
        Err(error) => {
            let mut text = format!("error: {error}");
            let mut cause = std::error::Error::source(&error);
            while let Some(error) = cause {
                text = format!("{text}: {error}");
                cause = error.source();
            }
            note(&text);
            ExitCode::from(error.exit_code())
        }
    }
}

fn selector(args: &Args) -> AdapterSelector {
    args.adapter
        .as_deref()
        .map_or(AdapterSelector::Any, AdapterSelector::named)
}

/// Whether the run is fine.
fn command(args: &Args, adapter: &AdapterSelector) -> Result<bool, Error> {
    let sources = Sources::read(&args.shader_dir())?;
    let all = generate::mutants(&sources)?;
    let list = List::read(&args.equivalent())?;
    list.check(&all)?;
    let part = Part {
        filter: args.filter.clone(),
        shard: args.shard,
        sample: args.sample.map(|count| (count, args.seed)),
    };
    let mutants = part.of(&all)?;
    if args.list {
        mutants
            .iter()
            .try_for_each(|it| print(&format!("{}\n  - {}\n  + {}\n", it.id, it.was, it.is)))?;
        return Ok(true);
    }
    let info = Device::open(adapter).map_err(Error::Adapter)?.info().clone();
    let start = Instant::now();
    let fates = fates(args, &info, &sources, &mutants)?;
    let report = Report::new(
        info.to_string(),
        part.is_whole() && !args.without_scenes,
        &mutants,
        fates,
        &list,
        start.elapsed(),
    );
    if let Some(path) = &args.json {
        write_json(path, &report)?;
    }
    print(&report.text())?;
    Ok(report.faults().is_empty())
}

fn fates(args: &Args, info: &AdapterInfo, sources: &Sources, mutants: &[Mutant]) -> Result<Vec<Fate>, Error> {
    let scenes = (!args.without_scenes).then(scenes_folder);
    let ledger = Ledger::open(
        &ledger_folder(),
        &state(sources, scenes.as_deref(), info)?,
        args.fresh,
    )?;
    let mut fates: Vec<Option<Fate>> = mutants
        .iter()
        .map(|mutant| ledger.known(mutant).cloned())
        .collect();
    let open: Vec<usize> = (0..mutants.len()).filter(|&at| fates[at].is_none()).collect();
    if open.len() < mutants.len() {
        note(&format!(
            "{} verdicts are known from an earlier run",
            mutants.len() - open.len()
        ));
    }
    if !open.is_empty() {
        let asked: Vec<Mutant> = open.iter().map(|&at| mutants[at].clone()).collect();
        // Workers read this copy, so that editing the sources meanwhile changes nothing.
        let copy = sources.copy()?;
        let program = std::env::current_exe()
            .map_err(|error| Error::Worker(format!("could not be started: {error}")))?;
        let pool = Pool {
            program,
            arguments: Vec::new(),
            folder: copy.path(),
            adapter: Some(&info.name),
            scenes: !args.without_scenes,
            jobs: jobs(args),
        };
        let mut watch = Watch::new(asked.len());
        let mut kept = Ok(());
        pool.run(&asked, &mut |index, fate| {
            watch.done(&asked[index], &fate);
            if kept.is_ok() {
                kept = ledger.keep(&asked[index], &fate);
            }
            fates[open[index]] = Some(fate);
        })?;
        kept?;
    }
    let all: Option<Vec<Fate>> = fates.into_iter().collect();
    all.ok_or_else(|| Error::Worker("lost a mutant".to_owned()))
}

fn jobs(args: &Args) -> usize {
    let cores = || std::thread::available_parallelism().map_or(1, usize::from);
    args.jobs.map_or_else(cores, usize::from)
}

/// Beside, then renamed: never half a file.
fn write_json(path: &Path, report: &Report<'_>) -> Result<(), Error> {
    let failed = |source| Error::Write {
        path: path.to_owned(),
        source,
    };
    let folder = path
        .parent()
        .filter(|parent| !parent.as_os_str().is_empty())
        .unwrap_or(Path::new("."));
    let mut file = tempfile::NamedTempFile::new_in(folder).map_err(failed)?;
    serde_json::to_writer_pretty(&mut file, report).map_err(|error| failed(error.into()))?;
    file.write_all(b"\n").map_err(failed)?;
    file.persist(path).map_err(|error| failed(error.error))?;
    Ok(())
}

/// A bar on a terminal, a line now and then elsewhere, and every survivor as soon as it is known.
struct Watch {
    bar: ProgressBar,
    total: usize,
    done: usize,
    survived: usize,
    start: Instant,
}

impl Watch {
    fn new(total: usize) -> Self {
        let bar = ProgressBar::with_draw_target(Some(total as u64), ProgressDrawTarget::stderr());
        let style = ProgressStyle::with_template("mutants {wide_bar} {pos}/{len} {msg}");
        bar.set_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()));
        Self {
            bar,
            total,
            done: 0,
            survived: 0,
            start: Instant::now(),
        }
    }

    fn done(&mut self, mutant: &Mutant, fate: &Fate) {
        self.done += 1;
        self.bar.inc(1);
        if fate.survived() {
            self.survived += 1;
            self.bar.set_message(format!("{} survived", self.survived));
            self.bar.suspend(|| note(&format!("survived: {}", mutant.id)));
        }
        if self.bar.is_hidden() && (self.done.is_multiple_of(LINE_EVERY) || self.done == self.total) {
            let (done, total, survived) = (self.done, self.total, self.survived);
            note(&format!(
                "{done}/{total} mutants, {survived} survived, {:.0} s",
                self.start.elapsed().as_secs_f64()
            ));
        }
    }
}

impl Drop for Watch {
    fn drop(&mut self) {
        self.bar.finish_and_clear();
    }
}

/// A line on standard error; where that is closed, nobody can be told.
fn note(line: &str) {
    let _ = writeln!(std::io::stderr().lock(), "{line}");
}

/// A result. A closed pipe ends the printing, not the run.
fn print(text: &str) -> Result<(), Error> {
    let mut out = std::io::stdout().lock();
    match out.write_all(text.as_bytes()).and_then(|()| out.flush()) {
        Err(error) if error.kind() != std::io::ErrorKind::BrokenPipe => Err(Error::Write {
            path: "standard output".into(),
            source: error,
        }),
        Ok(()) | Err(_) => Ok(()),
    }
}
