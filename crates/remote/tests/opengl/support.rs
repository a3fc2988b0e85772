//! The machine under test, under the name that the tests of every machine ask for.

use std::io::Write;
use std::path::PathBuf;
use std::sync::OnceLock;
use std::sync::atomic::{AtomicUsize, Ordering};

use bossage_remote::{Kind, Limits, Remote};
use bossage_runner::{AdapterInfo, AdapterSelector};
use bossage_translate::external::find_program;

pub(crate) use crate::compiled::{Compiled, bits, compile};

static SKIPPED: AtomicUsize = AtomicUsize::new(0);

/// The machine that all tests share, or `None` after saying that the test is skipped.
///
/// # Panics
/// Where there is none though `BOSSAGE_REQUIRE` lists `opengl`.
pub(crate) fn device(test: &str) -> Option<&'static Remote> {
    static MACHINE: OnceLock<Result<Remote, String>> = OnceLock::new();
    match MACHINE.get_or_init(|| open(Limits::default())) {
        Ok(machine) => Some(machine),
        Err(why) => {
            skip(test, why);
            None
        }
    }
}

fn open(limits: Limits) -> Result<Remote, String> {
    let program: PathBuf = find_program("python3").ok_or("python3 was not found")?;
    Remote::open(Kind::OpenGl, &program, &adapter()?, limits).map_err(|error| error.to_string())
}

fn adapter() -> Result<AdapterInfo, String> {
    let all = bossage_runner::adapters();
    let lavapipe = AdapterSelector::named("lavapipe");
    let found = all.into_iter().find(|info| lavapipe.matches(info));
    found.ok_or_else(|| "llvmpipe is not here".to_owned())
}

/// Says that a test is skipped, past the capture of the test harness, which would hide it since the test passes.
fn skip(test: &str, why: &str) {
    let list = std::env::var("BOSSAGE_REQUIRE").unwrap_or_default();
    let required = list.split(',').any(|name| name.trim() == "opengl");
    assert!(!required, "opengl is required, but: {why}");
    let count = SKIPPED.fetch_add(1, Ordering::Relaxed) + 1;
    writeln!(std::io::stderr(), "SKIP {count}: {test}: {why}").expect("standard error can be written");
}
