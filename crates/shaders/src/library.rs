//! The library of shader sources, read and checked once, and assembled as often as needed.

use std::collections::BTreeMap;
use std::path::Path;
use std::sync::{Mutex, PoisonError};

use include_dir::{Dir, include_dir};
use wesl::ModulePath;
use wesl::syntax::PathOrigin;

use crate::assemble::{self, Assembled, Job, Modules, Trees, path_of_file};
use crate::check::{self, Sources};
use crate::feature_set::Relief;
use crate::features::Variant;
use crate::source::Source;
use crate::{
    Error, FeatureSet, FragmentKey, Kernel, PROBES, ProbeId, Result, Stage, TECHNIQUES, features,
    probe_entry, read,
};

static EMBEDDED: Dir<'static> = include_dir!("$CARGO_MANIFEST_DIR/../../shaders");
const VERTEX_FILE: &str = "entry/surface_vertex.wesl";
const FRAGMENT_FILE: &str = "entry/surface_fragment.wesl";
/// The module path that a probe's written root takes.
const PROBE_ROOT: &str = "entry/probe.wesl";
/// The module path of text that is written elsewhere; no file of the library lies there.
const TEXT_ROOT: &str = "written/kernel.wesl";

/// One plain WGSL module.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct AssembledShader {
    /// A stable name, safe as a file name.
    pub name: String,
    /// The text.
    pub wgsl: String,
    /// The features that were on, sorted.
    pub features: Vec<&'static str>,
    /// The source files that went in, root first.
    pub modules: Vec<String>,
}

/// The sources, read, parsed and checked.
///
/// Reading the embedded sources takes some milliseconds; keep the library. It can be shared between threads: parsed trees
/// are pooled, so the first assembly of each thread that runs at the same time parses anew and later ones do not.
#[derive(Debug)]
pub struct Library {
    /// Where the sources come from, for messages.
    origin: String,
    sources: Sources,
    pool: Mutex<Vec<Trees>>,
}

impl Library {
    /// The sources built into this binary.
    ///
    /// # Errors
    /// Only if this binary was built from a faulty library.
    pub fn embedded() -> Result<Self> {
        let mut files = BTreeMap::new();
        collect(&EMBEDDED, &mut files)?;
        Self::from_files("this binary".to_owned(), &files)
    }

    /// The sources of a folder laid out as `/shaders`.
    ///
    /// # Errors
    /// When the folder or a file cannot be read, a file that the tables name is missing, a source has a syntax error, names a
    /// feature that does not exist, or imports what does not exist.
    pub fn from_dir(dir: &Path) -> Result<Self> {
        Self::from_files(format!("`{}`", dir.display()), &read::folder(dir)?)
    }

    fn from_files(origin: String, files: &BTreeMap<String, String>) -> Result<Self> {
        let mut sources = Sources::new();
        for (file, text) in files {
            let path = path_of_file(PathOrigin::Absolute, file);
            sources.insert(path.to_string(), Source::parse(file, text)?);
        }
        let library = Library {
            origin,
            sources,
            pool: Mutex::new(Vec::new()),
        };
        library.check(files)?;
        Ok(library)
    }

    fn check(&self, files: &BTreeMap<String, String>) -> Result<()> {
        if let Some(file) = roots().into_iter().find(|file| !files.contains_key(*file)) {
            return Err(Error::MissingFile {
                library: self.origin.clone(),
                file: file.to_owned(),
            });
        }
        for file in files.keys() {
            let path = path_of_file(PathOrigin::Absolute, file);
            let Some(source) = self.sources.get(&path.to_string()) else {
                continue;
            };
            check::features_known(source, features::KNOWN)?;
            check::imports_resolve(source, &path, &self.sources)?;
            check::no_capture(source, &path)?;
        }
        Ok(())
    }

    /// The files that neither a table nor an import reaches. None in a healthy library; a test holds that.
    #[must_use]
    pub fn orphans(&self) -> Vec<String> {
        let roots: Vec<ModulePath> = roots()
            .into_iter()
            .map(|file| path_of_file(PathOrigin::Absolute, file))
            .collect();
        check::orphans(&self.sources, &roots)
    }

