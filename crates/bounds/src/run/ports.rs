//! Stage inputs and outputs by binding.

use crate::compile::program::{Port, Program};
use crate::domain::Domain;
use crate::error::{Error, Result};
use crate::kind::Kind;
use crate::stage::{Column, Slot, StageInputs};
use naga::{Binding, BuiltIn};

/// Built-ins of other stages than the ones evaluated here.
macro_rules! foreign_builtin {
    () => {
        BuiltIn::BaseInstance
            | BuiltIn::BaseVertex
            | BuiltIn::CullDistance
            | BuiltIn::DrawIndex
            | BuiltIn::PointCoord
            | BuiltIn::MeshTaskSize
            | BuiltIn::CullPrimitive
            | BuiltIn::PointIndex
            | BuiltIn::LineIndices
            | BuiltIn::TriangleIndices
            | BuiltIn::VertexCount
            | BuiltIn::Vertices
            | BuiltIn::PrimitiveCount
            | BuiltIn::Primitives
            | BuiltIn::RayInvocationId
            | BuiltIn::NumRayInvocations
            | BuiltIn::InstanceCustomData
            | BuiltIn::GeometryIndex
            | BuiltIn::WorldRayOrigin
            | BuiltIn::WorldRayDirection
            | BuiltIn::ObjectRayOrigin
            | BuiltIn::ObjectRayDirection
            | BuiltIn::RayTmin
            | BuiltIn::RayTCurrentMax
            | BuiltIn::ObjectToWorld
            | BuiltIn::WorldToObject
            | BuiltIn::HitKind
    };
}
pub(super) use foreign_builtin;

pub(super) fn wrong_kind(port: &Port, kind: Kind) -> Error {
    Error::Input {
        input: name_of(&port.binding),
        reason: format!("a value of another kind than {kind:?}, or out of its range"),
    }
}

/// What built-ins are when the caller says nothing: the front of the first instance, everything covered.
pub(super) fn default_input<D: Domain>(binding: &Binding, kind: Kind) -> D::Cell {
    match (binding, kind) {
        (Binding::BuiltIn(BuiltIn::FrontFacing), _) => D::bool(true),
        (Binding::BuiltIn(BuiltIn::SampleMask), Kind::Int(t)) => D::int(t, t.max().min(i128::from(u32::MAX))),
        (_, kind) => crate::exec::places::zero::<D>(kind),
    }
}

pub(super) fn may_be_absent(slot: Slot) -> bool {
    match slot {
        Slot::Location(..) | Slot::Position | Slot::VertexIndex => false,
        Slot::InstanceIndex
        | Slot::FrontFacing
        | Slot::SampleIndex
        | Slot::SampleMask
        | Slot::FragDepth
        | Slot::PrimitiveIndex
        | Slot::ViewIndex
        | Slot::ClipDistances
        | Slot::Barycentric
        | Slot::PointSize => true,
    }
}

pub(super) fn input_columns<'a, D: Domain>(
    program: &Program,
    inputs: &'a StageInputs<D>,
) -> Result<Vec<Option<&'a Column<D>>>> {
    let mut columns = Vec::with_capacity(program.inputs.len());
    for port in &program.inputs {
        let wrong = |reason: String| Error::Input {
            input: name_of(&port.binding),
            reason,
        };
        let slot = slot_of(&port.binding).ok_or_else(|| unsupported_port("input", &port.binding))?;
        let column = inputs.columns.get(&slot);
        match column {
            None if may_be_absent(slot) => {}
            None => return Err(wrong("has no values; set it in the stage inputs".into())),
            Some(c) if c.components < port.rows.len() || c.values.len() != c.components * inputs.count => {
                let (need, have) = (port.rows.len(), c.components);
                let reason = format!(
                    "needs {need} scalars for each of {} invocations; {} were given, {have} each",
                    inputs.count,
                    c.values.len()
                );
                return Err(wrong(reason));
            }
            Some(_) => {}
        }
        columns.push(column);
    }
    Ok(columns)
}

pub(super) fn unsupported_port(what: &str, binding: &Binding) -> Error {
    Error::Unsupported {
        what: format!("the {what} {}", name_of(binding)),
        span: naga::Span::UNDEFINED,
    }
}

pub(super) fn name_of(binding: &Binding) -> String {
    match binding {
        Binding::Location { location, .. } => format!("location {location}"),
        Binding::BuiltIn(builtin) => format!("{builtin:?}"),
    }
}

pub(crate) fn slot_of(binding: &Binding) -> Option<Slot> {
    match binding {
        Binding::Location {
            location, blend_src, ..
        } => Some(Slot::Location(*location, blend_src.unwrap_or(0))),
        Binding::BuiltIn(BuiltIn::Position { .. }) => Some(Slot::Position),
        Binding::BuiltIn(BuiltIn::VertexIndex) => Some(Slot::VertexIndex),
        Binding::BuiltIn(BuiltIn::InstanceIndex) => Some(Slot::InstanceIndex),
        Binding::BuiltIn(BuiltIn::FrontFacing) => Some(Slot::FrontFacing),
        Binding::BuiltIn(BuiltIn::SampleIndex) => Some(Slot::SampleIndex),
        Binding::BuiltIn(BuiltIn::SampleMask) => Some(Slot::SampleMask),
        Binding::BuiltIn(BuiltIn::FragDepth) => Some(Slot::FragDepth),
        Binding::BuiltIn(BuiltIn::PrimitiveIndex) => Some(Slot::PrimitiveIndex),
        Binding::BuiltIn(BuiltIn::ViewIndex) => Some(Slot::ViewIndex),
        Binding::BuiltIn(BuiltIn::ClipDistances) => Some(Slot::ClipDistances),
        Binding::BuiltIn(BuiltIn::Barycentric { .. }) => Some(Slot::Barycentric),
        Binding::BuiltIn(BuiltIn::PointSize) => Some(Slot::PointSize),
        Binding::BuiltIn(
            BuiltIn::GlobalInvocationId
            | BuiltIn::LocalInvocationId
            | BuiltIn::LocalInvocationIndex
            | BuiltIn::WorkGroupId
            | BuiltIn::WorkGroupSize
            | BuiltIn::NumWorkGroups
            | BuiltIn::NumSubgroups
            | BuiltIn::SubgroupId
            | BuiltIn::SubgroupSize
            | BuiltIn::SubgroupInvocationId
            | foreign_builtin!(),
        ) => None,
    }
}
