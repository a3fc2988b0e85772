//! OpenGL, by Mesa's renderer on the CPU.

use std::path::PathBuf;

use bossage_remote::Kind;
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
    find_program("python3").ok_or_else(|| "python3 was not found".to_owned())
}