    /// The names of the features that the sources use, sorted.
    #[must_use]
    pub fn features_used(&self) -> Vec<String> {
        let mut names: Vec<String> = self
            .sources
            .values()
            .flat_map(|source| features::used(&source.syntax))
            .map(|(name, _)| name)
            .collect();
        names.sort();
        names.dedup();
        names
    }

    /// The functions of `lib/` and `techniques/` as (file, function), sorted: what probes must cover.
    #[must_use]
    pub fn functions(&self) -> Vec<(String, String)> {
        let pure =
            |source: &&Source| source.file.starts_with("lib/") || source.file.starts_with("techniques/");
        let mut all: Vec<(String, String)> = self
            .sources
            .values()
            .filter(pure)
            .flat_map(|source| {
                source
                    .functions()
                    .into_iter()
                    .map(|name| (source.file.clone(), name))
            })
            .collect();
        all.sort();
        all
    }

    /// The functions of `lib/` and `techniques/` that take a texture, by name: no probe can bind one, so kernels run them.
    #[must_use]
    pub fn texture_functions(&self) -> Vec<String> {
        let pure =
            |source: &&Source| source.file.starts_with("lib/") || source.file.starts_with("techniques/");
        self.sources
            .values()
            .filter(pure)
            .flat_map(Source::texture_functions)
            .collect()
    }

    /// One stage of the surface shader for a feature set (taken in its canonical form). Without a second pass, the module of
    /// [`Stage::SecondPass`] is that of the first.
    ///
    /// # Errors
    /// When the sources do not assemble.
    pub fn assemble_surface(&self, set: &FeatureSet, stage: Stage) -> Result<AssembledShader> {
        let (file, entry, on) = match stage {
            Stage::Vertex => (VERTEX_FILE, "surface_vertex", features::of_vertex(&set.vertex())),
            Stage::Fragment => fragment(&set.fragment(), Variant::Plain),
            Stage::FragmentCapture => fragment(&set.fragment(), Variant::Capture),
            Stage::FragmentGivenHit if set.canonical().relief == Relief::Exact => {
                fragment(&set.fragment(), Variant::GivenHit)
            }
            Stage::FragmentGivenHit => fragment(&set.fragment(), Variant::Plain),
            Stage::SecondPass => fragment(
                &set.second_pass().unwrap_or_else(|| set.fragment()),
                Variant::Plain,
            ),
        };
        let name = set.module_name(stage);
        self.assemble(file, entry, name, on)
    }

    /// The compute module that runs one function over arrays.
    ///
    /// # Errors
    /// [`Error::UnknownProbe`], or when the sources do not assemble.
    pub fn assemble_probe(&self, id: ProbeId) -> Result<AssembledShader> {
        let probe = id.probe().ok_or_else(|| Error::UnknownProbe(id.to_string()))?;
        self.assemble_root(PROBE_ROOT, &probe_entry::source(probe), probe.entry)
    }

    /// A compute module whose root is written elsewhere: WESL text that imports from this library as its own files do
    /// (`package::lib::normalise::normalise`), stripped to what `entry` needs. `name` is the module's.
    ///
    /// ```
    /// let library = bossage_shaders::Library::embedded()?;
    /// let text = "
    ///     import package::lib::lambert::lambert;
    ///     @group(0) @binding(0) var<storage, read_write> outputs: array<f32>;
    ///     @compute @workgroup_size(1) fn lit() { outputs[0] = lambert(vec3f(0.0, 0.0, 1.0), vec3f(0.6, 0.0, 0.8)); }";
    /// let kernel = library.assemble_text("lit", text, "lit")?;
    /// assert!(kernel.wgsl.contains("fn lambert("));
    /// # Ok::<(), bossage_shaders::Error>(())
    /// ```
    ///
    /// # Errors
    /// When the text has a syntax error or imports what does not exist, with line and column.
    pub fn assemble_text(&self, name: &str, text: &str, entry: &str) -> Result<AssembledShader> {
        let assembled = self.assemble_root(TEXT_ROOT, text, entry)?;
        Ok(AssembledShader {
            name: name.to_owned(),
            ..assembled
        })
    }

