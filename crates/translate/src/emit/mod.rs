//! Writes a shader in a target language, one file an entry point.
//!
//! One file an entry point in every language: GLSL has no other way, Direct3D and Metal compile one entry point at a time,
//! and a file that holds only what its entry point needs can be hashed, cached and compared on its own.
//!
//! Every back end is one small file with the same shape: it assigns slots, sets naga's options, calls naga's writer, and
//! says where everything ended up.

use std::collections::{BTreeMap, BTreeSet};
use std::error::Error;

use naga::proc::{BoundsCheckPolicies, BoundsCheckPolicy};
use naga::{GlobalVariable, Handle, Span};

use crate::diagnostic::{Code, Diagnostic};
use crate::front;
use crate::guard::guard;
use crate::manifest::{BufferSizes, GlslImmediate, GlslSlot, HlslSlot, MslSlot, SpirvSlot};
use crate::options::{BoundsChecks, EmitOptions};
use crate::resources::{self, Resource};
use crate::shader::{Shader, Unit};
use crate::target::{Stage, Target};

mod glsl;
mod glsl_features;
mod hlsl;
mod hlsl_idioms;
mod hlsl_registers;
mod msl;
mod sample_arguments;
mod spirv;
mod support;
mod wgsl;

pub use spirv::listing as spirv_listing;

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
    pub(crate) placement: Placement,
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

/// Where a back end put things, for the manifest.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Placement {
    pub(crate) slots: BTreeMap<(u32, u32), Slot>,
    pub(crate) hlsl_immediates: Option<HlslSlot>,
    pub(crate) msl_immediates: Option<MslSlot>,
    pub(crate) glsl_immediates: Vec<GlslImmediate>,
    pub(crate) special_constants: Option<HlslSlot>,
    pub(crate) buffer_sizes: Option<BufferSizes>,
    pub(crate) first_instance: Option<String>,
}

/// The place of one resource in one language.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Slot {
    Spirv(SpirvSlot),
    Hlsl(HlslSlot),
    Msl(MslSlot),
    Glsl(GlslSlot),
}

/// What a back end gives back.
struct Written {
    contents: Contents,
    entry_point: String,
    placement: Placement,
}

/// One entry point to be written in one language.
struct Job<'a> {
    shader: &'a Shader,
    unit: &'a Unit,
    target: Target,
    options: &'a EmitOptions,
    resources: &'a [Resource],
    immediates: Option<(Handle<GlobalVariable>, &'a GlobalVariable)>,
}

impl Job<'_> {
    /// A refusal; without a place of its own it points at the entry point.
    fn refuse(&self, code: Code, message: impl Into<String>, span: Option<Span>) -> Diagnostic {
        let entry = &self.unit.entry().name;
        let text = self.shader.text();
        let place = span
            .and_then(|span| front::range_in(text, span))
            .or_else(|| declaration(text, entry))
            .map(|range| (range, String::new()));
        Diagnostic::new(code, message)
            .at(self.shader.name(), text, place)
            .with_note(format!("in {} entry point `{entry}`", self.unit.stage))
    }

    /// A writer of naga's refused.
    fn failed(&self, error: &dyn Error) -> Diagnostic {
        let message = format!("{}: {}", self.target, front::chain(error));
        self.refuse(Code::Unsupported, message, None)
    }
}

/// The name of a function where it is declared in WGSL or GLSL.
fn declaration(text: &str, name: &str) -> Option<std::ops::Range<usize>> {
    let declared = |keyword: &str| {
        text.find(&format!("{keyword} {name}("))
            .map(|at| at + keyword.len() + 1)
    };
    let start = declared("fn").or_else(|| declared("void"))?;
    Some(start..start + name.len())
}

/// Emits a shader in a language.
///
/// # Errors
/// What the target cannot express, with its place in the source. Other targets are not affected.
pub fn emit(shader: &Shader, target: Target, options: &EmitOptions) -> Result<Emitted, Diagnostic> {
    let names = file_names(shader, target)?;
    let files = shader
        .units()
        .iter()
        .zip(names)
        .map(|(unit, file_name)| emit_unit(shader, unit, target, options, file_name))
        .collect::<Result<_, _>>()?;
    Ok(Emitted { target, files })
}

