//! Compute jobs: bind, dispatch, read back.
//!
//! Outputs hold the [sentinel](crate::SENTINEL) before the shader runs, so what it never wrote can be told.

use std::collections::BTreeMap;

use crate::code::Shader;
use crate::device::Device;
use crate::error::Error;
use crate::resources::Resources;

/// A dispatch.
#[derive(Clone, Debug)]
pub struct ComputeJob<'a> {
    /// The name that errors use.
    pub name: &'a str,
    /// What to run.
    pub shader: Shader<'a>,
    /// What to bind.
    pub resources: Resources<'a>,
    /// How many workgroups.
    pub workgroups: [u32; 3],
}

/// What a compute job left in its writable buffers.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct ComputeOutput {
    /// The bytes, by binding name.
    pub buffers: BTreeMap<String, Vec<u8>>,
}

impl ComputeOutput {
    /// A buffer's floats; empty when there is no such buffer.
    #[must_use]
    pub fn floats(&self, name: &str) -> Vec<f32> {
        self.words(name).into_iter().map(f32::from_bits).collect()
    }

    /// A buffer's words; empty when there is no such buffer.
    #[must_use]
    pub fn words(&self, name: &str) -> Vec<u32> {
        let bytes = self.buffers.get(name).map(Vec::as_slice).unwrap_or_default();
        let (chunks, _) = bytes.as_chunks::<4>();
        chunks.iter().map(|chunk| u32::from_le_bytes(*chunk)).collect()
    }
}

impl ComputeJob<'_> {
    /// Runs the job and reads its writable buffers back.
    ///
    /// # Errors
    /// When the resources don't fit the shader, the driver refuses, or memory ends.
    pub fn run(&self, device: &Device) -> Result<ComputeOutput, Error> {
        Err(Error::Internal { job: self.name.to_owned(), message: format!("{} can't run yet", device.info()) })
    }
}