    /// A root that is no file of the library, for as long as it is assembled.
    fn assemble_root(&self, file: &str, text: &str, entry: &str) -> Result<AssembledShader> {
        let root = Source::parse(file, text)?;
        let path = path_of_file(PathOrigin::Absolute, file);
        check::imports_resolve(&root, &path, &self.sources)?;
        let mut trees = self.borrow_trees()?;
        trees.insert(path.to_string(), root.syntax);
        let assembled = self.run(&trees, path.clone(), entry, &[]);
        trees.remove(&path.to_string());
        self.give_back(trees);
        let mut shader = named(entry.to_owned(), Vec::new(), assembled?);
        shader.modules.insert(0, file.to_owned());
        Ok(shader)
    }

    /// A compute kernel.
    ///
    /// # Errors
    /// When the sources do not assemble.
    pub fn assemble_kernel(&self, kernel: Kernel) -> Result<AssembledShader> {
        self.assemble(kernel.file(), kernel.entry(), kernel.name(), kernel.features())
    }

    fn assemble(
        &self,
        file: &str,
        entry: &str,
        name: String,
        on: Vec<&'static str>,
    ) -> Result<AssembledShader> {
        let trees = self.borrow_trees()?;
        let assembled = self.run(&trees, path_of_file(PathOrigin::Absolute, file), entry, &on);
        self.give_back(trees);
        Ok(named(name, on, assembled?))
    }

    fn run(&self, trees: &Trees, root: ModulePath, entry: &str, on: &[&str]) -> Result<Assembled> {
        let modules = Modules {
            sources: &self.sources,
            trees,
        };
        let features = assemble::features(features::KNOWN.iter().copied(), on);
        let job = Job {
            root,
            keep: Some(vec![entry.to_owned()]),
            features,
            renames: &BTreeMap::new(),
        };
        assemble::assemble(&modules, &job)
    }

    /// Trees for one assembly at a time, from the pool or parsed anew.
    fn borrow_trees(&self) -> Result<Trees> {
        let pooled = self.pool.lock().unwrap_or_else(PoisonError::into_inner).pop();
        match pooled {
            Some(trees) => Ok(trees),
            None => self.parse_trees(),
        }
    }

    fn give_back(&self, trees: Trees) {
        self.pool
            .lock()
            .unwrap_or_else(PoisonError::into_inner)
            .push(trees);
    }

    /// Fresh trees of all sources.
    fn parse_trees(&self) -> Result<Trees> {
        let parse = |(path, source): (&String, &Source)| {
            Source::parse(&source.file, &source.text).map(|fresh| (path.clone(), fresh.syntax))
        };
        self.sources.iter().map(parse).collect()
    }

    /// The sources themselves.
    pub(crate) fn sources(&self) -> &Sources {
        &self.sources
    }
}

/// File, entry and features of a fragment module.
fn fragment(key: &FragmentKey, variant: Variant) -> (&'static str, &'static str, Vec<&'static str>) {
    (
        FRAGMENT_FILE,
        "surface_fragment",
        features::of_fragment(key, variant),
    )
}

/// The files that tables name, and therefore must exist.
fn roots() -> Vec<&'static str> {
    let mut files = vec![VERTEX_FILE, FRAGMENT_FILE];
    files.extend(Kernel::all().map(Kernel::file));
    files.extend(TECHNIQUES.iter().flat_map(|technique| technique.files));
    files.extend(PROBES.iter().map(|probe| probe.file));
    files
}

fn named(name: String, features: Vec<&'static str>, assembled: Assembled) -> AssembledShader {
    let listed = if features.is_empty() {
        "none".to_owned()
    } else {
        features.join(", ")
    };
    let wgsl = format!("// {name}\n// features: {listed}\n\n{}", assembled.wgsl);
    AssembledShader {
        name,
        wgsl,
        features,
        modules: assembled.modules,
    }
}

fn collect(dir: &Dir<'_>, files: &mut BTreeMap<String, String>) -> Result<()> {
    for file in dir.files() {
        if file
            .path()
            .extension()
            .is_some_and(|extension| extension == "wesl")
        {
            let text = file.contents_utf8().ok_or_else(|| Error::NotText {
                path: file.path().to_owned(),
            })?;
            files.insert(read::slashed(file.path()), text.to_owned());
        }
    }
    dir.dirs().try_for_each(|dir| collect(dir, files))
}
