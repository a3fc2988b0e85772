//! Route `embedded`: the assembled text, evaluated by `bounds` in f32. No compiler of a driver, no driver: a perfect machine, on
//! every machine.

use bossage_shaders::AssembledShader;
use bossage_translate::Shader;

use super::{Fault, Prepared, wgsl};

/// The evaluator reads the text that route `wgsl` hands to wgpu.
pub(super) fn prepare(
    shader: Shader,
    assembled: &AssembledShader,
    fault: Option<&Fault>,
) -> Result<Prepared, String> {
    wgsl::prepare(shader, assembled, fault)
}
