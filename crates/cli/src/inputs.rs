//! INPUT… → shader modules: a scene becomes the modules of its permutations, a shader file becomes one.
//!
//! What a file is, its extension says. Permutations that several scenes share are taken once. Every file that was read is
//! recorded, for dep-files and for telling whether anything changed.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

use bossage_scene::{Plan, Scene, Shape};
use bossage_shaders::{AssembledShader, Library};
use bossage_translate::manifest::Entry;
use bossage_translate::{Code, EmitOptions, Overrides, Shader, Source, Stage, manifest};
use rayon::prelude::*;

use crate::args::Global;
use crate::error::{Error, Result, read};
use crate::nearest::suggestion;

/// The largest shader file that is read.
pub(crate) const MAX_SHADER_BYTES: u64 = 16 << 20;

const EXTENSIONS: &[&str] = &["toml", "wgsl", "wesl", "spv", "vert", "frag", "comp", "glsl"];

/// Everything the inputs lead to.
#[derive(Debug, Default)]
pub(crate) struct Inputs {
    /// The modules, in the order of the inputs.
    pub(crate) modules: Vec<Module>,
    /// The scenes among the inputs.
    pub(crate) scenes: Vec<Planned>,
    /// Every file that was read, sorted.
    pub(crate) read: BTreeSet<PathBuf>,
}

/// One shader to translate.
#[derive(Clone, Debug)]
pub(crate) struct Module {
    /// Its name, which starts the names of its files.
    pub(crate) name: String,
    /// The input it comes from, as the user wrote it.
    pub(crate) input: PathBuf,
    /// What messages call it: the user's file where its lines are the code's lines, else the name.
    pub(crate) label: String,
    /// Its code.
    pub(crate) source: Source,
}

/// A scene with its plan.
#[derive(Debug)]
pub(crate) struct Planned {
    pub(crate) scene: Scene,
    pub(crate) plan: Plan,
}

impl Module {
    fn new(name: String, input: &Path, source: Source, lines_are_the_users: bool) -> Self {
        let label = if lines_are_the_users {
            input.display().to_string()
        } else {
            name.clone()
        };
        Self {
            name,
            input: input.to_owned(),
            label,
            source,
        }
    }

    /// The parsed and validated shader, ready to be written to files of its name.
    pub(crate) fn parse(&self) -> Result<Shader> {
        parse(&self.name, &self.source).or_else(|_| self.parse_labelled())
    }

    /// The same, under the name that messages use, with values for its pipeline-overridable constants.
    pub(crate) fn parse_with(&self, overrides: &Overrides) -> Result<Shader> {
        Shader::parse_with(&self.label, &self.source, overrides).map_err(|diagnostic| {
            let lacks_value = diagnostic.code == Code::Override && !diagnostic.labels.is_empty();
            Error::Shaders(vec![match lacks_value {
                true => diagnostic.with_hint(
                    "give it a default in the shader, or a value under [overrides] of NAME.ranges.toml",
                ),
                false => diagnostic,
            }])
        })
    }

    /// The same, under the name that messages use.
    pub(crate) fn parse_labelled(&self) -> Result<Shader> {
        parse(&self.label, &self.source)
    }
}

/// The library that the flags ask for, and the files it was read from (none for the embedded one).
pub(crate) fn library(global: &Global) -> Result<(Library, BTreeSet<PathBuf>)> {
    let Some(folder) = &global.shader_dir else {
        return Ok((Library::embedded()?, BTreeSet::new()));
    };
    let library = Library::from_dir(folder)?;
    let mut files = BTreeSet::new();
    walk(folder, &mut files)?;
    Ok((library, files))
}

/// All shader sources below a folder.
fn walk(folder: &Path, files: &mut BTreeSet<PathBuf>) -> Result<()> {
    let cannot = |source| Error::Read {
        path: folder.to_owned(),
        source,
    };
    for entry in std::fs::read_dir(folder).map_err(cannot)? {
        let path = entry.map_err(cannot)?.path();
        if path.is_dir() {
            walk(&path, files)?;
        } else if extension(&path) == "wesl" {
            files.insert(path);
        }
    }
    Ok(())
}

