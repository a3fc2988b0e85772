//! One message about one shader: what is wrong, where, with the line and a caret under it, and what to do.
//!
//! A diagnostic owns all it shows, so that it outlives the source. It is rendered when it is made, since the source is at
//! hand then; errors are rare, so the cost does not matter.

use std::fmt;
use std::ops::{Deref, DerefMut, Range};

use codespan_reporting::diagnostic::{Diagnostic as Report, Label as ReportLabel};
use codespan_reporting::files::SimpleFile;
use codespan_reporting::term;
use serde::Serialize;

/// What kind of mistake a diagnostic is about. The names are stable.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Code {
    /// The text is not of its language.
    Parse,
    /// The module breaks a rule of the language.
    Validate,
    /// An override has no value, or a value that does not fit.
    Override,
    /// The target cannot express something that the shader uses.
    Unsupported,
    /// Resources exceed what the target or its binding model holds.
    Binding,
    /// Two outputs would have the same name.
    Collision,
    /// A name that is not known.
    UnknownName,
    /// A fault of ours or of naga: the writer failed on a valid module.
    Internal,
}

impl Code {
    /// The code's name as printed in brackets.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Parse => "parse",
            Self::Validate => "validate",
            Self::Override => "override",
            Self::Unsupported => "unsupported",
            Self::Binding => "binding",
            Self::Collision => "collision",
            Self::UnknownName => "unknown-name",
            Self::Internal => "internal",
        }
    }
}

/// One marked place in a source.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Label {
    /// Line, from 1.
    pub line: u32,
    /// Column in characters, from 1.
    pub column: u32,
    /// Bytes of the source that are marked.
    #[serde(skip)]
    pub range: Range<usize>,
    /// What to know about this place; may be empty.
    pub message: String,
}

/// A message with its place. Its parts are those of [`Details`], which it dereferences to.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[serde(transparent)]
pub struct Diagnostic(Box<Details>);

/// The parts of a [`Diagnostic`], behind a pointer so that a `Result` that holds one stays small.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Details {
    /// The kind of mistake.
    pub code: Code,
    /// What is wrong, in one sentence.
    pub message: String,
    /// The name the shader was parsed under; empty when the message is about no shader.
    pub file: String,
    /// Line of the first label, from 1.
    pub line: Option<u32>,
    /// Column of the first label in characters, from 1.
    pub column: Option<u32>,
    /// Every marked place, the most important first.
    pub labels: Vec<Label>,
    /// Further facts.
    pub notes: Vec<String>,
    /// What to do about it.
    pub hint: Option<String>,
    /// The marked source lines with carets; empty where there is no place.
    pub snippet: String,
}

impl Deref for Diagnostic {
    type Target = Details;

    fn deref(&self) -> &Details {
        &self.0
    }
}

impl DerefMut for Diagnostic {
    fn deref_mut(&mut self) -> &mut Details {
        &mut self.0
    }
}

impl Diagnostic {
    /// A message without a place.
    #[must_use]
    pub fn new(code: Code, message: impl Into<String>) -> Self {
        Self(Box::new(Details {
            code,
            message: message.into(),
            file: String::new(),
            line: None,
            column: None,
            labels: Vec::new(),
            notes: Vec::new(),
            hint: None,
            snippet: String::new(),
        }))
    }

    /// Adds what to do.
    #[must_use]
    pub fn with_hint(mut self, hint: impl Into<String>) -> Self {
        self.hint = Some(hint.into());
        self
    }

    /// Adds a fact.
    #[must_use]
    pub fn with_note(mut self, note: impl Into<String>) -> Self {
        self.notes.push(note.into());
        self
    }

    /// Names the file, where there is no place in it to show.
    #[must_use]
    pub fn in_file(mut self, file: &str) -> Self {
        self.file = file.to_owned();
        self
    }

    /// Marks places in a source. Ranges that do not lie in the text (as those of binary sources) are dropped.
    #[must_use]
    pub fn at(
        mut self,
        file: &str,
        text: &str,
        places: impl IntoIterator<Item = (Range<usize>, String)>,
    ) -> Self {
        self.file = file.to_owned();
        self.labels = places
            .into_iter()
            .filter_map(|(range, message)| label(text, range, message))
            .collect();
        self.line = self.labels.first().map(|first| first.line);
        self.column = self.labels.first().map(|first| first.column);
        if !self.labels.is_empty() {
            self.snippet = snippet(file, text, &self.labels);
        }
        self
    }
}

