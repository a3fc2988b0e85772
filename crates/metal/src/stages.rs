//! The two stages of a draw, each a program that takes rows of words.

use std::sync::Arc;

use bossage_bounds::{Column, F32, Scalar, Slot, StageInputs, StageOutputs, Truth};
use bossage_embedded::Stages;
use bossage_runner::{Draw, Error, Resolved, Shader, push_constants, resolve};
use bossage_translate::external::Limits;
use bossage_translate::manifest::Entry;

use crate::child;
use crate::job::Words;
use crate::machine::Metal;
use crate::program::{Program, components};
use crate::signature::{Declared, Role};
use crate::tables::Tables;

/// Both stages of a draw, compiled and bound.
pub(crate) struct Compiled {
    job: String,
    vertex: Side,
    fragment: Side,
}

/// One stage.
struct Side {
    program: Arc<Program>,
    entry: Entry,
    tables: Words,
    limits: Limits,
}

impl Compiled {
    pub(crate) fn new(machine: &Metal, job: &str, draw: &Draw<'_>) -> Result<Self, Error> {
        let shaders = [&draw.vertex, &draw.fragment];
        let resolved = resolve(job, &shaders, &draw.resources)?;
        let pushed = push_constants(job, &shaders, &draw.resources)?;
        Ok(Self {
            job: job.to_owned(),
            vertex: Side::new(machine, job, &draw.vertex, &resolved, &pushed)?,
            fragment: Side::new(machine, job, &draw.fragment, &resolved, &pushed)?,
        })
    }
}

impl Stages for Compiled {
    fn vertices(&mut self, inputs: &StageInputs<F32>) -> Result<StageOutputs<F32>, Error> {
        self.vertex.run(&self.job, inputs)
    }

    fn fragments(&mut self, inputs: &StageInputs<F32>) -> Result<StageOutputs<F32>, Error> {
        self.fragment.run(&self.job, inputs)
    }

    fn may_discard(&self) -> bool {
        self.fragment.program.may_discard
    }
}

impl Side {
    fn new(
        machine: &Metal,
        job: &str,
        shader: &Shader<'_>,
        resolved: &[Resolved<'_>],
        pushed: &[u8],
    ) -> Result<Self, Error> {
        Ok(Self {
            program: machine.programs.get(job, shader)?,
            entry: shader.entry.clone(),
            // Writable buffers, which alone come back, are refused before this.
            tables: Tables::of(job, shader, resolved, pushed)?.words,
            limits: machine.limits,
        })
    }

    fn run(&self, job: &str, inputs: &StageInputs<F32>) -> Result<StageOutputs<F32>, Error> {
        let signature = &self.program.signature;
        let count = inputs.count();
        let mut words = Words::job();
        words.append(&self.tables);
        words.word(count as u32);
        let column = |value: &Declared| slot(value.role).and_then(|slot| inputs.column(slot));
        let columns: Vec<_> = signature
            .values_in()
            .map(|value| (value.role, column(value)))
            .collect();
        for invocation in 0..count {
            for (role, column) in &columns {
                match column {
                    Some(column) => column
                        .of(invocation)
                        .iter()
                        .for_each(|scalar| words.word(word(scalar))),
                    // There is one sample and one instance, the first.
                    None => words.word(u32::from(*role == Role::SampleMask)),
                }
            }
        }
        let outputs: Vec<(Slot, usize, Kind)> = signature
            .members_out
            .iter()
            .filter_map(|value| {
                let components = components(&self.entry, value, true);
                Some((slot(value.role)?, components, Kind::of(&self.entry, value)))
            })
            .collect();
        let row = outputs.iter().map(|(_, components, _)| components).sum::<usize>() + 1;
        let bytes = 4 * row * count;
        let answer = child::answer(job, &self.program.path, &words, bytes, &self.limits)?;
        let answer: Vec<u32> = answer
            .as_chunks::<4>()
            .0
            .iter()
            .map(|word| u32::from_le_bytes(*word))
            .collect();
        let rows = || answer.chunks_exact(row);
        let mut result = StageOutputs {
            columns: Default::default(),
            discarded: rows()
                .map(|row| Truth::from_bool(row[row.len() - 1] != 0))
                .collect(),
        };
        let mut at = 0;
        for (slot, components, kind) in outputs {
            let values = rows()
                .flat_map(|row| &row[at..at + components])
                .map(|word| kind.scalar(*word));
            let values = values.collect();
            result.columns.insert(slot, Column { components, values });
            at += components;
        }
        Ok(result)
    }
}

/// The scalars of an output.
#[derive(Clone, Copy)]
enum Kind {
    Float,
    Signed,
    Unsigned,
}

impl Kind {
    fn of(entry: &Entry, value: &Declared) -> Self {
        let location = match value.role {
            Role::Location(location) => Some(location),
            Role::SampleMask => return Self::Unsigned,
            _ => None,
        };
        let found = entry
            .outputs
            .iter()
            .find(|output| output.location.is_some() && output.location == location);
        let ty = found.map_or("", |output| output.ty.as_str());
        // `u32`, `vec2u`, `vec2<u32>`
        if ty.contains("u32") || ty.ends_with('u') {
            Self::Unsigned
        } else if ty.contains("i32") || ty.ends_with('i') {
            Self::Signed
        } else {
            Self::Float
        }
    }

    fn scalar(self, word: u32) -> Scalar<F32> {
        let exactly = |number: i128| Scalar::Int(number, number);
        match self {
            Self::Float => Scalar::Float(f64::from(f32::from_bits(word))),
            Self::Signed => exactly(i128::from(word.cast_signed())),
            Self::Unsigned => exactly(i128::from(word)),
        }
    }
}

fn word(scalar: &Scalar<F32>) -> u32 {
    match scalar {
        Scalar::Float(value) => (*value as f32).to_bits(),
        // The low 32 bits are those of a signed and of an unsigned integer alike.
        Scalar::Int(number, _) => *number as u32,
        Scalar::Bool(truth) => u32::from(*truth == Truth::True),
    }
}

/// What the rasteriser calls a value of a stage.
fn slot(role: Role) -> Option<Slot> {
    Some(match role {
        Role::Location(location) => Slot::Location(location, 0),
        Role::Position => Slot::Position,
        Role::VertexIndex => Slot::VertexIndex,
        Role::InstanceIndex => Slot::InstanceIndex,
        Role::FrontFacing => Slot::FrontFacing,
        Role::PrimitiveIndex => Slot::PrimitiveIndex,
        Role::SampleIndex => Slot::SampleIndex,
        Role::SampleMask => Slot::SampleMask,
        Role::Depth => Slot::FragDepth,
        Role::Buffer(_)
        | Role::Texture(_)
        | Role::Sampler(_)
        | Role::Workgroup
        | Role::StageIn
        | Role::GridPosition
        | Role::WorkgroupPosition
        | Role::PositionInWorkgroup
        | Role::IndexInWorkgroup
        | Role::Workgroups => return None,
    })
}
