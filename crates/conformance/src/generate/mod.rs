//! Inputs for probes: hand-picked, hard, evenly spaced, and random, each from the meaning of the fields alone.
//!
//! A generator knows nothing of the function that it feeds; it knows what a field *is* (`Role`) and what is hard about such
//! values. Every generator is deterministic: the same call gives the same inputs on every machine.

pub mod control;
pub mod edge;
pub mod random;
pub mod spaced;

use bossage_shaders::{Field, Probe};

/// Inputs of many items, tightly packed.
#[derive(Clone, Debug, PartialEq)]
pub struct Inputs {
    /// The items' floats, one item after the other.
    pub values: Vec<f32>,
    /// Floats an item; never 0.
    pub stride: usize,
}

impl Inputs {
    /// No items yet.
    #[must_use]
    pub fn of(probe: &Probe) -> Self {
        Self {
            values: Vec::new(),
            stride: probe.input_floats.max(1),
        }
    }

    /// How many items.
    #[must_use]
    pub fn len(&self) -> usize {
        self.values.len() / self.stride
    }

    /// Whether there is nothing to run.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.values.is_empty()
    }

    /// The items in order.
    pub fn items(&self) -> impl Iterator<Item = &[f32]> {
        self.values.chunks_exact(self.stride)
    }

    /// Adds an item, one value list a field.
    pub(crate) fn push(&mut self, fields: impl IntoIterator<Item = Vec<f32>>) {
        self.values.extend(fields.into_iter().flatten());
    }
}

/// The fields' values of every item chosen by `pick`, which gets the field and its place.
pub(crate) fn item(fields: &[Field], mut pick: impl FnMut(usize, &Field) -> Vec<f32>) -> Vec<Vec<f32>> {
    fields
        .iter()
        .enumerate()
        .map(|(place, field)| pick(place, field))
        .collect()
}
