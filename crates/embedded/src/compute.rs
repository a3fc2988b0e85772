//! Dispatches.

use std::collections::BTreeMap;

use bossage_bounds::{F32, Limits, run_compute};
use bossage_runner::{ComputeJob, ComputeOutput, Error, Machine, Value, push_constants, resolve};
use bossage_translate::manifest::Kind;

use crate::bind::bindings;
use crate::failure::of_job;
use crate::machine::Embedded;
use crate::texture;

/// Runs a dispatch; gives back all buffers and textures that it may write.
pub(crate) fn run(machine: &Embedded, job: &ComputeJob<'_>) -> Result<ComputeOutput, Error> {
    job.check(machine.dispatch_limits().workgroups)?;
    let resolved = resolve(job.name, &[&job.shader], &job.resources)?;
    let pushed = push_constants(job.name, &[&job.shader], &job.resources)?;
    let mut bindings = bindings::<F32>(job.name, &resolved)?.immediate(pushed);
    let compiled = machine.programs.get(job.name, &job.shader)?;
    run_compute(
        &compiled.program,
        &mut bindings,
        job.workgroups,
        &Limits::default(),
    )
    .map_err(|refusal| of_job(job.name, refusal))?;
    let mut buffers = BTreeMap::new();
    for one in resolved
        .iter()
        .filter(|one| one.binding.kind == Kind::StorageBuffer)
    {
        let Value::Storage(data) = &one.value else {
            continue;
        };
        let mut bytes = data.bytes().into_owned();
        let (group, binding) = one.place;
        bindings
            .read_bytes(&compiled.program, group, binding, &mut bytes)
            .ok_or_else(|| {
                Error::misfit(
                    job.shader.entry,
                    &one.binding.name,
                    "it can't be read back".to_owned(),
                )
            })?;
        buffers.insert(one.binding.name.clone(), bytes);
    }
    let mut textures = BTreeMap::new();
    for one in &resolved {
        if let (Value::StorageTexture(data), Some(scalars)) =
            (&one.value, bindings.written_textures.get(&one.place))
        {
            let bytes = texture::format(data.format).bytes_of(scalars);
            textures.insert(one.binding.name.clone(), bytes);
        }
    }
    Ok(ComputeOutput { buffers, textures })
}
