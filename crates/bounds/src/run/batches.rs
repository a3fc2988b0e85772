//! Splitting a run into batches, on all cores, with results that do not depend on how many there are.

use super::ports::{default_input, foreign_builtin, input_columns, slot_of, unsupported_port, wrong_kind};
use super::prepare::Prepared;
use crate::bindings::Scalar;
use crate::compile::code::{Node, Op};
use crate::compile::program::{Port, Program};
use crate::domain::{Domain, Truth};
use crate::error::{Error, Result};
use crate::exec::machine::{Context, Counters, Machine};
use crate::exec::memory::{Memory, Pages};
use crate::kind::IntType;
use crate::limits::Limits;
use crate::stage::{Column, StageInputs, StageOutputs};
use naga::{Binding, BuiltIn};
use rayon::prelude::*;
use std::collections::BTreeMap;

/// Invocations of a batch where nothing else decides it: enough to share the cost of decoding, few enough for the cache.
const LANES: usize = 64;

/// Batches that run from one state of memory before their writes are merged.
const WINDOW: usize = 256;

/// What one batch gives.
struct BatchResult<D: Domain, T> {
    pages: Pages<D>,
    counters: Counters,
    value: T,
}

/// Runs batches in windows: in parallel within a window, their writes merged in order after it. Programs with atomics see each
/// batch's writes before the next starts.
fn windows<D: Domain, T: Send>(
    program: &Program,
    prepared: &mut Prepared<D>,
    limits: &Limits,
    batches: usize,
    run: impl Fn(&Context<'_, D>, usize) -> Result<BatchResult<D, T>> + Sync,
) -> Result<(Vec<T>, Counters)> {
    let window = if has_atomics(program) { 1 } else { WINDOW };
    let mut counters = Counters::default();
    let mut values = Vec::with_capacity(batches);
    let mut at = 0;
    while at < batches {
        let end = (at + window).min(batches);
        let results: Vec<BatchResult<D, T>> = {
            let context = context(program, limits, &prepared.memory, prepared);
            (at..end)
                .into_par_iter()
                .map(|batch| run(&context, batch))
                .collect::<Result<_>>()?
        };
        for result in results {
            prepared.memory.commit(result.pages);
            counters.absorb(&result.counters);
            values.push(result.value);
        }
        at = end;
    }
    Ok((values, counters))
}

fn context<'a, D: Domain>(
    program: &'a Program,
    limits: &'a Limits,
    memory: &'a Memory<D>,
    prepared: &'a Prepared<D>,
) -> Context<'a, D> {
    Context {
        program,
        limits,
        memory,
        textures: &prepared.textures,
        samplers: &prepared.samplers,
    }
}

fn has_atomics(program: &Program) -> bool {
    fn any(nodes: &[Node]) -> bool {
        nodes.iter().any(|node| match node {
            Node::Run(run) => run.iter().any(|i| matches!(i.op, Op::Atomic(_))),
            Node::If { accept, reject, .. } => any(accept) || any(reject),
            Node::Switch { cases, .. } => cases.iter().any(|c| any(&c.body)),
            Node::Loop(l) => any(&l.body) || any(&l.continuing),
            Node::Break | Node::Continue | Node::Return | Node::Kill | Node::Barrier | Node::Call { .. } => {
                false
            }
        })
    }
    program.code.functions.iter().any(|f| any(&f.body))
}

/// Checks that the register files fit, and gives the number of lanes of a batch.
fn lanes_of_batch<D: Domain>(
    program: &Program,
    limits: &Limits,
    wanted: usize,
    needed: bool,
) -> Result<usize> {
    let threads = rayon::current_num_threads().max(1);
    let column = (program.code.kinds.len() * size_of::<D::Cell>() * if D::UNCERTAIN { 2 } else { 1 }).max(1);
    let room = usize::try_from(limits.memory).unwrap_or(usize::MAX) / 2 / threads / column;
    if room >= wanted {
        return Ok(wanted);
    }
    if needed || room < 4 {
        let bytes = (column * wanted * threads) as u64 * 2;
        let what = format!(
            "{wanted} invocations of {} values each run together",
            program.code.kinds.len()
        );
        return Err(Error::Memory {
            needed: bytes,
            limit: limits.memory,
            what,
        });
    }
    Ok(room / 4 * 4)
}

