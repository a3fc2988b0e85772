//! The vertex stage over a mesh: each vertex once.

use bossage_bounds::{Bindings, Column, F32, Limits, Slot, StageInputs, StageOutputs, run_vertex};
use bossage_runner::{Draw, Error};

use crate::clip::Clip;
use crate::failure::{misfit, of_job};
use crate::machine::Embedded;

/// What the vertices of a draw became.
pub(crate) struct Vertices {
    outputs: StageOutputs<F32>,
}

impl Vertices {
    /// Runs the vertex stage. The mesh has been validated against it.
    pub(crate) fn run(
        machine: &Embedded,
        job: &str,
        draw: &Draw<'_>,
        bindings: &mut Bindings<F32>,
    ) -> Result<Self, Error> {
        let compiled = machine.programs.get(job, &draw.vertex)?;
        let count = draw.mesh.indices.iter().max().map_or(0, |last| last + 1);
        let numbers: Vec<u32> = (0..count).collect();
        let mut inputs = StageInputs::new(count as usize).index(Slot::VertexIndex, &numbers);
        for input in &draw.vertex.entry.inputs {
            let attribute = draw.mesh.attributes.get(&input.name);
            if let (Some(location), Some(attribute)) = (input.location, attribute) {
                let components = attribute.components as usize;
                let used = attribute.values.iter().take(components * count as usize);
                let values: Vec<f64> = used.map(|value| f64::from(*value)).collect();
                inputs = inputs.location(location, components, &values);
            }
        }
        let (outputs, _) = run_vertex(&compiled.program, bindings, &inputs, &Limits::default())
            .map_err(|refusal| of_job(job, refusal))?;
        Ok(Self { outputs })
    }

    /// The positions in clip space.
    pub(crate) fn positions(&self, draw: &Draw<'_>) -> Result<Vec<Clip>, Error> {
        let column = self.outputs.columns.get(&Slot::Position);
        let values = column.and_then(|column| {
            let floats = column.values.iter().map(|value| value.float());
            floats.collect::<Option<Vec<f64>>>()
        });
        let values = values.ok_or_else(|| {
            let entry = draw.vertex.entry;
            misfit(entry, "position", "the vertex stage doesn't return it".to_owned())
        })?;
        Ok(values.as_chunks::<4>().0.to_vec())
    }

    /// The values at a location.
    pub(crate) fn location(&self, location: u32) -> Option<&Column<F32>> {
        self.outputs.columns.get(&Slot::Location(location, 0))
    }
}
