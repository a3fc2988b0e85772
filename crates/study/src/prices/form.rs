//! `form`: each technique's hardened form against the published one, on ordinary inputs and on hard ones, relative error.
//!
//! Inputs are conformance's: random ones over the whole domain, and hard values in combination. Both forms are judged by the truth of
//! the hardened one: what the formula means where the published form fails. The error of an item is that of its worst output over
//! its largest true one, at least the smallest normal f32; nothing is worse than 1, which a result that is not a number has.
//!
//! Times are those of the probes on ordinary inputs: hard ones take the same code.

use bossage_conformance::generate::{Inputs, edge, random};
use bossage_conformance::oracle::truth_of;
use bossage_shaders::{Form, PROBES, Probe};

use super::frame::{Frame, bytes_of};
use super::variant::{self, Variant};
use super::{Context, Error};
use crate::record::Price;

/// Random items; a frame holds them again and again.
const ORDINARY: usize = 4096;

/// What separates the name of a published function from that of the hardened one.
const SUFFIX: &str = "_published";

/// Published functions that have no hardened one of the same inputs and of one right answer.
const ALONE: &[(&str, &str)] = &[
    ("frame_from_normal_published", "any tangent is right"),
    ("frame_from_normal_unit_published", "any tangent is right"),
    ("frame_hughes_moller_published", "any tangent is right"),
    ("frame_frisvad_published", "any tangent is right"),
    (
        "frame_from_uv_vertex_published",
        "the hardened form takes a weight",
    ),
    (
        "height_to_normal_forward_published",
        "it takes bytes, and other axes",
    ),
    ("soft_shadow_light_published", "the hardened form takes a horizon"),
    (
        "soft_shadow_sample_published",
        "the hardened form weighs no samples",
    ),
    ("wrap_lambert_published", "it takes the light's alpha as well"),
];

/// The two forms of one function.
struct Pair {
    hardened: &'static Probe,
    published: &'static Probe,
}

/// Inputs of a kind.
struct Kind {
    name: &'static str,
    inputs: Inputs,
    truth: Vec<Vec<f64>>,
}

fn pairs() -> Vec<Pair> {
    let published = PROBES.iter().filter(|probe| probe.form == Form::Published);
    let comparable = published.filter(|probe| ALONE.iter().all(|(name, _)| *name != probe.function()));
    comparable.filter_map(pair_of).collect()
}

fn pair_of(published: &'static Probe) -> Option<Pair> {
    let name = published.function().strip_suffix(SUFFIX)?;
    let hardened = PROBES.iter().find(|probe| probe.function() == name)?;
    Some(Pair { hardened, published })
}

/// The inputs of a pair with the truth that both forms are judged by.
fn kinds(context: &Context<'_>, pair: &Pair) -> Result<[Kind; 2], Error> {
    let probe = pair.hardened;
    let ordinary = random::generate(probe, ORDINARY, 0, context.seed);
    let kind = |name, inputs: Inputs| -> Result<Kind, Error> {
        let truth = inputs.items().map(|item| truth_of(probe, item));
        let truth = truth.collect::<Option<Vec<_>>>().ok_or_else(|| Error::Kernel {
            kernel: probe.entry.to_owned(),
            problem: "it has no truth".to_owned(),
        })?;
        Ok(Kind { name, inputs, truth })
    };
    Ok([kind("ordinary", ordinary)?, kind("hard", edge::generate(probe))?])
}

/// How far an item's outputs are off, relative to its largest true one; at most 1.
fn error(truth: &[f64], found: &[f64]) -> f64 {
    let scale = truth
        .iter()
        .map(|x| x.abs())
        .fold(f64::from(f32::MIN_POSITIVE), f64::max);
    let worst = truth
        .iter()
        .zip(found)
        .map(|(truth, found)| (found - truth).abs())
        .fold(0.0, |worst: f64, off| {
            if off.is_nan() {
                f64::INFINITY
            } else {
                worst.max(off)
            }
        });
    if worst < scale { worst / scale } else { 1.0 }
}

/// One frame of the items of a kind, the first ones in order.
fn frame(context: &Context<'_>, probe: &Probe, inputs: &Inputs) -> Result<Frame, Error> {
    let assembled = context.library.assemble_probe(probe.id)?;
    let [_, items] = context.frame();
    let floats = inputs.stride * items as usize;
    let repeated: Vec<f32> = inputs.values.iter().copied().cycle().take(floats).collect();
    let frame = Frame::of(&assembled, probe.entry, items, 4 * probe.output_floats)?;
    Ok(frame.buffer("inputs", &bytes_of(&repeated)))
}

/// The chart.
pub(super) fn prices(context: &Context<'_>) -> Result<Vec<Price>, Error> {
    measure(context, &pairs())
}

fn measure(context: &Context<'_>, pairs: &[Pair]) -> Result<Vec<Price>, Error> {
    let mut frames = Vec::new();
    for pair in pairs {
        for kind in kinds(context, pair)? {
            for probe in [pair.hardened, pair.published] {
                let form = if probe.form == Form::Published {
                    "published"
                } else {
                    "hardened"
                };
                let name = format!("{} {form}, {}", pair.hardened.function(), kind.name);
                frames.push((name, frame(context, probe, &kind.inputs)?, kind.truth.clone()));
            }
        }
    }
    let mut variants = Vec::new();
    for (name, frame, truth) in &frames {
        let measured = frame.measure(context)?;
        let stride = truth.first().map_or(1, Vec::len);
        let found = measured.outputs.chunks_exact(stride);
        let errors = truth
            .iter()
            .zip(found)
            .map(|(truth, found)| error(truth, found))
            .collect();
        let mut variant = Variant::new(name, measured, 0.0, errors);
        if name.ends_with("hard") {
            variant.timed = Err("timed on ordinary inputs".to_owned());
        }
        variants.push(variant);
    }
    variant::prices(context, "form", "relative error", variants)
}

#[cfg(test)]
mod tests;
