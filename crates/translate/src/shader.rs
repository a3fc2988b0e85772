//! A parsed, validated and compacted shader.
//!
//! A module with several entry points is split: each entry point becomes a module of its own that holds nothing else's
//! types, functions and resources, because several of naga's writers write everything that a module holds. A module with
//! one entry point is compacted in place. Either way the order of declarations is that of the source, so equal sources
//! give equal output.

use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;

use naga::compact::{KeepUnused, compact};
use naga::valid::{FunctionInfo, ModuleInfo};
use naga::{GlobalVariable, Handle, Module};

use crate::diagnostic::{Code, Diagnostic};
use crate::features::Features;
use crate::front;
use crate::guard::guard;
use crate::manifest::OverrideValue;
use crate::overrides;
use crate::repairs::repair;
use crate::resources::{Resource, resources};
use crate::source::{Language, Source};
use crate::target::Stage;

/// Values for pipeline-overridable constants, by name, or by number where the constant has an `@id`.
pub type Overrides = BTreeMap<String, f64>;

/// A shader that obeys every rule naga knows, ready to be emitted.
#[derive(Clone, Debug)]
pub struct Shader {
    name: String,
    language: Language,
    text: String,
    units: Vec<Unit>,
    unused: Vec<UnusedBinding>,
    group_bindings: BTreeSet<(u32, u32)>,
    overrides: Vec<OverrideValue>,
}

/// One entry point with all that it needs and nothing else.
#[derive(Clone, Debug)]
pub(crate) struct Unit {
    pub(crate) stage: Stage,
    pub(crate) features: Features,
    pub(crate) resources: Vec<Resource>,
    pub(crate) module: Module,
    pub(crate) info: ModuleInfo,
}

impl Unit {
    pub(crate) fn entry(&self) -> &naga::EntryPoint {
        &self.module.entry_points[0]
    }

    pub(crate) fn entry_info(&self) -> &FunctionInfo {
        self.info.get_entry_point(0)
    }
}

/// A resource that no entry point uses.
#[derive(Clone, Debug)]
pub(crate) struct UnusedBinding {
    pub(crate) name: String,
    pub(crate) range: Option<Range<usize>>,
}

impl Shader {
    /// Reads and validates a shader; overrides take their defaults.
    ///
    /// # Errors
    /// What is wrong, with its place.
    pub fn parse(name: &str, source: &Source) -> Result<Self, Diagnostic> {
        Self::parse_with(name, source, &Overrides::new())
    }

    /// Reads and validates a shader, with values for its overrides.
    ///
    /// # Errors
    /// What is wrong, with its place.
    pub fn parse_with(name: &str, source: &Source, values: &Overrides) -> Result<Self, Diagnostic> {
        guard(name, "reading the shader", || {
            let module = front::parse(name, source)?;
            Self::from_module(name, source, module, values)
        })
    }

    fn from_module(
        name: &str,
        source: &Source,
        module: Module,
        values: &Overrides,
    ) -> Result<Self, Diagnostic> {
        let text = source.text();
        let info = front::validate(name, text, &module)?;
        check_entry_points(name, text, &module)?;
        let unused = unused_bindings(text, &module, &info);
        let group_bindings = module
            .global_variables
            .iter()
            .filter_map(|(_, variable)| variable.binding)
            .map(|at| (at.group, at.binding))
            .collect();
        let overrides = overrides::describe(&module, values);
        let units = split(name, text, module, &info, values)?;
        Ok(Self {
            name: name.to_owned(),
            language: source.language(),
            text: text.to_owned(),
            units,
            unused,
            group_bindings,
            overrides,
        })
    }

