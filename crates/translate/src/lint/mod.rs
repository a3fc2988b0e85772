//! Rules about shaders that are valid but will hurt, one rule a file, each telling what went wrong without it.
//!
//! A rule finds something or it does not: none guesses. To add one, write its file and list it in `RULES`.

use std::ops::Range;

use naga::Span;
use serde::{Deserialize, Serialize};

use crate::diagnostic::position;
use crate::front::range_in;
use crate::shader::Shader;

mod endless_loop;
mod es_texture_query;
mod float_width;
mod implicit_derivative;
mod mat3_in_buffer;
mod stage_interface;
mod texture_two_samplers;
mod unused_binding;

/// All rules, in order of their ids.
const RULES: [&Rule; 8] = [
    &endless_loop::RULE,
    &es_texture_query::RULE,
    &float_width::RULE,
    &implicit_derivative::RULE,
    &mat3_in_buffer::RULE,
    &stage_interface::RULE,
    &texture_two_samplers::RULE,
    &unused_binding::RULE,
];

/// A rule.
struct Rule {
    id: &'static str,
    severity: Severity,
    find: fn(&Shader) -> Vec<Finding>,
}

/// What a rule found, and where in the text, if there is a text.
struct Finding {
    range: Option<Range<usize>>,
    message: String,
}

impl Finding {
    fn new(shader: &Shader, span: Span, message: String) -> Self {
        Self {
            range: range_in(shader.text(), span),
            message,
        }
    }
}

/// A finding.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
pub struct Lint {
    /// The file it is in.
    pub file: String,
    /// Line, from 1.
    pub line: Option<u32>,
    /// Column in characters, from 1.
    pub column: Option<u32>,
    /// The rule's id.
    pub rule: String,
    /// How bad it is.
    pub severity: Severity,
    /// What was found and what to do.
    pub message: String,
}

/// How bad a finding is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Severity {
    /// The result is wrong somewhere.
    Warning,
    /// Worth knowing.
    Note,
}

/// Ids and severities of all rules.
pub fn rules() -> impl ExactSizeIterator<Item = (&'static str, Severity)> {
    RULES.iter().map(|rule| (rule.id, rule.severity))
}

/// All findings in a shader, by place; the same finding through several entry points is listed once.
#[must_use]
pub fn lint(shader: &Shader) -> Vec<Lint> {
    let mut lints: Vec<Lint> = RULES
        .iter()
        .flat_map(|rule| {
            (rule.find)(shader)
                .into_iter()
                .map(|found| located(shader, rule, found))
        })
        .collect();
    lints.sort();
    lints.dedup();
    lints
}

fn located(shader: &Shader, rule: &Rule, found: Finding) -> Lint {
    let place = found.range.map(|range| position(shader.text(), range.start));
    Lint {
        file: shader.name().to_owned(),
        line: place.map(|(line, _)| line),
        column: place.map(|(_, column)| column),
        rule: rule.id.to_owned(),
        severity: rule.severity,
        message: found.message,
    }
}

#[cfg(test)]
mod testing {
    use super::{Lint, lint};
    use crate::{Shader, Source};

    /// Findings of one rule in a WGSL text.
    pub(super) fn findings(rule: &str, text: &str) -> Vec<Lint> {
        assert!(super::rules().any(|(id, _)| id == rule), "no rule `{rule}`");
        let shader = Shader::parse("lint.wgsl", &Source::Wgsl(text.to_owned()))
            .unwrap_or_else(|error| panic!("{error}"));
        lint(&shader).into_iter().filter(|l| l.rule == rule).collect()
    }

    /// Lines of the findings of one rule.
    pub(super) fn lines(rule: &str, text: &str) -> Vec<u32> {
        findings(rule, text).iter().filter_map(|l| l.line).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rules_are_sorted_and_distinct() {
        let ids: Vec<&str> = rules().map(|(id, _)| id).collect();
        assert!(ids.is_sorted_by(|a, b| a < b), "{ids:?}");
    }
}
