//! What can be wrong with a scene, and how it is shown.
//!
//! A scene with mistakes yields one [`Error::Invalid`] holding *all* of them, in file order. Each is rendered with file, line,
//! column, caret, the path of the field and what to do.

use std::fmt;
use std::ops::Range;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use codespan_reporting::diagnostic::{Diagnostic, Label};
use codespan_reporting::files::SimpleFile;
use codespan_reporting::term::{self, Chars, Config};

/// Why a scene could not be loaded.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// The scene file or cost profile itself could not be read.
    #[error("cannot read the {what} {}", path.display())]
    Read {
        /// What the file should be.
        what: &'static str,
        /// The file.
        path: PathBuf,
        /// Why.
        #[source]
        source: std::io::Error,
    },
    /// The file is larger than any of its kind: [`crate::schema::MAX_SCENE_BYTES`], [`crate::profile::MAX_BYTES`].
    #[error("the {what} {} has {bytes} bytes; at most {most} are read: is this a {what}?", path.display())]
    TooLarge {
        /// What the file should be.
        what: &'static str,
        /// The file.
        path: PathBuf,
        /// Its size.
        bytes: u64,
        /// The largest size that is read.
        most: u64,
    },
    /// The file was read, and is wrong in one place or more.
    #[error(transparent)]
    Invalid(#[from] Box<Report>),
}

impl Error {
    /// The problems found in the scene file's text; empty when the file could not be read.
    #[must_use]
    pub fn problems(&self) -> &[Problem] {
        match self {
            Self::Read { .. } | Self::TooLarge { .. } => &[],
            Self::Invalid(report) => &report.problems,
        }
    }
}

/// Whose text a mistake is in.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Origin {
    /// The scene file's.
    File,
    /// A setting's, as it was given.
    Setting(String),
    /// That of a file which the scene names.
    Named(Arc<NamedFile>),
}

/// A file that a scene names and that has places of its own.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct NamedFile {
    /// The file, as resolved.
    pub path: PathBuf,
    /// Its text.
    pub text: String,
}

/// One mistake in a scene file, in a setting that goes with it, or in a cost profile.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Problem {
    /// Path of the field, as `materials[1].height.scale`; empty for the file as a whole.
    pub field: String,
    /// What is wrong.
    pub message: String,
    /// What to do.
    pub hint: String,
    /// Whose text it is in.
    pub origin: Origin,
    /// Where, in bytes of that text.
    pub span: Range<usize>,
    /// Line, from 1.
    pub line: usize,
    /// Column in characters, from 1.
    pub column: usize,
}

/// All mistakes of one file and of those that it names, with its text.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Report {
    /// The file, as given.
    pub path: PathBuf,
    /// Its text.
    pub text: String,
    /// At least one, in file order, those of settings last.
    pub problems: Vec<Problem>,
}

impl Report {
    /// The problems, told as those of a file that another one names.
    pub(crate) fn into_named(self) -> Vec<Problem> {
        let file = Arc::new(NamedFile {
            path: self.path,
            text: self.text,
        });
        let told = |problem| Problem {
            origin: Origin::Named(file.clone()),
            ..problem
        };
        self.problems.into_iter().map(told).collect()
    }

    /// For a scene that was refused without a problem being noted: a mistake of this crate, and still no panic.
    pub(crate) fn unexplained(path: &Path, text: &str) -> Self {
        let problem = Problem {
            field: String::new(),
            message: "the scene was refused and no reason was noted".to_owned(),
            hint: "this is a mistake of the loader: please report it with the scene".to_owned(),
            origin: Origin::File,
            span: 0..0,
            line: 1,
            column: 1,
        };
        Self {
            path: path.to_owned(),
            text: text.to_owned(),
            problems: vec![problem],
        }
    }
}

impl std::error::Error for Report {}

impl fmt::Display for Report {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        let config = Config {
            chars: Chars::ascii(),
            ..Config::default()
        };
        for problem in &self.problems {
            let file = match &problem.origin {
                Origin::File => SimpleFile::new(self.path.display().to_string(), self.text.as_str()),
                Origin::Setting(given) => SimpleFile::new("KEY=VALUE".to_owned(), given.as_str()),
                Origin::Named(file) => SimpleFile::new(file.path.display().to_string(), file.text.as_str()),
            };
            let text =
                term::emit_into_string(&config, &file, &diagnostic(problem)).map_err(|_| fmt::Error)?;
            writeln!(out, "{}", text.trim_end())?;
            writeln!(out)?;
        }
        let count = self.problems.len();
        write!(
            out,
            "{}: {count} problem{}",
            self.path.display(),
            if count == 1 { "" } else { "s" }
        )
    }
}

fn diagnostic(problem: &Problem) -> Diagnostic<()> {
    let message = if problem.field.is_empty() {
        problem.message.clone()
    } else {
        format!("`{}`: {}", problem.field, problem.message)
    };
    Diagnostic::error()
        .with_message(message)
        .with_label(Label::primary((), problem.span.clone()))
        .with_note(format!("help: {}", problem.hint))
}

/// Line and column (in characters), both from 1, of a byte offset.
pub(crate) fn line_column(text: &str, offset: usize) -> (usize, usize) {
    let before = text.get(..offset).unwrap_or(text);
    let line_start = before.rfind('\n').map_or(0, |newline| newline + 1);
    (
        before.matches('\n').count() + 1,
        before[line_start..].chars().count() + 1,
    )
}

#[cfg(test)]
mod tests {
    use super::line_column;

    #[test]
    fn columns_count_characters_not_bytes() {
        assert_eq!(line_column("a\nöö = 1", "a\nöö".len()), (2, 3));
        assert_eq!(line_column("", 0), (1, 1));
    }
}
