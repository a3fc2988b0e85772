//! What the routes share whose machines are processes of their own.

use std::collections::BTreeMap;
use std::path::Path;
use std::sync::{Mutex, PoisonError};

use bossage_remote::{Kind, Limits, Remote};
use bossage_runner::{AdapterInfo, Error, Machine};
use bossage_translate::{Contents, EmitOptions, Shader, Target, emit, manifest};

use super::{Fault, Prepared, Text};

/// Every entry point as text of its own, exactly as emitted.
pub(super) fn prepare(
    shader: Shader,
    target: Target,
    fault: Option<&Fault>,
    text: fn(String) -> Text,
) -> Result<Prepared, String> {
    let options = EmitOptions::default();
    let mut emitted = emit(&shader, target, &options).map_err(|diagnostic| diagnostic.to_string())?;
    if let Some(fault) = fault {
        fault.plant(emitted.files.iter_mut().map(|file| &mut file.contents))?;
    }
    let code = emitted.files.iter().map(|file| match &file.contents {
        Contents::Text(written) => Ok((file.entry.clone(), text(written.clone()))),
        Contents::Binary(_) => Err(format!("{} is binary where text is expected", file.file_name)),
    });
    let code = code.collect::<Result<_, _>>()?;
    let manifest = manifest(&shader, &options, &[emitted]);
    Ok(Prepared::new(shader, manifest, code))
}

/// An adapter through a program; `missing` says how to get that.
pub(super) fn open(
    kind: Kind,
    info: &AdapterInfo,
    program: Option<&Path>,
    missing: Option<String>,
) -> Result<Box<dyn Machine>, Error> {
    let missing = missing.unwrap_or_default();
    let program = program.ok_or_else(|| Error::unsupported(kind.name(), &info.name, missing))?;
    Ok(Box::new(Remote::open(kind, program, info, Limits::default())?))
}

/// Why an adapter is not taken; `None` where it is. Asked once in a process.
pub(super) fn refuses(
    kind: Kind,
    info: &AdapterInfo,
    open: fn(&AdapterInfo) -> Result<Box<dyn Machine>, Error>,
) -> Option<String> {
    static ASKED: Mutex<BTreeMap<(&str, String), Option<String>>> = Mutex::new(BTreeMap::new());
    let mut asked = ASKED.lock().unwrap_or_else(PoisonError::into_inner);
    let ask = || open(info).err().map(|error| error.to_string());
    asked
        .entry((kind.name(), info.name.clone()))
        .or_insert_with(ask)
        .clone()
}