/// A label, if the range can be shown.
fn label(text: &str, range: Range<usize>, message: String) -> Option<Label> {
    if range.is_empty() && range.start == 0 || range.start > range.end {
        return None;
    }
    text.get(range.clone())?;
    let (line, column) = position(text, range.start);
    Some(Label {
        line,
        column,
        range,
        message,
    })
}

/// Line and column, both from 1, columns counted in characters. `offset` must lie on a character boundary of the text.
pub(crate) fn position(text: &str, offset: usize) -> (u32, u32) {
    let before = &text[..offset];
    let line_start = before.rfind('\n').map_or(0, |at| at + 1);
    let line = before.bytes().filter(|b| *b == b'\n').count() + 1;
    let column = before[line_start..].chars().count() + 1;
    (saturating(line), saturating(column))
}

fn saturating(n: usize) -> u32 {
    u32::try_from(n).unwrap_or(u32::MAX)
}

/// The marked lines with carets, without a heading. Control characters are shown as replacement characters.
fn snippet(file: &str, text: &str, labels: &[Label]) -> String {
    let shown = replace_control_characters(text);
    let files = SimpleFile::new(file, shown.as_str());
    let marks = labels.iter().enumerate().map(|(at, label)| {
        let range = label.range.clone();
        let mark = if at == 0 {
            ReportLabel::primary((), range)
        } else {
            ReportLabel::secondary((), range)
        };
        mark.with_message(&label.message)
    });
    let report: Report<()> = Report::error().with_labels(marks.collect());
    let config = term::Config::default();
    let rendered = term::emit_into_string(&config, &files, &report).unwrap_or_default();
    let body = rendered.split_once('\n').map_or("", |(_, body)| body);
    body.trim_end().to_owned()
}

/// A control character may move the cursor of a terminal. Each is replaced, byte for byte, so that offsets still fit.
fn replace_control_characters(text: &str) -> String {
    let replace = |c: char| c.is_control() && !c.is_whitespace();
    text.chars()
        .flat_map(|c| {
            let (shown, times) = if replace(c) { ('?', c.len_utf8()) } else { (c, 1) };
            std::iter::repeat_n(shown, times)
        })
        .collect()
}

impl fmt::Display for Diagnostic {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "error[{}]: {}", self.code.name(), self.message)?;
        if !self.snippet.is_empty() {
            write!(f, "\n{}", self.snippet)?;
        } else if !self.file.is_empty() {
            write!(f, "\n  --> {}", self.file)?;
        }
        for note in &self.notes {
            write!(f, "\n  note: {note}")?;
        }
        if let Some(hint) = &self.hint {
            write!(f, "\n  help: {hint}")?;
        }
        Ok(())
    }
}

impl std::error::Error for Diagnostic {}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_caret_stands_under_the_word() {
        let text = "fn f() {\n  let x = oops;\n}\n";
        let start = text.find("oops").unwrap();
        let diagnostic = Diagnostic::new(Code::Parse, "no such name")
            .at("a.wgsl", text, [(start..start + 4, "unknown".to_owned())])
            .with_hint("declare it");
        assert_eq!((diagnostic.line, diagnostic.column), (Some(2), Some(11)));
        let shown = diagnostic.to_string();
        let lines: Vec<&str> = shown.lines().collect();
        let source = lines.iter().position(|l| l.contains("let x = oops")).unwrap();
        let caret = lines[source + 1].find("^^^^").unwrap();
        // Columns of the two lines compare in characters: the gutter holds a box-drawing sign of several bytes.
        let column = |line: &str, byte: usize| line[..byte].chars().count();
        let word = lines[source].find("oops").unwrap();
        assert_eq!(column(lines[source], word), column(lines[source + 1], caret));
        assert!(shown.starts_with("error[parse]: no such name\n"));
        assert!(shown.ends_with("help: declare it"));
        assert!(shown.contains("a.wgsl:2:11"));
    }

    #[test]
    fn columns_count_characters() {
        let text = "// é\n/* ü */ x";
        let at = text.find('x').unwrap();
        assert_eq!(position(text, at), (2, 9));
    }

    #[test]
    fn a_range_outside_the_text_is_dropped() {
        let diagnostic = Diagnostic::new(Code::Parse, "m").at("a", "short", [(3..900, String::new())]);
        assert!(diagnostic.labels.is_empty());
        assert_eq!(diagnostic.to_string(), "error[parse]: m\n  --> a");
    }

    #[test]
    fn control_characters_are_not_shown() {
        let text = "a \u{1b}[31m b";
        let diagnostic = Diagnostic::new(Code::Parse, "m").at("a", text, [(8..9, String::new())]);
        assert!(!diagnostic.snippet.contains('\u{1b}'));
    }
}
