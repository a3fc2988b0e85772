//! Renders one object and gathers what each of its pixels got, should have got, and from which interpolants.

use bossage_reference::surface::{Fragment as Truth, shade};
use bossage_runner::{
    Clear, Cull, Draw as RunnerDraw, Picture, RenderJob, RenderTarget, Resources, SamplerSettings,
    is_unwritten,
};
use bossage_scene::Draw;
use bossage_shaders::{Alpha, FeatureSet, Stage};
use rayon::prelude::*;

use super::surface::{bounded, is_bounded};
use super::truth::{self, Maps, material};
use super::upload::{address, mesh, textures};
use crate::bench::Bench;
use crate::case::with_causes;
use crate::module::Module;
use crate::tolerance::surface::{Fragment, Interpolants};

/// The longer side of the rendered picture, in pixels: some thousands of pixels an object, from every angle that it has.
const LONGER_SIDE: u32 = 96;

/// The captured targets after the colour: position, normal, tangent, uv.
const CAPTURED: usize = 4;

/// One pixel of one object.
#[derive(Clone, Debug)]
pub(super) struct Pixel {
    /// x and y, and then the interpolants: what a report shows as the input.
    pub(super) place: Vec<f32>,
    /// The colour; `None` where the shader under test wrote nothing.
    pub(super) got: Option<[f32; 4]>,
    /// The reference's colour; `None` where it discards.
    pub(super) truth: Option<[f64; 4]>,
    /// What is allowed.
    pub(super) bound: Fragment,
}

/// Renders the object with the draw's shaders, and once more with the capture variant.
pub(super) fn render(bench: &Bench<'_>, draw: &Draw, size: [u32; 2]) -> Result<Vec<Pixel>, String> {
    if !is_bounded(draw) {
        return Err(format!("no bound is known for {}", draw.features.name()));
    }
    let size = scaled(size);
    let picture = picture(bench, draw, &draw.features, Stage::Fragment, size, 1)?;
    let capture = picture_of(bench, draw, &uncut(&draw.features), size)?;
    let got = picture.into_iter().next().ok_or("the draw has no picture")?;
    let covered = capture[0].covered();
    let context = Context::new(draw);
    let pixels = (0..got.pixels.len()).into_par_iter().filter(|at| covered[*at]);
    Ok(pixels
        .map(|at| context.pixel(at, size, got.pixels[at], &capture))
        .collect())
}

/// Without the alpha test, so that pixels that should be cut out are known too.
fn uncut(features: &FeatureSet) -> FeatureSet {
    FeatureSet {
        alpha: Alpha::Opaque,
        ..*features
    }
}

/// What [`render`] asks the bench for.
pub(super) fn modules(features: &FeatureSet) -> impl Iterator<Item = Module> {
    let picture = stages(features, Stage::Fragment);
    let capture = stages(&uncut(features), Stage::FragmentCapture);
    picture.into_iter().chain(capture)
}

/// The vertex stage and the stage after it.
fn stages(features: &FeatureSet, stage: Stage) -> [Module; 2] {
    let features = *features;
    [Stage::Vertex, stage].map(|stage| Module::Surface { features, stage })
}

/// The size with the same aspect whose longer side is [`LONGER_SIDE`].
fn scaled([width, height]: [u32; 2]) -> [u32; 2] {
    let longer = width.max(height).max(1);
    [width, height].map(|side| (side * LONGER_SIDE).div_ceil(longer).max(1))
}

fn picture_of(
    bench: &Bench<'_>,
    draw: &Draw,
    features: &FeatureSet,
    size: [u32; 2],
) -> Result<Vec<Picture>, String> {
    picture(bench, draw, features, Stage::FragmentCapture, size, 1 + CAPTURED)
}

fn picture(
    bench: &Bench<'_>,
    draw: &Draw,
    features: &FeatureSet,
    stage: Stage,
    [width, height]: [u32; 2],
    targets: usize,
) -> Result<Vec<Picture>, String> {
    let [vertex, fragment] = stages(features, stage);
    let (vertex, fragment) = (bench.module(&vertex)?, bench.module(&fragment)?);
    let (mesh, textures) = (mesh(draw), textures(draw));
    let mut resources = Resources {
        uniforms: draw.uniforms.clone(),
        ..Resources::default()
    };
    let (vertex, fragment) = (
        vertex.shader("surface_vertex")?,
        fragment.shader("surface_fragment")?,
    );
    let bound = |name: &str| vertex.binding(name).is_some() || fragment.binding(name).is_some();
    for (name, texture) in textures.iter().filter(|(name, _)| bound(name)) {
        resources.textures.insert(name.clone(), texture);
    }
    if bound("surface_sampler") {
        let settings = SamplerSettings {
            address: address(draw.edge),
            ..SamplerSettings::default()
        };
        resources.samplers.insert("surface_sampler".to_owned(), settings);
    }
    let runner_draw = RunnerDraw {
        vertex,
        fragment,
        mesh: &mesh,
        resources,
        cull: Cull::None,
        blend: Default::default(),
        depth: Default::default(),
    };
    let targets = vec![RenderTarget::floats(Clear::Sentinel); targets];
    let job = RenderJob {
        name: &draw.object,
        width,
        height,
        targets,
        read_depth: false,
        passes: vec![vec![runner_draw]],
    };
    Ok(job
        .run(bench.device)
        .map_err(|error| with_causes(&error))?
        .targets)
}

/// What is the same for all pixels of a draw.
struct Context<'a> {
    draw: &'a Draw,
    maps: Maps,
    reference: bossage_reference::surface::Material,
}

impl<'a> Context<'a> {
    fn new(draw: &'a Draw) -> Self {
        let maps = Maps::new(draw);
        let reference = material(draw, &maps);
        Self {
            draw,
            maps,
            reference,
        }
    }

    fn pixel(&self, at: usize, [width, _]: [u32; 2], got: [f32; 4], capture: &[Picture]) -> Pixel {
        let read = |target: usize| capture[target].pixels[at].map(|x| if is_unwritten(x) { 0.0 } else { x });
        let three = |[x, y, z, _]: [f32; 4]| [x, y, z];
        let [u, v, ..] = read(4);
        let interpolants = Interpolants {
            position: three(read(1)),
            normal: three(read(2)),
            tangent: read(3),
            uv: [u, v],
        };
        let (x, y) = (at as u32 % width, at as u32 / width);
        let place = [
            &[x as f32, y as f32],
            interpolants.position.as_slice(),
            &interpolants.normal,
            &interpolants.tangent,
            &interpolants.uv,
        ];
        Pixel {
            place: place.concat(),
            got: (!got.iter().copied().all(is_unwritten)).then_some(got),
            truth: self.truth(&interpolants),
            bound: bounded(self.draw, &self.maps).fragment(&interpolants),
        }
    }

    fn truth(&self, at: &Interpolants) -> Option<[f64; 4]> {
        let (viewer, lights, form) = truth::view(self.draw);
        match shade(&self.reference, &lights, &viewer, &truth::doubles(at), form) {
            Truth::Color(color) => Some(color.to_array()),
            Truth::Discarded => None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::scaled;

    #[test]
    fn scaling_keeps_the_aspect() {
        assert_eq!(scaled([800, 600]), [96, 72]);
        assert_eq!(scaled([600, 1200]), [48, 96]);
        assert_eq!(scaled([1, 10_000]), [1, 96]);
    }
}