fn emit_unit(
    shader: &Shader,
    unit: &Unit,
    target: Target,
    options: &EmitOptions,
    file_name: String,
) -> Result<EmittedFile, Diagnostic> {
    let job = Job {
        shader,
        unit,
        target,
        options,
        resources: &unit.resources,
        immediates: resources::immediates(unit),
    };
    support::check(&job)?;
    let written = guard(shader.name(), &format!("writing {target}"), || write(&job))?;
    Ok(EmittedFile {
        entry: unit.entry().name.clone(),
        stage: unit.stage,
        entry_point: written.entry_point,
        file_name,
        contents: written.contents,
        placement: written.placement,
    })
}

fn write(job: &Job<'_>) -> Result<Written, Diagnostic> {
    match job.target {
        Target::Spirv => spirv::write(job),
        Target::Hlsl => hlsl::write(job),
        Target::Msl => msl::write(job),
        Target::Glsl => glsl::write(job),
        Target::Wgsl => wgsl::write(job),
    }
}

/// `SHADER.ENTRY.EXTENSION` for each entry point. Two entry points of different stages may share a name (in SPIR-V both
/// are often `main`): then the stage goes between.
fn file_names(shader: &Shader, target: Target) -> Result<Vec<String>, Diagnostic> {
    let stem = file_safe(shader.name());
    let entries: Vec<(String, Stage)> = shader
        .entry_points()
        .map(|(name, stage)| (file_safe(name), stage))
        .collect();
    let mut taken = BTreeSet::new();
    let mut names = Vec::with_capacity(entries.len());
    for (name, stage) in &entries {
        let shared = entries.iter().filter(|(other, _)| other == name).count() > 1;
        let infix = if shared {
            format!(".{stage}")
        } else {
            String::new()
        };
        let extension = match target {
            Target::Glsl => format!("{}.glsl", stage.glsl_extension()),
            Target::Spirv | Target::Hlsl | Target::Msl | Target::Wgsl => target.extension().to_owned(),
        };
        let file = format!("{stem}.{name}{infix}.{extension}");
        if !taken.insert(file.to_lowercase()) {
            let message = format!("two entry points would be written to `{file}`");
            return Err(Diagnostic::new(Code::Collision, message)
                .in_file(shader.name())
                .with_hint("give them names that differ in letters and digits"));
        }
        names.push(file);
    }
    Ok(names)
}

/// The last component of a path without its extension, with everything that a file system may dislike replaced.
fn file_safe(name: &str) -> String {
    let last = name.rsplit(['/', '\\']).next().unwrap_or(name);
    let stem = match last.rsplit_once('.') {
        Some((stem, _)) if !stem.is_empty() => stem,
        _ => last,
    };
    let safe: String = stem
        .chars()
        .map(|c| {
            if c.is_alphanumeric() || c == '_' || c == '-' {
                c
            } else {
                '_'
            }
        })
        .collect();
    if safe.is_empty() {
        "shader".to_owned()
    } else {
        safe
    }
}

const fn bounds_check_policies(checks: BoundsChecks) -> BoundsCheckPolicies {
    let policy = match checks {
        BoundsChecks::Off => BoundsCheckPolicy::Unchecked,
        BoundsChecks::Restrict => BoundsCheckPolicy::Restrict,
    };
    BoundsCheckPolicies {
        index: policy,
        buffer: policy,
        image_load: policy,
        binding_array: policy,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn file_names_are_safe() {
        assert_eq!(file_safe("dir/brick.wgsl"), "brick");
        assert_eq!(file_safe(r"c:\x\brick wall.v2.wgsl"), "brick_wall_v2");
        assert_eq!(file_safe(".hidden"), "_hidden");
        assert_eq!(file_safe(""), "shader");
        assert_eq!(file_safe("../.."), "_");
    }

    #[test]
    fn declarations_are_found() {
        let text = "fn a_main() {}\n@vertex fn main(x: f32) {}";
        assert_eq!(declaration(text, "main").map(|r| &text[r]), Some("main"));
        assert_eq!(declaration(text, "none"), None);
    }
}
