//! `dawn`: Tint, the compiler of WGSL in Dawn, which is the WebGPU of Chromium.
//!
//! As a check it reads and validates the text, without an adapter. Its rules go beyond naga's: control flow must be uniform where
//! derivatives are taken, for one. The program is `tools/dawn.cjs` of this crate over the library that a package of others brings.

use crate::emit::EmittedFile;
use crate::external::{Input, Tool, as_it_is};
use crate::options::EmitOptions;
use crate::target::Target;

pub(super) const TOOL: Tool = Tool {
    name: "dawn",
    how_to_get: "have node 20 or later on the PATH and, in this repository: ./x setup --full",
    version_arguments: &["--version"],
    version,
    target: Target::Wgsl,
    input: Input::Pipe,
    arguments,
    ready: as_it_is,
};

/// `Dawn: webgpu 0.6.2`
fn version(said: &str) -> Option<String> {
    let version = said.lines().find_map(|line| line.strip_prefix("Dawn: "))?;
    Some(version.trim().to_owned())
}

fn arguments(_: &EmittedFile, _: &EmitOptions) -> Result<Vec<String>, String> {
    Ok(vec!["check".to_owned()])
}

#[cfg(test)]
mod tests {
    use super::version;

    #[test]
    fn the_version_is_read() {
        assert_eq!(version("Dawn: webgpu 0.6.2\n").as_deref(), Some("webgpu 0.6.2"));
        assert_eq!(version("env: 'node': No such file or directory"), None);
    }
}
