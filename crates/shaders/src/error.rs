//! What can go wrong between a feature set and a module, told with file, line, column and a caret.

use std::fmt;
use std::path::PathBuf;

/// Errors of this crate.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// A fault in a shader source.
    #[error("{0}")]
    Source(Box<SourceError>),
    /// A file or folder that cannot be read.
    #[error("cannot read `{}`", path.display())]
    Read {
        /// The path.
        path: PathBuf,
        /// Why.
        #[source]
        source: std::io::Error,
    },
    /// A file that is not UTF-8 text.
    #[error("`{}` is not UTF-8 text", path.display())]
    NotText {
        /// The path.
        path: PathBuf,
    },
    /// A shader folder without a file that the tables name.
    #[error(
        "the shader library in {library} has no `{file}`; `--shader-dir` expects a copy of the whole `shaders` folder"
    )]
    MissingFile {
        /// Where the library was read from.
        library: String,
        /// The missing file.
        file: String,
    },
    /// A file that no table and no import reaches.
    #[error(
        "the shader library in {library} has the file `{file}`, which nothing reaches: import it, list it, or delete it"
    )]
    Orphan {
        /// Where the library was read from.
        library: String,
        /// The orphan.
        file: String,
    },
    /// A probe id that is not in the table.
    #[error("there is no probe `{0}`")]
    UnknownProbe(String),
}

/// A fault in a shader source, with its place.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SourceError {
    /// What is wrong, in one sentence.
    pub message: String,
    /// The file, as given by the user or relative to the library's folder.
    pub file: String,
    /// Line and column (in characters), both from one; `None` where only the file is known.
    pub position: Option<(usize, usize)>,
    /// The line's text and how many characters to underline.
    pub snippet: Option<(String, usize)>,
    /// What to do.
    pub hint: Option<String>,
}

impl SourceError {
    /// A fault at a byte range of a text.
    pub(crate) fn at(
        message: impl Into<String>,
        file: &str,
        text: &str,
        range: std::ops::Range<usize>,
    ) -> Self {
        let start = floor_boundary(text, range.start);
        let end = floor_boundary(text, range.end).max(start);
        let line_start = text[..start].rfind('\n').map_or(0, |at| at + 1);
        let line_end = text[start..].find('\n').map_or(text.len(), |at| start + at);
        let column = text[line_start..start].chars().count() + 1;
        let marked = text[start..end.min(line_end).max(start)].chars().count().max(1);
        SourceError {
            message: message.into(),
            file: file.to_owned(),
            position: Some((text[..start].matches('\n').count() + 1, column)),
            snippet: Some((
                text[line_start..line_end].trim_end_matches('\r').to_owned(),
                marked,
            )),
            hint: None,
        }
    }

    /// A fault of a file as a whole.
    pub(crate) fn in_file(message: impl Into<String>, file: &str) -> Self {
        SourceError {
            message: message.into(),
            file: file.to_owned(),
            position: None,
            snippet: None,
            hint: None,
        }
    }

    pub(crate) fn hint(mut self, hint: impl Into<String>) -> Self {
        self.hint = Some(hint.into());
        self
    }
}

impl From<SourceError> for Error {
    fn from(error: SourceError) -> Self {
        Error::Source(Box::new(error))
    }
}

impl fmt::Display for SourceError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.position {
            Some((line, column)) => write!(f, "{}:{line}:{column}: {}", self.file, self.message)?,
            None => write!(f, "{}: {}", self.file, self.message)?,
        }
        if let (Some((line, column)), Some((text, marked))) = (self.position, &self.snippet) {
            let number = line.to_string();
            let margin = " ".repeat(number.len());
            // Tabs are kept in the padding so that the caret stays below its character.
            let pad: String = text
                .chars()
                .take(column - 1)
                .map(|c| if c == '\t' { '\t' } else { ' ' })
                .collect();
            write!(
                f,
                "\n{margin} |\n{number} | {text}\n{margin} | {pad}{}",
                "^".repeat(*marked)
            )?;
        }
        if let Some(hint) = &self.hint {
            write!(f, "\n  = {hint}")?;
        }
        Ok(())
    }
}

fn floor_boundary(text: &str, at: usize) -> usize {
    let mut at = at.min(text.len());
    while !text.is_char_boundary(at) {
        at -= 1;
    }
    at
}

#[cfg(test)]
mod tests {
    use super::SourceError;

    #[test]
    fn the_caret_stands_below_its_character() {
        let text = "const a = 1;\n\tlet ö = ?;\n";
        let at = text.find('?').unwrap_or(0);
        let error = SourceError::at("unexpected `?`", "lib/x.wesl", text, at..at + 1).hint("delete it");
        assert_eq!(
            error.to_string(),
            "lib/x.wesl:2:10: unexpected `?`\n  |\n2 | \tlet ö = ?;\n  | \t        ^\n  = delete it"
        );
    }

    #[test]
    fn a_range_beyond_the_text_or_inside_a_character_is_no_panic() {
        let text = "aö";
        for start in 0..6 {
            for end in 0..6 {
                let error = SourceError::at("x", "f", text, start..end);
                assert!(error.to_string().contains('^'));
            }
        }
    }
}
