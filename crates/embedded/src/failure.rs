//! What the evaluator says, as the errors that jobs have on every machine.

use bossage_bounds::Error as Refusal;
use bossage_runner::Error;

use crate::select::NAME;

/// An evaluator's error as the job's.
pub(crate) fn of_job(job: &str, refusal: Refusal) -> Error {
    match refusal {
        Refusal::Unsupported { what, .. } => Error::unsupported(job, NAME, what),
        Refusal::Budget { .. } | Refusal::Depth { .. } | Refusal::Memory { .. } => {
            Error::gave_up(job, NAME, refusal.to_string())
        }
        other => Error::invalid(job, other.to_string()),
    }
}
