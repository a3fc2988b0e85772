//! Route `spirv`: the emitted file of each entry point, byte for byte what an engine loads, passed through to Vulkan.

use bossage_translate::{Contents, EmitOptions, Shader, Target, emit, manifest};

use super::{Prepared, Text};

pub(super) fn prepare(shader: Shader) -> Result<Prepared, String> {
    let options = EmitOptions::default();
    let emitted = emit(&shader, Target::Spirv, &options).map_err(|diagnostic| diagnostic.to_string())?;
    let code = emitted.files.iter().map(|file| match &file.contents {
        Contents::Binary(bytes) => Ok((file.entry.clone(), Text::Spirv(bytes.clone()))),
        Contents::Text(_) => Err(format!("{} is text where SPIR-V is expected", file.file_name)),
    });
    let code = code.collect::<Result<_, _>>()?;
    let manifest = manifest(&shader, &options, &[emitted]);
    Ok(Prepared::new(shader, manifest, code))
}
