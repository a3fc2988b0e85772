//! Which source lines an error bound comes from, as reports show it: the text with a share beside each line.
//!
//! The share of a line is what the bound of one output at one input would lose in width if the line were exact
//! ([`bossage_bounds::attribution`]); shares need not add up to 100 %. Of a user's shader the output and the input are those with the widest
//! interval that is decided, or the widest of a named output; of a probe they are the widest among [`ITEMS`] random inputs.

use bossage_bounds::{
    Accept, Attribution, Error as BoundsError, Interval, Limits, Scalar, attribution, run_probe,
};
use bossage_shaders::{Library, Probe};
use serde::Serialize;

use crate::bound::Bound;
use crate::case::with_causes;
use crate::compare::NamedInput;
use crate::error::Error;
use crate::generate::random;
use crate::module::Module;
use crate::oracle;
use crate::report::json::Number;
use crate::route::Route;
use crate::user::expect::At;
use crate::user::{Plan, Ready, judge};

/// Random inputs of a probe among which the widest is looked for.
pub const ITEMS: usize = 256;

/// Intervals within so much of zero are not looked at where the widest is wanted.
const LEAST: f64 = 1e-30;

/// A text with the part that each line has in an error bound.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Heat {
    /// The shader and its entry point, or the probe.
    pub subject: String,
    /// The output.
    pub output: String,
    /// The input.
    pub inputs: Vec<NamedInput>,
    /// The output's acceptance interval there.
    pub interval: [Number; 2],
    /// Its width in ULPs.
    pub ulps: f64,
    /// Every line of the text.
    pub lines: Vec<Line>,
}

/// A line.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Line {
    /// From 1.
    pub number: usize,
    /// Its text.
    pub text: String,
    /// The share of the width that the bound would lose if this line were exact; `None` where nothing is computed.
    pub share: Option<f64>,
}

/// Which output of a user's shader is attributed.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Wanted {
    /// None.
    Nothing,
    /// The one with the widest interval.
    Widest,
    /// The one of this name.
    Named(String),
}

fn lines(text: &str, attribution: &Attribution) -> Vec<Line> {
    let share = |number: usize| {
        let found = attribution.lines.iter().find(|line| line.line == number);
        found.map(|line| line.share)
    };
    (1..)
        .zip(text.lines())
        .map(|(number, text)| Line {
            number,
            text: text.to_owned(),
            share: share(number),
        })
        .collect()
}

fn ends(interval: Interval) -> [Number; 2] {
    [Number(interval.lo), Number(interval.hi)]
}

/// The heat of a user's entry point.
pub(crate) fn of_entry(
    plan: &Plan,
    ready: &Ready,
    text: &str,
    expected: &[At],
    wanted: &Wanted,
) -> Result<Option<Heat>, Error> {
    let named = match wanted {
        Wanted::Nothing => return Ok(None),
        Wanted::Widest => None,
        Wanted::Named(name) => Some(name),
    };
    let count = expected
        .iter()
        .filter_map(|one| one.as_ref().as_ref().ok())
        .map(|one| one.allowed.len())
        .max()
        .unwrap_or(0);
    let outputs: Vec<usize> = (0..count)
        .filter(|&output| named.is_none_or(|name| ready.name(output) == *name))
        .collect();
    if let (Some(name), true) = (named, outputs.is_empty()) {
        return Err(Error::NoOutput {
            name: name.clone(),
            known: (0..count).take(12).map(|output| ready.name(output)).collect(),
        });
    }
    let mut widest: Option<(f64, usize, usize)> = None;
    for (at, expected) in expected.iter().enumerate() {
        let Ok(expected) = expected.as_ref() else {
            continue;
        };
        for &output in &outputs {
            let Scalar::Float(_) = expected.allowed[output] else {
                continue;
            };
            let bound = judge::bound(&expected.allowed[output]);
            // Next to zero any width is many ULPs of nothing; a named output is taken as it is.
            let counts = named.is_some() || bound.low().abs().max(bound.high().abs()) > LEAST;
            let ulps = bound.width_ulps().filter(|_| bound.is_settled() && counts);
            if let Some(ulps) = ulps.filter(|ulps| widest.is_none_or(|(most, _, _)| *ulps > most)) {
                widest = Some((ulps, at, output));
            }
        }
    }
    let Some((ulps, at, output)) = widest else {
        return Ok(None);
    };
    let points = &ready.points[at];
    let evaluate = |limits: &Limits| {
        ready
            .evaluate::<Accept>(points, limits)
            .map(|all| match all[output] {
                Scalar::Float(interval) => interval,
                Scalar::Int(..) | Scalar::Bool(_) => Interval::unknown(bossage_bounds::Flags::UNDECIDED),
            })
    };
    let found = attribution(&ready.program, text, &ready.limits, evaluate)
        .ok()
        .flatten();
    let name = ready.name(output);
    Ok(found.map(|found| Heat {
        subject: format!("{}/{}", plan.shader, plan.entry),
        inputs: ready.named_inputs(&points[ready.lane(output)], &name),
        output: name,
        interval: ends(found.interval),
        ulps,
        lines: lines(text, &found),
    }))
}

