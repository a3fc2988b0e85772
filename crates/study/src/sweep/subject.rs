//! What takes part in a sweep: a technique of the library with its settings, or a shader of the user's.

use std::collections::BTreeMap;
use std::sync::Arc;

use bossage_conformance::Route;
use bossage_conformance::route::Prepared;
use bossage_reference::relief_search::{Maps, Search};
use bossage_reference::relief_truth::height_at;
use bossage_runner::{BufferData, ComputeJob, Resources};
use bossage_shaders::{AssembledShader, Library, ReliefTechnique};
use bossage_translate::Stage;
use glam::DVec2;
use rayon::prelude::*;

use super::kernel;
use super::ladder::Chosen;
use super::map::Map;
use super::rays::ViewRay;
use crate::error::Error;
use crate::record::Settings;

/// One competitor.
#[derive(Clone, Debug)]
pub struct Subject {
    /// Technique id, or `user:NAME`.
    pub id: String,
    /// Its settings.
    pub settings: Settings,
    /// The flags that choose it, after `bossage study`.
    pub flags: String,
    /// The way from its text to the driver.
    pub route: Route,
    /// Its module.
    pub prepared: Arc<Prepared>,
    /// The entry point that is run.
    pub entry: String,
    /// The library's technique; none of the user's.
    chosen: Option<Chosen>,
}

/// Layers or steps, and halvings, that users' shaders are given in `search`.
const USERS_STEPS: [u32; 2] = [32, 5];

impl Subject {
    /// Techniques of the library. Those that differ in their settings alone share a module.
    ///
    /// # Errors
    /// When the library does not assemble, or a module cannot be made for the route.
    pub fn of_library(library: &Library, chosen: &[Chosen], route: Route) -> Result<Vec<Self>, Error> {
        let mut modules: BTreeMap<&str, Arc<Prepared>> = BTreeMap::new();
        let mut subjects = Vec::with_capacity(chosen.len());
        for one in chosen {
            let id = one.technique.id;
            let prepared = match modules.get(id) {
                Some(found) => Arc::clone(found),
                None => {
                    let assembled = super::ladder::assemble(library, one.technique)?;
                    let made = Arc::new(route.prepare(&assembled).map_err(Error::Shader)?);
                    modules.insert(id, Arc::clone(&made));
                    made
                }
            };
            subjects.push(Self {
                id: id.to_owned(),
                settings: one.settings(),
                flags: format!("--technique {one}"),
                route,
                prepared,
                entry: super::ladder::ENTRY.to_owned(),
                chosen: Some(one.clone()),
            });
        }
        Ok(subjects)
    }

    /// A shader of the user's: its only compute entry point, or the one that is called as the library's.
    ///
    /// # Errors
    /// When it has none or several, or does not write `hits`.
    pub fn of_user(name: &str, file: &str, text: String, route: Route) -> Result<Self, Error> {
        let assembled = AssembledShader {
            name: file.to_owned(),
            wgsl: text,
            features: Vec::new(),
            modules: vec![file.to_owned()],
        };
        let prepared = route.prepare(&assembled).map_err(Error::Shader)?;
        let entry = users_entry(file, &prepared)?;
        let writes = prepared.entry(&entry).map_err(Error::Shader)?.bindings.iter();
        let missing: Vec<&str> = [kernel::RAYS, kernel::HITS]
            .into_iter()
            .filter(|wanted| !writes.clone().any(|binding| binding.name == *wanted))
            .collect();
        if !missing.is_empty() {
            return Err(Error::Shader(format!(
                "{file}: `{entry}` binds no `{}`; a shader that takes part has the bindings of the library's `{}`, which docs/study.md shows",
                missing.join("` and no `"),
                super::ladder::ENTRY
            )));
        }
        Ok(Self {
            id: format!("user:{name}"),
            settings: Settings::default(),
            flags: format!("--shader {file}"),
            route,
            prepared: Arc::new(prepared),
            entry,
            chosen: None,
        })
    }

