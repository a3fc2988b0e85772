//! Route `spirv`: the emitted file of each entry point, byte for byte what an engine loads, passed through to Vulkan.

use bossage_translate::{Contents, EmitOptions, Shader, Source, Target, emit, manifest};

use super::{Fault, Prepared, Text};

pub(super) fn prepare(shader: Shader, fault: Option<&Fault>) -> Result<Prepared, String> {
    let options = EmitOptions::default();
    let mut emitted = emit(&shader, Target::Spirv, &options).map_err(|diagnostic| diagnostic.to_string())?;
    if let Some(fault) = fault {
        fault.plant(emitted.files.iter_mut().map(|file| &mut file.contents))?;
    }
    let code = emitted.files.iter().map(|file| match &file.contents {
        Contents::Binary(bytes) => Ok((file.entry.clone(), Text::Spirv(bytes.clone()))),
        Contents::Text(_) => Err(format!("{} is text where SPIR-V is expected", file.file_name)),
    });
    let code = code.collect::<Result<_, _>>()?;
    let manifest = manifest(&shader, &options, &[emitted]);
    Ok(Prepared::new(shader, manifest, code))
}

/// A file that others wrote: its bindings are at its own places.
pub(super) fn as_it_is(name: &str, bytes: &[u8]) -> Result<Prepared, String> {
    let shader =
        Shader::parse(name, &Source::Spirv(bytes.to_vec())).map_err(|diagnostic| diagnostic.to_string())?;
    let manifest = manifest(&shader, &EmitOptions::default(), &[]);
    let entries = shader.entry_points();
    let code = entries
        .map(|(entry, _)| (entry.to_owned(), Text::Spirv(bytes.to_vec())))
        .collect();
    Ok(Prepared::new(shader, manifest, code))
}
