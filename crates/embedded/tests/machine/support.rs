//! The machine under test, under the name that the tests of every machine ask for.

use std::sync::OnceLock;

use bossage_embedded::Embedded;

pub(crate) use crate::compiled::{Compiled, bits, compile};

/// The machine that all tests share: it is always there.
pub(crate) fn device(_test: &str) -> Option<&'static Embedded> {
    static MACHINE: OnceLock<Embedded> = OnceLock::new();
    Some(MACHINE.get_or_init(Embedded::new))
}
