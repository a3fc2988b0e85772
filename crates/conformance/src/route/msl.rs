//! Route `msl`: the emitted MSL of each entry point → clang, with a `metal_stdlib` of ours → native code, in processes of its own.
//!
//! Not seen: address spaces, which C++ does not have, and what Metal's own compiler makes of the text.

use bossage_translate::{Contents, EmitOptions, Shader, Target, emit, manifest};

use super::{Fault, Prepared, Text};

pub(super) fn prepare(shader: Shader, fault: Option<&Fault>) -> Result<Prepared, String> {
    let options = EmitOptions::default();
    let mut emitted = emit(&shader, Target::Msl, &options).map_err(|diagnostic| diagnostic.to_string())?;
    if let Some(fault) = fault {
        fault.plant(emitted.files.iter_mut().map(|file| &mut file.contents))?;
    }
    let code = emitted.files.iter().map(|file| match &file.contents {
        Contents::Text(text) => Ok((file.entry.clone(), Text::Msl(text.clone()))),
        Contents::Binary(_) => Err(format!("{} is no text", file.file_name)),
    });
    let code = code.collect::<Result<_, _>>()?;
    let manifest = manifest(&shader, &options, &[emitted]);
    Ok(Prepared::new(shader, manifest, code))
}
