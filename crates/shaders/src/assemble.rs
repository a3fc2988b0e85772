//! From parsed sources to one plain WGSL module: conditions, imports, stripping, and a check that no two declarations share
//! a name.
//!
//! A parsed tree must not be used by two assemblies at once: WESL's identifiers are shared cells behind locks, and it
//! takes two read locks at a time while it renames under a write lock. [`Trees`] are therefore lent out one at a time.

use std::borrow::Cow;
use std::collections::{BTreeMap, BTreeSet};

use wesl::syntax::{PathOrigin, TranslationUnit};
use wesl::{CompileOptions, Feature, Features, Mangler, ModulePath, ResolveError, Resolver};

use crate::error::{Error, SourceError};
use crate::source::{Source, declared_name};

/// Parsed modules by absolute path, as `package::lib::normalise`.
pub(crate) type Trees = BTreeMap<String, TranslationUnit>;

/// What an assembly reads.
pub(crate) struct Modules<'a> {
    pub(crate) sources: &'a BTreeMap<String, Source>,
    pub(crate) trees: &'a Trees,
}

/// What to assemble.
pub(crate) struct Job<'a> {
    pub(crate) root: ModulePath,
    /// The declarations to keep; all of the root's where `None`.
    pub(crate) keep: Option<Vec<String>>,
    pub(crate) features: Features,
    pub(crate) renames: &'a BTreeMap<(String, String), String>,
}

/// The result, before it gets a name.
pub(crate) struct Assembled {
    pub(crate) wgsl: String,
    pub(crate) modules: Vec<String>,
}

impl Resolver for Modules<'_> {
    fn resolve_source<'b>(&'b self, path: &ModulePath) -> Result<Cow<'b, str>, ResolveError> {
        let source = self
            .sources
            .get(&path.to_string())
            .ok_or_else(|| not_found(path))?;
        Ok(Cow::Borrowed(&source.text))
    }

    fn resolve_module(&self, path: &ModulePath) -> Result<TranslationUnit, ResolveError> {
        self.trees
            .get(&path.to_string())
            .cloned()
            .ok_or_else(|| not_found(path))
    }

    fn display_name(&self, path: &ModulePath) -> Option<String> {
        self.sources
            .get(&path.to_string())
            .map(|source| source.file.clone())
    }
}

fn not_found(path: &ModulePath) -> ResolveError {
    ResolveError::ModuleNotFound(path.clone(), "no such file".to_owned())
}

struct Renames<'a>(&'a BTreeMap<(String, String), String>);

impl Mangler for Renames<'_> {
    fn mangle(&self, path: &ModulePath, item: &str) -> String {
        self.0
            .get(&(path.to_string(), item.to_owned()))
            .cloned()
            .unwrap_or_else(|| item.to_owned())
    }
}

/// The features of a module: those named are on, all others known are off, unknown ones are errors.
pub(crate) fn features<'a>(known: impl IntoIterator<Item = &'a str>, on: &[&str]) -> Features {
    let flags = known
        .into_iter()
        .map(|name| (name.to_owned(), Feature::from(on.contains(&name))))
        .collect();
    Features {
        default: Feature::Error,
        flags,
    }
}

/// Assembles one module.
pub(crate) fn assemble(modules: &Modules<'_>, job: &Job<'_>) -> Result<Assembled, Error> {
    let options = CompileOptions {
        validate: false,
        keep_root: job.keep.is_none(),
        keep: job.keep.clone(),
        features: job.features.clone(),
        ..CompileOptions::default()
    };
    let result = wesl::compile(&job.root, modules, &Renames(job.renames), &options)
        .map_err(|error| translated(error, modules, &job.root))?;
    if let Some(name) = twice_declared(&result.syntax) {
        return Err(declared_twice(&name, modules, &result.modules).into());
    }
    let wgsl = result.syntax.to_string();
    let files = result
        .modules
        .iter()
        .filter_map(|path| modules.display_name(path))
        .collect();
    Ok(Assembled { wgsl, modules: files })
}

fn twice_declared(syntax: &TranslationUnit) -> Option<String> {
    let mut seen = BTreeSet::new();
    syntax
        .global_declarations
        .iter()
        .filter_map(|it| declared_name(it.node()))
        .find(|name| !seen.insert(name.clone()))
}

fn declared_twice(name: &str, modules: &Modules<'_>, used: &[ModulePath]) -> SourceError {
    let holders: Vec<&Source> = used
        .iter()
        .filter_map(|path| modules.sources.get(&path.to_string()))
        .filter(|source| source.declared().any(|declared| declared == name))
        .collect();
    let others = holders
        .iter()
        .skip(1)
        .map(|source| format!("`{}`", source.file))
        .collect::<Vec<_>>()
        .join(", ");
    let message = format!("`{name}` is declared twice in one module; names are not mangled");
    match holders.first() {
        Some(first) if !others.is_empty() => first
            .fault_at_word(name, message)
            .hint(format!("also declared in {others}")),
        Some(first) => first.fault_at_word(name, message),
        None => SourceError::in_file(message, "assembled module"),
    }
}

/// WESL's error as one of ours, with the best place that can be told.
fn translated(error: wesl::Error, modules: &Modules<'_>, root: &ModulePath) -> Error {
    let message = summary(&error);
    let diagnostic = wesl::Diagnostic::<wesl::Error>::from(error);
    let detail = &diagnostic.detail;
    let path = detail.module_path.as_ref().unwrap_or(root);
    let source = modules.sources.get(&path.to_string());
    let place = match (source, &detail.span) {
        (Some(source), Some(span)) => SourceError::at(message, &source.file, &source.text, span.range()),
        (Some(source), None) => SourceError::in_file(message, &source.file),
        (None, _) => SourceError::in_file(message, &path.to_string()),
    };
    place.into()
}

/// The innermost message, without the rendering of a diagnostic around it.
fn summary(error: &wesl::Error) -> String {
    match error {
        wesl::Error::Error(diagnostic) => summary(&diagnostic.error),
        wesl::Error::ParseError(parse) => parse.error.to_string(),
        wesl::Error::ResolveError(ResolveError::Error(diagnostic)) => summary(&diagnostic.error),
        wesl::Error::ImportError(wesl::ImportError::ResolveError(ResolveError::Error(diagnostic))) => {
            summary(&diagnostic.error)
        }
        wesl::Error::ValidateError(_)
        | wesl::Error::ResolveError(_)
        | wesl::Error::ImportError(_)
        | wesl::Error::CondCompError(_)
        | wesl::Error::GenericsError(_)
        | wesl::Error::Custom(_) => error.to_string(),
    }
}

/// The absolute path of a library file, as `lib/normalise.wesl`.
pub(crate) fn path_of_file(origin: PathOrigin, file: &str) -> ModulePath {
    let stem = file.strip_suffix(".wesl").unwrap_or(file);
    ModulePath::new(origin, stem.split('/').map(str::to_owned).collect())
}
