//! Modules → emitted files and manifest entries, in parallel and in order.

use bossage_translate::{Diagnostic, EmitOptions, Emitted, Manifest, Shader, Target, emit, manifest};
use rayon::prelude::*;

use crate::inputs::Module;

/// One module in all languages that it can be expressed in.
#[derive(Debug)]
pub(crate) struct Translation {
    pub(crate) emitted: Vec<Emitted>,
    pub(crate) manifest: Manifest,
    /// Targets that cannot express the shader, with the place.
    pub(crate) failures: Vec<(Target, Diagnostic)>,
}

/// Translates one module, given parsed.
pub(crate) fn translate(
    module: &Module,
    shader: &Shader,
    targets: &[Target],
    options: &EmitOptions,
) -> Translation {
    let (mut emitted, mut failures) = (Vec::new(), Vec::new());
    for target in targets {
        match emit(shader, *target, options) {
            Ok(files) => emitted.push(files),
            Err(diagnostic) => {
                failures.push((*target, labelled(module, *target, options).unwrap_or(diagnostic)))
            }
        }
    }
    Translation {
        manifest: manifest(shader, options, &emitted),
        emitted,
        failures,
    }
}

/// The refusal again, naming the file that the user knows.
fn labelled(module: &Module, target: Target, options: &EmitOptions) -> Option<Diagnostic> {
    emit(&module.parse_labelled().ok()?, target, options).err()
}

/// Translates all modules on all cores; results are in the order of the modules.
pub(crate) fn translate_all(
    modules: &[Module],
    shaders: &[Shader],
    targets: &[Target],
    options: &EmitOptions,
) -> Vec<Translation> {
    let pairs: Vec<_> = modules.iter().zip(shaders).collect();
    pairs
        .into_par_iter()
        .map(|(module, shader)| translate(module, shader, targets, options))
        .collect()
}
