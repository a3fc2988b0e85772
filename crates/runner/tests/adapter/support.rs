//! The adapter under test.

use std::io::Write;
use std::sync::OnceLock;
use std::sync::atomic::{AtomicUsize, Ordering};

use bossage_runner::{AdapterSelector, Device, Error};

pub(crate) use crate::compiled::{Compiled, bits, compile, compile_with};

static SKIPPED: AtomicUsize = AtomicUsize::new(0);

/// The device that all tests share, or `None` after saying that the test is skipped.
///
/// # Panics
/// Where there is none though `BOSSAGE_REQUIRE` lists `lavapipe`.
pub(crate) fn device(test: &str) -> Option<&'static Device> {
    static DEVICE: OnceLock<Result<Device, Error>> = OnceLock::new();
    match DEVICE.get_or_init(open) {
        Ok(device) => Some(device),
        Err(error) => {
            assert!(!required("lavapipe"), "lavapipe is required, but: {error}");
            skip(test, error);
            None
        }
    }
}

fn open() -> Result<Device, Error> {
    let lavapipe = Device::open(&AdapterSelector::named("lavapipe"));
    if lavapipe.is_ok() || required("lavapipe") {
        lavapipe
    } else {
        Device::open(&AdapterSelector::Any)
    }
}

fn required(tool: &str) -> bool {
    std::env::var("BOSSAGE_REQUIRE").is_ok_and(|list| list.split(',').any(|name| name.trim() == tool))
}

/// Says that a test is skipped, past the capture of the test harness, which would hide it since the test passes.
fn skip(test: &str, why: &Error) {
    let count = SKIPPED.fetch_add(1, Ordering::Relaxed) + 1;
    writeln!(std::io::stderr(), "SKIP {count}: {test}: {why}").expect("standard error can be written");
}
