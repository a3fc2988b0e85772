//! Writes a shader in a target language, one file an entry point.
//!
//! Every back end is one small file with the same shape: it assigns slots, sets naga's options, calls naga's writer, and
//! says where everything ended up.

use crate::diagnostic::{Code, Diagnostic};
use crate::options::EmitOptions;
use crate::shader::Shader;
use crate::target::{Stage, Target};

/// All files of a shader in one language.
#[derive(Clone, Debug, PartialEq)]
pub struct Emitted {
    /// The language.
    pub target: Target,
    /// One file an entry point, in the order of the source.
    pub files: Vec<EmittedFile>,
}

impl Emitted {
    /// The file of an entry point.
    #[must_use]
    pub fn file(&self, entry: &str) -> Option<&EmittedFile> {
        self.files.iter().find(|file| file.entry == entry)
    }
}

/// One entry point in one language.
#[derive(Clone, Debug, PartialEq)]
pub struct EmittedFile {
    /// The entry point's name in the source.
    pub entry: String,
    /// Its stage.
    pub stage: Stage,
    /// Its name in the emitted code.
    pub entry_point: String,
    /// A file name that is unique within the shader: `SHADER.ENTRY.EXTENSION`.
    pub file_name: String,
    /// The code.
    pub contents: Contents,
}

/// Emitted code.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Contents {
    /// Text.
    Text(String),
    /// The words of a SPIR-V module, little endian.
    Binary(Vec<u8>),
}

impl Contents {
    /// The bytes to write to a file.
    #[must_use]
    pub fn bytes(&self) -> &[u8] {
        match self {
            Self::Text(text) => text.as_bytes(),
            Self::Binary(bytes) => bytes,
        }
    }

    /// The text, if it is text.
    #[must_use]
    pub fn text(&self) -> Option<&str> {
        match self {
            Self::Text(text) => Some(text),
            Self::Binary(_) => None,
        }
    }
}

/// Emits a shader in a language.
///
/// # Errors
/// What the target cannot express, with its place in the source. Other targets are not affected.
pub fn emit(shader: &Shader, target: Target, options: &EmitOptions) -> Result<Emitted, Diagnostic> {
    let _ = (shader, options);
    Err(Diagnostic::new(
        Code::Internal,
        format!("{target} is not there yet"),
    ))
}
