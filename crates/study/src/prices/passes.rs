//! `passes`: `dot3` in one pass and in two, on a target of bytes and on one of floats, error in colour.
//!
//! A target is covered once by the shader of one pass, or twice: the light first, then the surface's colour, which the blending
//! unit multiplies in. Normals and lights are colours of directions within 60° of each other, so that something is lit; truth is the
//! reference's single pass in f64. What the detour costs is a rounding to the target's format, and its pixels loaded and stored
//! once more.

use bossage_bounds::{F32, Limits, StageInputs, run_fragment};
use bossage_conformance::Route;
use bossage_conformance::generate::random::stream;
use bossage_conformance::route::Prepared;
use bossage_embedded::{Embedded, bindings};
use bossage_reference::dot3_single_pass;
use bossage_runner::{
    Blend, Clear, Cull, Depth, Draw, Mesh, RenderJob, RenderTarget, Resources, TextureData, resolve,
};
use glam::DVec3;
use rand::RngExt;

use super::directions::sphere;
use super::frame::Cost;
use super::variant::{self, Timed, Variant};
use super::{Context, Error};
use crate::record::Price;

const TEXT: &str = include_str!("kernels/passes.wesl");

/// Pixels whose operations are counted.
const COUNTED: u32 = 2048;

/// What a colour that is not a number is off by.
const WRONG: f64 = 1.0;

/// A way to the picture: the entries of its passes.
const WAYS: [(&str, &[&str]); 2] = [
    ("one pass", &["single_pass"]),
    ("two passes", &["first_pass", "second_pass"]),
];

const TARGETS: [(&str, RenderTarget); 2] = [
    (
        "bytes",
        RenderTarget {
            format: bossage_runner::TargetFormat::Rgba8Unorm,
            clear: Clear::Colour([0.0; 4]),
        },
    ),
    (
        "floats",
        RenderTarget {
            format: bossage_runner::TargetFormat::Rgba32Float,
            clear: Clear::Colour([0.0; 4]),
        },
    ),
];

/// What a pixel is made of, as colours of f32.
struct Pixels {
    side: u32,
    normals: Vec<[f32; 4]>,
    lights: Vec<[f32; 4]>,
    surfaces: Vec<[f32; 4]>,
}

impl Pixels {
    fn new(seed: u64, side: u32) -> Self {
        let directions = |name: &str| sphere(&format!("passes/{name}"), seed, side * side);
        let mut rng = stream("passes/surfaces", seed);
        let colour = |v: DVec3| (0.5 * v + 0.5).extend(1.0).as_vec4().to_array();
        let middles = directions("middles");
        // A unit vector added to twice another lies within 30° of it, two such within 60° of each other.
        let beside = |name: &str| {
            let beside = directions(name).into_iter().zip(&middles);
            beside.map(|(v, n)| colour((v + 2.0 * *n).normalize())).collect()
        };
        Self {
            side,
            lights: beside("lights"),
            surfaces: (0..side * side)
                .map(|_| [rng.random(), rng.random(), rng.random(), 1.0])
                .collect(),
            normals: beside("normals"),
        }
    }

    fn textures(&self) -> [(&'static str, TextureData); 3] {
        [
            ("normals", &self.normals),
            ("lights", &self.lights),
            ("surfaces", &self.surfaces),
        ]
        .map(|(name, texels)| (name, TextureData::rgba32f(self.side, self.side, texels)))
    }

    fn truth(&self) -> Vec<DVec3> {
        let vector = |&[r, g, b, _]: &[f32; 4]| DVec3::from_array([r, g, b].map(f64::from));
        let colours = self.normals.iter().zip(&self.lights).zip(&self.surfaces);
        colours
            .map(|((normal, light), surface)| {
                dot3_single_pass::shade(vector(normal), vector(light), vector(surface))
            })
            .collect()
    }
}

/// The stages, and one triangle that covers the target.
struct Rig {
    vertex: Prepared,
    fragments: Vec<(&'static str, Prepared)>,
    textures: [(&'static str, TextureData); 3],
    mesh: Mesh,
    side: u32,
}

fn refused(kernel: &str, problem: String) -> Error {
    Error::Kernel {
        kernel: kernel.to_owned(),
        problem,
    }
}

fn prepare(context: &Context<'_>, text: &str, entry: &str) -> Result<Prepared, Error> {
    let assembled = context.library.assemble_text(entry, text, entry)?;
    let prepared = Route::Wgsl.prepare(&assembled);
    prepared.map_err(|problem| refused(entry, problem))
}

impl Rig {
    fn new(context: &Context<'_>, text: &str, pixels: &Pixels) -> Result<Self, Error> {
        let entries = WAYS.iter().flat_map(|(_, entries)| entries.iter().copied());
        let fragments = entries.map(|entry| Ok((entry, prepare(context, text, entry)?)));
        Ok(Self {
            vertex: prepare(context, text, "cover")?,
            fragments: fragments.collect::<Result<_, Error>>()?,
            textures: pixels.textures(),
            mesh: Mesh::new(vec![0, 1, 2]).with("corner", &[[-1.0, -1.0], [3.0, -1.0], [-1.0, 3.0]]),
            side: pixels.side,
        })
    }

    fn fragment(&self, entry: &str) -> Result<&Prepared, Error> {
        let found = self.fragments.iter().find(|(name, _)| *name == entry);
        let (_, prepared) = found.ok_or_else(|| refused(entry, "there is no such stage".to_owned()))?;
        Ok(prepared)
    }

    fn resources(&self) -> Resources<'_> {
        let mut resources = Resources::default();
        for (name, texels) in &self.textures {
            resources.textures.insert((*name).to_owned(), texels);
        }
        resources
    }

    /// A pass; the second and later ones are multiplied in.
    fn pass(&self, entry: &str, is_first: bool) -> Result<Vec<Draw<'_>>, Error> {
        let vertex = self.vertex.shader("cover");
        let fragment = self.fragment(entry)?.shader(entry);
        Ok(vec![Draw {
            vertex: vertex.map_err(|problem| refused("cover", problem))?,
            fragment: fragment.map_err(|problem| refused(entry, problem))?,
            mesh: &self.mesh,
            resources: self.resources(),
            cull: Cull::None,
            blend: if is_first { Blend::Replace } else { Blend::Multiply },
            depth: Depth::Ignore,
        }])
    }

    fn job(
        &self,
        name: &'static str,
        entries: &[&str],
        target: RenderTarget,
    ) -> Result<RenderJob<'_>, Error> {
        let passes = entries
            .iter()
            .enumerate()
            .map(|(at, entry)| self.pass(entry, at == 0));
        Ok(RenderJob {
            name,
            width: self.side,
            height: self.side,
            targets: vec![target],
            read_depth: false,
            passes: passes.collect::<Result<_, _>>()?,
        })
    }