/// Reads all inputs. The first wrong one ends it.
pub(crate) fn gather(paths: &[PathBuf], stage: Option<Stage>, global: &Global) -> Result<Inputs> {
    let (library, read) = library(global)?;
    let mut inputs = Inputs {
        read,
        ..Inputs::default()
    };
    for path in paths {
        inputs.add(path, stage, &library)?;
    }
    Ok(inputs)
}

impl Inputs {
    /// Reads one input more.
    pub(crate) fn add(&mut self, path: &Path, stage: Option<Stage>, library: &Library) -> Result<()> {
        match extension(path).as_str() {
            "toml" => self.add_scene(path, library),
            "wesl" => self.add_wesl(path, library),
            _ => self.add_shader(path, stage),
        }
    }

    fn add_scene(&mut self, path: &Path, library: &Library) -> Result<()> {
        let scene = bossage_scene::load(path)?;
        let plan = bossage_scene::plan(&scene);
        for assembled in assemble(library, &plan)? {
            let source = Source::Wgsl(assembled.wgsl);
            let shared = self
                .modules
                .iter()
                .any(|m| m.name == assembled.name && m.source == source);
            if !shared {
                self.modules
                    .push(Module::new(assembled.name, path, source, false));
            }
        }
        self.read.extend(files_of(&scene));
        self.scenes.push(Planned { scene, plan });
        Ok(())
    }

    fn add_wesl(&mut self, path: &Path, library: &Library) -> Result<()> {
        read_shader(path)?;
        let assembled = library.assemble_user_file(path)?;
        let folder = path.parent().unwrap_or(Path::new(""));
        self.read.extend(
            assembled
                .modules
                .iter()
                .map(|module| folder.join(module))
                .filter(|file| file.is_file()),
        );
        self.read.insert(path.to_owned());
        self.modules
            .push(Module::new(stem(path), path, Source::Wgsl(assembled.wgsl), false));
        Ok(())
    }

    fn add_shader(&mut self, path: &Path, stage: Option<Stage>) -> Result<()> {
        let kind = extension(path);
        let (name, source) = match (kind.as_str(), glsl_stage(path, stage)) {
            ("wgsl", _) => (stem(path), Source::Wgsl(read_text(path)?)),
            ("spv", _) => (stem(path), Source::Spirv(read_shader(path)?)),
            ("vert" | "frag" | "comp" | "glsl", Some(stage)) => (
                format!("{}_{}", stem(path), stage.glsl_extension()),
                Source::Glsl {
                    text: read_text(path)?,
                    stage,
                },
            ),
            ("glsl", None) => return Err(stage_missing(path)),
            _ => return Err(unknown_kind(path, &kind)),
        };
        self.read.insert(path.to_owned());
        self.modules.push(Module::new(name, path, source, true));
        Ok(())
    }

    /// All modules parsed and validated, in order; or what is wrong with any of them, all at once.
    pub(crate) fn parse(&self) -> Result<Vec<Shader>> {
        let parsed: Vec<_> = self.modules.par_iter().map(Module::parse).collect();
        let (mut shaders, mut wrong) = (Vec::new(), Vec::new());
        for result in parsed {
            match result {
                Ok(shader) => shaders.push(shader),
                Err(Error::Shaders(diagnostics)) => wrong.extend(diagnostics),
                Err(other) => return Err(other),
            }
        }
        if wrong.is_empty() {
            Ok(shaders)
        } else {
            Err(Error::Shaders(wrong))
        }
    }
}

/// A parsed and validated shader.
pub(crate) fn parse(name: &str, source: &Source) -> Result<Shader> {
    Shader::parse(name, source).map_err(|diagnostic| Error::Shaders(vec![diagnostic]))
}

/// A shader of the library, parsed, with the one entry point that each of ours has.
pub(crate) fn entry(assembled: &AssembledShader) -> Result<Entry> {
    let shader = parse(&assembled.name, &Source::Wgsl(assembled.wgsl.clone()))?;
    let entries = manifest(&shader, &EmitOptions::default(), &[]).entries;
    let nothing = || Error::Call(format!("{} has no entry point", assembled.name));
    entries.into_iter().next().ok_or_else(nothing)
}

/// The modules of a plan's permutations, each once, sorted by name.
pub(crate) fn assemble(library: &Library, plan: &Plan) -> Result<Vec<AssembledShader>> {
    let mut modules = BTreeMap::new();
    for permutation in &plan.permutations {
        for &part in permutation.features.stages() {
            let assembled = library.assemble_surface(&permutation.features, part)?;
            modules.insert(assembled.name.clone(), assembled);
        }
    }
    Ok(modules.into_values().collect())
}

