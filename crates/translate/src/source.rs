//! What a shader is read from.

use serde::{Deserialize, Serialize};

use crate::target::Stage;

/// The text or words of a shader, and the language they are in.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Source {
    /// WGSL text.
    Wgsl(String),
    /// A SPIR-V module, little endian.
    Spirv(Vec<u8>),
    /// GLSL text of one stage, for Vulkan or OpenGL as far as naga reads it.
    Glsl {
        /// The text, beginning with `#version`.
        text: String,
        /// GLSL does not say its stage: the caller must.
        stage: Stage,
    },
}

impl Source {
    /// The language's name.
    #[must_use]
    pub const fn language(&self) -> Language {
        match self {
            Self::Wgsl(_) => Language::Wgsl,
            Self::Spirv(_) => Language::Spirv,
            Self::Glsl { .. } => Language::Glsl,
        }
    }

    /// The text, which a binary source has not.
    #[must_use]
    pub fn text(&self) -> &str {
        match self {
            Self::Wgsl(text) | Self::Glsl { text, .. } => text,
            Self::Spirv(_) => "",
        }
    }
}

/// A language that shaders are read from.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Language {
    /// WebGPU Shading Language.
    Wgsl,
    /// SPIR-V.
    Spirv,
    /// OpenGL Shading Language.
    Glsl,
}
