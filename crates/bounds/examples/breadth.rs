//! How many of other people's shaders evaluate: every entry point of every `.wgsl` file in a folder, over every domain.
//!
//! `cargo run --profile dev -p bossage-bounds --example breadth -- DIR [SECONDS]`. Prints one line for each entry point that did
//! not evaluate within the budget, and a summary; the exit code is 1 when a domain panicked, was unsupported, or ran longer
//! than SECONDS (default 60).

use bossage_bounds::ranges::{Inputs, Seed, Style, Target, infer};
use bossage_bounds::{
    Accept, Bindings, BufferData, Domain, Error, F32, F64, Kind, Limits, Program, Range, Scalar,
    range_scalar, run_entry,
};
use naga::Module;
use naga::valid::ModuleInfo;
use std::collections::BTreeMap;
use std::io::Write;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::time::Instant;

/// What became of the entry points, and why.
#[derive(Default)]
struct Tally {
    invalid: usize,
    entries: usize,
    fine: usize,
    reasons: BTreeMap<String, usize>,
    slowest: (f64, String),
    bad: usize,
}

fn files(dir: &Path) -> Vec<PathBuf> {
    let Ok(entries) = std::fs::read_dir(dir) else {
        return Vec::new();
    };
    let mut list: Vec<PathBuf> = entries.filter_map(|e| Some(e.ok()?.path())).collect();
    list.sort();
    list.into_iter()
        .flat_map(|p| {
            if p.is_dir() {
                files(&p)
            } else if p.extension().is_some_and(|e| e == "wgsl") {
                vec![p]
            } else {
                Vec::new()
            }
        })
        .collect()
}

/// The reason in a few words, without names and numbers.
fn class(error: &Error) -> String {
    match error {
        Error::Unsupported { what, .. } => format!("unsupported: {what}"),
        Error::Budget { .. } => "budget".into(),
        Error::Depth { .. } => "depth".into(),
        Error::Memory { .. } => "memory".into(),
        other => other.to_string(),
    }
}

/// One run at a random and one at a hard choice of all inputs, or over their whole ranges.
fn evaluate<D: Domain>(program: &Program, inputs: &Inputs, whole: Whole<D>) -> (Result<(), String>, f64) {
    let start = Instant::now();
    let result = [Style::Random, Style::Edge].into_iter().try_for_each(|style| {
        match catch_unwind(AssertUnwindSafe(|| at::<D>(program, inputs, style, whole))) {
            Ok(Ok(())) => Ok(()),
            Ok(Err(error)) => Err(class(&error)),
            Err(_) => Err("PANIC".into()),
        }
    });
    (
        result.map_err(|e| format!("{}: {e}", D::NAME)),
        start.elapsed().as_secs_f64(),
    )
}

/// Makes a scalar the whole of a range, in the domain that has ranges.
type Whole<D> = Option<fn(f64, f64) -> Option<Scalar<D>>>;

fn at<D: Domain>(program: &Program, inputs: &Inputs, style: Style, whole: Whole<D>) -> Result<(), Error> {
    let mut seed = Seed::new(1);
    let point = inputs.sample(&mut seed, style);
    let quad = inputs.quad(&point, &mut seed);
    let (mut bindings, stage) = inputs.at::<D>(&quad.each_ref())?;
    if let Some(whole) = whole {
        widen(&mut bindings, inputs, whole);
    }
    run_entry(
        program,
        &mut bindings,
        &stage,
        inputs.workgroups,
        &Limits::default(),
    )
    .map(|_| ())
}

fn widen<D: Domain>(bindings: &mut Bindings<D>, inputs: &Inputs, whole: fn(f64, f64) -> Option<Scalar<D>>) {
    for (scalar, (lo, hi)) in inputs.scalars.iter().zip(inputs.bounds()) {
        let (
            Target::Buffer {
                group,
                binding,
                index,
            },
            Kind::Float(_),
        ) = (scalar.target, scalar.kind)
        else {
            continue;
        };
        if let (Some(BufferData::Scalars(list)), Some(x)) =
            (bindings.buffers.get_mut(&(group, binding)), whole(lo, hi))
        {
            list[index] = x;
        }
    }
}

fn over_domains(program: &Program, inputs: &Inputs) -> [(Result<(), String>, f64); 4] {
    [
        evaluate::<F32>(program, inputs, None),
        evaluate::<F64>(program, inputs, None),
        evaluate::<Accept>(program, inputs, None),
        evaluate::<Range>(program, inputs, Some(|lo, hi| range_scalar(lo, hi).ok())),
    ]
}

fn prepared(module: &Module, info: &ModuleInfo, name: &str) -> Result<(Program, Inputs), Error> {
    let constants = infer::constants(module);
    let program = Program::with_constants(module, info, name, &constants)?;
    Ok((program, Inputs::new(module, info, name, None)?))
}

fn entry(tally: &mut Tally, module: &Module, info: &ModuleInfo, name: &str, place: &str, patience: f64) {
    tally.entries += 1;
    let results = match catch_unwind(AssertUnwindSafe(|| prepared(module, info, name))) {
        Err(_) => vec![(Err("compile: PANIC".to_string()), 0.0)],
        Ok(Err(error)) => vec![(Err(format!("compile: {}", class(&error))), 0.0)],
        Ok(Ok((program, inputs))) => over_domains(&program, &inputs).into(),
    };
    let mut fine = true;
    for (result, seconds) in results {
        if seconds > tally.slowest.0 {
            tally.slowest = (seconds, place.to_string());
        }
        if seconds > patience {
            tally.bad += 1;
            say(&format!("{place}: {seconds:.1} s"));
        }
        if let Err(reason) = result {
            fine = false;
            tally.bad += usize::from(reason.contains("PANIC") || reason.contains("unsupported"));
            say(&format!("{place}: {reason}"));
            *tally.reasons.entry(reason).or_default() += 1;
        }
    }
    tally.fine += usize::from(fine);
}

fn file(tally: &mut Tally, path: &Path, patience: f64) {
    let Ok(source) = std::fs::read_to_string(path) else {
        return;
    };
    let validated = catch_unwind(|| {
        let module = naga::front::wgsl::parse_str(&source).ok()?;
        let mut validator = naga::valid::Validator::new(
            naga::valid::ValidationFlags::all(),
            naga::valid::Capabilities::all(),
        );
        let info = validator.validate(&module).ok()?;
        Some((module, info))
    });
    let Ok(Some((module, info))) = validated else {
        tally.invalid += 1;
        return;
    };
    for point in &module.entry_points {
        let place = format!("{}:{}", path.display(), point.name);
        entry(tally, &module, &info, &point.name, &place, patience);
    }
}

fn say(line: &str) {
    // A reader that has gone away is no reason to stop.
    let _ = writeln!(std::io::stdout(), "{line}");
}

fn main() -> ExitCode {
    let mut arguments = std::env::args().skip(1);
    let Some(dir) = arguments.next() else {
        say("usage: breadth DIR [SECONDS]");
        return ExitCode::from(2);
    };
    let patience = arguments.next().and_then(|s| s.parse().ok()).unwrap_or(60.0);
    let mut tally = Tally::default();
    for path in files(Path::new(&dir)) {
        file(&mut tally, &path, patience);
    }
    say(&format!(
        "{} of {} entry points evaluate in every domain; {} files are not valid WGSL; slowest {:.1} s ({})",
        tally.fine, tally.entries, tally.invalid, tally.slowest.0, tally.slowest.1
    ));
    for (reason, count) in &tally.reasons {
        say(&format!("{count:6}  {reason}"));
    }
    ExitCode::from(u8::from(tally.bad > 0))
}
