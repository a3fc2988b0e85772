//! `bossage emit`: files of five languages and a manifest, all or nothing, and nothing when nothing changed.
//!
//! A wrong input writes nothing (exit code 2). A target that cannot express a shader is reported with the place in the
//! source, and everything else is written (exit code 1).

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use bossage_translate::emit::spirv_listing;
use bossage_translate::{Contents, Diagnostic, EmitOptions, Manifest, Target, manifest};
use serde::Serialize;

use crate::Verdict;
use crate::args::{Global, emit::Emit};
use crate::console::{self, Console};
use crate::error::{Error, Result, read};
use crate::inputs::{self, Inputs, Planned};
use crate::output::{Outputs, Written};
use crate::stamp::{self, Stamp};
use crate::translation::{Translation, translate_all};
use crate::{depfile, options};

/// What is emitted, and where to.
#[derive(Debug)]
pub(crate) struct Job<'a> {
    pub(crate) targets: &'a [Target],
    pub(crate) options: &'a EmitOptions,
    pub(crate) folder: &'a Path,
}

/// What a job wrote.
#[derive(Debug)]
pub(crate) struct Done {
    pub(crate) translations: Vec<Translation>,
    pub(crate) written: Written,
}

impl Done {
    pub(crate) fn failures(&self) -> impl Iterator<Item = &(Target, Diagnostic)> {
        self.translations
            .iter()
            .flat_map(|translation| &translation.failures)
    }
}

pub(crate) fn run(args: &Emit, global: &Global, console: Console) -> Result<Verdict> {
    let options = options::options(&args.versions);
    let targets = options::targets(&args.target);
    let call = call(args, global, &targets, &options)?;
    let before = Stamp::load(&args.output);
    if let Some(stamp) = before
        .as_ref()
        .filter(|stamp| stamp.is_current(&call, &args.output))
    {
        write_depfile(args, stamp.read.keys().map(PathBuf::as_path))?;
        console.note(format_args!("{}: nothing changed", args.output.display()));
        return Ok(Verdict::Fine);
    }
    let inputs = inputs::gather(&args.inputs.inputs, args.inputs.stage.map(options::stage), global)?;
    let job = Job {
        targets: &targets,
        options: &options,
        folder: &args.output,
    };
    let done = job.write(&inputs, Some((call, before)))?;
    write_depfile(args, inputs.read.iter().map(PathBuf::as_path))?;
    report(&inputs, &done, &args.output, console)
}

/// Everything that the result depends on beside the contents of files.
fn call(args: &Emit, global: &Global, targets: &[Target], options: &EmitOptions) -> Result<String> {
    let stage = args.inputs.stage.map(options::stage);
    let parts = (&args.inputs.inputs, stage, targets, options, &global.shader_dir);
    serde_json::to_string(&parts).map_err(Error::Json)
}

fn write_depfile<'a>(args: &Emit, dependencies: impl Iterator<Item = &'a Path>) -> Result<()> {
    let Some(path) = &args.depfile else { return Ok(()) };
    let manifest = args.output.join(MANIFEST);
    crate::output::write_whole(path, depfile::rule(&manifest, dependencies).into_bytes())
}

fn report(inputs: &Inputs, done: &Done, folder: &Path, console: Console) -> Result<Verdict> {
    let Written { changed, unchanged } = done.written;
    let shaders = inputs.modules.len();
    console.note(format_args!(
        "{shaders} shaders, {changed} files written, {unchanged} unchanged"
    ));
    console::print(&format!("{}\n", folder.join(MANIFEST).display()))?;
    let mut verdict = Verdict::Fine;
    for (target, diagnostic) in done.failures() {
        console::warn(format_args!("{target}: {diagnostic}\n"));
        verdict = Verdict::Failed;
    }
    Ok(verdict)
}

/// The manifest's file name.
pub(crate) const MANIFEST: &str = "manifest.json";

/// The manifest of a folder: its entries, and which material of which scene uses which.
#[derive(Debug, Serialize)]
struct FolderManifest<'a> {
    #[serde(flatten)]
    manifest: Manifest,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    scenes: Vec<SceneEntry<'a>>,
}

#[derive(Debug, Serialize)]
struct SceneEntry<'a> {
    path: &'a Path,
    materials: Vec<MaterialEntry<'a>>,
}

/// Which shaders draw a material.
#[derive(Debug, Serialize)]
struct MaterialEntry<'a> {
    name: &'a str,
    technique: &'a str,
    permutation: &'a str,
    vertex: String,
    fragment: String,
    /// Drawn after the first with the same vertex stage at equal depth, its colour and alpha multiplied into the target.
    #[serde(skip_serializing_if = "Option::is_none")]
    second_pass: Option<String>,
}

