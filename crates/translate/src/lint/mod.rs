//! Rules about shaders that are valid but will hurt, one rule a file.

use serde::{Deserialize, Serialize};

use crate::shader::Shader;

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

/// All findings in a shader, by place.
#[must_use]
pub fn lint(shader: &Shader) -> Vec<Lint> {
    let _ = shader;
    Vec::new()
}
