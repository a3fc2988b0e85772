//! What the outputs may be, from the shader's own IR at each of its inputs.

use bossage_bounds::ranges::Point;
use bossage_bounds::{Accept, BufferData, Domain, Error, F32, F64, Limits, Scalar, run_compute};
use bossage_translate::{Code, Diagnostic, Shader};
use rayon::prelude::*;

use super::plan::Ready;
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

/// For each input the expected outputs.
pub(crate) fn of(ready: &Ready, shader: &Shader) -> Vec<Result<Expected, Unknown>> {
    let one = |point| at(ready, point).map_err(|error| unknown(&error, ready, shader));
    ready.points.par_iter().map(one).collect()
}

/// The expected outputs at a point.
pub(crate) fn at(ready: &Ready, point: &Point) -> Result<Expected, Error> {
    Ok(Expected {
        allowed: outputs(ready, point, &ready.limits)?,
        formula: outputs(ready, point, &ready.limits).ok(),
    })
}

/// What a perfect machine returns at a point.
pub(crate) fn perfect(ready: &Ready, point: &Point) -> Result<Vec<Scalar<F32>>, Error> {
    outputs(ready, point, &ready.limits)
}

/// The allowed outputs at a point, within other limits.
pub(crate) fn allowed(ready: &Ready, point: &Point, limits: &Limits) -> Result<Vec<Scalar<Accept>>, Error> {
    outputs(ready, point, limits)
}

fn outputs<D: Domain>(ready: &Ready, point: &Point, limits: &Limits) -> Result<Vec<Scalar<D>>, Error> {
    let (mut bindings, _) = ready.inputs.at::<D>(&[point])?;
    run_compute(&ready.program, &mut bindings, ready.workgroups, limits)?;
    let of_buffer = |buffer: &bossage_bounds::BufferUse| match bindings.buffers.get(&buffer.binding) {
        Some(BufferData::Scalars(scalars)) => scalars.clone(),
        // A run leaves every writable buffer as scalars.
        Some(BufferData::Bytes(_)) | None => Vec::new(),
    };
    Ok(ready
        .outputs
        .iter()
        .flat_map(|(buffer, _)| of_buffer(buffer))
        .collect())
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
