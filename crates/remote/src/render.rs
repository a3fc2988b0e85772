//! Pictures.

use bossage_runner::{
    Blend as Blending, Clear, Cull, Depth, Draw as Drawn, Error, Picture, RenderJob, RenderOutput,
    RenderTarget, SENTINEL_BITS, TargetFormat, within,
};

use crate::answer::Capacity;
use crate::groups::{groups, stage};
use crate::machine::Remote;
use crate::message::{Attribute, Blend, BlendComponent, Data, Draw, Request, States, Target, TargetState};

/// WebGPU's flags of all four channels.
const ALL_CHANNELS: u32 = 0xf;

/// Draws a picture.
pub(crate) fn run(remote: &Remote, job: &RenderJob<'_>) -> Result<RenderOutput, Error> {
    for (location, target) in job.targets.iter().enumerate() {
        target.validate(job.name, location)?;
    }
    if job.width.min(job.height) == 0 {
        return Err(Error::Texture {
            name: job.name.to_owned(),
            problem: format!("a picture of {} x {} pixels", job.width, job.height),
        });
    }
    let Capacity { side, targets, .. } = remote.capacity;
    let longer = u64::from(job.width.max(job.height));
    within(job.name, "the picture's side", longer, u64::from(side))?;
    let given = job.targets.len() as u64;
    within(job.name, "the number of targets", given, u64::from(targets))?;
    let mut data = Data::default();
    let mut passes = Vec::new();
    for pass in &job.passes {
        let draws = pass.iter().map(|draw| prepare(remote, job, draw, &mut data));
        passes.push(draws.collect::<Result<Vec<_>, Error>>()?);
    }
    let targets = job.targets.iter().map(|target| describe(job, target, &mut data));
    let request = Request::Render {
        width: job.width,
        height: job.height,
        targets: targets.collect(),
        read_depth: job.read_depth,
        passes,
    };
    let parts = remote.ask(job.name, &request, &data)?;
    taken(job, parts)
}

fn describe(job: &RenderJob<'_>, target: &RenderTarget, data: &mut Data) -> Target {
    let pixel_bytes = target.format.pixel_bytes();
    // The sentinel is copied in rather than cleared to, and so is what JSON has no numbers for.
    let copied = match target.clear {
        Clear::Sentinel => Some([SENTINEL_BITS; 4]),
        Clear::Colour(colour) if colour.iter().all(|value| value.is_finite()) => None,
        Clear::Colour(colour) => Some(colour.map(f32::to_bits)),
    };
    let pixels = copied.map(|pixel| {
        let bytes: Vec<u8> = pixel.iter().flat_map(|word| word.to_le_bytes()).collect();
        data.add(&bytes.repeat(job.width as usize * job.height as usize))
    });
    let colour = match target.clear {
        Clear::Colour(colour) if pixels.is_none() => Some(colour),
        Clear::Colour(_) | Clear::Sentinel => None,
    };
    Target {
        format: format(target.format),
        pixel_bytes,
        colour,
        pixels,
    }
}

fn format(format: TargetFormat) -> &'static str {
    match format {
        TargetFormat::Rgba32Float => "rgba32float",
        TargetFormat::Rgba8Unorm => "rgba8unorm",
        TargetFormat::Rgba32Uint => "rgba32uint",
        TargetFormat::Rgba32Sint => "rgba32sint",
    }
}

fn prepare(remote: &Remote, job: &RenderJob<'_>, draw: &Drawn<'_>, data: &mut Data) -> Result<Draw, Error> {
    draw.validate(job)?;
    let floats = job
        .targets
        .first()
        .is_some_and(|target| target.format == TargetFormat::Rgba32Float);
    if draw.blend != Blending::Replace && floats {
        remote.require(job.name, "float32-blendable", "the blending of 32-bit floats")?;
    }
    let (groups, _) = groups(
        remote,
        job.name,
        &[&draw.vertex, &draw.fragment],
        &draw.resources,
        data,
    )?;
    let mut attributes = Vec::new();
    for (location, attribute) in draw.mesh.located(draw.vertex.entry)? {
        attributes.push(Attribute {
            location,
            components: attribute.components,
            values: data.add(bytemuck::cast_slice(&attribute.values)),
        });
    }
    Ok(Draw {
        vertex: stage(remote, job.name, &draw.vertex)?,
        fragment: stage(remote, job.name, &draw.fragment)?,
        groups,
        attributes,
        indices: data.add(bytemuck::cast_slice(&draw.mesh.indices)),
        states: states(job, draw)?,
    })
}

fn states(job: &RenderJob<'_>, draw: &Drawn<'_>) -> Result<States, Error> {
    let (depth_writes, depth_compare) = match draw.depth {
        Depth::TestAndWrite => (true, "less"),
        Depth::TestOnly => (false, "less-equal"),
        Depth::Equal => (false, "equal"),
        Depth::Ignore => (false, "always"),
    };
    let written = draw.written(job.targets.len())?;
    let targets = job.targets.iter().zip(written).enumerate();
    Ok(States {
        cull: match draw.cull {
            Cull::None => "none",
            Cull::Back => "back",
            Cull::Front => "front",
        },
        depth_writes,
        depth_compare,
        targets: targets
            .map(|(location, (target, written))| TargetState {
                format: format(target.format),
                write_mask: if written { ALL_CHANNELS } else { 0 },
                blend: if location == 0 { blend(draw.blend) } else { None },
            })
            .collect(),
    })
}

fn blend(blend: Blending) -> Option<Blend> {
    let (src_factor, dst_factor) = match blend {
        Blending::Replace => return None,
        Blending::Add => ("one", "one"),
        Blending::Multiply => ("dst", "zero"),
    };
    let component = BlendComponent {
        operation: "add",
        src_factor,
        dst_factor,
    };
    Some(Blend {
        color: component,
        alpha: component,
    })
}

/// Pictures, and the depth, of what came back.
fn taken(job: &RenderJob<'_>, parts: Vec<Vec<u8>>) -> Result<RenderOutput, Error> {
    let expected = job.targets.len() + usize::from(job.read_depth);
    if parts.len() != expected {
        return Err(Error::Internal {
            job: job.name.to_owned(),
            message: format!("{} pictures came back instead of {expected}", parts.len()),
        });
    }
    let picture = |(target, bytes): (&RenderTarget, &Vec<u8>)| Picture {
        width: job.width,
        height: job.height,
        format: target.format,
        pixels: target.format.pixels(bytes),
    };
    let depth = parts.last().filter(|_| job.read_depth);
    Ok(RenderOutput {
        targets: job.targets.iter().zip(&parts).map(picture).collect(),
        depth: depth.map(|bytes| {
            let words = bytes.as_chunks::<4>().0;
            words.iter().map(|word| f32::from_le_bytes(*word)).collect()
        }),
    })
}