/// The scene file and every file it names.
pub(crate) fn files_of(scene: &Scene) -> BTreeSet<PathBuf> {
    let mut files = BTreeSet::from([scene.path.clone()]);
    files.extend(
        scene
            .environment
            .iter()
            .flat_map(|environment| environment.paths.iter().cloned()),
    );
    for material in &scene.materials {
        files.extend(material.albedo.map.as_ref().map(|(path, _)| path.clone()));
        files.extend(material.normal.as_ref().map(|normal| normal.path.clone()));
        files.extend(material.height.as_ref().map(|height| height.path.clone()));
    }
    for object in &scene.objects {
        if let Shape::Obj { path } = &object.shape {
            files.insert(path.clone());
        }
    }
    files
}

fn extension(path: &Path) -> String {
    path.extension()
        .map(|e| e.to_string_lossy().to_lowercase())
        .unwrap_or_default()
}

/// The file's name without its extensions, with nothing in it that is unsafe in file names anywhere.
fn stem(path: &Path) -> String {
    let name = path
        .file_name()
        .map(|n| n.to_string_lossy().into_owned())
        .unwrap_or_default();
    let stem = name.rsplit_once('.').map_or(name.as_str(), |(stem, _)| stem);
    let is_safe = |c: char| c.is_alphanumeric() || matches!(c, '_' | '-');
    stem.chars().map(|c| if is_safe(c) { c } else { '_' }).collect()
}

/// What the call says, else what the extension says: `.frag`, or `.frag.glsl`.
fn glsl_stage(path: &Path, said: Option<Stage>) -> Option<Stage> {
    let inner = path
        .file_stem()
        .map(|stem| extension(Path::new(stem)))
        .unwrap_or_default();
    let by_extension = |extension: &str| match extension {
        "vert" => Some(Stage::Vertex),
        "frag" => Some(Stage::Fragment),
        "comp" => Some(Stage::Compute),
        _ => None,
    };
    by_extension(&extension(path))
        .or(said)
        .or_else(|| by_extension(&inner))
}

fn read_shader(path: &Path) -> Result<Vec<u8>> {
    let size = std::fs::metadata(path).map(|meta| meta.len()).unwrap_or(0);
    if size > MAX_SHADER_BYTES {
        let (path, limit) = (path.display(), MAX_SHADER_BYTES >> 20);
        return Err(Error::Call(format!(
            "{path} has {size} bytes; shaders of at most {limit} MiB are read"
        )));
    }
    read(path)
}

fn read_text(path: &Path) -> Result<String> {
    String::from_utf8(read_shader(path)?).map_err(|e| {
        let at = e.utf8_error().valid_up_to();
        Error::Call(format!("{} is not UTF-8 text (byte {at})", path.display()))
    })
}

fn stage_missing(path: &Path) -> Error {
    Error::Call(format!(
        "{}: the extension does not tell the stage; say --stage vertex, fragment or compute, or name the file .vert, .frag \
         or .comp",
        path.display()
    ))
}

fn unknown_kind(path: &Path, kind: &str) -> Error {
    let known = suggestion(kind, EXTENSIONS);
    Error::Call(format!(
        "{}: not a kind of file that is read here ({known})",
        path.display()
    ))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_stage_comes_from_the_extension_or_the_call() {
        let stage = |path: &str, said| glsl_stage(Path::new(path), said);
        assert_eq!(stage("a.vert", None), Some(Stage::Vertex));
        assert_eq!(stage("a.FRAG", None), Some(Stage::Fragment));
        assert_eq!(stage("a.comp.glsl", None), Some(Stage::Compute));
        assert_eq!(stage("a.glsl", Some(Stage::Compute)), Some(Stage::Compute));
        assert_eq!(
            stage("a.vert", Some(Stage::Compute)),
            Some(Stage::Vertex),
            "a file's own word wins"
        );
        assert_eq!(stage("a.glsl", None), None);
    }

    #[test]
    fn names_are_safe_in_file_names() {
        assert_eq!(stem(Path::new("x/My shader: 1.2.wgsl")), "My_shader__1_2");
        assert_eq!(stem(Path::new("x/été.wgsl")), "été");
    }
}
