//! Native programs of emitted MSL: the text exactly as it was emitted, included by a file that calls its entry point, and linked to a
//! program that reads jobs.

use std::path::{Path, PathBuf};

use crate::external::{State, Validator, cache, clang, metal, run};

/// What becomes one program.
#[derive(Clone, Copy, Debug)]
pub struct Native<'a> {
    /// The emitted text; the compiler's messages call it `shader.metal`.
    pub msl: &'a str,
    /// The file that includes it by that name, and calls its entry point.
    pub caller: &'a str,
    /// Headers that the caller includes besides, by name.
    pub headers: &'a [(&'a str, &'a str)],
    /// The rest of the program, which is the same for all shaders, as C++ without the library of MSL.
    pub host: &'a str,
}

/// Compiles a program, which is kept in the folder under a hash of everything that it is made of.
///
/// # Errors
/// Why not: clang is missing, or it refuses the text, crashes, or takes too long.
pub fn compile_native(
    native: &Native<'_>,
    validators: &[Validator],
    folder: &Path,
) -> Result<PathBuf, String> {
    let compiler = Compiler::find(validators)?;
    let host = compiler.host(native, folder)?;
    let mut parts = vec![host.as_os_str().as_encoded_bytes(), native.msl.as_bytes()];
    parts.push(native.caller.as_bytes());
    let path = folder.join(compiler.key("msl", &cache::digest(&parts), native)?);
    if metal::is_whole(&path) {
        return Ok(path);
    }
    metal::made_at(&path, |partial| {
        let sources = sources(native)?;
        std::fs::write(sources.path().join("shader.metal"), native.msl).map_err(said)?;
        std::fs::write(sources.path().join("caller.cpp"), native.caller).map_err(said)?;
        let precompiled = metal::precompiled(compiler.path, compiler.version)?;
        let mut arguments = compiler.arguments(sources.path())?;
        arguments.extend(["-include-pch".to_owned(), text(&precompiled)]);
        arguments.extend(["-x".to_owned(), "c++".to_owned()]);
        arguments.push(text(&sources.path().join("caller.cpp")));
        arguments.extend(["-x".to_owned(), "none".to_owned(), text(&host)]);
        arguments.extend(["-lm".to_owned(), "-o".to_owned(), text(partial)]);
        compiler.run(&arguments)
    })?;
    Ok(path)
}

/// A compiler that can be used.
struct Compiler<'a> {
    path: &'a Path,
    version: &'a str,
}

impl<'a> Compiler<'a> {
    fn find(validators: &'a [Validator]) -> Result<Self, String> {
        let tool = clang::TOOL.name;
        let found = validators.iter().find(|validator| validator.tool == tool);
        let found = found.ok_or_else(|| format!("`{tool}` was not looked for"))?;
        match (&found.path, &found.version, found.state) {
            (Some(path), Some(version), State::Enabled) => Ok(Self { path, version }),
            _ => Err(found.reason.clone().unwrap_or_default()),
        }
    }

    /// The rest of the program, compiled once.
    fn host(&self, native: &Native<'_>, folder: &Path) -> Result<PathBuf, String> {
        let path = folder.join(self.key("msl-host", native.host, native)? + ".o");
        if metal::is_whole(&path) {
            return Ok(path);
        }
        metal::made_at(&path, |partial| {
            let sources = sources(native)?;
            std::fs::write(sources.path().join("host.cpp"), native.host).map_err(said)?;
            let mut arguments = self.arguments(sources.path())?;
            arguments.extend(["-c", "-x", "c++"].map(str::to_owned));
            arguments.push(text(&sources.path().join("host.cpp")));
            arguments.extend(["-o".to_owned(), text(partial)]);
            self.run(&arguments)
        })?;
        Ok(path)
    }

    fn key(&self, kind: &str, of: &str, native: &Native<'_>) -> Result<String, String> {
        let mut arguments = clang::LANGUAGE.map(str::to_owned).to_vec();
        arguments.push(text(metal::headers()?));
        arguments.extend(
            native
                .headers
                .iter()
                .map(|(name, text)| format!("{name}: {text}")),
        );
        Ok(cache::key(kind, self.version, &arguments, of.as_bytes()))
    }

    fn arguments(&self, sources: &Path) -> Result<Vec<String>, String> {
        let mut all = clang::LANGUAGE.map(str::to_owned).to_vec();
        for folder in [metal::headers()?, sources] {
            all.extend(["-I".to_owned(), text(folder)]);
        }
        Ok(all)
    }

    fn run(&self, arguments: &[String]) -> Result<(), String> {
        let outcome = run(self.path, arguments, &[], &metal::LIMITS)?;
        if outcome.success {
            return Ok(());
        }
        Err(format!("`clang` refuses it: {}", outcome.output.trim()))
    }
}

/// A folder with the headers of a program.
fn sources(native: &Native<'_>) -> Result<tempfile::TempDir, String> {
    let folder = tempfile::tempdir().map_err(said)?;
    for (name, text) in native.headers {
        std::fs::write(folder.path().join(name), text).map_err(said)?;
    }
    Ok(folder)
}

fn said(error: std::io::Error) -> String {
    format!("a file for `clang` could not be written: {error}")
}

fn text(path: &Path) -> String {
    path.to_string_lossy().into_owned()
}