    /// The name it was parsed under.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.name
    }

    /// The language it was written in.
    #[must_use]
    pub const fn language(&self) -> Language {
        self.language
    }

    /// The text it was parsed from; empty for SPIR-V.
    #[must_use]
    pub fn text(&self) -> &str {
        &self.text
    }

    /// Names and stages of its entry points, in the order of the source.
    pub fn entry_points(&self) -> impl ExactSizeIterator<Item = (&str, Stage)> {
        self.units
            .iter()
            .map(|unit| (unit.entry().name.as_str(), unit.stage))
    }

    /// The reduced module of an entry point, and naga's findings about it.
    #[must_use]
    pub fn module(&self, entry: &str) -> Option<(&Module, &ModuleInfo)> {
        self.units
            .iter()
            .find(|unit| unit.entry().name == entry)
            .map(|unit| (&unit.module, &unit.info))
    }

    pub(crate) fn units(&self) -> &[Unit] {
        &self.units
    }

    pub(crate) fn unused(&self) -> &[UnusedBinding] {
        &self.unused
    }

    pub(crate) const fn group_bindings(&self) -> &BTreeSet<(u32, u32)> {
        &self.group_bindings
    }

    pub(crate) fn overrides(&self) -> &[OverrideValue] {
        &self.overrides
    }
}

/// There must be an entry point, and every stage must be one that we emit.
fn check_entry_points(name: &str, text: &str, module: &Module) -> Result<(), Diagnostic> {
    if module.entry_points.is_empty() {
        return Err(Diagnostic::new(Code::Validate, "the shader has no entry point")
            .in_file(name)
            .with_hint("mark a function with @vertex, @fragment or @compute"));
    }
    for entry in &module.entry_points {
        if Stage::from_naga(entry.stage).is_none() {
            let message = format!(
                "entry point `{}` is of the {:?} stage; vertex, fragment and compute are supported",
                entry.name, entry.stage
            );
            return Err(Diagnostic::new(Code::Unsupported, message).at(name, text, []));
        }
    }
    Ok(())
}

fn unused_bindings(text: &str, module: &Module, info: &ModuleInfo) -> Vec<UnusedBinding> {
    let used = |handle: Handle<GlobalVariable>| {
        (0..module.entry_points.len()).any(|at| !info.get_entry_point(at)[handle].is_empty())
    };
    module
        .global_variables
        .iter()
        .filter(|(handle, variable)| variable.binding.is_some() && !used(*handle))
        .map(|(handle, variable)| UnusedBinding {
            name: variable.name.clone().unwrap_or_default(),
            range: front::range_in(text, module.global_variables.get_span(handle)),
        })
        .collect()
}

/// One unit an entry point.
fn split(
    name: &str,
    text: &str,
    mut module: Module,
    info: &ModuleInfo,
    values: &Overrides,
) -> Result<Vec<Unit>, Diagnostic> {
    if !module.overrides.is_empty() || !values.is_empty() {
        return overrides::resolve(name, text, &module, info, values);
    }
    if module.entry_points.len() == 1 {
        return Ok(vec![reduce(name, text, module)?]);
    }
    let entries = std::mem::take(&mut module.entry_points);
    entries
        .into_iter()
        .map(|entry| {
            let mut alone = module.clone();
            alone.entry_points.push(entry);
            reduce(name, text, alone)
        })
        .collect()
}

/// Drops everything that the only entry point does not reach.
pub(crate) fn reduce(name: &str, text: &str, mut module: Module) -> Result<Unit, Diagnostic> {
    compact(&mut module, KeepUnused::No);
    repair(&mut module);
    let info = front::analyze(name, text, &module)?;
    unit(module, info)
}

pub(crate) fn unit(module: Module, info: ModuleInfo) -> Result<Unit, Diagnostic> {
    let stage = Stage::from_naga(module.entry_points[0].stage)
        .ok_or_else(|| Diagnostic::new(Code::Internal, "a stage was not checked"))?;
    let mut unit = Unit {
        stage,
        features: Features::default(),
        resources: Vec::new(),
        module,
        info,
    };
    unit.features = Features::of(&unit);
    unit.resources = resources(&unit);
    Ok(unit)
}
