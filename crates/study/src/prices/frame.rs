//! One frame of items through a kernel: run on the machine, counted by the evaluator.

use std::collections::BTreeMap;
use std::sync::Arc;

use bossage_bounds::{F32, Limits, run_compute};
use bossage_conformance::Route;
use bossage_conformance::route::Prepared;
use bossage_embedded::bindings;
use bossage_runner::{BufferData, ComputeJob, Resources, SamplerSettings, TextureData, resolve};
use bossage_shaders::AssembledShader;

use super::variant::Timed;
use super::{Context, Error};

/// Invocations of a workgroup: all kernels are one-dimensional.
const WORKGROUP: u32 = 64;

/// Items whose operations are counted where the machine runs the frame: the first ones, since items are in no order.
const COUNTED: u32 = 2048;

/// The buffer that kernels write, unless they say otherwise.
const OUTPUTS: &str = "outputs";

/// A kernel with what it is bound to.
pub(super) struct Frame {
    prepared: Prepared,
    entry: String,
    items: u32,
    output: &'static str,
    output_bytes: usize,
    textures: BTreeMap<&'static str, TextureData>,
    samplers: BTreeMap<&'static str, SamplerSettings>,
    buffers: BTreeMap<&'static str, Arc<[u8]>>,
}

/// What an item costs on average, counted.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Cost {
    /// Scalar operations.
    pub(super) ops: f64,
    /// Texture reads.
    pub(super) fetches: f64,
}

/// What came of a frame.
pub(super) struct Measured<'a> {
    /// The floats of [`OUTPUTS`].
    pub(super) outputs: Vec<f64>,
    pub(super) cost: Cost,
    /// What is to be timed, or why nothing is.
    pub(super) timed: Result<Timed<'a>, String>,
}

impl Frame {
    /// The entry point of WESL text that imports from the library, over so many items that leave so many bytes each.
    pub(super) fn new(
        context: &Context<'_>,
        text: &str,
        entry: &str,
        items: u32,
        bytes_each: usize,
    ) -> Result<Self, Error> {
        let assembled = context.library.assemble_text(entry, text, entry)?;
        Self::of(&assembled, entry, items, bytes_each)
    }

    /// The entry point of an assembled module.
    pub(super) fn of(
        assembled: &AssembledShader,
        entry: &str,
        items: u32,
        bytes_each: usize,
    ) -> Result<Self, Error> {
        let refused = |problem| Error::Kernel {
            kernel: entry.to_owned(),
            problem,
        };
        Ok(Self {
            prepared: Route::Wgsl.prepare(assembled).map_err(refused)?,
            entry: entry.to_owned(),
            items,
            output: OUTPUTS,
            output_bytes: bytes_each * items as usize,
            textures: BTreeMap::new(),
            samplers: BTreeMap::new(),
            buffers: BTreeMap::new(),
        })
    }

    pub(super) fn texture(mut self, name: &'static str, texels: TextureData) -> Self {
        self.textures.insert(name, texels);
        self
    }

    pub(super) fn sampler(mut self, name: &'static str, sampler: SamplerSettings) -> Self {
        self.samplers.insert(name, sampler);
        self
    }

    /// A buffer that is read, or a uniform one.
    pub(super) fn buffer(mut self, name: &'static str, bytes: &Arc<[u8]>) -> Self {
        self.buffers.insert(name, Arc::clone(bytes));
        self
    }

    /// With a buffer of that name written instead of [`OUTPUTS`].
    pub(super) fn leaving(mut self, output: &'static str) -> Self {
        self.output = output;
        self
    }

