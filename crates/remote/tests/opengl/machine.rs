//! OpenGL, by Mesa's renderer on the CPU.

use std::path::PathBuf;

use bossage_remote::{Kind, lacking};
use bossage_translate::Target;
use bossage_translate::external::find_program;

use crate::tested::{Refused, Tested};

pub(crate) const TESTED: Tested = Tested {
    kind: Kind::OpenGl,
    name: "opengl",
    target: Target::Glsl,
    adapter: "lavapipe",
    without_adapter: "llvmpipe is not here",
    takes: "OpenGL takes GLSL",
    text: Refused {
        from: "2.0 *",
        to: "nothing *",
        said: &["refuses the GLSL: 0:", "nothing"],
    },
    binding: Refused {
        from: "binding = 1",
        to: "binding = 5",
        said: &["is bound to 5, the manifest states 1"],
    },
    too_few_bytes: 8 << 20,
};

pub(crate) fn program() -> Result<PathBuf, String> {
    const HOW_TO_GET: &str = "on Debian: apt install python3 libegl1 libgl1-mesa-dri";
    let program = find_program("python3").ok_or_else(|| format!("python3 was not found; {HOW_TO_GET}"))?;
    match lacking(Kind::OpenGl, &program) {
        None => Ok(program),
        Some(what) => Err(format!("{what}; {HOW_TO_GET}")),
    }
}
