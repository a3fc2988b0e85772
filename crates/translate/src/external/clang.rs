//! `clang`, which takes MSL as C++ with a `metal_stdlib` of ours.
//!
//! As a check it knows types, overloads and names, not address spaces: those vanish, as C++ has none. As a compiler it makes native
//! code of the same text ([`super::native`]).

use std::path::Path;

use crate::emit::EmittedFile;
use crate::external::{Input, Tool, metal};
use crate::options::EmitOptions;
use crate::target::Target;

pub(super) const TOOL: Tool = Tool {
    name: "clang",
    how_to_get: "on Debian: apt install clang, or in this repository: ./x setup --full",
    version_arguments: &["--version"],
    version,
    target: Target::Msl,
    input: Input::Path,
    arguments,
    ready,
};

/// How MSL is read: literals are of single precision, vectors convert only where they say so, integers wrap, products and sums are not
/// fused, and a loop may be endless.
pub(super) const LANGUAGE: [&str; 12] = [
    "-std=c++20",
    "-O1",
    "-ffp-contract=off",
    "-Xclang",
    "-cl-single-precision-constant",
    "-fno-lax-vector-conversions",
    "-fdeclspec",
    "-fwrapv",
    "-fno-finite-loops",
    "-fno-strict-aliasing",
    "-fPIC",
    "-Wno-everything",
];

/// `Debian clang version 14.0.6`
fn version(said: &str) -> Option<String> {
    let line = said.lines().find(|line| line.contains("clang version "))?;
    let (_, version) = line.split_once("clang version ")?;
    Some(version.trim().to_owned())
}

fn arguments(_: &EmittedFile, _: &EmitOptions) -> Result<Vec<String>, String> {
    let headers = metal::headers()?.to_string_lossy().into_owned();
    let mut all: Vec<String> = LANGUAGE.map(str::to_owned).to_vec();
    all.extend(["-I".to_owned(), headers]);
    all.extend(["-fsyntax-only", "-x", "c++"].map(str::to_owned));
    Ok(all)
}

/// The library as clang keeps it when it has read it, which saves most of the time of a check.
fn ready(program: &Path, version: &str) -> Vec<String> {
    let read = metal::precompiled(program, version);
    read.map_or_else(
        |_| Vec::new(),
        |path| vec!["-include-pch".to_owned(), path.to_string_lossy().into_owned()],
    )
}

#[cfg(test)]
mod tests {
    use super::version;

    #[test]
    fn the_version_is_read() {
        let said = "Debian clang version 14.0.6\nTarget: x86_64-pc-linux-gnu\n";
        assert_eq!(version(said).as_deref(), Some("14.0.6"));
        assert_eq!(version("clang: command not found"), None);
    }
}
