//! What the evaluator says, as the errors that jobs have on every machine.

use bossage_bounds::Error as Refusal;
use bossage_runner::Error;
use bossage_translate::manifest::Entry;

use crate::select::NAME;

/// An evaluator's error as the job's.
pub(crate) fn of_job(job: &str, refusal: Refusal) -> Error {
    let job = job.to_owned();
    match refusal {
        Refusal::Unsupported { what, .. } => unsupported(&job, what),
        Refusal::Budget { .. } | Refusal::Depth { .. } | Refusal::Memory { .. } => Error::GaveUp {
            job,
            machine: NAME.to_owned(),
            message: refusal.to_string(),
        },
        other => Error::Validation {
            job,
            message: other.to_string(),
        },
    }
}

/// Something that this machine lacks.
pub(crate) fn unsupported(job: &str, what: impl Into<String>) -> Error {
    Error::Unsupported {
        job: job.to_owned(),
        adapter: NAME.to_owned(),
        what: what.into(),
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
