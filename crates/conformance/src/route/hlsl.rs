//! Route `hlsl`: the emitted HLSL of each entry point → DXC → SPIR-V → Vulkan. The same text must also become DXIL that DXC's
//! validator accepts, which is what Direct3D 12 takes.
//!
//! Registers go to the sets and bindings that the manifest states for them, so a register that is stated wrongly leaves a resource
//! without a place, which DXC refuses. Not seen: what a Direct3D driver makes of the DXIL.

use bossage_translate::{EmitOptions, Shader, ShaderModel, Target};

use super::{Fault, Prepared, compiled};

pub(super) fn prepare(shader: Shader, fault: Option<&Fault>) -> Result<Prepared, String> {
    let options = EmitOptions {
        hlsl: ShaderModel::V6_0,
        ..EmitOptions::default()
    };
    compiled::prepare(shader, Target::Hlsl, &options, fault)
}
