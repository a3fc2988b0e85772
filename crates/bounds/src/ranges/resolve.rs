//! A sidecar and an entry point become [`Inputs`].

use super::infer;
use super::layout::{Leaf, Target, Walk};
use super::parse::{Declared, Entry, Said};
use super::pattern::{Step, written};
use super::report::{Report, suggestion};
use super::{Group, InputScalar, Inputs, SamplerInput, TextureInput, Values};
use crate::error::{Error, Result};
use crate::kind::Kind;
use crate::texture::{Dimension, TexelFormat};
use naga::valid::ModuleInfo;
use naga::{AddressSpace, ArraySize, ImageClass, ImageDimension, Module, ScalarKind, TypeInner};
use std::collections::BTreeSet;

/// Side of a texture whose size nobody declared.
const DEFAULT_SIDE: u32 = 4;

impl Inputs {
    /// The inputs of an entry point: what the sidecar declares of it, and the inferred rest.
    ///
    /// # Errors
    /// [`Error::NoEntryPoint`], [`Error::Unsupported`], or [`Error::Ranges`] for a declaration that does not fit what it names.
    /// That a key names nothing is not an error here, since another entry point may have it: see [`Declared::check`].
    pub fn new(module: &Module, info: &ModuleInfo, entry: &str, declared: Option<&Declared>) -> Result<Self> {
        let index = module
            .entry_points
            .iter()
            .position(|e| e.name == entry)
            .ok_or_else(|| crate::compile::program::no_entry(module, entry))?;
        let declared_size = |name: &str| plain_size(declared, name).and_then(|size| size.first().copied());
        let longest = longest_size(module, info, index, &declared_size);
        let size_of = |name: &str| declared_size(name).unwrap_or(longest);
        let mut walk = Walk {
            module,
            leaves: Vec::new(),
            buffers: Vec::new(),
            elements: &size_of,
        };
        walk.stage_inputs(&module.entry_points[index])?;
        walk.buffers(info, index)?;
        let mut inputs = Self {
            groups: groups(&walk.leaves),
            scalars: walk
                .leaves
                .iter()
                .map(|l| InputScalar {
                    target: l.target,
                    kind: l.kind,
                })
                .collect(),
            textures: Vec::new(),
            samplers: Vec::new(),
            workgroups: declared.and_then(|d| d.workgroups).unwrap_or([1; 3]),
            buffers: walk.buffers,
            used: BTreeSet::new(),
        };
        inputs.handles(module, info, index, declared)?;
        if let Some(declared) = declared {
            inputs.declare(&walk.leaves, declared)?;
        }
        Ok(inputs)
    }

    /// Textures and samplers.
    fn handles(
        &mut self,
        module: &Module,
        info: &ModuleInfo,
        entry: usize,
        declared: Option<&Declared>,
    ) -> Result<()> {
        let uses = info.get_entry_point(entry);
        for (handle, variable) in module.global_variables.iter() {
            let Some(at) = variable
                .binding
                .filter(|_| variable.space == AddressSpace::Handle)
            else {
                continue;
            };
            if uses[handle].is_empty() {
                continue;
            }
            let name = variable.name.clone().unwrap_or_default();
            let (inner, count) = match module.types[variable.ty].inner {
                TypeInner::BindingArray { base, size } => (&module.types[base].inner, array_count(size)),
                ref inner => (inner, 1),
            };
            let binding = (at.group, at.binding);
            if let TypeInner::Sampler { comparison } = *inner {
                self.samplers.push(SamplerInput {
                    binding,
                    comparison,
                    count,
                });
            } else if let TypeInner::Image { dim, arrayed, class } = *inner {
                let size = plain_size(declared, &name);
                self.textures
                    .push(texture(&name, binding, (dim, arrayed, class), count, size));
            }
        }
        Ok(())
    }

    fn declare(&mut self, leaves: &[Leaf], declared: &Declared) -> Result<()> {
        let mut report = Report::new(&declared.file, &declared.text);
        for (number, entry) in declared.entries.iter().enumerate() {
            let texture = self
                .textures
                .iter_mut()
                .find(|texture| entry.pattern.is_plain() && texture.name == entry.pattern.head());
            if let Some(texture) = texture {
                self.used.insert(number);
                declare_texture(texture, entry, &mut report);
                continue;
            }
            if entry.size.is_some() && self.declares_written(entry, &mut report) {
                self.used.insert(number);
                continue;
            }
            let matched: Vec<usize> = (0..leaves.len())
                .filter(|&k| entry.pattern.matches(&leaves[k].path))
                .collect();
            if !matched.is_empty() {
                self.used.insert(number);
                self.declare_scalars(leaves, &matched, entry, &mut report);
            }
        }
        report.check(()).map_err(Error::Ranges)
    }

