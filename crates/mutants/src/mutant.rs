//! One mutant: a change of one place, and the names it goes by.

use std::ops::Range;

use serde::Serialize;

/// A replacement of a part of a file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Change {
    /// The bytes that are replaced.
    pub range: Range<usize>,
    /// What stands there then.
    pub text: String,
}

/// The library with one fault.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Mutant {
    /// `FILE:ITEM:OPERATOR:NUMBER`. The number counts the operator's mutants in the item, in the order of the text, from 1.
    pub id: String,
    /// The file, below the shader folder.
    pub file: String,
    /// The function, or the constant, that is changed.
    pub item: String,
    /// The name of the operator.
    pub operator: &'static str,
    /// The line of the place, from 1.
    pub line: usize,
    /// The line or lines of the place as they were, without indentation, joined by single spaces.
    pub was: String,
    /// The same as they are.
    pub is: String,
    /// Which one it is of several with the same item, operator, `was` and `is`, from 1.
    pub nth: usize,
    /// The whole mutated file.
    #[serde(skip)]
    pub text: String,
}

impl Change {
    /// The text with the change made.
    #[must_use]
    pub fn apply(&self, text: &str) -> String {
        format!(
            "{}{}{}",
            &text[..self.range.start],
            self.text,
            &text[self.range.end..]
        )
    }

    /// The number of the first line that is touched, and the touched lines before and after.
    #[must_use]
    pub fn lines(&self, text: &str) -> (usize, String, String) {
        let start = text[..self.range.start].rfind('\n').map_or(0, |at| at + 1);
        let end = text[self.range.end..]
            .find('\n')
            .map_or(text.len(), |length| self.range.end + length);
        let inner = Self {
            range: self.range.start - start..self.range.end - start,
            text: self.text.clone(),
        };
        let was = &text[start..end];
        let line = text[..start].matches('\n').count() + 1;
        (line, joined(was), joined(&inner.apply(was)))
    }
}

/// The lines without indentation, joined by single spaces.
fn joined(lines: &str) -> String {
    lines.lines().map(str::trim).collect::<Vec<_>>().join(" ")
}

#[cfg(test)]
mod tests {
    use super::Change;

    #[test]
    fn a_change_shows_its_whole_lines() {
        let text = "fn f() {\n    let a = b\n        + c;\n}\n";
        let at = text.find("b\n").unwrap();
        let change = Change {
            range: at..text.find(';').unwrap(),
            text: "(b)".to_owned(),
        };
        let (line, was, is) = change.lines(text);
        assert_eq!(
            (line, was.as_str(), is.as_str()),
            (2, "let a = b + c;", "let a = (b);")
        );
        assert_eq!(change.apply(text), "fn f() {\n    let a = (b);\n}\n");
    }

    #[test]
    fn the_last_line_needs_no_end() {
        let change = Change {
            range: 0..1,
            text: "x".to_owned(),
        };
        assert_eq!(change.lines("a;"), (1, "a;".to_owned(), "x;".to_owned()));
    }
}
