//! One draw: vertices, triangles, coverage, fragments.

use bossage_runner::{Blend, Cull, Draw, Error, RenderJob, Shader, TargetFormat};
use bossage_translate::Stage;

use crate::clip::{Clip, clip, guard_band};
use crate::coverage::{Coverage, snap};
use crate::frame::Frame;
use crate::shade::{Quad, Shading};
use crate::stages::Open;
use crate::triangle::Triangle;
use crate::vertex::Vertices;

/// Quads that are shaded at a time, to bound memory.
const QUADS_A_RUN: usize = 1 << 12;

/// Draws one mesh.
pub(crate) fn run(
    open: &Open<'_>,
    job: &RenderJob<'_>,
    draw: &Draw<'_>,
    frame: &mut Frame,
) -> Result<(), Error> {
    check(job, draw)?;
    let mut stages = open(draw)?;
    let vertices = Vertices::run(stages.as_mut(), draw)?;
    let triangles = triangles(draw, &vertices.positions(draw)?);
    let size = [job.width, job.height];
    let quads = quads(&triangles, size);
    let shading = Shading::new(job.name, draw, size, &triangles, &vertices)?;
    let returns = |name: &str| {
        let mut outputs = draw.fragment.entry.outputs.iter();
        outputs.any(|output| output.builtin.as_deref() == Some(name))
    };
    let returns_depth = returns("frag_depth");
    let late = stages.may_discard() || returns_depth || returns("sample_mask");
    let live = match (late, returns_depth) {
        (false, _) => frame.test_early(quads, &shading, draw),
        (true, false) => frame.leave_hidden_out(quads, &shading, draw.depth),
        (true, true) => quads,
    };
    for part in live.chunks(QUADS_A_RUN) {
        let shaded = shading.run(stages.as_mut(), part)?;
        frame.write(part, &shading, &shaded, draw, late);
    }
    Ok(())
}

/// What a device refuses is refused here, too.
fn check(job: &RenderJob<'_>, draw: &Draw<'_>) -> Result<(), Error> {
    let (vertex, fragment) = (draw.vertex.code.route(), draw.fragment.code.route());
    if vertex != fragment {
        return Err(Error::MixedRoutes {
            job: job.name.to_owned(),
            vertex,
            fragment,
        });
    }
    expect_stage(&draw.vertex, Stage::Vertex)?;
    expect_stage(&draw.fragment, Stage::Fragment)?;
    draw.mesh.validate(job.name, draw.vertex.entry)?;
    let entry = draw.fragment.entry;
    if draw.blend != Blend::Replace && !entry.outputs.iter().any(|output| output.location == Some(0)) {
        let problem = "the draw is blended, but nothing goes to @location(0)".to_owned();
        return Err(Error::misfit(entry, &entry.name, problem));
    }
    for output in &entry.outputs {
        let Some(location) = output.location else {
            continue;
        };
        let Some(target) = job.targets.get(location as usize) else {
            let targets = job.targets.len();
            let problem = format!("it goes to @location({location}), the job has {targets} targets");
            return Err(Error::misfit(entry, &output.name, problem));
        };
        let scalar = match target.format {
            TargetFormat::Rgba32Float | TargetFormat::Rgba8Unorm => "f32",
            TargetFormat::Rgba32Uint => "u32",
            TargetFormat::Rgba32Sint => "i32",
        };
        let short = format!("vec4{}", &scalar[..1]);
        if output.ty != short && output.ty != format!("vec4<{scalar}>") {
            let problem = format!("the target takes vec4<{scalar}>, it is {}", output.ty);
            return Err(Error::misfit(entry, &output.name, problem));
        }
    }
    Ok(())
}

fn expect_stage(shader: &Shader<'_>, stage: Stage) -> Result<(), Error> {
    if shader.entry.stage == stage {
        return Ok(());
    }
    let problem = format!("it is a {} shader, not a {stage} shader", shader.entry.stage);
    Err(Error::misfit(shader.entry, &shader.entry.name, problem))
}

/// The triangles that are not culled.
fn triangles(draw: &Draw<'_>, positions: &[Clip]) -> Vec<Triangle> {
    let is_shown = |triangle: &Triangle| match draw.cull {
        Cull::None => true,
        Cull::Back => triangle.is_front,
        Cull::Front => !triangle.is_front,
    };
    (0..)
        .zip(draw.mesh.indices.as_chunks::<3>().0)
        .filter_map(|(number, corners)| {
            let clip = corners.map(|corner| positions.get(corner as usize).copied());
            let [a, b, c] = clip;
            Triangle::new(number, *corners, [a?, b?, c?])
        })
        .filter(is_shown)
        .collect()
}

/// The quads of all triangles, in their order.
fn quads(triangles: &[Triangle], [width, height]: [u32; 2]) -> Vec<Quad> {
    let guard = guard_band(width, height);
    let mut quads = Vec::new();
    for (number, triangle) in (0..).zip(triangles) {
        let polygon: Vec<_> = clip(&triangle.clip, guard)
            .into_iter()
            .map(|corner| snap(corner, width, height))
            .collect();
        if let Some(coverage) = Coverage::of(&polygon, width, height) {
            let own = coverage.quads().map(|(at, mask)| Quad {
                at,
                mask,
                triangle: number,
            });
            quads.extend(own);
        }
    }
    quads
}
