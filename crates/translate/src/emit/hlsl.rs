//! HLSL that an engine can bind: plain samplers, and a register for everything, read back from the text itself.
//!
//! See [`super::hlsl_registers`] for the numbering and [`super::hlsl_idioms`] for what is rewritten.
//!
//! Direct3D's `SV_VertexID` and `SV_InstanceID` count from 0 whatever the draw's first vertex and instance are, and it has
//! no count of workgroups: where a shader reads these, a constant buffer that the engine fills is declared.

use std::collections::BTreeMap;

use naga::back::hlsl;
use naga::{BuiltIn, Expression};

use crate::diagnostic::{Code, Diagnostic};
use crate::emit::hlsl_idioms::Rewrite;
use crate::emit::hlsl_registers::{self, Register, Registers};
use crate::emit::sample_arguments::{self, HLSL_OFFSETS};
use crate::emit::{Contents, Job, Placement, Slot, Written};
use crate::manifest::{HlslSlot, Kind};
use crate::options::BoundsChecks;
use crate::target::ShaderModel;

/// Where naga is told to put index buffers of samplers; they are gone before the text leaves this module.
const INDEX_BUFFER_SPACE: u8 = u8::MAX;

pub(super) fn write(job: &Job<'_>) -> Result<Written, Diagnostic> {
    check_immediates(job)?;
    let registers = hlsl_registers::assign(job, needs_special_constants(job))?;
    let options = naga_options(job, &registers);
    let pipeline = hlsl::PipelineOptions::default();
    let mut raw = String::new();
    let reflection = hlsl::Writer::new(&mut raw, &options, &pipeline)
        .write(&job.unit.module, &job.unit.info, None)
        .map_err(|error| job.failed(&error))?;
    let entry_point = match reflection.entry_point_names.into_iter().next() {
        Some(Ok(name)) => name,
        Some(Err(error)) => return Err(job.failed(&error)),
        None => return Err(job.refuse(Code::Internal, "naga wrote no entry point", None)),
    };
    let text = with_offsets(job, rewrite(job, &registers, raw)?)?;
    let placement = place(job, &registers, &text)?;
    Ok(Written {
        contents: Contents::Text(text),
        entry_point,
        placement,
    })
}

/// naga writes push constants as `ConstantBuffer<T>`, and knows only structs for T.
fn check_immediates(job: &Job<'_>) -> Result<(), Diagnostic> {
    let Some((handle, variable)) = job.immediates else {
        return Ok(());
    };
    let module = &job.unit.module;
    if matches!(module.types[variable.ty].inner, naga::TypeInner::Struct { .. }) {
        return Ok(());
    }
    let span = module.global_variables.get_span(handle);
    let message = "HLSL: push constants must be a struct";
    Err(job
        .refuse(Code::Unsupported, message, Some(span))
        .with_hint("wrap the value in a struct with one member"))
}

fn needs_special_constants(job: &Job<'_>) -> bool {
    crate::ir::interface(job.unit, false)
        .iter()
        .any(|(_, _, binding)| {
            matches!(
                binding,
                naga::Binding::BuiltIn(
                    BuiltIn::VertexIndex | BuiltIn::InstanceIndex | BuiltIn::NumWorkGroups
                )
            )
        })
}

fn naga_options(job: &Job<'_>, registers: &Registers) -> hlsl::Options {
    let restrict = job.options.bounds_checks == BoundsChecks::Restrict;
    let target = |register: &Register| hlsl::BindTarget {
        space: register.space,
        register: register.number,
        restrict_indexing: restrict,
        ..hlsl::BindTarget::default()
    };
    let mut binding_map = hlsl::BindingMap::default();
    let mut index_buffers = hlsl::SamplerIndexBufferBindingMap::default();
    for resource in job.resources {
        binding_map.insert(resource.naga_key(), target(&registers.resources[&resource.key()]));
        if matches!(resource.kind, Kind::Sampler | Kind::ComparisonSampler) {
            let group = resource.group;
            let place = hlsl::BindTarget {
                space: INDEX_BUFFER_SPACE,
                register: group,
                ..hlsl::BindTarget::default()
            };
            index_buffers.insert(hlsl::SamplerIndexBufferKey { group }, place);
        }
    }
    hlsl::Options {
        shader_model: naga_model(job.options.hlsl),
        binding_map,
        fake_missing_bindings: false,
        special_constants_binding: registers.special_constants.as_ref().map(target),
        immediates_target: registers.immediates.as_ref().map(target),
        sampler_buffer_binding_map: index_buffers,
        restrict_indexing: restrict,
        force_loop_bounding: job.options.bound_loops,
        ..hlsl::Options::default()
    }
}

