//! `arithmetic`: a shading function in f16, f32 and f64, error in colour.
//!
//! The functions are the library's own text with other types (`retype.rs`): `dot3` with a light vector of any length, and
//! `blinn_phong`. A half of the views see the highlight: they lie around the mirrored light, the closer the sharper it is. Inputs
//! are f32; a format that cannot hold them loses that, too. Truth is the
//! formula in f64 at the f32 inputs, so the last digits of f64 are truth's as well as the shader's.
//!
//! Errors are the evaluator's, which rounds to nearest after each operation and needs no driver. Times are the driver's, where it
//! has the format; `blinn_phong` in f64 has none anywhere, since SPIR-V's `Pow` takes 16 and 32 bits only.

use std::sync::Arc;

use bossage_conformance::generate::random::stream;
use bossage_reference::blinn_phong::{self, Reflectance};
use bossage_runner::ComputeJob;
use glam::DVec3;
use rand::RngExt;

use super::directions::sphere;
use super::frame::{Frame, bytes_of};
use super::retype::{Real, retyped};
use super::variant::{self, Timed, Variant};
use super::{Context, Error};
use crate::record::Price;

const HARNESS: &str = include_str!("kernels/shade.wgsl");

/// What a result that is not a number is off by: all of white.
const WRONG: f64 = 1.0;

/// A shading function.
#[derive(Clone, Copy)]
struct Function {
    name: &'static str,
    /// WESL text that declares `shade`.
    text: &'static str,
    truth: fn(&Item) -> DVec3,
    /// Whether a driver can be asked for it in that format.
    runs: fn(Real) -> Result<(), String>,
}

const FUNCTIONS: [Function; 2] = [
    Function {
        name: "dot3",
        text: include_str!("kernels/shade_dot3.wesl"),
        truth: dot3,
        runs: |_| Ok(()),
    },
    Function {
        name: "blinn_phong",
        text: include_str!("kernels/shade_blinn_phong.wesl"),
        truth: |item| {
            let (normal, light) = (item.normal, item.light.normalize());
            blinn_phong::hardened(normal, light, item.view, &item.surface)
        },
        runs: |real| match real {
            Real::F16 | Real::F32 => Ok(()),
            Real::F64 => Err("SPIR-V has no power of 64-bit floats".to_owned()),
        },
    },
];

/// `dot3` by another formula than the shader's, so that f64 is not compared with itself: products of f32 inputs are exact here, and
/// four roundings are left.
fn dot3(item: &Item) -> DVec3 {
    let cosine = item.normal.dot(item.light) / item.light.length_squared().sqrt();
    cosine.clamp(0.0, 1.0) * item.surface.diffuse
}

/// One item's inputs: numbers of f32.
struct Item {
    normal: DVec3,
    /// Toward the light, of any length.
    light: DVec3,
    view: DVec3,
    surface: Reflectance,
}

impl Item {
    /// As the kernel reads them.
    fn floats(&self) -> [f32; 16] {
        let Reflectance {
            diffuse,
            specular,
            shininess,
        } = self.surface;
        let mut floats = [shininess as f32; 16];
        let vectors = [self.normal, self.light, self.view, diffuse, specular];
        for (to, from) in floats.chunks_exact_mut(3).zip(vectors) {
            to.copy_from_slice(&from.as_vec3().to_array());
        }
        floats
    }
}

