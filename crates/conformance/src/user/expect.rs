//! What the outputs may be, from the shader's own IR at each of its inputs.

use std::collections::{BTreeMap, HashMap};
use std::sync::Arc;

use bossage_bounds::ranges::Point;
use bossage_bounds::{Accept, Error, F32, F64, Limits, Scalar};
use bossage_translate::{Code, Diagnostic, Shader};
use rayon::prelude::*;

use super::ready::Ready;
use crate::case::with_causes;

/// Outputs at one input.
#[derive(Clone, Debug)]
pub(crate) struct Expected {
    /// What is allowed.
    pub(crate) allowed: Vec<Scalar<Accept>>,
    /// What the formula says, where that could be evaluated.
    pub(crate) formula: Option<Vec<Scalar<F64>>>,
}

/// Why there are none.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Unknown {
    /// The shader does not end within its budget of operations.
    Endless(String),
    /// The evaluator leaves something out, or lacks memory.
    Limited(String),
}

/// The expected outputs at the invocations of an input.
pub(crate) fn at(ready: &Ready, points: &[Point]) -> Result<Expected, Error> {
    Ok(Expected {
        allowed: ready.evaluate(points, &ready.limits)?,
        formula: ready.evaluate(points, &ready.limits).ok(),
    })
}

/// What a perfect machine returns.
pub(crate) fn perfect(ready: &Ready, points: &[Point]) -> Result<Vec<Scalar<F32>>, Error> {
    ready.evaluate(points, &ready.limits)
}

/// The expected outputs at the inputs that were asked for. Machines that got the same inputs share them.
pub(super) struct Known<'a> {
    ready: &'a Ready,
    shader: &'a Shader,
    found: HashMap<Vec<u64>, At>,
}

/// Shared, since an input may have very many outputs.
pub(crate) type At = Arc<Result<Expected, Unknown>>;

impl<'a> Known<'a> {
    pub(super) fn new(ready: &'a Ready, shader: &'a Shader) -> Self {
        Self {
            ready,
            shader,
            found: HashMap::new(),
        }
    }

    /// For each input the expected outputs.
    pub(super) fn at<'p>(&mut self, inputs: impl Iterator<Item = &'p [Point]>) -> Vec<At> {
        let keyed: Vec<(Vec<u64>, &[Point])> = inputs.map(|points| (key(points), points)).collect();
        let new: BTreeMap<&Vec<u64>, &[Point]> = keyed
            .iter()
            .filter(|(key, _)| !self.found.contains_key(key))
            .map(|(key, points)| (key, *points))
            .collect();
        let (ready, shader) = (self.ready, self.shader);
        let made: Vec<(Vec<u64>, At)> = new
            .into_par_iter()
            .map(|(key, points)| {
                let expected = at(ready, points).map_err(|error| unknown(&error, ready, shader));
                (key.clone(), Arc::new(expected))
            })
            .collect();
        self.found.extend(made);
        keyed
            .iter()
            .filter_map(|(key, _)| self.found.get(key).cloned())
            .collect()
    }
}

/// Everything of an input, to the bit.
fn key(points: &[Point]) -> Vec<u64> {
    let values = points.iter().flat_map(|point| &point.values);
    let texels = points
        .first()
        .into_iter()
        .flat_map(|point| point.texels.iter().flatten());
    values.chain(texels).map(|x| x.to_bits()).collect()
}

fn unknown(error: &Error, ready: &Ready, shader: &Shader) -> Unknown {
    let Error::Budget { span, .. } = error else {
        return Unknown::Limited(with_causes(error));
    };
    let Limits { operations, .. } = ready.limits;
    let message = format!("it does not end within {operations} operations an invocation");
    let place = span.to_range().map(|range| (range, "still running".to_owned()));
    let diagnostic = Diagnostic::new(Code::Validate, message)
        .at(shader.name(), shader.text(), place)
        .with_hint("if it does end, allow more by --operations");
    Unknown::Endless(diagnostic.to_string())
}
