//! Running programs: compute dispatches, vertices, fragments, probes.

mod batches;
mod ports;
mod prepare;

pub(crate) use ports::slot_of;

use crate::bindings::{Bindings, BufferData, Scalar};
use crate::compile::program::Program;
use crate::domain::Domain;
use crate::error::{Error, Result};
use crate::exec::machine::Counters;
use crate::limits::Limits;
use crate::stage::{StageInputs, StageOutputs};
use naga::{ShaderStage, Span};
use std::collections::BTreeMap;

/// Operations and fetches of one source span.
#[derive(Clone, Copy, Debug)]
pub struct SpanCost {
    /// The place in the source.
    pub span: Span,
    /// Scalar operations executed there.
    pub operations: u64,
    /// Texels or samples fetched there.
    pub fetches: u64,
}

/// What a run cost.
#[derive(Clone, Debug, Default)]
pub struct Outcome {
    /// Totals.
    pub counters: Counters,
    /// Cost by span, in source order; empty unless [`Limits::count`] is set.
    pub spans: Vec<SpanCost>,
}

impl Outcome {
    pub(crate) fn new(program: &Program, counters: Counters) -> Self {
        let mut by_place: BTreeMap<(usize, usize), SpanCost> = BTreeMap::new();
        for (&span, &[operations, fetches]) in program.code.spans.iter().zip(&counters.by_span) {
            let range = span.to_range().unwrap_or(0..0);
            let entry = by_place.entry((range.start, range.end)).or_insert(SpanCost {
                span,
                operations: 0,
                fetches: 0,
            });
            entry.operations += operations;
            entry.fetches += fetches;
        }
        let spans = by_place
            .into_values()
            .filter(|c| c.operations + c.fetches > 0)
            .collect();
        Self { counters, spans }
    }
}

fn expect_stage(program: &Program, stage: ShaderStage, wanted: &'static str) -> Result<()> {
    if program.stage == stage {
        return Ok(());
    }
    let found = match program.stage {
        ShaderStage::Vertex => "vertex",
        ShaderStage::Fragment => "fragment",
        ShaderStage::Compute => "compute",
        ShaderStage::Task
        | ShaderStage::Mesh
        | ShaderStage::RayGeneration
        | ShaderStage::Miss
        | ShaderStage::AnyHit
        | ShaderStage::ClosestHit => "other",
    };
    Err(Error::WrongStage {
        name: program.name.clone(),
        found,
        wanted,
    })
}

/// Dispatches a compute shader. Buffers that the shader may write are left in `bindings` as scalars of the domain.
///
/// Workgroups run in a fixed order or in parallel with a fixed result; invocations of a workgroup run in lockstep.
///
/// # Errors
/// A binding that is missing or does not fit, a budget that is used up, or something unsupported.
pub fn run_compute<D: Domain>(
    program: &Program,
    bindings: &mut Bindings<D>,
    workgroups: [u32; 3],
    limits: &Limits,
) -> Result<Outcome> {
    expect_stage(program, ShaderStage::Compute, "compute")?;
    let mut prepared = prepare::prepare(program, bindings, limits)?;
    let counters = batches::compute(program, &mut prepared, workgroups, limits)?;
    prepare::write_back(program, prepared, bindings);
    Ok(Outcome::new(program, counters))
}

/// Evaluates fragments at given inputs.
///
/// # Errors
/// An input or binding that is missing or does not fit, a budget that is used up, or something unsupported.
pub fn run_fragment<D: Domain>(
    program: &Program,
    bindings: &mut Bindings<D>,
    inputs: &StageInputs<D>,
    limits: &Limits,
) -> Result<(StageOutputs<D>, Outcome)> {
    expect_stage(program, ShaderStage::Fragment, "fragment")?;
    if program.uses_derivatives() && !inputs.lone && !inputs.count.is_multiple_of(4) {
        let reason = format!(
            "the shader takes derivatives, so fragments come in quads of four or are said to be lone; {} were given",
            inputs.count
        );
        return Err(Error::Input {
            input: "invocations".into(),
            reason,
        });
    }
    run_stage(program, bindings, inputs, limits)
}

