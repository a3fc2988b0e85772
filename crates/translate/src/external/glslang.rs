//! `glslangValidator` of Khronos, the reference compiler of GLSL.
//!
//! It parses and checks one stage by the rules of the version that the text states; it is not asked for SPIR-V, so the
//! rules are those of OpenGL.

use crate::external::Tool;
use crate::options::EmitOptions;
use crate::target::{Stage, Target};

pub(super) const TOOL: Tool = Tool {
    name: "glslangValidator",
    how_to_get: "on Debian: apt install glslang-tools",
    version_arguments: &["--version"],
    version,
    target: Target::Glsl,
    arguments,
};

/// `Glslang Version: 11:12.0.0`
fn version(said: &str) -> Option<String> {
    said.lines()
        .find_map(|line| line.strip_prefix("Glslang Version: "))
        .map(|version| version.trim().to_owned())
}

fn arguments(stage: Stage, _: &EmitOptions) -> Result<Vec<String>, String> {
    Ok(vec![
        "--stdin".to_owned(),
        "-S".to_owned(),
        stage.glsl_extension().to_owned(),
    ])
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
