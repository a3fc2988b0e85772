//! The five languages we emit, the versions of each, and how their names are read from a command line.
//!
//! Every `FromStr` here refuses an unknown name with the nearest known one: nothing defaults silently.

use std::fmt;
use std::str::FromStr;

use serde::{Deserialize, Serialize};

use crate::diagnostic::{Code, Diagnostic};

/// A language that shaders are emitted in.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Target {
    /// SPIR-V, a binary module (with a readable listing beside it).
    Spirv,
    /// High-Level Shading Language of Direct3D.
    Hlsl,
    /// Metal Shading Language.
    Msl,
    /// OpenGL Shading Language, core or ES.
    Glsl,
    /// WebGPU Shading Language.
    Wgsl,
}

impl Target {
    /// All targets, in the order in which they are emitted and listed.
    pub const ALL: [Self; 5] = [Self::Spirv, Self::Hlsl, Self::Msl, Self::Glsl, Self::Wgsl];

    /// The name used on the command line and as a key of the manifest.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Spirv => "spirv",
            Self::Hlsl => "hlsl",
            Self::Msl => "msl",
            Self::Glsl => "glsl",
            Self::Wgsl => "wgsl",
        }
    }

    /// The extension of emitted files, without the dot. GLSL files end in the stage (`vert`, `frag`, `comp`), which is
    /// how GLSL compilers tell stages apart; this is the extension that goes before it.
    #[must_use]
    pub const fn extension(self) -> &'static str {
        match self {
            Self::Spirv => "spv",
            Self::Hlsl => "hlsl",
            Self::Msl => "metal",
            Self::Glsl => "glsl",
            Self::Wgsl => "wgsl",
        }
    }
}

impl fmt::Display for Target {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

impl FromStr for Target {
    type Err = Diagnostic;

    fn from_str(s: &str) -> Result<Self, Diagnostic> {
        pick("target", s, &Self::ALL.map(|t| (t.name(), t)))
    }
}

/// A pipeline stage. Mesh, task and ray stages are refused when a shader is parsed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Stage {
    /// Runs once a vertex.
    Vertex,
    /// Runs once a fragment.
    Fragment,
    /// Runs over a grid of workgroups.
    Compute,
}

impl Stage {
    /// The stage's name in the manifest.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Vertex => "vertex",
            Self::Fragment => "fragment",
            Self::Compute => "compute",
        }
    }

    /// The customary file extension of a GLSL shader of this stage.
    #[must_use]
    pub const fn glsl_extension(self) -> &'static str {
        match self {
            Self::Vertex => "vert",
            Self::Fragment => "frag",
            Self::Compute => "comp",
        }
    }

    pub(crate) const fn to_naga(self) -> naga::ShaderStage {
        match self {
            Self::Vertex => naga::ShaderStage::Vertex,
            Self::Fragment => naga::ShaderStage::Fragment,
            Self::Compute => naga::ShaderStage::Compute,
        }
    }

    pub(crate) const fn from_naga(stage: naga::ShaderStage) -> Option<Self> {
        use naga::ShaderStage as S;
        match stage {
            S::Vertex => Some(Self::Vertex),
            S::Fragment => Some(Self::Fragment),
            S::Compute => Some(Self::Compute),
            S::Task | S::Mesh | S::RayGeneration | S::Miss | S::AnyHit | S::ClosestHit => None,
        }
    }
}

impl fmt::Display for Stage {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

impl FromStr for Stage {
    type Err = Diagnostic;

    fn from_str(s: &str) -> Result<Self, Diagnostic> {
        const ALL: [Stage; 3] = [Stage::Vertex, Stage::Fragment, Stage::Compute];
        pick("stage", s, &ALL.map(|t| (t.name(), t)))
    }
}

/// A Direct3D shader model.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
pub enum ShaderModel {
    /// Direct3D 11: one flat register file a class, no register spaces.
    #[serde(rename = "5_0")]
    V5_0,
    /// Direct3D 12 with FXC: register spaces.
    #[serde(rename = "5_1")]
    V5_1,
    /// Direct3D 12 with DXC: 64-bit integers, wave operations.
    #[serde(rename = "6_0")]
    V6_0,
    /// Adds real 16-bit types.
    #[serde(rename = "6_2")]
    V6_2,
}

impl ShaderModel {
    /// All shader models, oldest first.
    pub const ALL: [Self; 4] = [Self::V5_0, Self::V5_1, Self::V6_0, Self::V6_2];

    /// The suffix of a compiler profile, as in `ps_5_0`.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::V5_0 => "5_0",
            Self::V5_1 => "5_1",
            Self::V6_0 => "6_0",
            Self::V6_2 => "6_2",
        }
    }

    /// The compiler profile of a stage, as in `ps_5_0`.
    #[must_use]
    pub fn profile(self, stage: Stage) -> String {
        let prefix = match stage {
            Stage::Vertex => "vs",
            Stage::Fragment => "ps",
            Stage::Compute => "cs",
        };
        format!("{prefix}_{}", self.name())
    }
}

impl fmt::Display for ShaderModel {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

impl FromStr for ShaderModel {
    type Err = Diagnostic;

