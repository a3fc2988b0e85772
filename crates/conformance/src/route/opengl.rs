//! Route `opengl`: the emitted GLSL of each entry point, exactly as emitted, compiled and run by OpenGL 4.5 core, without a display, in a
//! process of its own.
//!
//! Blocks and textures are bound by the names that the manifest states, which must stand where it says. Not seen: the older versions
//! and OpenGL ES, which the text may also be emitted for.

use bossage_remote::Kind;
use bossage_runner::{AdapterInfo, Error, Machine};
use bossage_translate::external::find_program;
use bossage_translate::{Shader, Target};

use super::{Fault, Prepared, Text, remote};

/// What has to be there, by the name in messages and in lists of what is required.
pub(super) const TOOL: &str = "opengl";

/// It calls OpenGL.
const PROGRAM: &str = "python3";

const HOW_TO_GET: &str = "on Debian: apt install python3 libegl1 libgl1-mesa-dri";

pub(super) fn prepare(shader: Shader, fault: Option<&Fault>) -> Result<Prepared, String> {
    remote::prepare(shader, Target::Glsl, fault, Text::Glsl)
}

/// Why it cannot run, whatever the adapter.
pub(super) fn missing() -> Option<String> {
    match find_program(PROGRAM) {
        Some(_) => None,
        None => Some(format!("`{PROGRAM}` was not found; {HOW_TO_GET}")),
    }
}

/// An adapter through OpenGL.
pub(crate) fn open(info: &AdapterInfo) -> Result<Box<dyn Machine>, Error> {
    remote::open(Kind::OpenGl, info, find_program(PROGRAM).as_deref(), missing())
}

/// Why OpenGL does not run on an adapter; `None` where it does.
pub(super) fn refuses(info: &AdapterInfo) -> Option<String> {
    remote::refuses(Kind::OpenGl, info, open)
}
