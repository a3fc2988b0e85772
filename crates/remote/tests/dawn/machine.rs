//! Dawn, by SwiftShader.

use std::path::PathBuf;

use bossage_remote::Kind;
use bossage_translate::Target;
use bossage_translate::external::{State, detect};

use crate::tested::{Refused, Tested};

pub(crate) const TESTED: Tested = Tested {
    kind: Kind::Dawn,
    name: "dawn",
    target: Target::Wgsl,
    adapter: "swiftshader",
    without_adapter: "SwiftShader is not here: ./x setup --full fetches it",
    takes: "Dawn takes WGSL",
    text: Refused {
        from: "2.0 *",
        to: "2u *",
        said: &["Tint refuses the WGSL: 5:", "u32"],
    },
    binding: Refused {
        from: "@binding(1)",
        to: "@binding(4)",
        said: &["binding"],
    },
    too_few_bytes: 64 << 20,
};

pub(crate) fn program() -> Result<PathBuf, String> {
    let found = detect().into_iter().find(|tool| tool.tool == "dawn");
    let found = found.ok_or_else(|| "no such tool is known".to_owned())?;
    match (found.state, found.path) {
        (State::Enabled, Some(path)) => Ok(path),
        _ => Err(found.reason.unwrap_or_default()),
    }
}