pub(super) fn compute<D: Domain>(
    program: &Program,
    prepared: &mut Prepared<D>,
    groups: [u32; 3],
    limits: &Limits,
) -> Result<Counters> {
    let size = program.workgroup_size.map(|n| n.max(1) as usize);
    let group: usize = size.iter().product();
    let count: usize = groups.iter().map(|&n| n as usize).product();
    let lanes = lanes_of_batch::<D>(program, limits, group, true)?;
    let (_, counters) = windows(program, prepared, limits, count, |context, index| {
        let mut machine = Machine::new(context, lanes);
        let [gx, gy, _] = groups.map(|n| n as usize);
        let id = [index % gx, index / gx % gy, index / gx / gy];
        for port in &program.inputs {
            set_compute_input(&mut machine, port, id, size, groups);
        }
        machine.run()?;
        let (pages, counters) = machine.finish();
        Ok(BatchResult {
            pages,
            counters,
            value: (),
        })
    })?;
    Ok(counters)
}

/// Fills a built-in input of all invocations of one workgroup.
fn set_compute_input<D: Domain>(
    machine: &mut Machine<'_, D>,
    port: &Port,
    id: [usize; 3],
    size: [usize; 3],
    groups: [u32; 3],
) {
    let Binding::BuiltIn(builtin) = port.binding else {
        return;
    };
    let group: usize = size.iter().product();
    for lane in 0..group {
        let local = [lane % size[0], lane / size[0] % size[1], lane / size[0] / size[1]];
        let sub = crate::exec::quads::SUBGROUP;
        let values: [usize; 3] = match builtin {
            BuiltIn::GlobalInvocationId => std::array::from_fn(|k| id[k] * size[k] + local[k]),
            BuiltIn::LocalInvocationId => local,
            BuiltIn::LocalInvocationIndex => [lane, 0, 0],
            BuiltIn::WorkGroupId => id,
            BuiltIn::WorkGroupSize => size,
            BuiltIn::NumWorkGroups => groups.map(|n| n as usize),
            BuiltIn::NumSubgroups => [group.div_ceil(sub), 0, 0],
            BuiltIn::SubgroupId => [lane / sub, 0, 0],
            BuiltIn::SubgroupSize => [sub, 0, 0],
            BuiltIn::SubgroupInvocationId => [lane % sub, 0, 0],
            BuiltIn::PrimitiveIndex
            | BuiltIn::Position { .. }
            | BuiltIn::ViewIndex
            | BuiltIn::ClipDistances
            | BuiltIn::InstanceIndex
            | BuiltIn::PointSize
            | BuiltIn::VertexIndex
            | BuiltIn::FragDepth
            | BuiltIn::FrontFacing
            | BuiltIn::Barycentric { .. }
            | BuiltIn::SampleIndex
            | BuiltIn::SampleMask
            | foreign_builtin!() => [0; 3],
        };
        let most = any_subgroup::<D>(builtin, group);
        for (&row, value) in port.rows.iter().zip(values) {
            let cell = match most {
                Some((lo, hi)) => D::int_range(IntType::U32, lo, hi),
                None => D::int(IntType::U32, value as i128),
            };
            machine.set(row, lane as u32, cell);
        }
    }
}

