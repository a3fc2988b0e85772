//! What runs in the process.

use std::path::Path;

use bossage_runner::Code;

/// What runs in the process.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Kind {
    /// Dawn, which takes WGSL. Its program is `dawn`.
    Dawn,
    /// OpenGL, which takes GLSL. Its program is Python.
    OpenGl,
}

/// Name and text of each module of a script; the first is the one to run.
type Modules = &'static [(&'static str, &'static str)];

const DAWN: Modules = &[
    ("main.mjs", include_str!("../dawn/main.mjs")),
    ("messages.mjs", include_str!("../dawn/messages.mjs")),
    ("scopes.mjs", include_str!("../dawn/scopes.mjs")),
    ("resources.mjs", include_str!("../dawn/resources.mjs")),
    ("compute.mjs", include_str!("../dawn/compute.mjs")),
    ("render.mjs", include_str!("../dawn/render.mjs")),
];

const OPENGL: Modules = &[
    ("opengl.py", include_str!("../opengl/opengl.py")),
    ("context.py", include_str!("../opengl/context.py")),
    ("programs.py", include_str!("../opengl/programs.py")),
    ("picture.py", include_str!("../opengl/picture.py")),
];

impl Kind {
    /// In messages.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Dawn => "Dawn",
            Self::OpenGl => "OpenGL",
        }
    }

    /// The text of a shader in the language that this takes.
    pub(crate) fn text<'a>(self, code: Code<'a>) -> Result<&'a str, String> {
        match (self, code) {
            (Self::Dawn, Code::Wgsl(text)) | (Self::OpenGl, Code::Glsl(text)) => Ok(text),
            (Self::Dawn, _) => Err(format!("Dawn takes WGSL, not {}", code.route())),
            (Self::OpenGl, _) => Err(format!("OpenGL takes GLSL, not {}", code.route())),
        }
    }

    pub(crate) const fn modules(self) -> Modules {
        match self {
            Self::Dawn => DAWN,
            Self::OpenGl => OPENGL,
        }
    }

    /// How its program is called to say what this computer lacks, whatever the adapter; `None` where only opening an adapter tells.
    pub(crate) fn check_arguments(self, script: &Path) -> Option<Vec<String>> {
        match self {
            Self::Dawn => None,
            Self::OpenGl => Some(vec![script.to_string_lossy().into_owned(), "--check".to_owned()]),
        }
    }

    /// How its program is called.
    pub(crate) fn arguments(self, script: &Path, adapter: &str) -> Vec<String> {
        let script = script.to_string_lossy().into_owned();
        let own = match self {
            Self::Dawn => vec!["run".to_owned(), script],
            Self::OpenGl => vec![script],
        };
        own.into_iter().chain([adapter.to_owned()]).collect()
    }
}
