//! Predicted error and steps of a relief technique: rays of this scene, the technique in f64, against the first hit on the bilinear
//! height field.
//!
//! Error in texels is the distance between the shaded and the true texture position; in pixels, the same carried to the
//! screen by the derivative of the projection on the polygon. Percentiles over all rays of all objects of a material, each object
//! getting its share of the rays by visible area.
//!
//! Guarantee: deterministic. The planner's rays fill the visible area evenly; [`measure`] draws independent ones.
//! The slope techniques read the normal map, bilinear, in the frame of the polygon. Displaced vertices are right where they
//! are; between them the grid is straight, and the height it misses is carried to the texture along the view.
//! Limits: as for views, hidden parts count; the derivative is taken at the polygon, so very large errors are only
//! roughly right in pixels. Searches are those of f64 and of exact filters: what 32 bits add (at most 0.01 texel for `exact`) is
//! not in it, nor what smaller mip levels take away.

use std::cell::OnceCell;

use bossage_assets::cone_map::{self, ConeMap};
use bossage_assets::{EdgeMode, NormalMap, relaxed_cone_map};
use bossage_reference::relief_ray::{Layer, Ray, Status};
use bossage_reference::relief_search::{Maps, Search};
use bossage_reference::{parallax_offset, parallax_slope_ao, parallax_slope_ao_directed, relief_truth};
use bossage_shaders::Form;
use glam::{DVec2, DVec3};
use serde::Serialize;

use crate::model::{Elevation, HeightSource, Material, Scene};
use crate::percentile::Percentile;
use crate::sequence::Sequence;
use crate::technique::Technique;
use crate::views::{View, ViewRay};

/// 99th percentiles of the error.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Error {
    /// Texels.
    #[serde(rename = "error_texels_p99")]
    pub texels_p99: f64,
    /// Pixels.
    #[serde(rename = "error_px_p99")]
    pub px_p99: f64,
}

/// What a technique did on independent rays of a scene.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Measured {
    /// Its error.
    #[serde(flatten)]
    pub error: Error,
    /// Between what the 99th percentile in pixels lies, each with a doubt of 1 in 200; infinite where the rays are too few to say.
    pub error_px_p99_between: [f64; 2],
    /// Mean steps a ray, as [`bossage_reference::relief_search`] counts them.
    pub steps: f64,
    /// The rays.
    pub rays: usize,
}

/// Measures a technique on about `rays` independent rays of a material, other ones than the planner's. The same seed gives the
/// same rays. None where the material has no heights or is not seen.
#[must_use]
pub fn measure(
    scene: &Scene,
    material: usize,
    technique: Technique,
    rays: u32,
    seed: u64,
) -> Option<Measured> {
    let views: Vec<View> = scene
        .objects_of(material)
        .map(|object| View::new(&scene.camera, object))
        .collect();
    let material = &scene.materials[material];
    let height = material.height.as_ref()?;
    let mut sampler = Sampler::new(material, height, &views.iter().collect::<Vec<_>>(), Some(seed));
    sampler.grow(rays);
    let mut sample = Sample::default();
    sampler.extend(technique, &mut sample, sampler.len());
    let px = sample.px()?;
    Some(Measured {
        error: sample.error()?,
        error_px_p99_between: [px.at_least, px.at_most],
        steps: sample.mean_steps(),
        rays: sample.len(),
    })
}

/// A technique's errors and steps, one a ray.
#[derive(Clone, Debug, Default)]
pub(crate) struct Sample {
    texels: Vec<f64>,
    px: Vec<f64>,
    steps: u64,
}

impl Sample {
    /// How many rays.
    pub(crate) fn len(&self) -> usize {
        self.px.len()
    }

    /// The percentiles; none without rays.
    pub(crate) fn error(&self) -> Option<Error> {
        Some(Error {
            texels_p99: Percentile::of(&self.texels)?.estimate,
            px_p99: Percentile::of(&self.px)?.estimate,
        })
    }

    /// The percentile in pixels with its bounds; none without rays.
    pub(crate) fn px(&self) -> Option<Percentile> {
        Percentile::of(&self.px)
    }

    /// Steps a ray; 0 without rays.
    pub(crate) fn mean_steps(&self) -> f64 {
        self.steps as f64 / (self.len().max(1) as f64)
    }
}