/// In an interval domain, what a built-in value about subgroups may be on any machine: a subgroup has 4 to 128 invocations.
fn any_subgroup<D: Domain>(builtin: BuiltIn, group: usize) -> Option<(i128, i128)> {
    let group = group as i128;
    let known = [
        (BuiltIn::SubgroupSize, (4, 128)),
        (BuiltIn::NumSubgroups, (1, group)),
        (BuiltIn::SubgroupId, (0, group - 1)),
        (BuiltIn::SubgroupInvocationId, (0, 127)),
    ];
    let found = known.into_iter().find(|(b, _)| *b == builtin);
    found.filter(|_| D::UNCERTAIN).map(|(_, bounds)| bounds)
}

pub(super) fn stage<D: Domain>(
    program: &Program,
    prepared: &mut Prepared<D>,
    inputs: &StageInputs<D>,
    limits: &Limits,
) -> Result<(StageOutputs<D>, Counters)> {
    let columns = input_columns(program, inputs)?;
    let lanes = lanes_of_batch::<D>(program, limits, LANES, false)?;
    let batches = inputs.count.div_ceil(lanes);
    let (parts, counters) = windows(program, prepared, limits, batches, |context, index| {
        let range = index * lanes..((index + 1) * lanes).min(inputs.count);
        stage_batch(context, (&columns, inputs.lone), range)
    })?;
    let mut outputs = StageOutputs {
        columns: BTreeMap::new(),
        discarded: Vec::with_capacity(inputs.count),
    };
    let mut columns: Vec<Vec<Scalar<D>>> = vec![Vec::new(); program.outputs.len()];
    for part in parts {
        outputs.discarded.extend(part.discarded);
        for (column, values) in columns.iter_mut().zip(part.columns) {
            column.extend(values);
        }
    }
    for (port, values) in program.outputs.iter().zip(columns) {
        let slot = slot_of(&port.binding).ok_or_else(|| unsupported_port("output", &port.binding))?;
        outputs.columns.insert(
            slot,
            Column {
                components: port.rows.len(),
                values,
            },
        );
    }
    Ok((outputs, counters))
}

/// Values of the outputs of one batch, and which of its invocations were discarded.
struct StagePart<D: Domain> {
    columns: Vec<Vec<Scalar<D>>>,
    discarded: Vec<Truth>,
}

fn stage_batch<D: Domain>(
    context: &Context<'_, D>,
    (columns, lone): (&[Option<&Column<D>>], bool),
    range: std::ops::Range<usize>,
) -> Result<BatchResult<D, StagePart<D>>> {
    let program = context.program;
    let n = range.len();
    let mut machine = Machine::new(context, n);
    machine.lone = lone;
    for (port, column) in program.inputs.iter().zip(columns) {
        set_stage_input(&mut machine, port, *column, range.clone())?;
    }
    machine.run()?;
    let column = |port: &Port| {
        let each = (0..n as u32).flat_map(|lane| port.rows.iter().map(move |&row| (row, lane)));
        each.map(|(row, lane)| Scalar::from_cell(machine.kind(row), machine.get(row, lane)))
            .collect()
    };
    let columns = program.outputs.iter().map(column).collect();
    let discarded = (0..n as u32).map(|lane| machine.discarded(lane)).collect();
    let (pages, counters) = machine.finish();
    Ok(BatchResult {
        pages,
        counters,
        value: StagePart { columns, discarded },
    })
}

fn set_stage_input<D: Domain>(
    machine: &mut Machine<'_, D>,
    port: &Port,
    column: Option<&Column<D>>,
    range: std::ops::Range<usize>,
) -> Result<()> {
    for (lane, invocation) in (0u32..).zip(range) {
        for (k, &row) in port.rows.iter().enumerate() {
            let kind = machine.kind(row);
            let cell = match column {
                Some(column) => column.of(invocation)[k]
                    .to_cell(kind)
                    .ok_or_else(|| wrong_kind(port, kind))?,
                None => default_input::<D>(&port.binding, kind),
            };
            machine.set(row, lane, cell);
        }
    }
    Ok(())
}