/// Evaluates vertices at given inputs.
///
/// # Errors
/// As [`run_fragment`].
pub fn run_vertex<D: Domain>(
    program: &Program,
    bindings: &mut Bindings<D>,
    inputs: &StageInputs<D>,
    limits: &Limits,
) -> Result<(StageOutputs<D>, Outcome)> {
    expect_stage(program, ShaderStage::Vertex, "vertex")?;
    run_stage(program, bindings, inputs, limits)
}

/// Evaluates an entry point of any stage: `workgroups` counts for compute shaders, `inputs` for the others.
///
/// # Errors
/// As [`run_compute`] and [`run_fragment`].
pub fn run_entry<D: Domain>(
    program: &Program,
    bindings: &mut Bindings<D>,
    inputs: &StageInputs<D>,
    workgroups: [u32; 3],
    limits: &Limits,
) -> Result<(Option<StageOutputs<D>>, Outcome)> {
    match program.stage {
        ShaderStage::Vertex => {
            run_vertex(program, bindings, inputs, limits).map(|(outputs, outcome)| (Some(outputs), outcome))
        }
        ShaderStage::Fragment => {
            run_fragment(program, bindings, inputs, limits).map(|(outputs, outcome)| (Some(outputs), outcome))
        }
        // `run_compute` names the stage of any other entry point in its error.
        ShaderStage::Compute
        | ShaderStage::Task
        | ShaderStage::Mesh
        | ShaderStage::RayGeneration
        | ShaderStage::Miss
        | ShaderStage::AnyHit
        | ShaderStage::ClosestHit => {
            run_compute(program, bindings, workgroups, limits).map(|outcome| (None, outcome))
        }
    }
}

fn run_stage<D: Domain>(
    program: &Program,
    bindings: &mut Bindings<D>,
    inputs: &StageInputs<D>,
    limits: &Limits,
) -> Result<(StageOutputs<D>, Outcome)> {
    let mut prepared = prepare::prepare(program, bindings, limits)?;
    let (outputs, counters) = batches::stage(program, &mut prepared, inputs, limits)?;
    prepare::write_back(program, prepared, bindings);
    Ok((outputs, Outcome::new(program, counters)))
}

/// Runs a *probe*: a compute shader that reads `array<f32>` at group 0, binding 0, writes `array<f32>` at group 0, binding 1,
/// and handles one item an invocation, `items` in all. This is the `embedded` route of conformance with [`F32`](crate::F32), and
/// the tolerance with [`Accept`](crate::Accept).
///
/// Outputs the shader does not write stay NaN (indeterminate in the interval domains).
///
/// # Errors
/// As [`run_compute`].
pub fn run_probe<D: Domain>(
    program: &Program,
    inputs: &[f32],
    output_len: usize,
    items: usize,
    limits: &Limits,
) -> Result<(Vec<D::Float>, Outcome)> {
    let bindings = Bindings::<D>::new().floats(0, 0, inputs);
    run_probe_with(program, bindings, output_len, items, limits)
}

/// As [`run_probe`], with further resources bound, such as a height map; inputs are expected at group 0, binding 0.
///
/// # Errors
/// As [`run_compute`].
pub fn run_probe_with<D: Domain>(
    program: &Program,
    mut bindings: Bindings<D>,
    output_len: usize,
    items: usize,
    limits: &Limits,
) -> Result<(Vec<D::Float>, Outcome)> {
    let kind = crate::kind::Kind::Float(crate::width::Width::F32);
    let sentinel = Scalar::Float(D::to_float(D::indeterminate(kind)));
    bindings
        .buffers
        .insert((0, 1), BufferData::Scalars(vec![sentinel; output_len]));
    let group = program
        .workgroup_size
        .iter()
        .map(|&n| n as usize)
        .product::<usize>()
        .max(1);
    let groups = items.div_ceil(group) as u32;
    let outcome = run_compute(program, &mut bindings, [groups, 1, 1], limits)?;
    let outputs = bindings.read_floats(0, 1).ok_or_else(|| Error::Buffer {
        group: 0,
        binding: 1,
        name: "outputs".into(),
        reason: "a probe's outputs are an `array<f32>`".into(),
    })?;
    Ok((outputs, outcome))
}