    /// What the passes of a pixel cost together; the blending unit is not in it.
    fn cost(&self, entries: &[&str]) -> Result<Cost, Error> {
        let mut sum = Cost::default();
        for entry in entries {
            let cost = self.stage_cost(entry)?;
            sum.ops += cost.ops;
            sum.fetches += cost.fetches;
        }
        Ok(sum)
    }

    fn stage_cost(&self, entry: &str) -> Result<Cost, Error> {
        let prepared = self.fragment(entry)?;
        let program = prepared
            .program(entry)
            .map_err(|problem| refused(entry, problem))?;
        let shader = prepared
            .shader(entry)
            .map_err(|problem| refused(entry, problem))?;
        let resources = self.resources();
        let resolved = resolve(entry, &[&shader], &resources)?;
        let mut bound = bindings::<F32>(entry, &resolved)?;
        let place = |at: u32| [at % self.side, at / self.side].map(|axis| f64::from(axis) + 0.5);
        let positions: Vec<[f64; 4]> = (0..COUNTED)
            .map(|at| {
                let [x, y] = place(at);
                [x, y, 0.5, 1.0]
            })
            .collect();
        let inputs = StageInputs::new(positions.len()).position(&positions);
        let (_, outcome) = run_fragment(&program, &mut bound, &inputs, &Limits::default())?;
        let each = |total: u64| total as f64 / f64::from(COUNTED);
        Ok(Cost {
            ops: each(outcome.counters.operations),
            fetches: each(outcome.counters.fetches),
        })
    }
}

/// How far each pixel is off, in its worst channel.
fn errors(truth: &[DVec3], pixels: &[[f32; 4]]) -> Vec<f64> {
    let error = |(truth, &[r, g, b, _]): (&DVec3, &[f32; 4])| {
        let off = (DVec3::from_array([r, g, b].map(f64::from)) - truth).abs();
        if off.is_finite() { off.max_element() } else { WRONG }
    };
    truth.iter().zip(pixels).map(error).collect()
}

/// The chart.
pub(super) fn prices(context: &Context<'_>) -> Result<Vec<Price>, Error> {
    measure(context, TEXT)
}

fn measure(context: &Context<'_>, text: &str) -> Result<Vec<Price>, Error> {
    let [side, _] = context.frame();
    let pixels = Pixels::new(context.seed, side);
    let (truth, rig) = (pixels.truth(), Rig::new(context, text, &pixels)?);
    let mut variants = Vec::new();
    for (target_name, target) in TARGETS {
        for (way, entries) in WAYS {
            let job = rig.job(way, entries, target)?;
            let (pixels, timed) = drawn(context, job)?;
            variants.push(Variant {
                name: format!("{way}, {target_name}"),
                errors: errors(&truth, &pixels),
                cost: rig.cost(entries)?,
                bytes: f64::from(target.format.pixel_bytes()),
                timed,
            });
        }
    }
    variant::prices(context, "passes", "colour", variants)
}

/// The picture, and what is to be timed: nothing where the machine lacks something, such as blending of floats, which is drawn
/// without a driver then.
#[expect(clippy::type_complexity, reason = "a picture beside what is timed of it")]
fn drawn<'a>(
    context: &Context<'_>,
    job: RenderJob<'a>,
) -> Result<(Vec<[f32; 4]>, Result<Timed<'a>, String>), Error> {
    let (output, timed) = match job.run(context.machine) {
        Ok(output) => (output, Ok(Timed::Render(job))),
        Err(lacking @ bossage_runner::Error::Unsupported { .. }) => {
            (job.run(&Embedded::new())?, Err(lacking.to_string()))
        }
        Err(error) => return Err(error.into()),
    };
    let picture = output.targets.into_iter().next();
    Ok((picture.map(|picture| picture.pixels).unwrap_or_default(), timed))
}

#[cfg(test)]
mod tests;
