//! What drivers are known to get wrong, each with a witness. An entry whose witness no longer shows fails its case.

use bossage_runner::{AdapterInfo, AdapterSelector};

/// A function of one driver that leaves the acceptance interval.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Deviation {
    /// Part of the adapter's name or driver, as on the command line.
    pub driver: &'static str,
    /// The function's name.
    pub function: &'static str,
    /// Arguments at which it shows.
    pub witness: [f32; 2],
    /// What is wrong.
    pub reason: &'static str,
}

/// All that are known.
pub const ALL: &[Deviation] = &[Deviation {
    driver: "SwiftShader",
    function: "atan2",
    witness: [-0.0, 6.601_958_3],
    reason: "atan2(-0, x) is π for x > 0",
}];

/// What is known of a function on an adapter.
#[must_use]
pub fn of(function: &str, info: &AdapterInfo) -> Option<&'static Deviation> {
    ALL.iter()
        .find(|known| known.function == function && AdapterSelector::named(known.driver).matches(info))
}
