//! What the routes of other languages share: the emitted text of each entry point goes exactly as it is to a compiler of others, and
//! the SPIR-V that this makes of it to Vulkan.

use bossage_translate::external::{self, CheckState};
use bossage_translate::{EmitOptions, Shader, Target, emit, manifest};

use super::{Fault, Prepared, Text, tools};

/// Emits and compiles every entry point. First the language's own checkers must accept each file.
pub(super) fn prepare(
    shader: Shader,
    target: Target,
    options: &EmitOptions,
    fault: Option<&Fault>,
) -> Result<Prepared, String> {
    let mut emitted = emit(&shader, target, options).map_err(|diagnostic| diagnostic.to_string())?;
    if let Some(fault) = fault {
        fault.plant(emitted.files.iter_mut().map(|file| &mut file.contents))?;
    }
    let checks = external::check(&emitted, options, tools::all(), tools::cache());
    if let Some(refused) = checks.iter().find(|check| check.state == CheckState::Fail) {
        return Err(format!(
            "`{}` refuses {}: {}",
            refused.tool, refused.file, refused.message
        ));
    }
    let mut manifest = manifest(&shader, options, std::slice::from_ref(&emitted));
    let mut code = Vec::new();
    for entry in &mut manifest.entries {
        let made = external::to_spirv(&emitted, entry, options, tools::all(), tools::cache())?;
        entry
            .entry_points
            .insert(Target::Spirv.name().to_owned(), made.entry_point);
        code.push((entry.name.clone(), Text::Spirv(made.bytes)));
    }
    Ok(Prepared::new(shader, manifest, code))
}
