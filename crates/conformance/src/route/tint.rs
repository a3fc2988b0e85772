//! Route `tint`: the emitted WGSL of each entry point, exactly as emitted, compiled by Tint and run by Dawn, in a process of its own.
//!
//! Route `wgsl` reads the assembled text by naga, which also writes what is emitted; here another compiler reads what users get. Not
//! seen: drivers that Dawn does not take, lavapipe before Mesa 25 among them.

use bossage_remote::Kind;
use bossage_runner::{AdapterInfo, Error, Machine};
use bossage_translate::{Shader, Target};

use super::{Fault, Prepared, Text, remote, tools};

/// The compiler's program.
pub(super) const TOOL: &str = "dawn";

pub(super) fn prepare(shader: Shader, fault: Option<&Fault>) -> Result<Prepared, String> {
    remote::prepare(shader, Target::Wgsl, fault, Text::Wgsl)
}

/// An adapter through Dawn.
pub(crate) fn open(info: &AdapterInfo) -> Result<Box<dyn Machine>, Error> {
    remote::open(Kind::Dawn, info, tools::path(TOOL), tools::missing(TOOL))
}

/// Why Dawn does not take an adapter; `None` where it does.
pub(super) fn refuses(info: &AdapterInfo) -> Option<String> {
    remote::refuses(Kind::Dawn, info, open)
}