    /// The dispatch over packed rays.
    ///
    /// # Errors
    /// When the module lacks its entry point.
    pub fn job<'a>(&'a self, map: &'a Map, rays: &'a [u8]) -> Result<ComputeJob<'a>, Error> {
        let shader = self.prepared.shader(&self.entry).map_err(Error::Shader)?;
        let count = rays.len() / 32;
        let [steps, refinements] = self.search();
        let mut resources = Resources {
            uniforms: kernel::search(map, steps, refinements).into(),
            ..Resources::default()
        };
        let buffers = &mut resources.buffers;
        buffers.insert(kernel::RAYS.to_owned(), BufferData::Bytes(rays));
        buffers.insert(
            kernel::HITS.to_owned(),
            BufferData::Output(count * kernel::HIT_BYTES),
        );
        for binding in &shader.entry.bindings {
            if let Some(texture) = map.textures.of(&binding.name, self.technique(), map) {
                resources.textures.insert(binding.name.clone(), texture);
            }
        }
        resources
            .samplers
            .insert(kernel::SAMPLER.to_owned(), kernel::sampler(map.edge));
        let group = shader.entry.workgroup_size.map_or(1, |size| size[0]).max(1) as usize;
        Ok(ComputeJob {
            name: &self.id,
            shader,
            resources,
            workgroups: [count.div_ceil(group) as u32, 1, 1],
        })
    }

    /// Layers, steps or iterations, and halvings.
    fn search(&self) -> [u32; 2] {
        let Some(chosen) = &self.chosen else {
            return USERS_STEPS;
        };
        let first = |names: &[&str]| names.iter().find_map(|name| chosen.setting(name));
        [
            first(&["layers", "steps", "iterations"]).unwrap_or(1),
            first(&["refinements"]).unwrap_or(0),
        ]
    }

    fn technique(&self) -> Option<ReliefTechnique> {
        ReliefTechnique::find(self.chosen.as_ref()?.technique.id)
    }

    /// Mean steps of the reference search on rays over a map; none where there is no such search.
    #[must_use]
    pub fn steps(&self, map: &Map, rays: &[ViewRay]) -> Option<f64> {
        let search = self.chosen.as_ref()?.search()?;
        let textures = &map.textures;
        let (cones, relaxed) = match search {
            Search::ConeStep { .. } => (Some(&textures.cones(map).second), None),
            Search::RelaxedConeStep { .. } => (None, Some(&textures.relaxed_cones(map).second)),
            _ => (None, None),
        };
        let normals =
            matches!(search, Search::ParallaxIterative { .. }).then(|| &textures.normals_z(map).second);
        let counts = rays.par_iter().map(|ray| {
            let normal_z = normals.map(|field| move |uv| height_at(field, map.edge, uv));
            let maps = Maps {
                normal_z: normal_z.as_ref().map(|read| read as &dyn Fn(DVec2) -> f64),
                cones,
                relaxed_cones: relaxed,
                ..Maps::of_heights(&map.field, map.edge)
            };
            let (uv, view_ts) = ray.exact();
            search
                .find(&maps, uv, view_ts, &map.layer)
                .map(|found| u64::from(found.steps))
        });
        let total = counts.sum::<Option<u64>>()?;
        Some(total as f64 / rays.len().max(1) as f64)
    }
}

fn users_entry(file: &str, prepared: &Prepared) -> Result<String, Error> {
    let compute: Vec<&str> = prepared
        .manifest
        .entries
        .iter()
        .filter(|entry| entry.stage == Stage::Compute)
        .map(|entry| entry.name.as_str())
        .collect();
    match compute.as_slice() {
        [one] => Ok((*one).to_owned()),
        all if all.contains(&super::ladder::ENTRY) => Ok(super::ladder::ENTRY.to_owned()),
        [] => Err(Error::Shader(format!(
            "{file} has no compute entry point; a relief shader is studied as one"
        ))),
        all => Err(Error::Shader(format!(
            "{file} has several compute entry points ({}); call the one to study `{}`",
            all.join(", "),
            super::ladder::ENTRY
        ))),
    }
}
