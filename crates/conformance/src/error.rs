//! What can go wrong before there is anything to compare.

use std::path::PathBuf;

/// Failures of the call or the environment. A shader that fails is a verdict, not an error.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// No case has that in its name.
    #[error("no case matches `{filter}`; `bossage conform --list` names all {known} cases")]
    NoSuchCase {
        /// The filter that was given.
        filter: String,
        /// How many cases there are.
        known: usize,
    },
    /// No route of that name.
    #[error("no route is called `{given}`; there are: {}", .known.join(", "))]
    NoSuchRoute {
        /// What was given.
        given: String,
        /// The names that exist.
        known: Vec<&'static str>,
    },
    /// A shard that cannot be.
    #[error("shard {index}/{count} cannot be: the first number goes from 1 to the second")]
    BadShard {
        /// The part asked for, from 1.
        index: usize,
        /// The number of parts.
        count: usize,
    },
    /// No adapter, or none that matches.
    #[error("no adapter to run on")]
    Adapter(#[source] bossage_runner::Error),
    /// A route that was named lacks its compiler.
    #[error("route `{route}` cannot run: {reason}")]
    NoTool {
        /// The route.
        route: crate::route::Route,
        /// What is missing, and how to get it.
        reason: String,
    },
    /// Routes and adapters that don't go together.
    #[error("{what}; it runs: {runs}")]
    NoPair {
        /// What doesn't run what.
        what: String,
        /// What it runs, or runs on.
        runs: String,
    },
    /// The examples' folder cannot be read.
    #[error("cannot read the scenes in {}", path.display())]
    Scenes {
        /// The folder.
        path: PathBuf,
        /// What the system said.
        #[source]
        source: std::io::Error,
    },
    /// A user's shader without anything to run.
    #[error("{shader} {problem}; it has: {}", .known.join(", "))]
    NoEntryPoint {
        /// The shader.
        shader: String,
        /// What it lacks.
        problem: String,
        /// Its entry points with their stages.
        known: Vec<String>,
    },
    /// A dispatch that no evaluation would see the end of.
    #[error(
        "{shader}: {workgroups:?} workgroups are {invocations} invocations, and at most {limit} are run; ask for less by --workgroups, or by `workgroups` in the ranges"
    )]
    TooManyInvocations {
        /// The shader.
        shader: String,
        /// Workgroups along x, y and z.
        workgroups: [u32; 3],
        /// Their invocations.
        invocations: u64,
        /// The most that are run.
        limit: u64,
    },
    /// An output whose bound cannot be attributed, since there is none of that name.
    #[error("there is no output `{name}`; there are: {}", .known.join(", "))]
    NoOutput {
        /// What was asked for.
        name: String,
        /// The first of those that there are.
        known: Vec<String>,
    },
    /// A file of the regression corpus is wrong.
    #[error("corpus {file}: {message}")]
    Corpus {
        /// The file, or the folder.
        file: String,
        /// What is wrong, with its place.
        message: String,
    },
    /// Declared ranges that are wrong or do not fit the shader.
    #[error(transparent)]
    Ranges(bossage_bounds::Error),
    /// The report cannot be put into its format.
    #[error("cannot write the report as {format}: {message}")]
    Report {
        /// `JSON` or `JUnit`.
        format: &'static str,
        /// What the writer said.
        message: String,
    },
}

impl Error {
    /// Whether the environment lacks what was demanded (exit code 3) rather than the call being wrong (2).
    #[must_use]
    pub fn is_missing_environment(&self) -> bool {
        matches!(self, Self::Adapter(_) | Self::NoTool { .. })
    }
}
