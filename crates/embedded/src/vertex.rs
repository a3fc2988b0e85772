//! The vertex stage over a mesh: each vertex once, some thousands at a time, which bounds memory.

use std::collections::BTreeMap;
use std::ops::Range;

use bossage_bounds::{Column, F32, Scalar, Slot, StageInputs};
use bossage_runner::{Draw, Error};

use crate::clip::Clip;
use crate::stages::Stages;

/// Vertices that run together.
const VERTICES_A_RUN: usize = 1 << 14;

/// What the vertices of a draw became.
#[derive(Default)]
pub(crate) struct Vertices {
    outputs: BTreeMap<Slot, Values>,
}

/// Values of one output for all vertices: a scalar of any kind takes six times the room of a float.
pub(crate) enum Values {
    /// Components of a vertex, and floats, vertex by vertex.
    Floats(usize, Vec<f64>),
    /// What is no float, or holds something else.
    Others(Column<F32>),
}

impl Values {
    fn of(column: Column<F32>) -> Self {
        let floats: Option<Vec<f64>> = column.values.iter().map(|value| value.float()).collect();
        match floats {
            Some(floats) => Self::Floats(column.components, floats),
            None => Self::Others(column),
        }
    }

    /// Adds the values of further vertices, which are of the same kind.
    fn extend(&mut self, more: Self) {
        match (self, more) {
            (Self::Floats(_, all), Self::Floats(_, more)) => all.extend(more),
            (Self::Others(all), Self::Others(more)) => all.values.extend(more.values),
            (Self::Floats(..), Self::Others(_)) | (Self::Others(_), Self::Floats(..)) => {
                unreachable!("an output is of one kind at all vertices")
            }
        }
    }

    /// Scalars of one vertex.
    pub(crate) fn components(&self) -> usize {
        match self {
            Self::Floats(components, _) => *components,
            Self::Others(column) => column.components,
        }
    }

    /// One scalar of one vertex.
    pub(crate) fn at(&self, vertex: usize, component: usize) -> Scalar<F32> {
        match self {
            Self::Floats(components, floats) => Scalar::Float(floats[vertex * components + component]),
            Self::Others(column) => column.of(vertex)[component],
        }
    }
}

impl Vertices {
    /// Runs the vertex stage. The mesh has been validated against it.
    pub(crate) fn run(stages: &mut dyn Stages, draw: &Draw<'_>) -> Result<Self, Error> {
        let count = draw
            .mesh
            .indices
            .iter()
            .max()
            .map_or(0, |last| *last as usize + 1);
        let mut all = Self::default();
        for start in (0..count).step_by(VERTICES_A_RUN) {
            let inputs = inputs(draw, start..count.min(start + VERTICES_A_RUN));
            for (slot, column) in stages.vertices(&inputs)?.columns {
                let values = Values::of(column);
                match all.outputs.get_mut(&slot) {
                    Some(known) => known.extend(values),
                    None => {
                        all.outputs.insert(slot, values);
                    }
                }
            }
        }
        Ok(all)
    }

    /// The positions in clip space.
    pub(crate) fn positions(&self, draw: &Draw<'_>) -> Result<Vec<Clip>, Error> {
        let values = match self.outputs.get(&Slot::Position) {
            Some(Values::Floats(4, floats)) => Some(floats),
            Some(Values::Floats(..) | Values::Others(_)) | None => None,
        };
        let values = values.ok_or_else(|| {
            let entry = draw.vertex.entry;
            Error::misfit(entry, "position", "the vertex stage doesn't return it".to_owned())
        })?;
        Ok(values.as_chunks::<4>().0.to_vec())
    }

    /// The values at a location.
    pub(crate) fn location(&self, location: u32) -> Option<&Values> {
        self.outputs.get(&Slot::Location(location, 0))
    }
}

/// What some vertices of a draw get.
fn inputs(draw: &Draw<'_>, vertices: Range<usize>) -> StageInputs<F32> {
    let numbers: Vec<u32> = vertices.clone().map(|vertex| vertex as u32).collect();
    let mut inputs = StageInputs::new(vertices.len()).index(Slot::VertexIndex, &numbers);
    for input in &draw.vertex.entry.inputs {
        let attribute = draw.mesh.attributes.get(&input.name);
        if let (Some(location), Some(attribute)) = (input.location, attribute) {
            let components = attribute.components as usize;
            let skipped = attribute.values.iter().skip(components * vertices.start);
            let values: Vec<f64> = skipped
                .take(components * vertices.len())
                .map(|value| f64::from(*value))
                .collect();
            inputs = inputs.location(location, components, &values);
        }
    }
    inputs
}
