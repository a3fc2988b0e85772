//! What comes back from a process.

use bossage_runner::Error;
use serde::Deserialize;

use crate::kind::Kind;
use crate::process::Stopped;

/// The first word: the adapter, or why there is none.
#[derive(Clone, Debug, Deserialize)]
#[serde(untagged)]
pub(crate) enum Hello {
    Open {
        features: Vec<String>,
        #[serde(flatten)]
        capacity: Capacity,
    },
    Refused {
        message: String,
    },
}

/// How much goes into one job.
#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(rename_all = "camelCase")]
pub(crate) struct Capacity {
    /// Pixels along the longer side of a picture.
    pub(crate) side: u32,
    /// Targets of a picture.
    pub(crate) targets: u32,
    /// Workgroups along an axis.
    pub(crate) workgroups: u32,
    /// Bytes of one buffer.
    pub(crate) buffer_bytes: u64,
}

/// The answer to a job.
#[derive(Clone, Debug, Deserialize)]
#[serde(untagged)]
pub(crate) enum Answer {
    Done { lengths: Vec<usize> },
    Failed { failure: String, message: String },
}

/// Why a job failed, as the error that every machine has for it.
pub(crate) fn error(kind: Kind, job: &str, failure: &str, message: String) -> Error {
    let name = job.to_owned();
    match failure {
        "validation" => Error::invalid(job, message),
        "memory" => Error::OutOfMemory { job: name },
        "lost" => Error::gave_up(job, kind.name(), format!("the device was lost: {message}")),
        _ => Error::Internal { job: name, message },
    }
}

/// The process ended, or was ended, under the job.
pub(crate) fn stopped(kind: Kind, job: &str, stopped: Stopped) -> Error {
    Error::gave_up(job, kind.name(), stopped.0)
}
