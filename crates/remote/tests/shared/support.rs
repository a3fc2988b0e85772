//! The machine under test, under the name that the tests of every machine ask for.

use std::io::Write;
use std::sync::OnceLock;
use std::sync::atomic::{AtomicUsize, Ordering};

use bossage_remote::{Limits, Remote};
use bossage_runner::{AdapterInfo, AdapterSelector, DeviceKind, Machine};

pub(crate) use crate::compiled::{Compiled, bits, compile};
use crate::machine::{TESTED, program};

static SKIPPED: AtomicUsize = AtomicUsize::new(0);

/// The machine that all tests share, or `None` after saying that the test is skipped.
///
/// # Panics
/// Where there is none though `BOSSAGE_REQUIRE` lists it.
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

/// A machine of the test's own.
pub(crate) fn open(limits: Limits) -> Result<Remote, String> {
    Remote::open(TESTED.kind, &program()?, &adapter()?, limits).map_err(|error| error.to_string())
}

fn adapter() -> Result<AdapterInfo, String> {
    let all = bossage_runner::adapters();
    let wanted = AdapterSelector::named(TESTED.adapter);
    let found = all.into_iter().find(|info| wanted.matches(info));
    found.ok_or_else(|| TESTED.without_adapter.to_owned())
}

/// Says that a test is skipped, past the capture of the test harness, which would hide it since the test passes.
pub(crate) fn skip(test: &str, why: &str) {
    let name = TESTED.name;
    let list = std::env::var("BOSSAGE_REQUIRE").unwrap_or_default();
    let required = list.split(',').any(|listed| listed.trim() == name);
    assert!(!required, "{name} is required, but: {why}");
    let count = SKIPPED.fetch_add(1, Ordering::Relaxed) + 1;
    writeln!(std::io::stderr(), "SKIP {count}: {test}: {why}").expect("standard error can be written");
}

/// An adapter that nobody has.
pub(crate) fn stand_in() -> AdapterInfo {
    AdapterInfo {
        name: "none".to_owned(),
        driver: String::new(),
        driver_info: String::new(),
        kind: DeviceKind::Cpu,
        backend: "vulkan".to_owned(),
        llvm: None,
        cpu: String::new(),
    }
}

#[test]
fn it_is_the_adapter_that_was_asked_for() {
    let Some(machine) = device("it_is_the_adapter_that_was_asked_for") else {
        return;
    };
    assert_eq!(machine.info(), &adapter().unwrap());
}
