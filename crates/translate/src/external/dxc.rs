//! `dxc`, Microsoft's DirectX Shader Compiler.
//!
//! As a check it makes DXIL, and its validator must accept that. It knows shader model 6.0 and later: text that was emitted for an
//! older one is compiled as 6.0, which takes it as it is. As a compiler it makes SPIR-V for Vulkan of the same text, with each
//! register of the manifest at the set and binding that the source states.
//!
//! A `dxc` on the `PATH` is taken before the one of `./x setup --full`, which is `tools/dxc.cpp` of this crate over the library that
//! a package of others brings.

use crate::emit::EmittedFile;
use crate::external::{Input, Tool, as_it_is, push};
use crate::manifest::Entry;
use crate::options::EmitOptions;
use crate::target::{ShaderModel, Target};

pub(super) const TOOL: Tool = Tool {
    name: "dxc",
    how_to_get: "in this repository: ./x setup --full",
    version_arguments: &["--version"],
    version,
    target: Target::Hlsl,
    input: Input::Path,
    arguments,
    ready: as_it_is,
};

/// `libdxcompiler.so: 1.7 (3435, d66bdf94)`
fn version(said: &str) -> Option<String> {
    let line = said.lines().find(|line| line.contains("dxcompiler"))?;
    let (_, version) = line.split_once(": ")?;
    Some(version.trim().to_owned())
}

fn arguments(file: &EmittedFile, options: &EmitOptions) -> Result<Vec<String>, String> {
    let model = options.hlsl.max(ShaderModel::V6_0);
    let mut all = vec!["-T".to_owned(), model.profile(file.stage)];
    all.extend(["-E".to_owned(), file.entry_point.clone()]);
    if model >= ShaderModel::V6_2 {
        all.push("-enable-16bit-types".to_owned());
    }
    Ok(all)
}

/// The arguments that make SPIR-V of a file, but for what is read and written.
pub(super) fn spirv_arguments(
    file: &EmittedFile,
    entry: &Entry,
    options: &EmitOptions,
) -> Result<Vec<String>, String> {
    if let Some(constants) = &entry.hlsl_special_constants {
        return Err(format!(
            "the HLSL reads draw or dispatch parameters from `{}`, which nothing fills here",
            constants.slot.name
        ));
    }
    let mut all = arguments(file, options)?;
    all.extend(["-spirv", "-fspv-target-env=vulkan1.1", "-fvk-use-dx-layout"].map(str::to_owned));
    for binding in &entry.bindings {
        let Some(slot) = &binding.hlsl else { continue };
        all.push("-fvk-bind-register".to_owned());
        all.push(slot.register.clone());
        all.extend([slot.space, binding.binding, binding.group].map(|number| number.to_string()));
    }
    if let Some(slot) = entry.immediates.as_ref().and_then(|pushed| pushed.hlsl.as_ref()) {
        let (group, binding) = push::PLACE;
        all.push("-fvk-bind-register".to_owned());
        all.push(slot.register.clone());
        all.extend([slot.space, binding, group].map(|number| number.to_string()));
    }
    Ok(all)
}

#[cfg(test)]
mod tests {
    use super::version;

    #[test]
    fn the_version_is_read() {
        let said = "libdxcompiler.so: 1.7 (3435, d66bdf94)\n";
        assert_eq!(version(said).as_deref(), Some("1.7 (3435, d66bdf94)"));
        let other = "libdxcompiler.so: 1.8(3-abc)(1.8.0.1) - 1.8.0.1\n";
        assert_eq!(version(other).as_deref(), Some("1.8(3-abc)(1.8.0.1) - 1.8.0.1"));
        assert_eq!(version("dxc: command not found"), None);
    }
}
