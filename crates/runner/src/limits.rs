//! The one check of limits, for every machine.

use crate::error::Error;

/// Fails when a value of a job is beyond a limit. `what` is its subject in the message: "the number of targets".
///
/// # Errors
/// [`Error::TooLarge`].
pub fn within(job: &str, what: &'static str, given: u64, limit: u64) -> Result<(), Error> {
    if given <= limit {
        return Ok(());
    }
    Err(Error::TooLarge {
        job: job.to_owned(),
        what,
        given,
        limit,
    })
}
