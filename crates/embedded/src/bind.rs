//! What a job binds, as the evaluator's bindings.

use bossage_bounds::{Bindings, F32};
use bossage_runner::{Error, Machine, Resolved, Value};

use crate::failure::within;
use crate::machine::Embedded;
use crate::texture;

/// Everything that a job's shaders bind.
pub(crate) fn bindings(
    machine: &Embedded,
    job: &str,
    resolved: &[Resolved<'_>],
) -> Result<Bindings<F32>, Error> {
    let mut bindings = Bindings::new();
    for one in resolved {
        let (group, binding) = one.place;
        bindings = match &one.value {
            Value::Uniform(bytes) => bindings.bytes(group, binding, bytes.as_slice()),
            Value::Storage(data) => {
                let limit = machine.dispatch_limits().buffer_bytes;
                within(job, "a buffer's size in bytes", data.len() as u64, limit)?;
                bindings.bytes(group, binding, data.bytes())
            }
            Value::Texture(data) => bindings.texture(group, binding, texture::texture(job, data)?),
            Value::Sampler(settings) => bindings.sampler(group, binding, texture::sampler(job, settings)?),
        };
    }
    Ok(bindings)
}
