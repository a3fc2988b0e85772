//! The two oracles of a probe: truth in f64 and the acceptance interval at each input.
//!
//! They know nothing of each other and meet only in [`expected`]. Truth comes from the formula ([`truth`]); the interval from the
//! IR of the shader that is run, evaluated over `bossage-bounds`' `Accept` domain. The comparator refuses a case where they
//! disagree, so a shader that computes another formula is caught although its interval is its own.

pub(crate) mod stages;
pub mod truth;

use bossage_bounds::{Accept, Limits, Program};
use bossage_shaders::Probe;

use crate::bound::Bound;
use crate::case::with_causes;
use crate::compare::Expected;
use crate::generate::Inputs;

/// What the reports say about the oracles of a probe.
pub const BASIS: [&str; 2] = ["reference f64", "accuracy rules over the shader's IR"];

/// An item's arguments, read one after the other.
#[derive(Clone, Debug)]
pub struct Args<'a, T> {
    rest: &'a [T],
}

impl<'a, T: Copy> Args<'a, T> {
    /// The arguments of one item, tightly packed.
    #[must_use]
    pub fn new(values: &'a [T]) -> Self {
        Self { rest: values }
    }

    /// The next N numbers.
    ///
    /// # Panics
    /// When there are fewer: the oracle and the table of probes disagree, which a test over the table finds.
    pub fn array<const N: usize>(&mut self) -> [T; N] {
        let (head, tail) = self
            .rest
            .split_first_chunk()
            .expect("an oracle reads more inputs than the probe has");
        self.rest = tail;
        *head
    }

    /// The next number.
    pub fn scalar(&mut self) -> T {
        let [x] = self.array();
        x
    }

    /// The next matrix, N columns of N.
    pub fn matrix<const N: usize>(&mut self) -> [[T; N]; N] {
        std::array::from_fn(|_| self.array())
    }

    /// All that is left.
    pub fn rest(&mut self) -> &'a [T] {
        std::mem::take(&mut self.rest)
    }

    /// Whether everything was read.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.rest.is_empty()
    }
}

/// The acceptance intervals of each item's outputs, from the probe's own IR.
///
/// # Errors
/// What the evaluator says: it lacks something that the shader needs.
pub fn bounds(probe: &Probe, program: &Program, inputs: &Inputs) -> Result<Vec<Bound>, String> {
    let outputs = probe.output_floats * inputs.len();
    bossage_bounds::run_probe::<Accept>(program, &inputs.values, outputs, inputs.len(), &Limits::default())
        .map(|(intervals, _)| intervals.into_iter().map(Bound::from).collect())
        .map_err(|error| with_causes(&error))
}

/// The truth of one item's outputs. `None` where the table has none for the probe.
#[must_use]
pub fn truth_of(probe: &Probe, input: &[f32]) -> Option<Vec<f64>> {
    let exact: Vec<f64> = input.iter().copied().map(f64::from).collect();
    truth::find(probe.function()).map(|truth| truth(&mut Args::new(&exact)))
}

/// What a probe's outputs should be, item by item.
///
/// # Errors
/// When an oracle is missing, or has another number of outputs than the probe.
pub fn expected(probe: &Probe, program: &Program, inputs: &Inputs) -> Result<Vec<Vec<Expected>>, String> {
    let bounds = bounds(probe, program, inputs)?;
    let pair = |(input, bounds): (&[f32], &[Bound])| {
        let truth = truth_of(probe, input).ok_or_else(|| format!("no truth for `{}`", probe.function()))?;
        if truth.len() != bounds.len() {
            let (t, b) = (truth.len(), bounds.len());
            return Err(format!("the truth has {t} outputs, the shader {b}"));
        }
        let both = truth.into_iter().zip(bounds);
        Ok(both.map(|(truth, &bound)| Expected { truth, bound }).collect())
    };
    inputs
        .items()
        .zip(bounds.chunks(probe.output_floats))
        .map(pair)
        .collect()
}

#[cfg(test)]
mod tests;
