//! A user's own `.wesl` file, with its imports.
//!
//! `package::x::y` and `super::x` are looked up in the folder of the file (`x.wesl`, then `x.wgsl`, with `::` as the folder
//! separator below it); `bossage::lib::normalise` is this library. All of the file's own declarations are kept. Where two
//! modules declare one name, the imported one is renamed after its file: `shapes_area` for `area` of `shapes.wesl`; the
//! file's own names never change.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

use wesl::ModulePath;
use wesl::syntax::PathOrigin;

use crate::assemble::{self, Job, Modules, Trees};
use crate::check::{self, Sources};
use crate::source::Source;
use crate::{AssembledShader, Library, Result, features, read};

/// The name under which a user's file imports the library.
const LIBRARY: &str = "bossage";

impl Library {
    /// A user's own `.wesl` file with its imports, which are relative to the file's folder; `bossage::…` imports from this
    /// library. The file may not name features.
    ///
    /// # Errors
    /// When a file cannot be read, has a syntax error, or imports what does not exist; with file, line and column.
    pub fn assemble_user_file(&self, path: &Path) -> Result<AssembledShader> {
        self.assemble_user_file_with(path, &BTreeMap::new())
    }

    /// The same with features for the file's `@if`. Naming one that is not given is an error.
    ///
    /// # Errors
    /// As [`Library::assemble_user_file`].
    pub fn assemble_user_file_with(
        &self,
        path: &Path,
        given: &BTreeMap<String, bool>,
    ) -> Result<AssembledShader> {
        let root = ModulePath::new(PathOrigin::Absolute, vec![stem(path)]);
        let sources = self.user_sources(path, &root)?;
        let known: Vec<&str> = given
            .keys()
            .map(String::as_str)
            .chain(features::KNOWN.iter().copied())
            .collect();
        for (key, source) in &sources {
            let names: &[&str] = if key.starts_with(LIBRARY) {
                features::KNOWN
            } else {
                &known
            };
            check::features_known(source, names)?;
        }
        let renames = renames(&sources, &root);
        let on: Vec<&str> = given
            .iter()
            .filter(|(_, on)| **on)
            .map(|(name, _)| name.as_str())
            .collect();
        let trees: Trees = sources
            .iter()
            .map(|(key, source)| (key.clone(), source.syntax.clone()))
            .collect();
        let features = assemble::features(known.iter().copied(), &on);
        let job = Job {
            root,
            keep: None,
            features,
            renames: &renames,
        };
        let assembled = assemble::assemble(
            &Modules {
                sources: &sources,
                trees: &trees,
            },
            &job,
        )?;
        Ok(AssembledShader {
            name: file_safe(&stem(path)),
            wgsl: assembled.wgsl,
            features: Vec::new(),
            modules: assembled.modules,
        })
    }

    /// The file and everything it imports, by absolute module path.
    fn user_sources(&self, path: &Path, root: &ModulePath) -> Result<Sources> {
        let folder = path.parent().unwrap_or(Path::new(""));
        let mut sources = Sources::new();
        sources.insert(
            root.to_string(),
            Source::parse(&path.display().to_string(), &read::text(path)?)?,
        );
        let mut todo = vec![root.clone()];
        while let Some(here) = todo.pop() {
            let imports = sources
                .get(&here.to_string())
                .map(|source| source.imports(&here))
                .unwrap_or_default();
            for import in imports {
                if sources.contains_key(&import.module.to_string()) {
                    continue;
                }
                if let Some(source) = self.find(folder, &import.module)? {
                    sources.insert(import.module.to_string(), source);
                    todo.push(import.module);
                }
            }
            if let Some(source) = sources.get(&here.to_string()) {
                check::imports_resolve(source, &here, &sources)?;
            }
        }
        Ok(sources)
    }

    /// A module of the user's folder or of the library. `None` where there is none; the caller tells where it was imported.
    fn find(&self, folder: &Path, module: &ModulePath) -> Result<Option<Source>> {
        match &module.origin {
            PathOrigin::Package(package) if package == LIBRARY => {
                let here = ModulePath::new(PathOrigin::Absolute, module.components.clone());
                let Some(source) = self.sources().get(&here.to_string()) else {
                    return Ok(None);
                };
                // Parsed anew: renaming must not touch the library's own tree.
                Source::parse(&format!("{LIBRARY}:{}", source.file), &source.text).map(Some)
            }
            PathOrigin::Package(_) => Ok(None),
            PathOrigin::Absolute | PathOrigin::Relative(_) => {
                let mut file = folder.to_owned();
                file.extend(&module.components);
                for extension in ["wesl", "wgsl"] {
                    // `with_extension` would cut a dot inside of the name off.
                    let candidate = file.with_file_name(format!("{}.{extension}", stem_of_module(module)));
                    if candidate.is_file() {
                        return Source::parse(&candidate.display().to_string(), &read::text(&candidate)?)
                            .map(Some);
                    }
                }
                Ok(None)
            }
        }
    }
}

/// New names for imported declarations that would clash with another module's or be caught by a local variable.
fn renames(sources: &Sources, root: &ModulePath) -> BTreeMap<(String, String), String> {
    let mut holders: BTreeMap<String, BTreeSet<&String>> = BTreeMap::new();
    for (key, source) in sources {
        for name in source.declared() {
            holders.entry(name).or_default().insert(key);
        }
    }
    let mut taken: BTreeSet<String> = holders.keys().cloned().collect();
    taken.extend(sources.values().flat_map(Source::locals));
    let captured: BTreeSet<String> = sources
        .values()
        .flat_map(|source| check::captured(source, root))
        .collect();
    let mut renames = BTreeMap::new();
    for (name, keys) in &holders {
        for key in keys.iter().filter(|key| **key != &root.to_string()) {
            if keys.len() > 1 || captured.contains(name) {
                let new = unused(key, name, &taken);
                taken.insert(new.clone());
                renames.insert(((*key).clone(), name.clone()), new);
            }
        }
    }
    renames
}

fn unused(key: &str, name: &str, taken: &BTreeSet<String>) -> String {
    let module = key.rsplit("::").next().unwrap_or(key);
    let base = format!("{module}_{name}");
    let numbered = (2_u32..).map(|number| format!("{base}_{number}"));
    std::iter::once(base.clone())
        .chain(numbered)
        .find(|candidate| !taken.contains(candidate))
        .unwrap_or(base)
}

fn stem(path: &Path) -> String {
    path.file_stem()
        .map(|stem| stem.to_string_lossy().into_owned())
        .unwrap_or_else(|| "shader".to_owned())
}

fn stem_of_module(module: &ModulePath) -> String {
    module.components.last().cloned().unwrap_or_default()
}

/// Letters, digits, `_` and `-` only.
fn file_safe(name: &str) -> String {
    let safe = |c: char| {
        if c.is_ascii_alphanumeric() || c == '_' || c == '-' {
            c
        } else {
            '_'
        }
    };
    name.chars().map(safe).collect()
}
