//! What a job binds, as the evaluator's bindings.

use bossage_bounds::{Bindings, CompareFunction, Domain};
use bossage_runner::{Error, Resolved, Value, within};
use bossage_translate::manifest::Kind;

use crate::texture;

/// Bytes of a buffer: what WebGPU promises everywhere.
pub(crate) const MAX_BUFFER_BYTES: u64 = 128 << 20;

/// Everything that a job's shaders bind, in any domain: what `embedded` runs in `F32`, an oracle runs in `Accept`.
///
/// # Errors
/// What this machine refuses: a buffer that is too large, a texture that is not whole, an anisotropic sampler.
pub fn bindings<D: Domain>(job: &str, resolved: &[Resolved<'_>]) -> Result<Bindings<D>, Error> {
    let mut bindings = Bindings::new();
    for one in resolved {
        let (group, binding) = one.place;
        bindings = match &one.value {
            Value::Uniform(bytes) => bindings.bytes(group, binding, bytes.as_slice()),
            Value::Storage(data) => {
                within(
                    job,
                    "a buffer's size in bytes",
                    data.len() as u64,
                    MAX_BUFFER_BYTES,
                )?;
                bindings.bytes(group, binding, data.bytes())
            }
            Value::Texture(data) | Value::StorageTexture(data) => {
                bindings.texture(group, binding, texture::texture(job, data)?)
            }
            Value::Sampler(settings) => {
                let sampler = texture::sampler(job, settings)?;
                let compares = one.binding.kind == Kind::ComparisonSampler;
                let sampler = match compares {
                    true => sampler.comparing(CompareFunction::LessEqual),
                    false => sampler,
                };
                bindings.sampler(group, binding, sampler)
            }
        };
    }
    Ok(bindings)
}
