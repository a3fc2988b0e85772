//! Dispatches.

use std::collections::BTreeMap;

use bossage_runner::{ComputeJob, ComputeOutput, Error, Machine, push_constants, resolve};

use crate::child;
use crate::job::Words;
use crate::machine::Metal;
use crate::tables::Tables;

/// Runs a dispatch; gives back all buffers that it may write.
pub(crate) fn run(machine: &Metal, job: &ComputeJob<'_>) -> Result<ComputeOutput, Error> {
    job.check(machine.dispatch_limits().workgroups)?;
    let resolved = resolve(job.name, &[&job.shader], &job.resources)?;
    let pushed = push_constants(job.name, &[&job.shader], &job.resources)?;
    let tables = Tables::of(job.name, &job.shader, &resolved, &pushed)?;
    let program = machine.programs.get(job.name, &job.shader)?;
    let mut words = Words::job();
    words.append(&tables.words);
    for count in job.workgroups {
        words.word(count);
    }
    let bytes = tables
        .written
        .iter()
        .map(|(_, bytes)| bytes.next_multiple_of(4))
        .sum();
    let answer = child::answer(job.name, &program.path, &words, bytes, &machine.limits)?;
    let mut buffers = BTreeMap::new();
    let mut at = 0;
    for (name, bytes) in tables.written {
        buffers.insert(name, answer[at..at + bytes].to_vec());
        at += bytes.next_multiple_of(4);
    }
    Ok(ComputeOutput {
        buffers,
        ..ComputeOutput::default()
    })
}