    /// Whether a range names a run-time sized array that the shader only writes: that has a size and nothing else to choose.
    fn declares_written(&self, entry: &Entry, report: &mut Report) -> bool {
        let found = self.buffers.iter().any(|buffer| {
            let is_named = entry.pattern.is_plain() && buffer.name == entry.pattern.head();
            is_named && buffer.first.is_none() && buffer.elements > 0
        });
        if found && entry.values.is_some() {
            let message = format!("`{}` is only written, so it has no values to choose", entry.key);
            report.note(entry.values_span.clone(), message, "leave its size alone here");
        }
        found
    }

    fn declare_scalars(&mut self, leaves: &[Leaf], matched: &[usize], entry: &Entry, report: &mut Report) {
        let Some(said) = &entry.values else {
            return;
        };
        let runs = if entry.pattern.takes_a_run() {
            consecutive(matched)
        } else {
            by_vector(leaves, matched)
        };
        for run in runs {
            match values_of(said, run.len()) {
                Ok(values) => self.replace(run, &values, leaves),
                Err(message) => {
                    let name = written(vector_path(&leaves[run.start].path));
                    report.note(
                        entry.values_span.clone(),
                        format!("{message}, and {name} has {}", scalars(run.len())),
                        "give one number for all components, or one for each",
                    );
                    return;
                }
            }
        }
    }

    /// Puts values on a run of scalars; groups that lie across its ends are cut.
    fn replace(&mut self, run: std::ops::Range<usize>, values: &Values, leaves: &[Leaf]) {
        let mut groups = Vec::with_capacity(self.groups.len() + 2);
        for group in self.groups.drain(..) {
            let (start, end) = (group.scalars.start, group.scalars.end);
            if end <= run.start || start >= run.end {
                groups.push(group);
                continue;
            }
            groups.extend(part(&group, start..run.start.max(start), leaves));
            groups.extend(part(&group, run.end.min(end)..end, leaves));
        }
        groups.push(Group {
            name: name_of(leaves, &run),
            scalars: run,
            values: values.clone(),
            declared: true,
        });
        groups.sort_by_key(|group| group.scalars.start);
        self.groups = groups;
    }
}

impl Declared {
    /// Checks that every key names something in at least one of the entry points; `known` lists what there is.
    ///
    /// # Errors
    /// The keys that name nothing, each with the nearest name.
    pub fn check(&self, inputs: &[Inputs]) -> Result<(), Box<Report>> {
        let mut report = Report::new(&self.file, &self.text);
        let names: BTreeSet<String> = inputs.iter().flat_map(Inputs::names).collect();
        let names: Vec<&str> = names.iter().map(String::as_str).collect();
        for (number, entry) in self.entries.iter().enumerate() {
            if inputs.iter().any(|i| i.used.contains(&number)) {
                continue;
            }
            let message = format!("the shader has no input `{}`", entry.key);
            report.note(
                entry.span.clone(),
                message,
                suggestion(&entry.key, "it has", &names),
            );
        }
        report.check(())
    }
}

impl Inputs {
    /// Names of all inputs, as a sidecar may write them; elements of arrays as `[]`.
    fn names(&self) -> Vec<String> {
        let mut names: Vec<String> = self
            .groups
            .iter()
            .map(|group| without_numbers(&group.name))
            .collect();
        names.extend(self.textures.iter().map(|texture| texture.name.clone()));
        let written = self
            .buffers
            .iter()
            .filter(|buffer| buffer.first.is_none() && buffer.elements > 0);
        names.extend(written.map(|buffer| buffer.name.clone()));
        names
    }
}

fn without_numbers(name: &str) -> String {
    let mut inside = false;
    name.chars()
        .filter(|c| {
            inside = (inside || *c == '[') && *c != ']';
            !inside || *c == '['
        })
        .collect()
}

fn array_count(size: ArraySize) -> u32 {
    match size {
        ArraySize::Constant(n) => n.get(),
        ArraySize::Pending(_) | ArraySize::Dynamic => 1,
    }
}

