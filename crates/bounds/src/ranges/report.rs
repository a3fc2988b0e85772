//! What can be wrong with a sidecar, with file, line, column and caret.

use codespan_reporting::diagnostic::{Diagnostic, Label};
use codespan_reporting::files::SimpleFile;
use codespan_reporting::term::{self, Chars, Config};
use std::fmt;
use std::ops::Range;

/// One mistake.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Problem {
    /// What is wrong.
    pub message: String,
    /// What to do.
    pub hint: String,
    /// Where, in bytes of the text.
    pub span: Range<usize>,
    /// Line, from 1.
    pub line: usize,
    /// Column in characters, from 1.
    pub column: usize,
}

/// All mistakes of one sidecar, with its text.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Report {
    /// The file, as given.
    pub file: String,
    /// Its text.
    pub text: String,
    /// At least one, in file order.
    pub problems: Vec<Problem>,
}

impl Report {
    pub(crate) fn new(file: &str, text: &str) -> Self {
        Self {
            file: file.to_owned(),
            text: text.to_owned(),
            problems: Vec::new(),
        }
    }

    pub(crate) fn note(&mut self, span: Range<usize>, message: impl Into<String>, hint: impl Into<String>) {
        let before = self.text.get(..span.start).unwrap_or(&self.text);
        let line_start = before.rfind('\n').map_or(0, |newline| newline + 1);
        self.problems.push(Problem {
            message: message.into(),
            hint: hint.into(),
            line: before.matches('\n').count() + 1,
            column: before[line_start..].chars().count() + 1,
            span,
        });
    }

    /// The value, unless something was noted.
    pub(crate) fn check<T>(mut self, value: T) -> Result<T, Box<Self>> {
        if self.problems.is_empty() {
            return Ok(value);
        }
        self.problems
            .sort_by_key(|problem| (problem.span.start, problem.span.end));
        Err(Box::new(self))
    }
}

impl fmt::Display for Report {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        let file = SimpleFile::new(self.file.as_str(), self.text.as_str());
        let config = Config {
            chars: Chars::ascii(),
            ..Config::default()
        };
        for (at, problem) in self.problems.iter().enumerate() {
            let diagnostic: Diagnostic<()> = Diagnostic::error()
                .with_message(&problem.message)
                .with_label(Label::primary((), problem.span.clone()))
                .with_note(format!("help: {}", problem.hint));
            let text = term::emit_into_string(&config, &file, &diagnostic).map_err(|_| fmt::Error)?;
            let gap = if at == 0 { "" } else { "\n\n" };
            write!(out, "{gap}{}", text.trim_end())?;
        }
        Ok(())
    }
}

impl std::error::Error for Report {}

/// ``did you mean `near`? `` where a name is near, then what is known.
pub(crate) fn suggestion(got: &str, what: &str, known: &[&str]) -> String {
    let distance = |name: &str| strsim::damerau_levenshtein(&got.to_lowercase(), &name.to_lowercase());
    let near = known
        .iter()
        .map(|name| (distance(name), *name))
        .filter(|(d, name)| d * 3 <= got.chars().count().max(name.chars().count()))
        .min_by_key(|(d, _)| *d);
    let shown: Vec<String> = known.iter().take(24).map(|name| format!("`{name}`")).collect();
    let rest = match known.len().saturating_sub(shown.len()) {
        0 => String::new(),
        n => format!(" and {n} more"),
    };
    let list = format!("{what}: {}{rest}", shown.join(", "));
    match near {
        Some((_, name)) => format!("did you mean `{name}`? {list}"),
        None => list,
    }
}