    fn from_str(s: &str) -> Result<Self, Diagnostic> {
        pick(
            "shader model",
            &s.replace('.', "_"),
            &Self::ALL.map(|t| (t.name(), t)),
        )
    }
}

/// A version of GLSL.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
pub enum GlslVersion {
    /// OpenGL 3.3: no compute, no storage, no binding layout qualifiers.
    #[serde(rename = "330")]
    Core330,
    /// OpenGL 4.3: compute and storage buffers.
    #[serde(rename = "430")]
    Core430,
    /// OpenGL 4.5.
    #[serde(rename = "450")]
    Core450,
    /// OpenGL ES 3.0 and WebGL 2: no compute, no storage, no binding layout qualifiers.
    #[serde(rename = "es300")]
    Es300,
    /// OpenGL ES 3.1: compute and storage buffers.
    #[serde(rename = "es310")]
    Es310,
}

impl GlslVersion {
    /// All versions.
    pub const ALL: [Self; 5] = [
        Self::Core330,
        Self::Core430,
        Self::Core450,
        Self::Es300,
        Self::Es310,
    ];

    /// The name used on the command line.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Core330 => "330",
            Self::Core430 => "430",
            Self::Core450 => "450",
            Self::Es300 => "es300",
            Self::Es310 => "es310",
        }
    }

    /// Whether this is a version for OpenGL ES.
    #[must_use]
    pub const fn is_es(self) -> bool {
        matches!(self, Self::Es300 | Self::Es310)
    }

    /// Whether the language has `layout(binding = N)`; without it the engine binds by name.
    #[must_use]
    pub const fn has_binding_layout(self) -> bool {
        matches!(self, Self::Core430 | Self::Core450 | Self::Es310)
    }

    pub(crate) const fn to_naga(self) -> naga::back::glsl::Version {
        use naga::back::glsl::Version;
        match self {
            Self::Core330 => Version::Desktop(330),
            Self::Core430 => Version::Desktop(430),
            Self::Core450 => Version::Desktop(450),
            Self::Es300 => Version::new_gles(300),
            Self::Es310 => Version::new_gles(310),
        }
    }
}

impl fmt::Display for GlslVersion {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

impl FromStr for GlslVersion {
    type Err = Diagnostic;

    fn from_str(s: &str) -> Result<Self, Diagnostic> {
        pick("GLSL version", s, &Self::ALL.map(|t| (t.name(), t)))
    }
}

/// The value that `given` names, or an error that lists the names and suggests the nearest.
fn pick<T: Copy>(what: &str, given: &str, known: &[(&str, T)]) -> Result<T, Diagnostic> {
    if let Some((_, value)) = known.iter().find(|(name, _)| *name == given) {
        return Ok(*value);
    }
    let names: Vec<&str> = known.iter().map(|(name, _)| *name).collect();
    let mut diagnostic = Diagnostic::new(
        Code::UnknownName,
        format!("unknown {what} `{given}`; known: {}", names.join(", ")),
    );
    if let Some(near) = nearest(given, &names) {
        diagnostic = diagnostic.with_hint(format!("did you mean `{near}`?"));
    }
    Err(diagnostic)
}

/// The name within two edits of `given` (one for names of up to three letters), if there is one.
fn nearest<'a>(given: &str, names: &[&'a str]) -> Option<&'a str> {
    let lower = given.to_lowercase();
    names
        .iter()
        .map(|name| (edit_distance(&lower, name), *name))
        .filter(|(distance, name)| *distance <= if name.len() <= 3 { 1 } else { 2 })
        .min()
        .map(|(_, name)| name)
}

/// Levenshtein distance, one row at a time.
fn edit_distance(a: &str, b: &str) -> usize {
    let b: Vec<char> = b.chars().collect();
    let mut row: Vec<usize> = (0..=b.len()).collect();
    for (i, ca) in a.chars().enumerate() {
        let mut diagonal = row[0];
        row[0] = i + 1;
        for (j, cb) in b.iter().enumerate() {
            let substituted = diagonal + usize::from(ca != *cb);
            diagonal = row[j + 1];
            row[j + 1] = substituted.min(row[j] + 1).min(diagonal + 1);
        }
    }
    row[b.len()]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_read_back() {
        for target in Target::ALL {
            assert_eq!(target.name().parse::<Target>().unwrap(), target);
        }
        for version in GlslVersion::ALL {
            assert_eq!(version.name().parse::<GlslVersion>().unwrap(), version);
        }
        for model in ShaderModel::ALL {
            assert_eq!(model.name().parse::<ShaderModel>().unwrap(), model);
        }
        assert_eq!("5.1".parse::<ShaderModel>().unwrap(), ShaderModel::V5_1);
    }

    #[test]
    fn a_misspelt_target_gets_a_suggestion() {
        let error = "hlls".parse::<Target>().unwrap_err();
        assert_eq!(error.hint.as_deref(), Some("did you mean `hlsl`?"));
    }

    #[test]
    fn a_far_off_target_gets_the_list_only() {
        let error = "cuda-ptx".parse::<Target>().unwrap_err();
        assert_eq!(error.hint, None);
        assert!(error.message.contains("spirv, hlsl, msl, glsl, wgsl"));
    }

    #[test]
    fn distances() {
        assert_eq!(edit_distance("", "abc"), 3);
        assert_eq!(edit_distance("kitten", "sitting"), 3);
        assert_eq!(edit_distance("wgsl", "wgsl"), 0);
    }
}
