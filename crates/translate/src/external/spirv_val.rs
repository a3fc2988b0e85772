//! `spirv-val` of the Khronos SPIRV-Tools.
//!
//! It checks a module against the rules of SPIR-V and of the Vulkan version that takes this version of SPIR-V.

use crate::emit::EmittedFile;
use crate::external::{Input, Tool, as_it_is};
use crate::options::EmitOptions;
use crate::target::Target;

pub(super) const TOOL: Tool = Tool {
    name: "spirv-val",
    how_to_get: "on Debian: apt install spirv-tools",
    version_arguments: &["--version"],
    version,
    target: Target::Spirv,
    input: Input::Pipe,
    arguments,
    ready: as_it_is,
};

/// `SPIRV-Tools v2023.1 unknown hash, 2023-03-10T05:07:01`
fn version(said: &str) -> Option<String> {
    let line = said.lines().find(|line| line.starts_with("SPIRV-Tools"))?;
    line.split_whitespace().nth(1).map(str::to_owned)
}

fn arguments(_: &EmittedFile, options: &EmitOptions) -> Result<Vec<String>, String> {
    let environment = match options.spirv {
        (1, 0..=3) => "vulkan1.1",
        (1, 4) => "vulkan1.1spv1.4",
        (1, 5) => "vulkan1.2",
        (1, 6) => "vulkan1.3",
        (major, minor) => return Err(format!("no Vulkan version takes SPIR-V {major}.{minor}")),
    };
    Ok(vec![
        "--target-env".to_owned(),
        environment.to_owned(),
        "-".to_owned(),
    ])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_version_is_read() {
        let said = "SPIRV-Tools v2023.1 unknown hash, 2023\nTargets:\n  SPIR-V 1.0\n";
        assert_eq!(version(said).as_deref(), Some("v2023.1"));
        assert_eq!(version("command not found"), None);
    }
}
