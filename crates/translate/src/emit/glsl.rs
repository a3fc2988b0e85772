//! GLSL, one stage a file, with every resource's name and number stated.
//!
//! naga joins a texture and the sampler it is used with into one combined sampler, named after the texture; a texture that
//! is used with two samplers cannot be expressed. Numbers follow [`GlslUnits`]; versions without `layout(binding)` get the
//! same numbers in the manifest, to be set by name.

use std::collections::{BTreeMap, BTreeSet};

use naga::back::glsl;
use naga::proc::BoundsCheckPolicies;
use naga::{BuiltIn, GlobalVariable, Handle};

use crate::diagnostic::{Code, Diagnostic};
use crate::emit::{Contents, Job, Placement, Slot, Written, glsl_features};
use crate::manifest::{GlslImmediate, GlslSlot, Kind};
use crate::options::GlslUnits;
use crate::resources::Resource;

/// The stride of [`GlslUnits::Auto`].
const AUTO_STRIDE: u32 = 8;

/// naga's name of the uniform that stands for the first instance.
const FIRST_INSTANCE: &str = "naga_vs_first_instance";

pub(super) fn write(job: &Job<'_>) -> Result<Written, Diagnostic> {
    let pairs = sampler_pairs(job)?;
    let units = units(job)?;
    let options = naga_options(job, &units)?;
    let pipeline = glsl::PipelineOptions {
        shader_stage: job.unit.stage.to_naga(),
        entry_point: job.unit.entry().name.clone(),
        multiview: None,
    };
    let policies: BoundsCheckPolicies = super::bounds_check_policies(job.options.bounds_checks);
    let mut text = String::new();
    let mut writer = glsl::Writer::new(
        &mut text,
        &job.unit.module,
        &job.unit.info,
        &options,
        &pipeline,
        policies,
    )
    .map_err(|error| glsl_features::diagnostic(job, &error))?;
    let reflection = writer
        .write()
        .map_err(|error| glsl_features::diagnostic(job, &error))?;
    let placement = place(job, &units, &pairs, &reflection);
    drop_invariant_input(&mut text);
    Ok(Written {
        contents: Contents::Text(text),
        entry_point: "main".to_owned(),
        placement,
    })
}

/// A struct that both stages share may mark its position `@invariant`; naga then writes `invariant gl_FragCoord;` into the
/// fragment shader, which GLSL allows for outputs only. It says nothing there: the line goes.
fn drop_invariant_input(text: &mut String) {
    const LINE: &str = "invariant gl_FragCoord;\n";
    if let Some(at) = text.find(LINE) {
        text.replace_range(at..at + LINE.len(), "");
    }
}

type Pairs = BTreeMap<Handle<GlobalVariable>, Handle<GlobalVariable>>;

/// The sampler of each sampled texture.
fn sampler_pairs(job: &Job<'_>) -> Result<Pairs, Diagnostic> {
    let mut all: Vec<_> = job
        .unit
        .entry_info()
        .sampling_set
        .iter()
        .map(|pair| (pair.image, pair.sampler))
        .collect();
    all.sort_unstable();
    let mut pairs = Pairs::new();
    for (image, sampler) in all {
        if pairs.insert(image, sampler).is_some_and(|other| other != sampler) {
            return Err(two_samplers(job, image));
        }
    }
    Ok(pairs)
}

fn two_samplers(job: &Job<'_>, image: Handle<GlobalVariable>) -> Diagnostic {
    let variables = &job.unit.module.global_variables;
    let name = variables[image].name.clone().unwrap_or_default();
    let message = format!("GLSL: texture `{name}` is used with more than one sampler");
    job.refuse(Code::Unsupported, message, Some(variables.get_span(image)))
        .with_hint(
            "GLSL has textures and samplers only as pairs: bind the texture twice, once for each sampler",
        )
}

/// The number of each resource.
fn units(job: &Job<'_>) -> Result<BTreeMap<(u32, u32), u32>, Diagnostic> {
    let all = job.shader.group_bindings();
    let numbers = match &job.options.glsl_units {
        GlslUnits::Auto if all.iter().all(|(_, binding)| *binding < AUTO_STRIDE) => stride(all, AUTO_STRIDE),
        GlslUnits::Auto | GlslUnits::Dense => dense(all),
        GlslUnits::Stride(by) => stride(all, *by),
        GlslUnits::Map(map) => map.clone(),
    };
    check_units(job, &numbers)?;
    Ok(numbers)
}

fn stride(all: &BTreeSet<(u32, u32)>, by: u32) -> BTreeMap<(u32, u32), u32> {
    let number = |group: u32, binding: u32| group.saturating_mul(by).saturating_add(binding);
    all.iter().map(|&(g, b)| ((g, b), number(g, b))).collect()
}

fn dense(all: &BTreeSet<(u32, u32)>) -> BTreeMap<(u32, u32), u32> {
    all.iter().copied().zip(0..).collect()
}

