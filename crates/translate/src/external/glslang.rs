//! `glslangValidator` of Khronos, the reference compiler of GLSL.
//!
//! As a check it parses one stage by the rules of the version that the text states; it is not asked for SPIR-V, so the rules are
//! those of OpenGL. As a compiler it makes SPIR-V for Vulkan of the same text.

use crate::emit::EmittedFile;
use crate::external::{Input, Tool, as_it_is};
use crate::options::EmitOptions;
use crate::target::Target;

pub(super) const TOOL: Tool = Tool {
    name: "glslangValidator",
    how_to_get: "on Debian: apt install glslang-tools",
    version_arguments: &["--version"],
    version,
    target: Target::Glsl,
    input: Input::Pipe,
    arguments,
    ready: as_it_is,
};

/// `Glslang Version: 11:12.0.0`
fn version(said: &str) -> Option<String> {
    said.lines()
        .find_map(|line| line.strip_prefix("Glslang Version: "))
        .map(|version| version.trim().to_owned())
}

fn arguments(file: &EmittedFile, _: &EmitOptions) -> Result<Vec<String>, String> {
    let stage = file.stage.glsl_extension();
    Ok(["--stdin", "-S", stage].map(str::to_owned).to_vec())
}

/// The arguments that make SPIR-V of a file that comes through a pipe; the path to write to follows.
pub(super) fn spirv_arguments(file: &EmittedFile) -> Vec<String> {
    let stage = file.stage.glsl_extension();
    let all = ["--stdin", "-S", stage, "-V", "--target-env", "vulkan1.1", "-o"];
    all.map(str::to_owned).to_vec()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_version_is_read() {
        let said = "Glslang Version: 11:12.0.0\nESSL Version: OpenGL ES GLSL 3.20\n";
        assert_eq!(version(said).as_deref(), Some("11:12.0.0"));
        assert_eq!(version(""), None);
    }
}