/// The heat of an output of each of these probes.
///
/// # Errors
/// [`Error::NoOutput`] when a probe has no such output. What the library or the evaluator refuses leaves a probe out.
pub fn of_probes(
    probes: &[&'static Probe],
    output: usize,
    seed: u64,
    library: &Library,
) -> Result<Vec<Heat>, Error> {
    let mut heats = Vec::new();
    for probe in probes {
        if output >= probe.output_floats {
            return Err(Error::NoOutput {
                name: format!("{output} of {}", probe.function()),
                known: (0..probe.output_floats).map(|n| n.to_string()).collect(),
            });
        }
        heats.extend(of_probe(probe, output, seed, library).ok().flatten());
    }
    Ok(heats)
}

fn of_probe(
    probe: &'static Probe,
    output: usize,
    seed: u64,
    library: &Library,
) -> Result<Option<Heat>, String> {
    let assembled = Module::Probe(probe.id)
        .assemble(library)
        .map_err(|error| error.to_string())?;
    let module = Route::Embedded.prepare(&assembled)?;
    let program = module.program(probe.entry)?;
    let inputs = random::generate(probe, ITEMS, 0, seed);
    let bounds = oracle::bounds(probe, &program, &inputs)?;
    let of_item = |bounds: &[Bound]| {
        let bound = bounds[output];
        bound.width_ulps().filter(|_| bound.is_settled())
    };
    let widths = bounds.chunks(probe.output_floats).map(of_item);
    let widest = widths
        .enumerate()
        .filter_map(|(at, ulps)| Some((at, ulps?)))
        .max_by(|a, b| a.1.total_cmp(&b.1));
    let Some((at, ulps)) = widest else {
        return Ok(None);
    };
    let input: Vec<f32> = inputs.items().nth(at).unwrap_or_default().to_vec();
    let evaluate = |limits: &Limits| -> Result<Interval, BoundsError> {
        run_probe::<Accept>(&program, &input, probe.output_floats, 1, limits).map(|(all, _)| all[output])
    };
    let found = attribution(&program, module.text(), &Limits::default(), evaluate)
        .map_err(|error| with_causes(&error))?;
    let mut at = 0;
    let mut next = |n: usize| {
        at += n;
        input[at - n..at].iter().map(|x| f64::from(*x)).collect()
    };
    let fields = probe.inputs.iter().map(|field| NamedInput {
        name: field.name.to_owned(),
        values: next(field.shape.floats()),
    });
    let fields: Vec<NamedInput> = fields.collect();
    Ok(found.map(|found| Heat {
        subject: probe.function().to_owned(),
        output: output.to_string(),
        inputs: fields,
        interval: ends(found.interval),
        ulps,
        lines: lines(module.text(), &found),
    }))
}

#[cfg(test)]
mod tests {
    use bossage_shaders::{Library, PROBES};

    use super::of_probes;

    #[test]
    fn a_probe_names_a_line_that_its_bound_comes_from() {
        let probe = PROBES
            .iter()
            .find(|probe| probe.function() == "normalise")
            .unwrap();
        let library = Library::embedded().unwrap();
        let heats = of_probes(&[probe], 0, 1, &library).unwrap();
        let most = heats[0]
            .lines
            .iter()
            .max_by(|a, b| a.share.unwrap_or(0.0).total_cmp(&b.share.unwrap_or(0.0)))
            .unwrap();
        assert!(most.share.unwrap() > 0.1, "{most:?}");
        assert!(
            heats[0].lines.iter().any(|line| line.share.is_none()),
            "declarations compute nothing"
        );
        assert!(of_probes(&[probe], 99, 1, &library).is_err());
    }
}
