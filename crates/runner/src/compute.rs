//! Compute jobs: bind, dispatch, read back.
//!
//! Outputs hold the [sentinel](crate::SENTINEL) before the shader runs, so what it never wrote can be told.

use std::collections::BTreeMap;

use bossage_translate::Stage;

use crate::binding::{self, Bound};
use crate::code::Shader;
use crate::device::Device;
use crate::error::Error;
use crate::limits::within;
use crate::machine::Machine;
use crate::readback::PictureCopy;
use crate::resources::Resources;
use crate::{pipeline, readback};

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

/// What a compute job left in its writable buffers and textures.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct ComputeOutput {
    /// The bytes, by binding name.
    pub buffers: BTreeMap<String, Vec<u8>>,
    /// The texels of written textures, tightly packed, by binding name.
    pub textures: BTreeMap<String, Vec<u8>>,
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
    /// When the resources don't fit the shader, the machine refuses, or memory ends.
    pub fn run(&self, machine: &dyn Machine) -> Result<ComputeOutput, Error> {
        machine.compute(self)
    }
}

/// A job with everything on the device, to be dispatched once or many times.
pub(crate) struct PreparedCompute {
    pipeline: wgpu::ComputePipeline,
    bound: Bound,
    workgroups: [u32; 3],
}

impl ComputeJob<'_> {
    /// Fails when the entry point is none of a dispatch, or there are more workgroups along an axis than a machine takes.
    ///
    /// # Errors
    /// [`Error::Interface`], [`Error::TooLarge`].
    pub fn check(&self, most_workgroups: u32) -> Result<(), Error> {
        self.shader.expect(Stage::Compute)?;
        self.workgroups.into_iter().try_for_each(|count| {
            within(
                self.name,
                "the number of workgroups along an axis",
                u64::from(count),
                u64::from(most_workgroups),
            )
        })
    }

    pub(crate) fn prepare(&self, device: &Device) -> Result<PreparedCompute, Error> {
        self.check(device.limits().max_compute_workgroups_per_dimension)?;
        let bound = binding::bind(device, self.name, &[&self.shader], &self.resources)?;
        let stage = pipeline::stage(device, self.name, &self.shader)?;
        let pipeline = pipeline::compute(device, self.name, stage, &bound.layout)?;
        Ok(PreparedCompute {
            pipeline,
            bound,
            workgroups: self.workgroups,
        })
    }
}

impl PreparedCompute {
    /// Encodes one pass of `repetitions` dispatches.
    pub(crate) fn encode(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        repetitions: u32,
        timestamp_writes: Option<wgpu::ComputePassTimestampWrites<'_>>,
    ) {
        let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor {
            label: None,
            timestamp_writes,
        });
        pass.set_pipeline(&self.pipeline);
        for (index, group) in (0..).zip(&self.bound.groups) {
            pass.set_bind_group(index, group.as_ref(), &[]);
        }
        if !self.bound.push_constants.is_empty() {
            pass.set_immediates(0, &self.bound.push_constants);
        }
        let [x, y, z] = self.workgroups;
        for _ in 0..repetitions {
            pass.dispatch_workgroups(x, y, z);
        }
    }

    pub(crate) fn run(&self, device: &Device, job: &str) -> Result<ComputeOutput, Error> {
        device.scoped(job, || {
            let mut encoder = device
                .device
                .create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
            self.encode(&mut encoder, 1, None);
            let all = wgpu::TextureAspect::All;
            let copies: Vec<_> = self
                .bound
                .stored
                .iter()
                .map(|stored| {
                    PictureCopy::encode(device, &mut encoder, &stored.texture, all, stored.texel_bytes)
                })
                .collect();
            let written: Vec<_> = self.bound.written.iter().map(|written| &written.buffer).collect();
            let (bytes, submission) = readback::buffers(device, job, encoder, &written)?;
            let mut textures = BTreeMap::new();
            for (stored, copy) in self.bound.stored.iter().zip(&copies) {
                textures.insert(stored.name.clone(), copy.read(device, job, submission.clone())?);
            }
            let names = self.bound.written.iter().map(|written| written.name.clone());
            Ok(ComputeOutput {
                buffers: names.zip(bytes).collect(),
                textures,
            })
        })
    }
}
