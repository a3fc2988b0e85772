//! Route `opengl`: the emitted GLSL of each entry point, exactly as emitted, compiled and run by OpenGL 4.5 core, without a display, in a
//! process of its own.
//!
//! Blocks and textures are bound by the names that the manifest states, which must stand where it says. Not seen: the older versions
//! and OpenGL ES, which the text may also be emitted for.

use std::sync::OnceLock;

use bossage_remote::{Kind, lacking};
use bossage_runner::{AdapterInfo, Error, Machine};
use bossage_translate::external::find_program;
use bossage_translate::{Shader, Target};

use super::{Fault, Prepared, Text, remote};

/// What has to be there, by the name in messages and in lists of what is required.
pub(super) const TOOL: &str = "opengl";

/// It calls OpenGL.
const PROGRAM: &str = "python3";

const HOW_TO_GET: &str =
    "on Debian: apt install python3 libegl1 libgl1-mesa-dri, or in this repository: ./x setup --full";

pub(super) fn prepare(shader: Shader, fault: Option<&Fault>) -> Result<Prepared, String> {
    remote::prepare(shader, Target::Glsl, fault, Text::Glsl)
}

/// Why it cannot run, whatever the adapter: there is no Python, no EGL, or no context of OpenGL 4.5. Asked once in a process.
pub(super) fn missing() -> Option<String> {
    static ASKED: OnceLock<Option<String>> = OnceLock::new();
    let ask = || {
        let what = match find_program(PROGRAM) {
            None => format!("`{PROGRAM}` was not found"),
            Some(program) => lacking(Kind::OpenGl, &program)?,
        };
        Some(format!("{what}; {HOW_TO_GET}"))
    };
    ASKED.get_or_init(ask).clone()
}

/// An adapter through OpenGL.
pub(crate) fn open(info: &AdapterInfo) -> Result<Box<dyn Machine>, Error> {
    let missing = missing();
    let program = find_program(PROGRAM).filter(|_| missing.is_none());
    remote::open(Kind::OpenGl, info, program.as_deref(), missing)
}

/// Why OpenGL does not run on an adapter; `None` where it does.
pub(super) fn refuses(info: &AdapterInfo) -> Option<String> {
    remote::refuses(Kind::OpenGl, info, open)
}