    /// Runs the frame on the machine and counts what an item costs. What the machine lacks the evaluator does instead, and there is
    /// no time then.
    pub(super) fn measure(&self, context: &Context<'_>) -> Result<Measured<'_>, Error> {
        let job = self.job()?;
        match job.run(context.machine) {
            Ok(output) => Ok(Measured {
                outputs: output.floats(self.output).into_iter().map(f64::from).collect(),
                cost: self.cost()?,
                timed: Ok(Timed::Compute(job)),
            }),
            Err(lacking @ bossage_runner::Error::Unsupported { .. }) => {
                let (outputs, cost) = self.evaluate(self.items)?;
                Ok(Measured {
                    outputs,
                    cost,
                    timed: Err(lacking.to_string()),
                })
            }
            Err(error) => Err(error.into()),
        }
    }

    /// What is to be timed, or what the machine lacks.
    pub(super) fn timed(&self, context: &Context<'_>) -> Result<Result<Timed<'_>, String>, Error> {
        let job = self.job()?;
        match job.run(context.machine) {
            Ok(_) => Ok(Ok(Timed::Compute(job))),
            Err(lacking @ bossage_runner::Error::Unsupported { .. }) => Ok(Err(lacking.to_string())),
            Err(error) => Err(error.into()),
        }
    }

    /// What one of the first items costs.
    pub(super) fn cost(&self) -> Result<Cost, Error> {
        Ok(self.execute(COUNTED)?.0)
    }

    /// What a perfect machine leaves after the first items, all of it floats, and what one of these costs.
    pub(super) fn evaluate(&self, items: u32) -> Result<(Vec<f64>, Cost), Error> {
        let (cost, outputs) = self.execute(items)?;
        let outputs =
            outputs.ok_or_else(|| self.refused(format!("it has no floats called `{}`", self.output)))?;
        Ok((outputs, cost))
    }

    /// The first items on a perfect machine: what one costs, and what they leave, if all of it is floats.
    fn execute(&self, items: u32) -> Result<(Cost, Option<Vec<f64>>), Error> {
        let job = self.job()?;
        let program = self.prepared.program(&self.entry);
        let program = program.map_err(|problem| self.refused(problem))?;
        let resolved = resolve(job.name, &[&job.shader], &job.resources)?;
        let mut bound = bindings::<F32>(job.name, &resolved)?;
        let items = items.min(self.items);
        let workgroups = [items.div_ceil(WORKGROUP), 1, 1];
        let counters = run_compute(&program, &mut bound, workgroups, &Limits::default())?.counters;
        if counters.out_of_bounds > 0 {
            let times = counters.out_of_bounds;
            return Err(self.refused(format!(
                "it reads or writes outside of what it is bound to, {times} times"
            )));
        }
        let each = |total: u64| total as f64 / f64::from(items);
        let cost = Cost {
            ops: each(counters.operations),
            fetches: each(counters.fetches),
        };
        let output = resolved.iter().find(|one| one.binding.name == self.output);
        let floats = output.and_then(|one| bound.read_floats(one.place.0, one.place.1));
        Ok((cost, floats))
    }

    /// The dispatch of the whole frame.
    pub(super) fn job(&self) -> Result<ComputeJob<'_>, Error> {
        let shader = self.prepared.shader(&self.entry);
        Ok(ComputeJob {
            name: &self.entry,
            shader: shader.map_err(|problem| self.refused(problem))?,
            resources: self.resources(),
            workgroups: [self.items.div_ceil(WORKGROUP), 1, 1],
        })
    }

    fn resources(&self) -> Resources<'_> {
        let mut resources = Resources::default();
        for (name, texels) in &self.textures {
            resources.textures.insert((*name).to_owned(), texels);
        }
        for (name, sampler) in &self.samplers {
            resources.samplers.insert((*name).to_owned(), *sampler);
        }
        for (name, bytes) in &self.buffers {
            resources
                .buffers
                .insert((*name).to_owned(), BufferData::Bytes(bytes));
        }
        let outputs = BufferData::Output(self.output_bytes);
        resources.buffers.insert(self.output.to_owned(), outputs);
        resources
    }

    fn refused(&self, problem: String) -> Error {
        Error::Kernel {
            kernel: self.entry.clone(),
            problem,
        }
    }
}

/// Numbers as the bytes of a buffer.
pub(super) fn bytes_of<T: bytemuck::NoUninit>(numbers: &[T]) -> Arc<[u8]> {
    bytemuck::cast_slice(numbers).into()
}