const fn naga_model(model: ShaderModel) -> hlsl::ShaderModel {
    match model {
        ShaderModel::V5_0 => hlsl::ShaderModel::V5_0,
        ShaderModel::V5_1 => hlsl::ShaderModel::V5_1,
        ShaderModel::V6_0 => hlsl::ShaderModel::V6_0,
        ShaderModel::V6_2 => hlsl::ShaderModel::V6_2,
    }
}

fn rewrite(job: &Job<'_>, registers: &Registers, raw: String) -> Result<String, Diagnostic> {
    // In shader model 5.0 naga's index of a sampler is its flat register, which need not be its binding.
    let samplers: BTreeMap<(u32, u32), Register> = job
        .resources
        .iter()
        .map(|resource| (resource.group, registers.resources[&resource.key()]))
        .filter(|(_, register)| register.class == 's')
        .map(|(group, register)| ((group, register.number), register))
        .collect();
    let plain_constant_buffers = job.options.hlsl == ShaderModel::V5_0
        && (registers.special_constants.is_some() || registers.immediates.is_some());
    if samplers.is_empty() && !plain_constant_buffers {
        return Ok(raw);
    }
    let rewrite = Rewrite {
        samplers: &samplers,
        index_buffer_space: INDEX_BUFFER_SPACE,
        plain_constant_buffers,
    };
    rewrite.apply(&raw).map_err(|what| {
        let message = format!("HLSL: naga's sampler code is not as known: {what}");
        job.refuse(Code::Internal, message, None)
    })
}

/// Offsets of the texture's own dimensions.
fn with_offsets(job: &Job<'_>, text: String) -> Result<String, Diagnostic> {
    let has_offset = |sample: &Expression| matches!(sample, Expression::ImageSample { offset: Some(_), .. });
    if !sample_arguments::occurs(job.unit, has_offset) {
        return Ok(text);
    }
    HLSL_OFFSETS.apply(&text).map_err(|what| {
        let message = format!("HLSL: naga's code for offsets is not as known: {what}");
        job.refuse(Code::Internal, message, None)
    })
}

/// Reads names and registers back from the text, so that the manifest states what is there.
fn place(job: &Job<'_>, registers: &Registers, text: &str) -> Result<Placement, Diagnostic> {
    let declared: BTreeMap<&str, &str> = declarations(text).collect();
    let slot = |register: &Register| {
        let name = declared.get(register.to_string().as_str()).ok_or_else(|| {
            let message = format!("HLSL: nothing is declared at register({register})");
            job.refuse(Code::Internal, message, None)
        })?;
        Ok(HlslSlot {
            name: (*name).to_owned(),
            register: format!("{}{}", register.class, register.number),
            space: register.space.into(),
        })
    };
    let mut placement = Placement {
        special_constants: registers.special_constants.as_ref().map(slot).transpose()?,
        hlsl_immediates: registers.immediates.as_ref().map(slot).transpose()?,
        ..Placement::default()
    };
    for (key, register) in &registers.resources {
        placement.slots.insert(*key, Slot::Hlsl(slot(register)?));
    }
    Ok(placement)
}

/// Register and name of each declaration: what stands in the parentheses, and the last word before the colon.
fn declarations(text: &str) -> impl Iterator<Item = (&str, &str)> {
    const MARK: &str = ": register(";
    text.match_indices(MARK).filter_map(|(at, _)| {
        let (register, _) = text[at + MARK.len()..].split_once(')')?;
        let name = text[..at].split_whitespace().next_back()?;
        let name = name.split_once('[').map_or(name, |(name, _)| name);
        Some((register, name))
    })
}

#[cfg(test)]
mod tests {
    use super::declarations;

    #[test]
    fn declarations_are_read() {
        for (line, expected) in [
            ("cbuffer view : register(b0) { View view; }", ("b0", "view")),
            (
                "Texture2D<float4> t[4] : register(t1, space2);",
                ("t1, space2", "t"),
            ),
            ("RWByteAddressBuffer data : register(u0);", ("u0", "data")),
            (
                "ConstantBuffer<P> p: register(b1, space100);",
                ("b1, space100", "p"),
            ),
        ] {
            assert_eq!(declarations(line).collect::<Vec<_>>(), [expected]);
        }
        assert_eq!(declarations("float4 x : SV_Target0;").count(), 0);
    }
}