/// Every used resource has a number, naga can write it, and no two share one.
fn check_units(job: &Job<'_>, numbers: &BTreeMap<(u32, u32), u32>) -> Result<(), Diagnostic> {
    let mut taken: BTreeMap<u32, &str> = BTreeMap::new();
    let numbered = |r: &&Resource| !matches!(r.kind, Kind::Sampler | Kind::ComparisonSampler);
    for resource in job.resources.iter().filter(numbered) {
        let span = job.unit.module.global_variables.get_span(resource.handle);
        let refuse = |message: String| {
            job.refuse(Code::Binding, message, Some(span))
                .with_hint("state the numbers of GLSL bindings in the options (glsl_units)")
        };
        let place = format!(
            "`{}` (group {}, binding {})",
            resource.name, resource.group, resource.binding
        );
        let Some(&number) = numbers.get(&resource.key()) else {
            return Err(refuse(format!("GLSL: no number is given for {place}")));
        };
        if number > u32::from(u8::MAX) {
            return Err(refuse(format!(
                "GLSL: {place} would be number {number}; the largest is 255"
            )));
        }
        if let Some(other) = taken.insert(number, &resource.name) {
            return Err(refuse(format!(
                "GLSL: {place} and `{other}` would both be number {number}"
            )));
        }
    }
    Ok(())
}

fn naga_options(job: &Job<'_>, units: &BTreeMap<(u32, u32), u32>) -> Result<glsl::Options, Diagnostic> {
    let mut writer_flags = glsl::WriterFlags::empty();
    writer_flags.set(
        glsl::WriterFlags::ADJUST_COORDINATE_SPACE,
        job.options.adjust_clip_space,
    );
    let mut binding_map = glsl::BindingMap::default();
    for resource in job.resources {
        if let Some(&unit) = units.get(&resource.key())
            && let Ok(unit) = u8::try_from(unit)
        {
            binding_map.insert(resource.naga_key(), unit);
        }
    }
    Ok(glsl::Options {
        version: job.options.glsl.to_naga(),
        writer_flags,
        binding_map,
        zero_initialize_workgroup_memory: true,
    })
}

fn place(
    job: &Job<'_>,
    units: &BTreeMap<(u32, u32), u32>,
    pairs: &Pairs,
    reflection: &glsl::ReflectionInfo,
) -> Placement {
    let mut names: BTreeMap<Handle<GlobalVariable>, String> = reflection
        .uniforms
        .iter()
        .map(|(handle, name)| (*handle, name.clone()))
        .collect();
    names.extend(
        reflection
            .texture_mapping
            .iter()
            .map(|(name, m)| (m.texture, name.clone())),
    );
    let slots = job
        .resources
        .iter()
        .filter_map(|r| Some((r.key(), Slot::Glsl(slot(job, r, units, pairs, &names)?))))
        .collect();
    Placement {
        slots,
        first_instance: reads(job, BuiltIn::InstanceIndex).then(|| FIRST_INSTANCE.to_owned()),
        glsl_immediates: reflection
            .immediates_items
            .iter()
            .map(|item| GlslImmediate {
                name: item.access_path.clone(),
                offset: item.offset,
                size: item.size_bytes,
            })
            .collect(),
        ..Placement::default()
    }
}

fn slot(
    job: &Job<'_>,
    resource: &Resource,
    units: &BTreeMap<(u32, u32), u32>,
    pairs: &Pairs,
    names: &BTreeMap<Handle<GlobalVariable>, String>,
) -> Option<GlslSlot> {
    if matches!(resource.kind, Kind::Sampler | Kind::ComparisonSampler) {
        return sampler_slot(job, resource, units, pairs, names);
    }
    let variables = &job.unit.module.global_variables;
    Some(GlslSlot {
        name: names.get(&resource.handle)?.clone(),
        unit: *units.get(&resource.key())?,
        textures: Vec::new(),
        sampler: pairs
            .get(&resource.handle)
            .map(|sampler| variables[*sampler].name.clone().unwrap_or_default()),
    })
}

/// A sampler is wherever its textures are.
fn sampler_slot(
    job: &Job<'_>,
    sampler: &Resource,
    units: &BTreeMap<(u32, u32), u32>,
    pairs: &Pairs,
    names: &BTreeMap<Handle<GlobalVariable>, String>,
) -> Option<GlslSlot> {
    let mut textures = job
        .resources
        .iter()
        .filter(|texture| pairs.get(&texture.handle) == Some(&sampler.handle))
        .filter_map(|texture| Some((names.get(&texture.handle)?, *units.get(&texture.key())?)))
        .peekable();
    let &(name, unit) = textures.peek()?;
    Some(GlslSlot {
        name: name.clone(),
        unit,
        textures: textures.map(|(name, _)| name.clone()).collect(),
        sampler: None,
    })
}

fn reads(job: &Job<'_>, wanted: BuiltIn) -> bool {
    crate::ir::interface(job.unit, false)
        .iter()
        .any(|(_, _, binding)| *binding == naga::Binding::BuiltIn(wanted))
}
