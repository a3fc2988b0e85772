//! A draw of a scene made ready for jobs: its modules on the bench's route, its mesh and its textures.

use std::collections::BTreeMap;
use std::sync::Arc;

use bossage_runner::{
    Blend, Clear, Cull, Depth, Draw as RunnerDraw, Filter, Mesh, Picture, RenderJob, RenderTarget, Resources,
    SamplerSettings, Shader, TextureData,
};
use bossage_scene::Draw;
use bossage_shaders::{FeatureSet, Relief, Stage};
use bossage_translate::manifest::Entry;

use super::upload::{address, mesh, textures};
use super::{given_hit, truth};
use crate::bench::Bench;
use crate::case::with_causes;
use crate::module::Module;
use crate::oracle::stages::{self as oracle, Inputs, Outputs};
use crate::route::{Prepared, Route};

/// The entry points of the surface's modules.
const VERTEX: &str = "surface_vertex";
const FRAGMENT: &str = "surface_fragment";

/// A draw with its vertex module and some fragment modules.
pub(super) struct Rig<'a> {
    draw: &'a Draw,
    vertex: Arc<Prepared>,
    fragments: BTreeMap<Stage, Arc<Prepared>>,
    /// What is evaluated in place of the fragment module with an exact walk.
    given_hit: Option<Arc<Prepared>>,
    mesh: Mesh,
    textures: Vec<(String, TextureData)>,
    filter: Filter,
    ideal_filter: bool,
}

impl<'a> Rig<'a> {
    /// Prepares the modules of these features for a draw.
    pub(super) fn new(
        bench: &Bench<'_>,
        draw: &'a Draw,
        features: &FeatureSet,
        fragments: &[Stage],
    ) -> Result<Self, String> {
        let features = *features;
        let module = |stage| bench.module(&Module::Surface { features, stage });
        let prepared = |&stage: &Stage| Ok((stage, module(stage)?));
        Ok(Self {
            draw,
            vertex: module(Stage::Vertex)?,
            fragments: fragments.iter().map(prepared).collect::<Result<_, String>>()?,
            given_hit: match evaluated(&features, fragments) {
                Some(stage) => Some(module(stage)?),
                None => None,
            },
            mesh: mesh(draw),
            textures: textures(draw),
            filter: SamplerSettings::default().filter,
            // No driver's sampler is between the shader and the texels there.
            ideal_filter: bench.route == Route::Embedded,
        })
    }

    /// The same with another filter between texels.
    pub(super) fn filtered(self, filter: Filter) -> Self {
        Self { filter, ..self }
    }

