//! A job as pictures: each pass of a companion is drawn by itself, to targets that hold the sentinel first.

use std::collections::BTreeMap;

use bossage_runner::{
    Blend, Clear, Cull, Depth, Draw, Machine, Mesh, PUSH_CONSTANTS, Picture, RenderJob, RenderTarget,
    Resources, Shader, slot,
};

use super::Stop;
use super::request::{Bytes, Companion, Job, Kept, Pass, Side, stop};
use crate::route::Prepared;

/// Width and height of the targets: one quad.
const SIDE: u32 = 2;

/// Draws all passes of a job; the pixels of their targets, four words each.
pub(super) fn run(
    job: &Job,
    companion: &Companion,
    (own, entry): (&Prepared, &str),
    generated: &Prepared,
    machine: &dyn Machine,
) -> Result<Vec<Bytes>, Stop> {
    let textures = job.textures()?;
    let resources = job.resources(&textures);
    let numbers: Vec<[f32; 1]> = (0..companion.corners).map(|corner| [corner as f32]).collect();
    let mesh = Mesh::new((0..companion.corners).collect()).with("bossage_corner", &numbers);
    let mut left = Vec::new();
    for pass in &companion.passes {
        let shader = |side: &Side| match side {
            Side::Own => own.shader(entry),
            Side::Generated(entry) => generated.shader(entry),
        };
        let vertex = shader(&pass.vertex).map_err(Stop::Failed)?;
        let fragment = shader(&pass.fragment).map_err(Stop::Failed)?;
        let draw = Draw {
            resources: bound(&resources, [&vertex, &fragment]),
            vertex,
            fragment,
            mesh: &mesh,
            cull: Cull::None,
            blend: Blend::Replace,
            depth: Depth::Ignore,
        };
        left.extend(pictures(pass, draw, machine)?.iter().map(words));
    }
    Ok(left)
}

fn pictures(pass: &Pass, draw: Draw<'_>, machine: &dyn Machine) -> Result<Vec<Picture>, Stop> {
    let target = |kept: &Kept| match kept {
        Kept::Floats => RenderTarget::floats(Clear::Sentinel),
        Kept::Unsigned => RenderTarget::integers(false),
        Kept::Signed => RenderTarget::integers(true),
    };
    let name = draw.fragment.entry.name.clone();
    let job = RenderJob {
        name: &name,
        width: SIDE,
        height: SIDE,
        targets: pass.targets.iter().map(target).collect(),
        read_depth: false,
        passes: vec![vec![draw]],
    };
    Ok(job.run(machine).map_err(|error| stop(&error))?.targets)
}

/// The resources that a pair of stages has bindings for.
fn bound<'a>(all: &Resources<'a>, stages: [&Shader<'_>; 2]) -> Resources<'a> {
    let pushes = stages.iter().any(|stage| stage.entry.immediates.is_some());
    let pushed = pushes.then(|| PUSH_CONSTANTS.to_owned());
    let places: Vec<String> = stages
        .iter()
        .flat_map(|stage| &stage.entry.bindings)
        .map(|binding| slot(binding.group, binding.binding))
        .chain(pushed)
        .collect();
    let buffers = all.buffers.iter().filter(|(place, _)| places.contains(place));
    Resources {
        uniforms: BTreeMap::new(),
        buffers: buffers.map(|(place, data)| (place.clone(), *data)).collect(),
        textures: all.textures.clone(),
        samplers: all.samplers.clone(),
    }
}

fn words(picture: &Picture) -> Bytes {
    let words = picture.pixels.as_flattened().iter();
    Bytes(words.flat_map(|value| value.to_bits().to_le_bytes()).collect())
}