/// Rays of a material with their true texture positions, as many as are asked for.
pub(crate) struct Sampler<'a> {
    height: &'a HeightSource,
    normal: Option<&'a NormalMap>,
    edge: EdgeMode,
    form: Form,
    layer: Layer,
    views: Vec<Seen<'a>>,
    rays: Vec<(ViewRay, DVec2)>,
    cones: OnceCell<ConeMap>,
    relaxed_cones: OnceCell<ConeMap>,
}

/// An object in view, its share of the rays, and how many of them were drawn.
struct Seen<'a> {
    view: &'a View,
    share: f64,
    drawn: u32,
    sequence: Sequence,
}

impl<'a> Sampler<'a> {
    /// Without rays yet: with a seed independent ones, else those that fill the area evenly.
    pub(crate) fn new(
        material: &'a Material,
        height: &'a HeightSource,
        views: &[&'a View],
        seed: Option<u64>,
    ) -> Self {
        let total: f64 = views.iter().map(|view| view.area_px()).sum();
        let seen = views.iter().filter(|view| view.area_px() > 0.0);
        let sequence = |index| seed.map_or_else(Sequence::even, |seed| Sequence::random(seed, index));
        let Elevation { scale, bias } = height.elevation;
        Self {
            height,
            normal: material.normal.as_ref().map(|normal| normal.map.as_ref()),
            edge: material.address,
            form: material.form,
            layer: Layer {
                scale: scale.x,
                bias: bias.x,
                v_factor: scale.y / scale.x,
            },
            views: seen
                .zip(0..)
                .map(|(view, index)| Seen {
                    view,
                    share: view.area_px() / total,
                    drawn: 0,
                    sequence: sequence(index),
                })
                .collect(),
            rays: Vec::new(),
            cones: OnceCell::new(),
            relaxed_cones: OnceCell::new(),
        }
    }

    /// Draws until about `count` rays were drawn. Parts that are seen from behind give none.
    pub(crate) fn grow(&mut self, count: u32) {
        for seen in &mut self.views {
            let wanted = (f64::from(count) * seen.share).ceil() as u32;
            let new = (seen.drawn..wanted).filter_map(|_| seen.view.ray_at(seen.sequence.draw()));
            let new: Vec<ViewRay> = new.collect();
            seen.drawn = seen.drawn.max(wanted);
            let traced = new
                .into_iter()
                .filter_map(|ray| Some((ray, true_uv(self.height, self.edge, &ray)?)));
            self.rays.extend(traced);
        }
    }

    /// How many rays there are.
    pub(crate) fn len(&self) -> usize {
        self.rays.len()
    }

    /// Asks a technique about the first `count` rays, but for those that its sample has seen.
    pub(crate) fn extend(&self, technique: Technique, sample: &mut Sample, count: usize) {
        let size = DVec2::new(
            f64::from(self.height.field.width),
            f64::from(self.height.field.height),
        );
        for (ray, truth) in self.rays.iter().take(count).skip(sample.len()) {
            let (off, steps) = self.off(technique, ray, *truth);
            sample.texels.push((off * size).length());
            sample
                .px
                .push((ray.px_per_uv[0] * off.x + ray.px_per_uv[1] * off.y).length());
            sample.steps += u64::from(steps);
        }
    }

    /// How far the shaded texture position is from the true one, and the steps to it.
    fn off(&self, technique: Technique, ray: &ViewRay, truth: DVec2) -> (DVec2, u32) {
        match technique {
            Technique::None => (ray.uv - truth, 0),
            Technique::Displacement => (self.missed_by_grid(ray), 0),
            Technique::ParallaxSlopeAo => (self.slope_shift(false, ray) - truth, 0),
            Technique::ParallaxSlopeAoDirected => (self.slope_shift(true, ray) - truth, 0),
            Technique::Search(Search::ParallaxOffset) if self.form == Form::Published => {
                (self.offset_published(ray) - truth, 0)
            }
            Technique::Search(search) => self.searched(search, ray, truth),
        }
    }

    fn searched(&self, search: Search, ray: &ViewRay, truth: DVec2) -> (DVec2, u32) {
        let field = &self.height.field;
        let normal_z = |uv| {
            let flat = DVec3::Z;
            let normal = self.normal.map_or(flat, |map| normal_at(map, self.edge, uv));
            normal.try_normalize().unwrap_or(flat).z
        };
        let cones = || self.cones.get_or_init(|| cone_map::bake(field, self.edge));
        let relaxed = || {
            self.relaxed_cones
                .get_or_init(|| relaxed_cone_map::bake(field, self.edge))
        };
        let maps = Maps {
            normal_z: Some(&normal_z),
            cones: matches!(search, Search::ConeStep { .. }).then(cones),
            relaxed_cones: matches!(search, Search::RelaxedConeStep { .. }).then(relaxed),
            ..Maps::of_heights(field, self.edge)
        };
        // Every map that a search reads is here.
        let found = search.find(&maps, ray.uv, ray.view_ts, &self.layer);
        found.map_or((ray.uv - truth, 0), |found| {
            (found.record.uv - truth, found.steps)
        })
    }

    fn offset_published(&self, ray: &ViewRay) -> DVec2 {
        let height = relief_truth::height_at(&self.height.field, self.edge, ray.uv);
        let Elevation { scale, bias } = self.height.elevation;
        let moved = |scale, bias| parallax_offset::published(ray.uv, ray.view_ts, height, scale, bias);
        DVec2::new(moved(scale.x, bias.x).x, moved(scale.y, bias.y).y)
    }

    /// Where the view meets the grid, against where it meets the heights between the grid's vertices.
    fn missed_by_grid(&self, ray: &ViewRay) -> DVec2 {
        let at = |uv| relief_truth::height_at(&self.height.field, self.edge, uv);
        let grid: f64 = ray.corners.iter().map(|(uv, share)| share * at(*uv)).sum();
        (grid - at(ray.uv)) * self.height.elevation.scale * ray.view_ts.truncate() / ray.view_ts.z
    }

    fn slope_shift(&self, directed: bool, ray: &ViewRay) -> DVec2 {
        let Some(map) = self.normal else { return ray.uv };
        let height = relief_truth::height_at(&self.height.field, self.edge, ray.uv);
        let (n, scale) = (normal_at(map, self.edge, ray.uv), self.height.elevation.scale);
        let delta = |view| match self.form {
            Form::Published => parallax_slope_ao::delta_published(n, DVec3::Z, view, height, scale.x),
            Form::Hardened => parallax_slope_ao::delta_hardened(n, DVec3::Z, view, height, scale.x),
        };
        // Occlusion does not move anything.
        let still = 0.0;
        match (directed, self.form) {
            (true, _) => {
                let view = ray.view_ts * DVec3::new(1.0, scale.y / scale.x, 1.0);
                parallax_slope_ao_directed::shift(ray.uv, view, delta(ray.view_ts), still).uv
            }
            (false, Form::Published) => {
                parallax_slope_ao::published(ray.uv, delta(ray.backward_ts), still).uv
            }
            (false, Form::Hardened) => parallax_slope_ao::hardened(ray.uv, delta(ray.view_ts), still).uv,
        }
    }
}

/// Where the view ray first meets the surface; none for rays so flat that the walk gives up.
fn true_uv(height: &HeightSource, edge: EdgeMode, ray: &ViewRay) -> Option<DVec2> {
    let Elevation { scale, bias } = height.elevation;
    let slope = ray.view_ts.truncate() / ray.view_ts.z;
    let ray = Ray {
        uv_top: ray.uv + (scale + bias) * slope,
        delta: -scale * slope,
    };
    if !(ray.uv_top.is_finite() && ray.delta.is_finite()) {
        return None;
    }
    let hit = relief_truth::first_hit(&height.field, edge, &ray);
    (hit.status == Status::Hit).then_some(hit.uv)
}

/// The filtered normal of a map, decoded, not normalised.
fn normal_at(map: &NormalMap, edge: EdgeMode, uv: DVec2) -> DVec3 {
    let p = uv * DVec2::new(f64::from(map.width), f64::from(map.height)) - 0.5;
    let (cell, f) = (p.floor(), p - p.floor());
    let texel = |dx: i64, dy: i64| {
        let x = edge.resolve(cell.x as i64 + dx, map.width);
        let y = edge.resolve(cell.y as i64 + dy, map.height);
        map.decode(x, y).as_dvec3()
    };
    let row = |dy| texel(0, dy).lerp(texel(1, dy), f.x);
    row(0).lerp(row(1), f.y)
}
