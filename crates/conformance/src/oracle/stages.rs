//! The acceptance intervals of a pipeline's stages, from the IR of the very modules that are run.
//!
//! A stage is evaluated over `Accept` at given inputs: a fragment at the interpolants that a picture captured, a vertex at its
//! attributes. Inputs are exact: they are floats that the stage was given. Uniforms are packed and resources bound by the manifest, as
//! the runner does it, at the places of the assembled WGSL, which every route starts from.
//!
//! Fragments are *lone*: the pixel beside a captured one may belong to another triangle, so nothing is known of derivatives. Textures
//! with one level read the same whatever those are; a value that did depend on them would be open.

use std::collections::BTreeMap;

use bossage_bounds::{Accept, Interval, Limits, Program, Scalar, Slot, StageInputs, StageOutputs, Truth};
use bossage_embedded::bindings;
use bossage_runner::{Code, Resources, Shader, resolve};
use bossage_translate::manifest::Entry;

use crate::bound::Bound;
use crate::case::with_causes;
use crate::route::Prepared;

/// Inputs of a stage by the names that the manifest has for them.
#[derive(Clone, Debug)]
pub(crate) struct Inputs {
    count: usize,
    columns: BTreeMap<&'static str, (usize, Vec<Interval>)>,
}

impl Inputs {
    /// Inputs of so many invocations.
    pub(crate) fn new(count: usize) -> Self {
        Self {
            count,
            columns: BTreeMap::new(),
        }
    }

    /// Adds an input of N floats an invocation; a stage may read fewer of them.
    pub(crate) fn with<const N: usize>(
        mut self,
        name: &'static str,
        values: impl Iterator<Item = [f32; N]>,
    ) -> Self {
        let values = values.flatten().map(|value| Interval::point(f64::from(value)));
        self.columns.insert(name, (N, values.collect()));
        self
    }

    /// Adds an input of N intervals an invocation.
    pub(crate) fn with_intervals<const N: usize>(
        mut self,
        name: &'static str,
        values: impl Iterator<Item = [Interval; N]>,
    ) -> Self {
        self.columns.insert(name, (N, values.flatten().collect()));
        self
    }

    /// Of how many invocations.
    pub(crate) fn count(&self) -> usize {
        self.count
    }

    /// What an entry point reads of them.
    fn of(&self, entry: &Entry) -> StageInputs<Accept> {
        let mut inputs = StageInputs::new(self.count);
        for input in &entry.inputs {
            let column = self.columns.get(input.name.as_str());
            if let (Some(location), Some((components, values))) = (input.location, column) {
                inputs = inputs.location(location, *components, values);
            }
        }
        inputs
    }
}

/// The outputs of a stage, invocation by invocation.
#[derive(Debug)]
pub(crate) struct Outputs(StageOutputs<Accept>);

impl Outputs {
    /// The first N scalars at a location.
    ///
    /// # Errors
    /// When the stage has fewer there.
    pub(crate) fn location<const N: usize>(
        &self,
        location: u32,
        invocation: usize,
    ) -> Result<[Bound; N], String> {
        self.slot(Slot::Location(location, 0), invocation)
    }

    /// The same of any output.
    pub(crate) fn slot<const N: usize>(&self, slot: Slot, invocation: usize) -> Result<[Bound; N], String> {
        let column = self.0.columns.get(&slot);
        let scalars = column.and_then(|column| column.of(invocation).first_chunk::<N>());
        let scalars = scalars.ok_or_else(|| format!("the stage has no {N} numbers at {slot:?}"))?;
        Ok(scalars.each_ref().map(bound))
    }

    /// One scalar of any output; `None` where the stage has none there.
    pub(crate) fn component(&self, slot: Slot, invocation: usize, number: usize) -> Option<Bound> {
        let column = self.0.columns.get(&slot)?;
        column.of(invocation).get(number).map(bound)
    }

    /// 1 where a fragment is kept, 0 where it is discarded, forked where that is not decided.
    pub(crate) fn kept(&self, invocation: usize) -> Bound {
        match self.0.discarded[invocation] {
            Truth::False => Bound::exactly(1.0),
            Truth::True => Bound::exactly(0.0),
            Truth::Maybe => Bound::between(0.0, 1.0).forked(),
        }
    }
}

fn bound(scalar: &Scalar<Accept>) -> Bound {
    match scalar {
        Scalar::Float(interval) => Bound::from(*interval),
        Scalar::Int(..) | Scalar::Bool(_) => Bound::OPEN,
    }
}

/// A module's entry point with what it binds.
pub(crate) struct Stage<'a> {
    pub(crate) module: &'a Prepared,
    pub(crate) entry: &'a str,
    pub(crate) resources: &'a Resources<'a>,
    /// Whether what runs it filters textures ideally, as the evaluator does.
    pub(crate) ideal_filter: bool,
}

impl Stage<'_> {
    /// The intervals of fragments.
    ///
    /// # Errors
    /// What the evaluator says: an input or a binding is missing, or it lacks something that the shader needs.
    pub(crate) fn fragments(&self, inputs: &Inputs) -> Result<Outputs, String> {
        let (program, entry) = self.program()?;
        let inputs = inputs.of(entry).lone();
        self.run(entry, |bindings| {
            bossage_bounds::run_fragment(&program, bindings, &inputs, &Limits::default())
        })
    }

    /// The intervals of vertices.
    ///
    /// # Errors
    /// As [`Stage::fragments`].
    pub(crate) fn vertices(&self, inputs: &Inputs) -> Result<Outputs, String> {
        let (program, entry) = self.program()?;
        let inputs = inputs.of(entry);
        self.run(entry, |bindings| {
            bossage_bounds::run_vertex(&program, bindings, &inputs, &Limits::default())
        })
    }

    fn program(&self) -> Result<(std::sync::Arc<Program>, &Entry), String> {
        let entry = self.module.manifest.entry(self.entry);
        let entry = entry.ok_or_else(|| format!("the manifest has no entry point `{}`", self.entry))?;
        Ok((self.module.program(self.entry)?, entry))
    }

    fn run<T>(
        &self,
        entry: &Entry,
        run: impl FnOnce(
            &mut bossage_bounds::Bindings<Accept>,
        ) -> bossage_bounds::Result<(StageOutputs<Accept>, T)>,
    ) -> Result<Outputs, String> {
        let shader = Shader {
            code: Code::Wgsl(self.module.text()),
            entry,
        };
        let resolved =
            resolve(self.entry, &[&shader], self.resources).map_err(|error| with_causes(&error))?;
        let mut bindings = bindings::<Accept>(self.entry, &resolved).map_err(|error| with_causes(&error))?;
        for sampler in bindings.samplers.values_mut().flatten() {
            sampler.ideal = self.ideal_filter;
        }
        let (outputs, _) = run(&mut bindings).map_err(|error| with_causes(&error))?;
        Ok(Outputs(outputs))
    }
}
