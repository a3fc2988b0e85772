//! Which register every resource gets.
//!
//! Shader model 5.1 and later: register = binding and space = group, whatever else a stage uses, so that stages emitted
//! from separate modules share one root signature. Constants of the translator's own (draw parameters, push constants)
//! live in [`OWN_SPACE`].
//!
//! Shader model 5.0 has no spaces: each class (`b`, `t`, `u`, `s`) is numbered from 0 within a stage, by group and binding;
//! Direct3D 11 has registers of its own for each stage, so stages cannot collide. In a pixel shader render targets and
//! `u` registers share their slots: `u` starts after the last target.

use std::collections::BTreeMap;
use std::fmt;

use crate::diagnostic::{Code, Diagnostic};
use crate::emit::Job;
use crate::ir;
use crate::manifest::Kind;
use crate::resources::Resource;
use crate::target::{ShaderModel, Stage};

/// The register space of constants that the source does not declare with a group.
pub(super) const OWN_SPACE: u8 = 100;

/// Registers of each class in Direct3D 11 (feature level 11.0; `u` of pixel and compute shaders).
const LIMITS_5_0: [(char, u32); 4] = [('b', 14), ('t', 128), ('s', 16), ('u', 8)];

/// Class, number and space.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Register {
    pub(super) class: char,
    pub(super) number: u32,
    pub(super) space: u8,
}

impl fmt::Display for Register {
    /// As it stands between the parentheses of `register(…)`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}{}", self.class, self.number)?;
        if self.space != 0 {
            write!(f, ", space{}", self.space)?;
        }
        Ok(())
    }
}

/// The registers of one entry point.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Registers {
    pub(super) resources: BTreeMap<(u32, u32), Register>,
    pub(super) special_constants: Option<Register>,
    pub(super) immediates: Option<Register>,
}

const fn class(kind: Kind) -> char {
    match kind {
        Kind::UniformBuffer => 'b',
        Kind::ReadOnlyStorageBuffer | Kind::Texture | Kind::DepthTexture => 't',
        Kind::StorageBuffer | Kind::StorageTexture => 'u',
        Kind::Sampler | Kind::ComparisonSampler => 's',
    }
}

/// Assigns all registers.
pub(super) fn assign(job: &Job<'_>, special_constants: bool) -> Result<Registers, Diagnostic> {
    if job.options.hlsl == ShaderModel::V5_0 {
        assign_flat(job, special_constants)
    } else {
        assign_spaces(job, special_constants)
    }
}

fn assign_spaces(job: &Job<'_>, special_constants: bool) -> Result<Registers, Diagnostic> {
    let mut resources = BTreeMap::new();
    for resource in job.resources {
        let space = u8::try_from(resource.group)
            .ok()
            .filter(|space| *space < OWN_SPACE)
            .ok_or_else(|| refuse(job, resource, format!("HLSL: groups go up to {}", OWN_SPACE - 1)))?;
        let register = Register {
            class: class(resource.kind),
            number: resource.binding,
            space,
        };
        resources.insert(resource.key(), register);
    }
    check_overlap(job, &resources)?;
    let own = |number| Register {
        class: 'b',
        number,
        space: OWN_SPACE,
    };
    Ok(Registers {
        resources,
        special_constants: special_constants.then(|| own(0)),
        immediates: job.immediates.map(|_| own(1)),
    })
}

/// A binding array takes as many registers as it has elements: they must not be those of another binding.
fn check_overlap(job: &Job<'_>, registers: &BTreeMap<(u32, u32), Register>) -> Result<(), Diagnostic> {
    let mut ends: BTreeMap<(char, u8), (u32, &str)> = BTreeMap::new();
    for resource in job.resources {
        let register = registers[&resource.key()];
        let class = (register.class, register.space);
        if let Some((end, before)) = ends.get(&class)
            && register.number < *end
        {
            let message = format!(
                "HLSL: the registers of `{before}` run into those of `{}`",
                resource.name
            );
            return Err(refuse(job, resource, message)
                .with_hint("leave as many binding numbers free as the array has elements"));
        }
        let end = match resource.count {
            Some(0) => u32::MAX,
            count => register.number.saturating_add(count.unwrap_or(1)),
        };
        ends.insert(class, (end, &resource.name));
    }
    Ok(())
}

fn assign_flat(job: &Job<'_>, special_constants: bool) -> Result<Registers, Diagnostic> {
    let mut next: BTreeMap<char, u32> = BTreeMap::from([('u', color_targets(job))]);
    let mut take = |class: char, count: u32| {
        let slot = next.entry(class).or_default();
        let number = *slot;
        *slot += count;
        Register {
            class,
            number,
            space: 0,
        }
    };
    let mut registers = Registers::default();
    for resource in job.resources {
        let register = take(class(resource.kind), 1);
        registers.resources.insert(resource.key(), register);
    }
    registers.special_constants = special_constants.then(|| take('b', 1));
    registers.immediates = job.immediates.map(|_| take('b', 1));
    check_limits(job, &next)?;
    Ok(registers)
}

/// Render targets that a pixel shader writes.
fn color_targets(job: &Job<'_>) -> u32 {
    if job.unit.stage != Stage::Fragment {
        return 0;
    }
    ir::interface(job.unit, true)
        .iter()
        .filter_map(|(_, _, binding)| match binding {
            naga::Binding::Location { location, .. } => Some(location + 1),
            naga::Binding::BuiltIn(_) => None,
        })
        .max()
        .unwrap_or_default()
}

fn check_limits(job: &Job<'_>, next: &BTreeMap<char, u32>) -> Result<(), Diagnostic> {
    for (class, limit) in LIMITS_5_0 {
        let used = next.get(&class).copied().unwrap_or_default();
        let only_targets = class == 'u' && used == color_targets(job);
        if used > limit && !only_targets {
            let message = format!("HLSL 5.0: {used} `{class}` registers; Direct3D 11 has {limit}");
            return Err(job.refuse(Code::Binding, message, None));
        }
    }
    Ok(())
}

fn refuse(job: &Job<'_>, resource: &Resource, message: String) -> Diagnostic {
    let span = job.unit.module.global_variables.get_span(resource.handle);
    job.refuse(Code::Binding, message, Some(span))
}
