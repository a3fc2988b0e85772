//! What the tests of all machines have to know of the one that they test.

use bossage_remote::Kind;
use bossage_translate::Target;

/// A machine, and what it says.
pub(crate) struct Tested {
    pub(crate) kind: Kind,
    /// In `BOSSAGE_REQUIRE`.
    pub(crate) name: &'static str,
    /// The language that it takes.
    pub(crate) target: Target,
    /// Part of the adapter's name.
    pub(crate) adapter: &'static str,
    /// What is said where it is not there.
    pub(crate) without_adapter: &'static str,
    /// What is said to SPIR-V.
    pub(crate) takes: &'static str,
    /// A change that its compiler refuses.
    pub(crate) text: Refused,
    /// A change that moves a binding.
    pub(crate) binding: Refused,
    /// Memory in which it cannot start.
    pub(crate) too_few_bytes: u64,
}

/// A change of the doubling shader that is not valid.
pub(crate) struct Refused {
    pub(crate) from: &'static str,
    pub(crate) to: &'static str,
    /// Words of the message.
    pub(crate) said: &'static [&'static str],
}
