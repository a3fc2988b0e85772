//! What stops a run of mutants before there is a result.

use std::path::PathBuf;

use crate::equivalent::Entry;

/// Failures of the call, the environment or the tool. A mutant that survives is a result, not an error.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// A file or folder could not be read.
    #[error("cannot read {}", path.display())]
    Read {
        /// Which.
        path: PathBuf,
        /// What the system says.
        source: std::io::Error,
    },
    /// A file could not be written.
    #[error("cannot write {}", path.display())]
    Write {
        /// Which.
        path: PathBuf,
        /// What the system says.
        source: std::io::Error,
    },
    /// A source that cannot be parsed has no mutants.
    #[error("{file}:{line}: {message}")]
    Syntax {
        /// The file, below the shader folder.
        file: String,
        /// The line, from 1.
        line: usize,
        /// What the parser says.
        message: String,
    },
    /// The library is faulty before anything is put into it.
    #[error("the library does not assemble as it is: {0}")]
    Library(String),
    /// A case fails without a fault, so it cannot tell one.
    #[error("{case} fails with the library as it is: {reason}; `bossage conform` must pass first")]
    FailsUnmutated {
        /// The case.
        case: String,
        /// Why it fails.
        reason: String,
    },
    /// A case asks for a module that it does not name, so what reaches it is not known.
    #[error("{case} asks for a module that it does not name: {module}")]
    Undeclared {
        /// The case.
        case: String,
        /// The module.
        module: String,
    },
    /// The list of equivalent mutants cannot be read.
    #[error("{}: {message}", path.display())]
    List {
        /// The list.
        path: PathBuf,
        /// What is wrong, with its line.
        message: String,
    },
    /// An entry of the list fits no mutant.
    #[error(
        "{}: entry {number} ({}, {}, {}) fits no mutant: `{}` does not become `{}` there (any more); remove it or bring it up \
         to date",
        path.display(), entry.file, entry.item, entry.operator, entry.was, entry.is
    )]
    Stale {
        /// The list.
        path: PathBuf,
        /// Which entry, from 1.
        number: usize,
        /// What it says.
        entry: Box<Entry>,
    },
    /// Nothing has the filter in its name.
    #[error("no mutant's id contains `{filter}`; `./x mutants --list` names all {known}")]
    NoSuchMutant {
        /// The filter.
        filter: String,
        /// How many mutants there are.
        known: usize,
    },
    /// A value cannot be what it is.
    #[error("{0}")]
    Call(String),
    /// The cases cannot be listed, or there is nothing to run them on.
    #[error(transparent)]
    Conformance(#[from] bossage_conformance::Error),
    /// No adapter.
    #[error("no adapter to run on")]
    Adapter(#[source] bossage_runner::Error),
    /// A child process could not be started or said something that makes no sense.
    #[error("a worker process {0}")]
    Worker(String),
}

impl Error {
    /// 2: the call or the input is wrong. 3: the environment lacks what is needed.
    #[must_use]
    pub fn exit_code(&self) -> u8 {
        match self {
            Self::Adapter(_) => 3,
            Self::Conformance(error) if error.is_missing_environment() => 3,
            Self::Read { .. }
            | Self::Write { .. }
            | Self::Syntax { .. }
            | Self::Library(_)
            | Self::FailsUnmutated { .. }
            | Self::Undeclared { .. }
            | Self::List { .. }
            | Self::Stale { .. }
            | Self::NoSuchMutant { .. }
            | Self::Call(_)
            | Self::Conformance(_)
            | Self::Worker(_) => 2,
        }
    }
}
