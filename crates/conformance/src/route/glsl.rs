//! Route `glsl`: the emitted GLSL of each entry point → glslang → SPIR-V → Vulkan.
//!
//! A texture that GLSL joins with its sampler is taken apart again in what glslang made, since the runner binds the two by themselves.
//! Not seen: what an OpenGL driver makes of the text, and OpenGL's own binding of names.

use bossage_translate::{EmitOptions, Shader, Target};

use super::{Fault, Prepared, compiled};

pub(super) fn prepare(shader: Shader, fault: Option<&Fault>) -> Result<Prepared, String> {
    compiled::prepare(shader, Target::Glsl, &EmitOptions::default(), fault)
}
