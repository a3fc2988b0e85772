//! Everything that ends a command early, and the exit code it ends with.
//!
//! A failed check is not an error: it is a result ([`crate::Verdict::Failed`], exit code 1). Errors are wrong input
//! or calls (2) and environments that lack what was demanded (3).

use std::path::{Path, PathBuf};

use bossage_translate::Diagnostic;

/// Why a command could not do its job.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// A file could not be read.
    #[error("cannot read {}", path.display())]
    Read {
        /// The file.
        path: PathBuf,
        /// What the system says.
        source: std::io::Error,
    },
    /// A file could not be written; nothing else was written either.
    #[error("cannot write {}; nothing was changed", path.display())]
    Write {
        /// The file.
        path: PathBuf,
        /// What the system says.
        source: std::io::Error,
    },
    /// Two inputs claim one output file.
    #[error("{first} and {second} would both write {}; rename one, or give them different output folders", output.display())]
    Collision {
        /// The file.
        output: PathBuf,
        /// Who planned it first.
        first: String,
        /// Who planned it again.
        second: String,
    },
    /// The scene is wrong.
    #[error(transparent)]
    Scene(#[from] bossage_scene::Error),
    /// The shader library, or a shader in WESL, is wrong.
    #[error(transparent)]
    Library(#[from] bossage_shaders::Error),
    /// Shaders are wrong; each is shown with its line and a caret.
    #[error("{}", .0.iter().map(ToString::to_string).collect::<Vec<_>>().join("\n\n"))]
    Shaders(Vec<Diagnostic>),
    /// An image or a mesh is wrong.
    #[error(transparent)]
    Asset(#[from] bossage_assets::Error),
    /// A shader could not be run.
    #[error(transparent)]
    Run(#[from] bossage_runner::Error),
    /// Conformance could not start, or could not be reported.
    #[error(transparent)]
    Conform(#[from] bossage_conformance::Error),
    /// A study could not be made.
    #[error(transparent)]
    Study(#[from] bossage_study::Error),
    /// A chart of prices could not be measured.
    #[error(transparent)]
    Price(#[from] bossage_study::prices::Error),
    /// A study could not be drawn.
    #[error(transparent)]
    Report(#[from] bossage_study::report::Error),
    /// A value cannot be what it is; the message says which and what to do.
    #[error("{0}")]
    Call(String),
    /// The environment lacks something; the message says what and how to get it.
    #[error("{0}")]
    Environment(String),
    /// Results could not be printed.
    #[error("cannot write to standard output")]
    StandardOutput(#[source] std::io::Error),
    /// A picture could not be encoded.
    #[error("cannot encode a PNG")]
    Png(#[source] image::ImageError),
    /// A report could not be put into JSON (a map with keys that are no strings, say): a fault of ours.
    #[error("cannot write JSON")]
    Json(#[source] serde_json::Error),
}

/// Shorthand.
pub type Result<T> = std::result::Result<T, Error>;

impl Error {
    /// The exit code of the process: 2 for input and calls, 3 for the environment.
    #[must_use]
    pub fn exit_code(&self) -> u8 {
        match self {
            Self::Run(error) if error.is_missing_environment() => 3,
            Self::Conform(error) if error.is_missing_environment() => 3,
            Self::Study(error) if error.is_missing_environment() => 3,
            Self::Read { .. }
            | Self::Scene(_)
            | Self::Library(_)
            | Self::Shaders(_)
            | Self::Asset(_)
            | Self::Run(_)
            | Self::Conform(_)
            | Self::Study(_)
            | Self::Price(_)
            | Self::Report(_)
            | Self::Write { .. }
            | Self::Collision { .. }
            | Self::Call(_)
            | Self::Png(_)
            | Self::StandardOutput(_)
            | Self::Json(_) => 2,
            Self::Environment(_) => 3,
        }
    }
}

/// Reads a file, or says which one could not be read.
pub(crate) fn read(path: &Path) -> Result<Vec<u8>> {
    std::fs::read(path).map_err(|source| Error::Read {
        path: path.to_owned(),
        source,
    })
}

/// An error with everything that caused it, one `: `-joined line (or a block, where a cause brings its own picture).
pub(crate) fn chain(error: &dyn std::error::Error) -> String {
    let mut text = error.to_string();
    let mut cause = error.source();
    while let Some(inner) = cause {
        text.push_str(": ");
        text.push_str(&inner.to_string());
        cause = inner.source();
    }
    text
}
