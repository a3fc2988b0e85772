//! The errors of this machine.

use bossage_runner::Error;
use bossage_translate::manifest::Entry;

use crate::machine::NAME;

/// Something that this machine lacks.
pub(crate) fn unsupported(job: &str, what: impl Into<String>) -> Error {
    Error::Unsupported {
        job: job.to_owned(),
        adapter: NAME.to_owned(),
        what: what.into(),
    }
}

/// The job ended otherwise than it should.
pub(crate) fn gave_up(job: &str, message: impl Into<String>) -> Error {
    Error::GaveUp {
        job: job.to_owned(),
        machine: NAME.to_owned(),
        message: message.into(),
    }
}

/// The text cannot be run.
pub(crate) fn invalid(job: &str, message: impl Into<String>) -> Error {
    Error::Validation {
        job: job.to_owned(),
        message: message.into(),
    }
}

/// An entry point that doesn't fit its job.
pub(crate) fn misfit(entry: &Entry, name: &str, problem: String) -> Error {
    Error::Interface {
        entry: entry.name.clone(),
        name: name.to_owned(),
        problem,
    }
}