    /// What is drawn.
    pub(super) fn draw(&self) -> &'a Draw {
        self.draw
    }

    /// Whether what runs it filters textures ideally.
    pub(super) fn filters_ideally(&self) -> bool {
        self.ideal_filter
    }

    /// The assembled text of a fragment module.
    pub(super) fn text(&self, stage: Stage) -> Result<&str, String> {
        Ok(self.module(stage)?.text())
    }

    /// The acceptance intervals of what the vertex stage makes of the mesh.
    pub(super) fn vertices(&self) -> Result<Outputs, String> {
        let three = |vectors: &[glam::Vec3]| vectors.iter().map(|v| v.to_array()).collect::<Vec<_>>();
        let mesh = &self.draw.mesh;
        let inputs = Inputs::new(mesh.positions.len())
            .with("position", three(&mesh.positions).into_iter())
            .with("normal", three(&mesh.normals).into_iter())
            .with("uv", mesh.uvs.iter().map(|uv| uv.to_array()))
            .with("tangent", mesh.tangents.iter().map(|t| t.to_array()));
        let stage = oracle::Stage {
            module: &self.vertex,
            entry: VERTEX,
            resources: &self.resources(&[&self.vertex.shader(VERTEX)?]),
            ideal_filter: self.ideal_filter,
        };
        stage.vertices(&inputs)
    }

    /// The acceptance intervals of a fragment module's outputs, and of which invocations they join several hits.
    pub(super) fn intervals(&self, stage: Stage, inputs: &Inputs) -> Result<(Outputs, Vec<bool>), String> {
        let given_hit = self.given_hit.as_deref().filter(|_| stage == Stage::Fragment);
        let module = match given_hit {
            Some(module) => module,
            None => self.module(stage)?,
        };
        let stage = oracle::Stage {
            module,
            entry: FRAGMENT,
            resources: &self.resources(&[&module.shader(FRAGMENT)?]),
            ideal_filter: self.ideal_filter,
        };
        if given_hit.is_none() {
            return Ok((stage.fragments(inputs)?, vec![false; inputs.count()]));
        }
        let features = self.draw.features.canonical();
        let maps = truth::search::maps(self.draw, &features).ok_or("the draw has no heights to search")?;
        given_hit::intervals(&stage, inputs, &maps.heights, self.draw.edge)
    }

    /// The entry point of a fragment module.
    pub(super) fn entry(&self, stage: Stage) -> Result<&Entry, String> {
        Ok(self.fragment(stage)?.entry)
    }

    fn module(&self, stage: Stage) -> Result<&Prepared, String> {
        let prepared = self.fragments.get(&stage);
        Ok(prepared.ok_or_else(|| format!("{stage:?} was not prepared"))?)
    }

    fn fragment(&self, stage: Stage) -> Result<Shader<'_>, String> {
        self.module(stage)?.shader(FRAGMENT)
    }

    /// The mesh with one of the fragment modules.
    pub(super) fn with(&self, stage: Stage, blend: Blend, depth: Depth) -> Result<RunnerDraw<'_>, String> {
        let (vertex, fragment) = (self.vertex.shader(VERTEX)?, self.fragment(stage)?);
        Ok(RunnerDraw {
            vertex,
            fragment,
            mesh: &self.mesh,
            resources: self.resources(&[&vertex, &fragment]),
            cull: Cull::None,
            blend,
            depth,
        })
    }

    /// What these stages bind.
    fn resources(&self, stages: &[&Shader<'_>]) -> Resources<'_> {
        let bound = |name: &str| stages.iter().any(|stage| stage.binding(name).is_some());
        let sampler = SamplerSettings {
            address: address(self.draw.edge),
            filter: self.filter,
            ..SamplerSettings::default()
        };
        let named = self.textures.iter().filter(|(name, _)| bound(name));
        Resources {
            uniforms: self.draw.uniforms.clone(),
            textures: named.map(|(name, texture)| (name.clone(), texture)).collect(),
            samplers: bound("surface_sampler")
                .then(|| ("surface_sampler".to_owned(), sampler))
                .into_iter()
                .collect(),
            ..Resources::default()
        }
    }

    /// One fragment module alone in a float target, and what it leaves in the depth buffer where it writes its depth itself.
    pub(super) fn floats_and_depth(
        &self,
        bench: &Bench<'_>,
        stage: Stage,
        size: [u32; 2],
    ) -> Result<(Picture, Option<Vec<f32>>), String> {
        let draw = self.with(stage, Blend::Replace, Depth::TestAndWrite)?;
        let targets = vec![RenderTarget::floats(Clear::Sentinel)];
        let mut job = job(&self.draw.object, size, targets, vec![vec![draw]]);
        job.read_depth = self.draw.features.canonical().pixel_depth;
        let output = job.run(bench.device).map_err(|error| with_causes(&error))?;
        let picture = output.targets.into_iter().next();
        Ok((picture.ok_or("a picture has a target")?, output.depth))
    }

    /// One fragment module alone, in so many float targets.
    pub(super) fn floats(
        &self,
        bench: &Bench<'_>,
        stage: Stage,
        size: [u32; 2],
        targets: usize,
    ) -> Result<Vec<Picture>, String> {
        let draw = self.with(stage, Blend::Replace, Depth::TestAndWrite)?;
        let targets = vec![RenderTarget::floats(Clear::Sentinel); targets];
        render(bench, &job(&self.draw.object, size, targets, vec![vec![draw]]))
    }
}

/// The module that is evaluated in place of the drawn one, where that walks to an exact hit.
pub(super) fn evaluated(features: &FeatureSet, fragments: &[Stage]) -> Option<Stage> {
    let walks = features.canonical().relief == Relief::Exact && fragments.contains(&Stage::Fragment);
    walks.then_some(Stage::FragmentGivenHit)
}

/// A job without its depth.
pub(super) fn job<'a>(
    name: &'a str,
    [width, height]: [u32; 2],
    targets: Vec<RenderTarget>,
    passes: Vec<Vec<RunnerDraw<'a>>>,
) -> RenderJob<'a> {
    RenderJob {
        name,
        width,
        height,
        targets,
        read_depth: false,
        passes,
    }
}

pub(super) fn render(bench: &Bench<'_>, job: &RenderJob<'_>) -> Result<Vec<Picture>, String> {
    Ok(job
        .run(bench.device)
        .map_err(|error| with_causes(&error))?
        .targets)
}