/// The longest declared size of a buffer that the entry point uses: what arrays without a size get, since the arrays of a shader often
/// belong together.
fn longest_size(
    module: &Module,
    info: &ModuleInfo,
    entry: usize,
    declared: &dyn Fn(&str) -> Option<u32>,
) -> u32 {
    let uses = info.get_entry_point(entry);
    let buffers = module.global_variables.iter().filter(|(handle, variable)| {
        !uses[*handle].is_empty() && matches!(variable.space, AddressSpace::Storage { .. })
    });
    let sizes = buffers.filter_map(|(_, variable)| declared(variable.name.as_deref()?));
    sizes.max().unwrap_or(infer::DEFAULT_ELEMENTS)
}

fn plain_size<'a>(declared: Option<&'a Declared>, name: &str) -> Option<&'a [u32]> {
    let entries = &declared?.entries;
    let entry = entries
        .iter()
        .find(|e| e.pattern.is_plain() && e.pattern.head() == name)?;
    entry.size.as_deref()
}

/// One group a vector, scalar or matrix column, with inferred values.
fn groups(leaves: &[Leaf]) -> Vec<Group> {
    let mut out = Vec::new();
    for run in by_vector(leaves, &(0..leaves.len()).collect::<Vec<_>>()) {
        let leaf = &leaves[run.start];
        let parts = match leaf.target {
            Target::Stage { slot, .. } if !matches!(slot, crate::stage::Slot::Location(..)) => {
                infer::builtin(slot, leaf.kind, run.len())
            }
            Target::Stage { .. } | Target::Buffer { .. } => infer::values(&leaf.path, leaf.kind, run.len()),
        };
        let mut at = run.start;
        for (n, values) in parts {
            let scalars = at..at + n;
            at += n;
            out.push(Group {
                name: name_of(leaves, &scalars),
                scalars,
                values,
                declared: false,
            });
        }
    }
    out
}

/// What is left of a group when a neighbour takes the rest: a part of a unit vector is between −1 and 1.
fn part(group: &Group, rest: std::ops::Range<usize>, leaves: &[Leaf]) -> Option<Group> {
    if rest.is_empty() {
        return None;
    }
    let values = match &group.values {
        Values::Between(bounds) => {
            let start = rest.start - group.scalars.start;
            Values::Between(bounds[start..start + rest.len()].to_vec())
        }
        Values::Unit => Values::Between(vec![(-1.0, 1.0); rest.len()]),
        Values::OneOf(list) => Values::OneOf(list.clone()),
    };
    Some(Group {
        name: name_of(leaves, &rest),
        scalars: rest,
        values,
        declared: group.declared,
    })
}

/// The name of a run of scalars: of the vector, of a part of it, or of the first element of several.
fn name_of(leaves: &[Leaf], run: &std::ops::Range<usize>) -> String {
    let (first, last) = (&leaves[run.start].path, &leaves[run.end - 1].path);
    let (stem, Some(Step::Component(_))) = (vector_path(first), first.last()) else {
        return if run.len() == 1 {
            written(first)
        } else {
            format!("{}..{}", written(first), written(last))
        };
    };
    if vector_path(last) != stem {
        return format!("{}..{}", written(stem), written(vector_path(last)));
    }
    // Components of one vector stand side by side, so its neighbours tell whether this is all of it.
    let within = |at: Option<usize>| {
        at.and_then(|k| leaves.get(k))
            .is_some_and(|leaf| vector_path(&leaf.path) == stem)
    };
    let whole = !within(run.start.checked_sub(1)) && !within(Some(run.end));
    if whole {
        return written(stem);
    }
    let letters: String = leaves[run.clone()]
        .iter()
        .filter_map(|leaf| match leaf.path.last() {
            Some(Step::Component(c)) => "xyzw".chars().nth(usize::from(*c)),
            Some(Step::Name(_) | Step::Index(_)) | None => None,
        })
        .collect();
    format!("{}.{letters}", written(stem))
}

fn vector_path(path: &[Step]) -> &[Step] {
    match path.last() {
        Some(Step::Component(_)) => &path[..path.len() - 1],
        Some(Step::Name(_) | Step::Index(_)) | None => path,
    }
}

fn consecutive(numbers: &[usize]) -> Vec<std::ops::Range<usize>> {
    let mut out: Vec<std::ops::Range<usize>> = Vec::new();
    for &n in numbers {
        match out.last_mut() {
            Some(run) if run.end == n => run.end += 1,
            Some(_) | None => out.push(n..n + 1),
        }
    }
    out
}