/// Normals and views over the sphere, lights before the surface at distances of 1/4 to 64; every other view sees the highlight.
fn items(seed: u64, count: u32) -> Vec<Item> {
    let directions = |name: &str| sphere(&format!("arithmetic/{name}"), seed, count);
    let (normals, lights) = (directions("normal"), directions("light"));
    let (views, beside) = (directions("view"), directions("highlight"));
    let mut rng = stream("arithmetic/surface", seed);
    let mut item = |at: usize| {
        let shininess = 2f64.powf(8.0 * rng.random::<f64>());
        let mut colour = || DVec3::from_array(std::array::from_fn(|_| rng.random::<f64>()));
        let (diffuse, specular) = (colour(), colour());
        let distance = 2f64.powf(8.0 * rng.random::<f64>() - 2.0);
        let normal = normals[at];
        // Before the surface: behind it all is black, and nothing errs.
        let light = lights[at] * normal.dot(lights[at]).signum();
        // Half vectors within the highlight, whose width falls with the root of the exponent.
        let half = (normal + beside[at] / shininess.sqrt()).normalize();
        let mirrored = 2.0 * light.dot(half) * half - light;
        let rounded = |v: DVec3| v.as_vec3().as_dvec3();
        Item {
            normal: rounded(normal),
            light: rounded(distance * light),
            view: rounded(if at.is_multiple_of(2) { mirrored } else { views[at] }),
            surface: Reflectance {
                diffuse: rounded(diffuse),
                specular: rounded(specular),
                shininess: f64::from(shininess as f32),
            },
        }
    };
    (0..count as usize).map(&mut item).collect()
}

/// How far each colour is off, in its worst channel.
fn errors(truth: &[DVec3], found: &[f64]) -> Vec<f64> {
    let error = |(truth, found): (&DVec3, &[f64])| {
        let off = (DVec3::new(found[0], found[1], found[2]) - truth).abs();
        // max_element leaves NaN out.
        if off.is_finite() { off.max_element() } else { WRONG }
    };
    truth.iter().zip(found.chunks_exact(3)).map(error).collect()
}

fn frame(context: &Context<'_>, function: &Function, real: Real, inputs: &Arc<[u8]>) -> Result<Frame, Error> {
    let name = format!("shade_{}", function.name);
    let [_, items] = context.frame();
    let assembled = context.library.assemble_text(&name, function.text, "shade")?;
    let retyped = retyped(&assembled, HARNESS, real).ok_or_else(|| Error::Kernel {
        kernel: name,
        problem: format!("it has no guard to be changed for {real}"),
    })?;
    let frame = Frame::of(&retyped, "shade_frame", items, 3 * real.bytes())?;
    Ok(frame.buffer("inputs", inputs))
}

/// The chart.
pub(super) fn prices(context: &Context<'_>) -> Result<Vec<Price>, Error> {
    measure(context, &FUNCTIONS)
}

fn measure(context: &Context<'_>, functions: &[Function]) -> Result<Vec<Price>, Error> {
    let [_, count] = context.frame();
    let items = items(context.seed, count);
    let inputs = bytes_of(&items.iter().map(Item::floats).collect::<Vec<_>>());
    let all: Vec<(&Function, Real)> = functions
        .iter()
        .flat_map(|function| Real::ALL.map(|real| (function, real)))
        .collect();
    let frames = all
        .iter()
        .map(|(function, real)| frame(context, function, *real, &inputs))
        .collect::<Result<Vec<_>, _>>()?;
    let mut variants = Vec::new();
    for ((function, real), frame) in all.into_iter().zip(&frames) {
        let truth: Vec<DVec3> = items.iter().map(function.truth).collect();
        let (found, cost) = frame.evaluate(count)?;
        variants.push(Variant {
            name: format!("{} {real}", function.name),
            errors: errors(&truth, &found),
            cost,
            bytes: real.bytes() as f64,
            timed: timed(context, function, real, frame.job()?),
        });
    }
    variant::prices(context, "arithmetic", "colour", variants)
}

/// The frame, where the machine has the format. A driver that lacks it says so when it is asked.
fn timed<'a>(
    context: &Context<'_>,
    function: &Function,
    real: Real,
    job: ComputeJob<'a>,
) -> Result<Timed<'a>, String> {
    (function.runs)(real)?;
    match job.run(context.machine) {
        Ok(_) => Ok(Timed::Compute(job)),
        Err(error) => Err(format!("the adapter refuses {real}: {error}")),
    }
}

#[cfg(test)]
mod tests;
