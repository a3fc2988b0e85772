//! A device to run on, or word that the test is skipped.

use std::io::Write;
use std::path::PathBuf;
use std::sync::atomic::{AtomicUsize, Ordering};

use bossage_mutants::folder::Sources;
use bossage_runner::{AdapterSelector, Device, Error};

static SKIPPED: AtomicUsize = AtomicUsize::new(0);

/// The device, or `None` after saying that the test is skipped.
pub(crate) fn device(test: &str) -> Option<Device> {
    match Device::open(&AdapterSelector::Any) {
        Ok(device) => Some(device),
        Err(error @ Error::NoAdapter) => {
            let required = std::env::var("BOSSAGE_REQUIRE").is_ok_and(|list| list.contains("lavapipe"));
            assert!(!required, "lavapipe is required, but: {error}");
            let count = SKIPPED.fetch_add(1, Ordering::Relaxed) + 1;
            writeln!(std::io::stderr(), "SKIP {count}: {test}: {error}")
                .expect("standard error can be written");
            None
        }
        Err(error) => panic!("{test}: {error}"),
    }
}

/// The library's sources.
pub(crate) fn sources() -> Sources {
    let folder = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../shaders");
    Sources::read(&folder).expect("the shaders are there")
}
