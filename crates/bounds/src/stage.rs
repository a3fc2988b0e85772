//! Inputs and outputs of vertex and fragment stages, in columns: one value list for each location or built-in.

use crate::bindings::Scalar;
use crate::domain::{Domain, Truth};
use std::collections::BTreeMap;

/// What a stage input or output is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Slot {
    /// A user-defined location; the second number is the index of dual-source blending, zero otherwise.
    Location(u32, u32),
    /// `position`: clip-space output of vertices, window-space input of fragments.
    Position,
    /// `vertex_index`.
    VertexIndex,
    /// `instance_index`.
    InstanceIndex,
    /// `front_facing`.
    FrontFacing,
    /// `sample_index`.
    SampleIndex,
    /// `sample_mask`.
    SampleMask,
    /// `frag_depth`.
    FragDepth,
    /// `primitive_index`.
    PrimitiveIndex,
    /// `view_index`.
    ViewIndex,
    /// `clip_distances`.
    ClipDistances,
    /// `barycentric`.
    Barycentric,
    /// `point_size`.
    PointSize,
}

/// Values of one slot for all invocations.
#[derive(Clone, Debug, PartialEq)]
pub struct Column<D: Domain> {
    /// Scalars of one invocation.
    pub components: usize,
    /// All scalars, invocation by invocation.
    pub values: Vec<Scalar<D>>,
}

impl<D: Domain> Column<D> {
    /// The scalars of one invocation.
    pub fn of(&self, invocation: usize) -> &[Scalar<D>] {
        &self.values[invocation * self.components..][..self.components]
    }

    /// The floats of one invocation; `None` when some are no floats.
    pub fn floats(&self, invocation: usize) -> Option<Vec<D::Float>> {
        self.of(invocation).iter().map(Scalar::float).collect()
    }
}

/// Inputs of a stage.
#[derive(Clone, Debug, PartialEq)]
pub struct StageInputs<D: Domain> {
    pub(crate) count: usize,
    /// Whether fragments come without the quads that they were drawn in.
    pub(crate) lone: bool,
    pub(crate) columns: BTreeMap<Slot, Column<D>>,
}

impl<D: Domain> StageInputs<D> {
    /// Inputs of that many invocations. Fragments of a program that takes derivatives come in quads: four invocations with the
    /// pixels (0,0), (1,0), (0,1), (1,1).
    pub fn new(count: usize) -> Self {
        Self {
            count,
            lone: false,
            columns: BTreeMap::new(),
        }
    }

    /// How many invocations.
    pub fn count(&self) -> usize {
        self.count
    }

    /// The values of a slot.
    pub fn column(&self, slot: Slot) -> Option<&Column<D>> {
        self.columns.get(&slot)
    }

    /// Each fragment by itself, its neighbours in the quad unknown: its derivatives, and a level of detail that follows from them,
    /// are indeterminate (zero in point domains).
    ///
    /// For fragments whose inputs were read back from a picture: there the pixel beside one may belong to another triangle, and
    /// the derivative is then that of a helper invocation, which nobody has seen.
    #[must_use]
    pub fn lone(self) -> Self {
        Self { lone: true, ..self }
    }

    /// Sets a slot; `components` scalars for each invocation.
    pub fn set(mut self, slot: Slot, components: usize, values: Vec<Scalar<D>>) -> Self {
        self.columns.insert(slot, Column { components, values });
        self
    }

    /// Sets a location of floats.
    pub fn location(self, location: u32, components: usize, values: &[D::Float]) -> Self {
        let values = values.iter().map(|&x| Scalar::Float(x)).collect();
        self.set(Slot::Location(location, 0), components, values)
    }

    /// Sets the positions.
    pub fn position(self, values: &[[D::Float; 4]]) -> Self {
        let values = values.iter().flatten().map(|&x| Scalar::Float(x)).collect();
        self.set(Slot::Position, 4, values)
    }

    /// Sets whether fragments face the viewer.
    pub fn front_facing(self, values: &[bool]) -> Self {
        let values = values
            .iter()
            .map(|&b| Scalar::Bool(Truth::from_bool(b)))
            .collect();
        self.set(Slot::FrontFacing, 1, values)
    }

    /// Sets a slot of one exact integer for each invocation, such as the vertex index.
    pub fn index(self, slot: Slot, values: &[u32]) -> Self {
        let values = values
            .iter()
            .map(|&x| Scalar::Int(i128::from(x), i128::from(x)))
            .collect();
        self.set(slot, 1, values)
    }
}

/// Outputs of a stage.
#[derive(Clone, Debug, PartialEq)]
pub struct StageOutputs<D: Domain> {
    /// Values by slot.
    pub columns: BTreeMap<Slot, Column<D>>,
    /// Whether each fragment was discarded.
    pub discarded: Vec<Truth>,
}

impl<D: Domain> StageOutputs<D> {
    /// The floats at a location for one invocation.
    pub fn location(&self, location: u32, invocation: usize) -> Option<Vec<D::Float>> {
        self.columns.get(&Slot::Location(location, 0))?.floats(invocation)
    }
}