impl<'a> From<&'a Planned> for SceneEntry<'a> {
    fn from(planned: &'a Planned) -> Self {
        let material = |m: &'a bossage_scene::MaterialPlan| MaterialEntry {
            name: &m.name,
            technique: m.technique,
            permutation: &m.permutation,
            vertex: m.features.vertex().name(),
            fragment: m.features.fragment().name(),
            second_pass: m.features.second_pass().map(|key| key.name()),
        };
        Self {
            path: &planned.scene.path,
            materials: planned.plan.materials.iter().map(material).collect(),
        }
    }
}

impl Job<'_> {
    /// Translates the inputs and writes the folder. With a stamp, files of an earlier run of the same call that nobody
    /// needs any more are removed.
    pub(crate) fn write(&self, inputs: &Inputs, stamp: Option<(String, Option<Stamp>)>) -> Result<Done> {
        let shaders = inputs.parse()?;
        let translations = translate_all(&inputs.modules, &shaders, self.targets, self.options);
        let files = self.files(inputs, &translations)?;
        let complete = translations
            .iter()
            .all(|translation| translation.failures.is_empty());
        let (stamp, orphans) = match stamp {
            Some((call, before)) => {
                let now = stamp_of(call, complete, inputs, &files)?;
                let orphans = before
                    .map(|before| before.orphans(&now, self.folder))
                    .unwrap_or_default();
                (Some(now), orphans)
            }
            None => (None, Vec::new()),
        };
        let written = self.commit(files, stamp)?;
        for orphan in orphans {
            std::fs::remove_file(&orphan).map_err(|source| Error::Write { path: orphan, source })?;
        }
        Ok(Done {
            translations,
            written,
        })
    }

    fn commit(&self, files: Vec<File>, stamp: Option<Stamp>) -> Result<Written> {
        let mut outputs = Outputs::default();
        for file in files {
            outputs.add(self.folder.join(&file.name), &file.origin, file.bytes)?;
        }
        if let Some(stamp) = stamp {
            let text = console::json_text(&stamp)?;
            outputs.add(self.folder.join(stamp::FILE), "the stamp", text.into_bytes())?;
        }
        outputs.commit()
    }

    fn files(&self, inputs: &Inputs, translations: &[Translation]) -> Result<Vec<File>> {
        let mut files = Vec::new();
        for (module, translation) in inputs.modules.iter().zip(translations) {
            let origin = module.input.display().to_string();
            for file in translation.emitted.iter().flat_map(|emitted| &emitted.files) {
                let mut add = |name: &str, bytes: &[u8]| {
                    files.push(File {
                        name: name.to_owned(),
                        origin: origin.clone(),
                        bytes: bytes.to_vec(),
                    });
                };
                add(&file.file_name, file.contents.bytes());
                if let Contents::Binary(bytes) = &file.contents {
                    add(
                        &format!("{}asm", file.file_name),
                        listing(&file.file_name, bytes)?.as_bytes(),
                    );
                }
            }
        }
        let text = console::json_text(&self.folder_manifest(inputs, translations))?;
        files.push(File {
            name: MANIFEST.to_owned(),
            origin: "the manifest".to_owned(),
            bytes: text.into_bytes(),
        });
        Ok(files)
    }

    fn folder_manifest<'a>(&self, inputs: &'a Inputs, translations: &[Translation]) -> FolderManifest<'a> {
        let mut manifests = translations
            .iter()
            .map(|translation| translation.manifest.clone());
        let empty = || Manifest {
            schema: manifest::SCHEMA,
            tools: BTreeMap::new(),
            options: self.options.clone(),
            entries: Vec::new(),
        };
        let mut whole = manifests.next().unwrap_or_else(empty);
        manifests.for_each(|manifest| whole.append(manifest));
        whole
            .tools
            .insert("bossage".to_owned(), env!("CARGO_PKG_VERSION").to_owned());
        FolderManifest {
            manifest: whole,
            scenes: inputs.scenes.iter().map(SceneEntry::from).collect(),
        }
    }
}

/// SPIR-V for people.
pub(crate) fn listing(name: &str, bytes: &[u8]) -> Result<String> {
    spirv_listing(bytes).map_err(|diagnostic| Error::Shaders(vec![diagnostic.in_file(name)]))
}

/// One file to write.
struct File {
    name: String,
    origin: String,
    bytes: Vec<u8>,
}

fn stamp_of(call: String, complete: bool, inputs: &Inputs, files: &[File]) -> Result<Stamp> {
    let hash = |path: &PathBuf| Ok((path.clone(), stamp::sha256(&read(path)?)));
    Ok(Stamp {
        tool: stamp::tool(),
        call,
        complete,
        read: inputs.read.iter().map(hash).collect::<Result<_>>()?,
        written: files
            .iter()
            .map(|file| (file.name.clone(), stamp::sha256(&file.bytes)))
            .collect(),
    })
}
