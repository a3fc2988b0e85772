//! What ends a study early.

use std::path::PathBuf;

/// Why a study could not be made.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// A technique that the library does not have.
    #[error("unknown technique `{given}`; there is: {}", known.join(", "))]
    UnknownTechnique {
        /// What was asked for.
        given: String,
        /// What there is.
        known: Vec<&'static str>,
    },
    /// A technique with settings that it cannot have.
    #[error("technique {0}")]
    Technique(String),
    /// Nothing is left to measure.
    #[error("{0}")]
    Nothing(String),
    /// A map or another image is wrong.
    #[error(transparent)]
    Asset(#[from] bossage_assets::Error),
    /// The library's sources are wrong.
    #[error(transparent)]
    Library(#[from] bossage_shaders::Error),
    /// A shader could not be run.
    #[error(transparent)]
    Run(#[from] bossage_runner::Error),
    /// A shader cannot take part; the message names it and says why.
    #[error("{0}")]
    Shader(String),
    /// The journal could not be read or written.
    #[error("cannot keep finished points in {}", path.display())]
    Journal {
        /// The file.
        path: PathBuf,
        /// What the system says.
        source: std::io::Error,
    },
    /// Another process writes the same study.
    #[error("{} is being written by another process; give this study another folder, or wait", .0.display())]
    Busy(PathBuf),
    /// A cost profile could not be written: a fault of ours.
    #[error("cannot write the cost profile: {0}")]
    Profile(String),
    /// Times are demanded, and there is no driver to take them from.
    #[error("{0}")]
    NoDriver(String),
}

impl Error {
    /// Whether something is missing on this machine, rather than wrong in the call.
    #[must_use]
    pub fn is_missing_environment(&self) -> bool {
        match self {
            Self::Run(error) => error.is_missing_environment(),
            Self::NoDriver(_) => true,
            _ => false,
        }
    }
}