fn by_vector(leaves: &[Leaf], numbers: &[usize]) -> Vec<std::ops::Range<usize>> {
    let mut out: Vec<std::ops::Range<usize>> = Vec::new();
    for &n in numbers {
        let same = |run: &std::ops::Range<usize>| {
            let (a, b) = (&leaves[run.start].path, &leaves[n].path);
            run.end == n && matches!(b.last(), Some(Step::Component(_))) && vector_path(a) == vector_path(b)
        };
        match out.last_mut() {
            Some(run) if same(run) => run.end += 1,
            Some(_) | None => out.push(n..n + 1),
        }
    }
    out
}

fn scalars(n: usize) -> String {
    let plural = if n == 1 { "" } else { "s" };
    format!("{n} scalar{plural}")
}

fn values_of(said: &Said, n: usize) -> Result<Values, String> {
    match said {
        Said::Unit if n < 2 => Err("a unit vector is more than one scalar".to_owned()),
        Said::Unit => Ok(Values::Unit),
        Said::OneOf(list) => Ok(Values::OneOf(list.clone())),
        Said::Between(lo, hi) => {
            let many = lo.len().max(hi.len());
            if many != 1 && many != n {
                return Err(format!("{many} bounds"));
            }
            let pairs = lo.iter().cycle().zip(hi.iter().cycle()).take(n);
            Ok(Values::Between(pairs.map(|(l, h)| (*l, *h)).collect()))
        }
    }
}

fn declare_texture(texture: &mut TextureInput, entry: &Entry, report: &mut Report) {
    match entry.values.as_ref().map(|said| values_of(said, 4)) {
        None => {}
        Some(Ok(Values::Between(bounds))) => {
            texture.declared = true;
            for (channel, bound) in texture.channels.iter_mut().zip(bounds) {
                *channel = bound;
            }
        }
        Some(Ok(Values::Unit | Values::OneOf(_)) | Err(_)) => report.note(
            entry.values_span.clone(),
            format!("texels of `{}` have a lower and an upper end", texture.name),
            "give lo and hi: one number for all channels, or four",
        ),
    }
    let wanted = match texture.dimension {
        Dimension::D1 => 1,
        Dimension::D2 => 2,
        Dimension::D3 => 3,
        Dimension::Cube => 1,
    };
    if entry.size.as_ref().is_some_and(|size| size.len() != wanted) {
        report.note(
            entry.size_span.clone(),
            format!("`{}` has {wanted} size(s)", texture.name),
            "width, width and height, or width, height and depth; a cube has one side",
        );
    }
}

fn texture(
    name: &str,
    binding: (u32, u32),
    (dim, arrayed, class): (ImageDimension, bool, ImageClass),
    count: u32,
    size: Option<&[u32]>,
) -> TextureInput {
    let side = |k: usize| size.and_then(|s| s.get(k).copied()).unwrap_or(DEFAULT_SIDE);
    let (dimension, size) = match dim {
        ImageDimension::D1 => (Dimension::D1, [side(0), 1, 1]),
        ImageDimension::D2 => (Dimension::D2, [side(0), side(1), 1]),
        ImageDimension::D3 => (Dimension::D3, [side(0), side(1), side(2)]),
        ImageDimension::Cube => (Dimension::Cube, [side(0), side(0), 1]),
    };
    let multi = matches!(
        class,
        ImageClass::Sampled { multi: true, .. } | ImageClass::Depth { multi: true }
    );
    let format = format_of(class);
    let layers = if arrayed { 2 } else { 1 } * if dimension == Dimension::Cube { 6 } else { 1 };
    let (lo, hi) = match format.kind() {
        Kind::Int(t) if t.signed => (-128.0, 127.0),
        Kind::Int(_) => (0.0, 255.0),
        Kind::Float(_) | Kind::Bool => (0.0, 1.0),
    };
    TextureInput {
        name: name.to_owned(),
        binding,
        dimension,
        size,
        layers,
        samples: if multi { 4 } else { 1 },
        count,
        format,
        channels: [(lo, hi); 4],
        declared: false,
        storage: matches!(class, ImageClass::Storage { .. }),
    }
}

fn format_of(class: ImageClass) -> TexelFormat {
    match class {
        ImageClass::Sampled { kind, .. } => match kind {
            ScalarKind::Sint => TexelFormat::Rgba32Sint,
            ScalarKind::Uint | ScalarKind::Bool => TexelFormat::Rgba32Uint,
            ScalarKind::Float | ScalarKind::AbstractInt | ScalarKind::AbstractFloat => {
                TexelFormat::Rgba32Float
            }
        },
        ImageClass::Depth { .. } => TexelFormat::Depth32Float,
        ImageClass::External => TexelFormat::Rgba32Float,
        ImageClass::Storage { format, .. } => TexelFormat::of_storage(format),
    }
}
