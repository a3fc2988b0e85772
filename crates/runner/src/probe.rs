//! Probes: a function over an array of inputs, one invocation an item.
//!
//! The shader has `inputs: array<f32>` and `outputs: array<f32>` (storage), items tightly packed, and takes the number of
//! items from the length of `outputs`. More items than a dispatch or a buffer can take are run in pieces, in order.

use std::collections::BTreeMap;

use bossage_translate::manifest::Entry;

use crate::code::{Code, Shader};
use crate::compute::ComputeJob;
use crate::error::Error;
use crate::machine::{DispatchLimits, Machine};
use crate::resources::{BufferData, Resources};
use crate::texture::TextureData;

/// The name that a probe's inputs have.
pub const INPUTS: &str = "inputs";
/// The name that a probe's outputs have.
pub const OUTPUTS: &str = "outputs";

/// A function to run over many items.
#[derive(Clone, Debug)]
pub struct ProbeJob<'a> {
    /// The name that errors use.
    pub name: &'a str,
    /// The probe.
    pub shader: Shader<'a>,
    /// The items' inputs, one after the other, all of the same length.
    pub inputs: &'a [f32],
    /// How many items.
    pub items: usize,
    /// How many floats each item's output has.
    pub output_floats: usize,
    /// Uniforms that the probe binds besides.
    pub uniforms: BTreeMap<String, Vec<f32>>,
    /// Textures that the probe binds besides.
    pub textures: BTreeMap<String, &'a TextureData>,
    /// At most so many items a dispatch; `None`: as many as the adapter takes.
    pub chunk_items: Option<usize>,
}

/// Runs a probe that binds nothing but its inputs and outputs: `items × output_floats` floats, those that were never
/// written holding the [sentinel](crate::SENTINEL).
///
/// # Errors
/// As [`ProbeJob::run`].
pub fn run_probe(
    machine: &dyn Machine,
    code: Code<'_>,
    entry: &Entry,
    inputs: &[f32],
    output_floats: usize,
    items: usize,
) -> Result<Vec<f32>, Error> {
    let shader = Shader { code, entry };
    let name = &entry.name;
    let job = ProbeJob {
        name,
        shader,
        inputs,
        items,
        output_floats,
        uniforms: BTreeMap::new(),
        textures: BTreeMap::new(),
        chunk_items: None,
    };
    job.run(machine)
}

impl ProbeJob<'_> {
    /// Runs the probe over all items.
    ///
    /// # Errors
    /// [`Error::Length`] when the inputs are no whole items; otherwise as [`ComputeJob::run`].
    pub fn run(&self, machine: &dyn Machine) -> Result<Vec<f32>, Error> {
        if self.items == 0 {
            return Ok(Vec::new());
        }
        let input_floats = self.input_floats()?;
        let chunk = self.chunk(machine.dispatch_limits(), input_floats)?;
        let mut outputs = Vec::with_capacity(self.items * self.output_floats);
        for start in (0..self.items).step_by(chunk) {
            let count = chunk.min(self.items - start);
            let inputs = &self.inputs[start * input_floats..(start + count) * input_floats];
            outputs.extend(self.piece(inputs, count).run(machine)?.floats(OUTPUTS));
        }
        Ok(outputs)
    }

    fn input_floats(&self) -> Result<usize, Error> {
        let per_item = self.inputs.len() / self.items;
        if self.inputs.len() == per_item * self.items {
            return Ok(per_item);
        }
        Err(Error::Length {
            job: self.name.to_owned(),
            what: format!("inputs of {} items", self.items),
            given: self.inputs.len(),
            expected: per_item * self.items,
        })
    }

    /// How many items go into one dispatch.
    fn chunk(&self, limits: DispatchLimits, input_floats: usize) -> Result<usize, Error> {
        let by_groups = limits.workgroups as usize * self.group_items();
        let bytes = limits.buffer_bytes;
        let item_bytes = 4 * input_floats.max(self.output_floats).max(1);
        let by_bytes = usize::try_from(bytes).unwrap_or(usize::MAX) / item_bytes;
        let most = by_groups.min(by_bytes);
        match self.chunk_items.unwrap_or(most).min(most) {
            0 => Err(Error::TooLarge {
                job: self.name.to_owned(),
                what: "an item's size in bytes",
                given: item_bytes as u64,
                limit: bytes,
            }),
            chunk => Ok(chunk),
        }
    }

    fn group_items(&self) -> usize {
        self.shader.entry.workgroup_size.map_or(1, |size| size[0]).max(1) as usize
    }

    fn piece<'b>(&'b self, inputs: &'b [f32], items: usize) -> ComputeJob<'b> {
        let mut resources = Resources {
            uniforms: self.uniforms.clone(),
            textures: self.textures.clone(),
            ..Resources::default()
        };
        let outputs = BufferData::Output(items * self.output_floats * 4);
        resources.buffers.insert(OUTPUTS.to_owned(), outputs);
        if self.shader.binding(INPUTS).is_some() {
            let bytes = BufferData::Bytes(bytemuck::cast_slice(inputs));
            resources.buffers.insert(INPUTS.to_owned(), bytes);
        }
        let groups = items.div_ceil(self.group_items()) as u32;
        ComputeJob {
            name: self.name,
            shader: self.shader,
            resources,
            workgroups: [groups, 1, 1],
        }
    }
}
