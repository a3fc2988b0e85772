//! SPIR-V for Vulkan of emitted HLSL and GLSL, made by compilers of others from the text exactly as it was emitted.
//!
//! A compiler numbers resources and values between stages in its own way. What is changed in its output, and nothing else, is in
//! [`super::relocate`]: afterwards everything is at the set, binding and location of the source.

use std::path::Path;

use crate::emit::{Emitted, EmittedFile};
use crate::external::{LIMITS, Validator, cache, dxc, glslang, relocate, run, written};
use crate::manifest::Entry;
use crate::options::EmitOptions;
use crate::target::Target;

/// An entry point as SPIR-V.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Compiled {
    /// The module.
    pub bytes: Vec<u8>,
    /// What the entry point is called in it.
    pub entry_point: String,
}

/// Compiles the file of an entry point. `entry` is its part of the manifest that was made of these files; `cache` a folder that
/// keeps what was compiled.
///
/// # Errors
/// Why not: the language has no compiler, the tool is missing, or it refuses the text, crashes, takes too long or writes nothing.
pub fn to_spirv(
    emitted: &Emitted,
    entry: &Entry,
    options: &EmitOptions,
    validators: &[Validator],
    cache: Option<&Path>,
) -> Result<Compiled, String> {
    let file = emitted
        .file(&entry.name)
        .ok_or_else(|| format!("no file was emitted for `{}`", entry.name))?;
    match emitted.target {
        Target::Hlsl => {
            let arguments = dxc::spirv_arguments(file, entry, options)?;
            let raw = object(dxc::TOOL.name, file, &arguments, validators, cache)?;
            Ok(Compiled {
                bytes: relocate::hlsl(&raw, entry)?,
                entry_point: file.entry_point.clone(),
            })
        }
        Target::Glsl if entry.immediates.is_some() => Err(
            "error[unsupported]: the GLSL holds push constants in plain uniforms, which OpenGL has and Vulkan has not".to_owned(),
        ),
        Target::Glsl => {
            let raw = object(
                glslang::TOOL.name,
                file,
                &glslang::spirv_arguments(file),
                validators,
                cache,
            )?;
            Ok(Compiled {
                bytes: relocate::glsl(&raw, entry)?,
                entry_point: "main".to_owned(),
            })
        }
        Target::Spirv | Target::Msl | Target::Wgsl => Err(format!(
            "no tool is known that makes SPIR-V of {}",
            emitted.target
        )),
    }
}

/// What a tool makes of a file, kept in the cache.
fn object(
    tool: &str,
    file: &EmittedFile,
    arguments: &[String],
    validators: &[Validator],
    cache: Option<&Path>,
) -> Result<Vec<u8>, String> {
    let found = validators.iter().find(|validator| validator.tool == tool);
    let found = found.ok_or_else(|| format!("`{tool}` was not looked for"))?;
    let (Some(path), Some(version)) = (&found.path, &found.version) else {
        return Err(found.reason.clone().unwrap_or_default());
    };
    let content = file.contents.bytes();
    let key = cache::key(tool, version, arguments, content);
    if let Some(known) = cache.and_then(|folder| cache::read_object(folder, &key)) {
        return Ok(known);
    }
    let made =
        make(tool, path, arguments, content).map_err(|problem| format!("{}: {problem}", file.file_name))?;
    if let Some(folder) = cache {
        cache::write_object(folder, &key, &made);
    }
    Ok(made)
}

fn make(tool: &str, path: &Path, arguments: &[String], content: &[u8]) -> Result<Vec<u8>, String> {
    let (source, made) = (written(content)?, written(&[])?);
    let [source_path, made_path] = [&source, &made].map(|file| file.path().to_string_lossy().into_owned());
    let mut arguments = arguments.to_vec();
    let input = if tool == dxc::TOOL.name {
        arguments.extend(["-Fo".to_owned(), made_path, source_path]);
        &[]
    } else {
        arguments.push(made_path);
        content
    };
    let outcome = run(path, &arguments, input, &LIMITS)?;
    if !outcome.success {
        return Err(format!("`{tool}` refuses it: {}", outcome.output.trim()));
    }
    let bytes =
        std::fs::read(made.path()).map_err(|error| format!("`{tool}` left nothing to read: {error}"))?;
    if bytes.is_empty() {
        return Err(format!("`{tool}` wrote nothing: {}", outcome.output.trim()));
    }
    Ok(bytes)
}
