//! The same searches in f64, from `bossage-reference`.

use bossage_assets::{EdgeMode, HeightField};
use bossage_bounds::SUBTEXEL;
use bossage_reference::relief_grazing::steepest;
use bossage_reference::relief_ray::{Entry, HitRecord, Ray};
use bossage_reference::relief_truth::{height_at, trace};
use bossage_reference::steep_parallax::first_below;
use bossage_reference::{
    cone_step, parallax_iterative, parallax_occlusion, parallax_offset, parallax_offset_limited,
    relaxed_cone_step, relief,
};
use bossage_shaders::ReliefTechnique;
use glam::{DVec2, DVec3};

use super::beside::Beside;
use super::setting::Setting;
use super::views::View;

/// A search in one setting, over heights that may be lifted.
pub(super) struct Search<'a> {
    pub(super) technique: ReliefTechnique,
    pub(super) field: &'a HeightField,
    pub(super) setting: &'a Setting,
    pub(super) beside: Option<&'a Beside>,
    /// Heights that all of the surface is lifted by.
    pub(super) lift: f64,
}

impl Search<'_> {
    fn height(&self, uv: DVec2) -> f64 {
        height_at(self.field, self.setting.edge, uv) + self.lift
    }

    fn number(&self, uv: DVec2) -> f64 {
        self.beside.map_or(f64::NAN, |beside| beside.number(uv))
    }

    fn cone(&self, uv: DVec2) -> cone_step::Sample {
        cone_step::Sample {
            height: self.height(uv),
            ratio: self.number(uv),
        }
    }

    fn reach(&self, ray: &Ray) -> f64 {
        let sides = DVec2::new(f64::from(self.field.width), f64::from(self.field.height));
        cone_step::reach(ray, sides)
    }

    /// What the technique answers.
    pub(super) fn record(&self, view: &View) -> HitRecord {
        let (steps, refinements) = (self.setting.steps, self.setting.refinements);
        let height = |uv| self.height(uv);
        let entry = entry(self.setting, view);
        let (uv, direction) = exact(view);
        match self.technique {
            ReliefTechnique::ParallaxOffset | ReliefTechnique::ParallaxOffsetLimited => self.offset(view),
            ReliefTechnique::ParallaxIterative => {
                let sample = |uv| parallax_iterative::Sample {
                    height: self.height(uv),
                    normal_z: self.number(uv),
                };
                parallax_iterative::shift(uv, direction, &self.setting.layer(), steps, sample)
            }
            ReliefTechnique::SteepParallax => entry.search(|ray| (first_below(ray, steps, height), true)),
            ReliefTechnique::ParallaxOcclusion => {
                entry.search(|ray| (parallax_occlusion::secant(ray, steps, height), true))
            }
            ReliefTechnique::Relief => {
                entry.search(|ray| (relief::bisect(ray, steps, refinements, height), true))
            }
            ReliefTechnique::ConeStep => {
                entry.search(|ray| cone_step::step(ray, self.reach(ray), steps, |uv| self.cone(uv)))
            }
            ReliefTechnique::RelaxedConeStep => entry.search(|ray| {
                let cone = |uv| self.cone(uv);
                relaxed_cone_step::step_and_bisect(ray, self.reach(ray), steps, refinements, cone)
            }),
            ReliefTechnique::Exact => trace(
                self.field,
                self.setting.edge,
                uv,
                direction,
                &self.setting.layer(),
            ),
        }
    }

    /// What the search decided on its way, as a number: which layer, which half, met or not.
    fn decisions(&self, view: &View) -> f64 {
        let height = |uv| self.height(uv);
        let ray = entry(self.setting, view).ray;
        let (steps, refinements) = (self.setting.steps, self.setting.refinements);
        match self.technique {
            ReliefTechnique::ParallaxOffset
            | ReliefTechnique::ParallaxOffsetLimited
            | ReliefTechnique::ParallaxIterative
            | ReliefTechnique::Exact => 0.0,
            ReliefTechnique::SteepParallax | ReliefTechnique::ParallaxOcclusion => {
                first_below(&ray, steps, height)
            }
            ReliefTechnique::Relief => relief::bisect(&ray, steps, refinements, height),
            ReliefTechnique::ConeStep => f64::from(self.record(view).status.number()),
            ReliefTechnique::RelaxedConeStep => {
                let record = self.record(view);
                let (end, _) = cone_step::step(&ray, self.reach(&ray), steps, |uv| self.cone(uv));
                // t is so many halves of the last bracket behind the entry.
                let halves = f64::from(refinements + 1).exp2();
                let share = if end > 0.0 { record.t / end } else { 0.0 };
                4.0 * (share * halves).round() + f64::from(record.status.number())
            }
        }
    }

    /// What heights may be off by where the search reads them. Where a step builds on the one before, it reads at a place that is off
    /// by the steps before: t + k (1 − t − h(t)) with k ≤ 1 takes over up to 2 + |dh/dt| times what t was off by.
    pub(super) fn allowance(&self, view: &View, ideal: bool) -> f64 {
        let ray = entry(self.setting, view).ray;
        let once = height_allowance(self.field, self.setting.edge, &ray, ideal);
        match self.technique {
            ReliefTechnique::ConeStep | ReliefTechnique::RelaxedConeStep => {
                let sides = DVec2::new(f64::from(self.field.width), f64::from(self.field.height));
                let steepest = steepest(self.field, self.setting.edge);
                let slope = (ray.delta * sides).abs().dot(steepest);
                once * (2.0 + slope).powi(self.setting.steps as i32)
            }
            _ => once,
        }
    }

    /// Whether heights that are off by `allowance` lead the search another way.
    pub(super) fn is_touchy(&self, view: &View, allowance: f64) -> bool {
        let lifted = |lift| Search { lift, ..*self }.decisions(view);
        lifted(allowance) != lifted(-allowance)
    }

    /// The offsets read one height, at the polygon: the place is z(h) further toward the eye, and h says how deep.
    fn offset(&self, view: &View) -> HitRecord {
        let layer = self.setting.layer();
        let (uv, direction) = exact(view);
        let direction = direction * DVec3::new(1.0, layer.v_factor, 1.0);
        let h = self.height(uv);
        let shifted = match self.technique {
            ReliefTechnique::ParallaxOffset => {
                parallax_offset::hardened(uv, direction, h, layer.scale, layer.bias)
            }
            _ => parallax_offset_limited::offset(uv, direction, h, layer.scale, layer.bias),
        };
        let record = entry(self.setting, view).search(|_| (1.0 - h, true));
        HitRecord {
            uv: shifted,
            ..record
        }
    }
}

fn exact(view: &View) -> (DVec2, DVec3) {
    let [u, v] = view.uv.map(f64::from);
    (DVec2::new(u, v), DVec3::from_array(view.dir_ts.map(f64::from)))
}

/// What heights may be off by where a ray reads them: by the rounding of its places, and by what a sampler keeps of the weights
/// unless it is ideal.
pub(super) fn height_allowance(field: &HeightField, edge: EdgeMode, ray: &Ray, ideal: bool) -> f64 {
    let furthest = ray.uv_top.abs().max(ray.at(1.0).abs()).max_element();
    let side = f64::from(field.width.max(field.height));
    // A place is made by four roundings of numbers up to the furthest, in texels.
    let rounding = 4.0 * f64::from(f32::EPSILON) * furthest * side;
    let subtexel = if ideal { 0.0 } else { SUBTEXEL };
    let steepest = steepest(field, edge).element_sum();
    // Heights and t are numbers up to 1, of a few roundings each.
    (rounding + subtexel) * steepest + 8.0 * f64::from(f32::EPSILON)
}

/// The ray of a view.
pub(super) fn entry(setting: &Setting, view: &View) -> Entry {
    let (uv, direction) = exact(view);
    Entry::new(uv, direction, &setting.layer())
}
