//! `bossage conform --shader`: a user's shader on all routes, judged without a reference.
//!
//! The shader is read, validated and given its inputs here; it is run by child processes of this program, which get everything from
//! their standard input.

use std::ffi::OsString;
use std::io::{BufReader, stdin, stdout};
use std::path::{Path, PathBuf};
use std::time::Duration;

use bossage_bounds::ranges::Declared;
use bossage_conformance::heat::Wanted;
use bossage_conformance::user::{Children, Corpus, Options, run as run_shader, serve as serve_request};
use bossage_conformance::{Report, Selection};
use bossage_translate::{Shader, Source};

use super::conform::Watch;
use crate::Verdict;
use crate::args::Global;
use crate::args::conform::{Conform, UserShader};
use crate::console::Console;
use crate::error::{Error, Result, read as read_file};
use crate::inputs::{self, Inputs};
use crate::numeric;

/// The most workgroups along an axis: what every adapter takes.
const MAX_WORKGROUPS: u32 = 65_535;

/// Runs a shader.
pub(crate) fn report(
    file: &Path,
    args: &Conform,
    selection: &Selection,
    global: &Global,
    console: Console,
) -> Result<Report> {
    let declared = numeric::sidecar(file, args.user.ranges.as_deref())?;
    let (shader, original) = read(file, &args.user, declared.as_ref(), global)?;
    let options = Options {
        original,
        ..options(file, args)?
    };
    let program = std::env::current_exe()
        .map_err(|error| Error::Environment(format!("this program's own file cannot be found: {error}")))?;
    let children = Children {
        program,
        arguments: ["conform", "--serve"].map(OsString::from).to_vec(),
        time_limit: Duration::from_secs_f64(args.user.time_limit),
    };
    let report = run_shader(
        &shader,
        declared.as_ref(),
        &options,
        selection,
        &children,
        &mut Watch::new(console),
    );
    Ok(report?)
}

/// What of the shader is run.
pub(super) fn options(file: &Path, args: &Conform) -> Result<Options> {
    let wants_a_page = args.html.is_some() || args.json.is_some();
    Ok(Options {
        entry: args.user.entry.clone(),
        filter: args.filter.clone(),
        seed: args.user.seed,
        inputs: args.user.inputs as usize,
        workgroups: args.user.workgroups.as_deref().map(workgroups).transpose()?,
        operations: args.user.operations,
        attribute: match &args.attribute {
            Some(name) => Wanted::Named(name.clone()),
            None if wants_a_page => Wanted::Widest,
            None => Wanted::Nothing,
        },
        original: None,
        corpus: if args.hunt.hunt { None } else { corpus(file, args)? },
        arguments: arguments(file, args),
    })
}

/// The shader, with the values that its sidecar has for overrides; and its bytes, if it is SPIR-V.
pub(super) fn read(
    file: &Path,
    user: &UserShader,
    declared: Option<&Declared>,
    global: &Global,
) -> Result<(Shader, Option<Vec<u8>>)> {
    if file.extension().is_some_and(|extension| extension == "toml") {
        return Err(Error::Call(format!(
            "{} is a scene; --shader takes a shader, --scene a scene",
            file.display()
        )));
    }
    let (library, _) = inputs::library(global)?;
    let mut inputs = Inputs::default();
    inputs.add(file, user.stage.map(crate::options::stage), &library)?;
    let module = inputs.modules.first();
    let module = module.ok_or_else(|| Error::Call(format!("{} holds no shader", file.display())))?;
    let overrides = declared.map(|declared| declared.overrides().clone());
    let shader = module.parse_with(&overrides.unwrap_or_default())?;
    let original = match &module.source {
        Source::Spirv(bytes) => Some(bytes.clone()),
        Source::Wgsl(_) | Source::Glsl { .. } => None,
    };
    Ok((shader, original))
}

/// Where the shader's hard inputs are kept: beside it, or in the folder that the call names.
pub(super) fn corpus_path(file: &Path, args: &Conform) -> PathBuf {
    let beside = file.with_extension("corpus.toml");
    match (&args.hunt.corpus, beside.file_name()) {
        (Some(folder), Some(name)) => folder.join(name),
        _ => beside,
    }
}

/// The shader's hard inputs, where there are some.
pub(super) fn corpus(file: &Path, args: &Conform) -> Result<Option<Corpus>> {
    let path = corpus_path(file, args);
    if !path.is_file() {
        return Ok(None);
    }
    let name = path.display().to_string();
    let text = String::from_utf8(read_file(&path)?)
        .map_err(|_| Error::Call(format!("{name} is no text; a corpus is TOML in UTF-8")))?;
    Ok(Some(Corpus::parse(&name, &text)?))
}

/// One without any.
pub(super) fn no_corpus(file: &Path) -> Corpus {
    let name = file.file_stem().unwrap_or_default().to_string_lossy();
    Corpus::new("", &name)
}

/// What runs the same again.
fn arguments(file: &Path, args: &Conform) -> Vec<String> {
    let user = &args.user;
    let mut list = vec!["--shader".to_owned(), file.display().to_string()];
    let mut add = |flag: &str, value: Option<String>| {
        list.extend(value.into_iter().flat_map(|value| [flag.to_owned(), value]));
    };
    add(
        "--ranges",
        user.ranges.as_ref().map(|path| path.display().to_string()),
    );
    add(
        "--stage",
        user.stage.map(|stage| crate::options::stage(stage).to_string()),
    );
    add("--inputs", Some(user.inputs.to_string()));
    add("--seed", Some(user.seed.to_string()));
    add("--operations", Some(user.operations.to_string()));
    add("--workgroups", user.workgroups.clone());
    add(
        "--corpus",
        args.hunt.corpus.as_ref().map(|path| path.display().to_string()),
    );
    list
}

fn workgroups(text: &str) -> Result<[u32; 3]> {
    let numbers: Option<Vec<u32>> = text.split(',').map(|word| word.trim().parse().ok()).collect();
    let numbers = numbers.filter(|list| list.iter().all(|n| (1..=MAX_WORKGROUPS).contains(n)));
    match numbers.as_deref() {
        Some([x]) => Ok([*x, 1, 1]),
        Some([x, y]) => Ok([*x, *y, 1]),
        Some([x, y, z]) => Ok([*x, *y, *z]),
        Some(_) | None => Err(Error::Call(format!(
            "--workgroups {text}: write one to three numbers from 1 to {MAX_WORKGROUPS}, for example 4,2,1"
        ))),
    }
}

/// The child's side.
pub(crate) fn serve() -> Result<Verdict> {
    serve_request(&mut BufReader::new(stdin().lock()), &mut stdout().lock())
        .map_err(|error| Error::Call(format!("--serve: {error}")))?;
    Ok(Verdict::Fine)
}

#[cfg(test)]
mod tests {
    use super::workgroups;

    #[test]
    fn one_to_three_numbers_are_workgroups() {
        assert_eq!(workgroups("4").unwrap(), [4, 1, 1]);
        assert_eq!(workgroups("4, 2,1").unwrap(), [4, 2, 1]);
        for wrong in ["", "0", "1,0", "1,2,3,4", "-1", "70000", "a"] {
            assert_eq!(workgroups(wrong).unwrap_err().exit_code(), 2, "{wrong}");
        }
    }
}
