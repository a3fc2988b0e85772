//! The relief ladder as one value: which search goes along the view ray, with which settings, and how far it has to go.
//!
//! [`Search::find`] answers with the hit record of the technique's own file, and with a count: the **steps**, heights read on the ray
//! after the first. `exact` counts the cells that it walks through after the first. So an offset takes no step, a march of
//! n layers between none and n, and what a step costs on a machine is a matter of measuring (`ray_ns`, `step_ns` of a cost profile).
//!
//! Heights are bilinear, cones as well; nothing is rounded to what a filter or a format of 32 bits can hold.

use std::cell::Cell;

use bossage_assets::cone_map::ConeMap;
use bossage_assets::{EdgeMode, HeightField};
use glam::{DVec2, DVec3};

use crate::relief_ray::{Entry, HitRecord, Layer, Ray, Status};
use crate::relief_truth::{self, height_at};
use crate::{
    cone_step, parallax_iterative, parallax_occlusion, parallax_offset, parallax_offset_limited,
    relaxed_cone_step, relief, steep_parallax,
};

/// A technique that searches for the hit of the view ray, with its settings.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Search {
    /// One height, at the place where the view meets the polygon; no division by V.z.
    ParallaxOffsetLimited,
    /// One height, at the place where the view meets the polygon.
    ParallaxOffset,
    /// Steps along the view by the height above the ray.
    ParallaxIterative {
        /// How many.
        iterations: u32,
    },
    /// A march; the first sample under the surface.
    SteepParallax {
        /// Samples from the layer's top to its bottom.
        layers: u32,
    },
    /// A march and a secant.
    ParallaxOcclusion {
        /// Samples from the layer's top to its bottom.
        layers: u32,
    },
    /// A march and bisection.
    Relief {
        /// Samples from the layer's top to its bottom.
        layers: u32,
        /// Halvings.
        refinements: u32,
    },
    /// Free cones.
    ConeStep {
        /// Cones.
        steps: u32,
    },
    /// Cones that cross the surface once, and bisection.
    RelaxedConeStep {
        /// Cones.
        steps: u32,
        /// Halvings.
        refinements: u32,
    },
    /// Every cell's quadratic.
    Exact,
}

/// What a search reads.
#[derive(Clone, Copy)]
pub struct Maps<'a> {
    /// Heights in [0, 1].
    pub height: &'a HeightField,
    /// What lies beyond their border.
    pub edge: EdgeMode,
    /// Third component of the unit normal at a uv, for `parallax_iterative`.
    pub normal_z: Option<&'a dyn Fn(DVec2) -> f64>,
    /// Free cones, for `cone_step`.
    pub cones: Option<&'a ConeMap>,
    /// Relaxed cones, for `relaxed_cone_step`.
    pub relaxed_cones: Option<&'a ConeMap>,
}

impl<'a> Maps<'a> {
    /// Heights alone.
    #[must_use]
    pub fn of_heights(height: &'a HeightField, edge: EdgeMode) -> Self {
        Self {
            height,
            edge,
            normal_z: None,
            cones: None,
            relaxed_cones: None,
        }
    }
}

/// A hit record, and what it took.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Counted {
    /// The answer.
    pub record: HitRecord,
    /// Heights read on the ray after the first; cells after the first for `exact`.
    pub steps: u32,
}

impl Search {
    /// The technique's id.
    #[must_use]
    pub fn id(self) -> &'static str {
        match self {
            Self::ParallaxOffsetLimited => "parallax_offset_limited",
            Self::ParallaxOffset => "parallax_offset",
            Self::ParallaxIterative { .. } => "parallax_iterative",
            Self::SteepParallax { .. } => "steep_parallax",
            Self::ParallaxOcclusion { .. } => "parallax_occlusion",
            Self::Relief { .. } => "relief",
            Self::ConeStep { .. } => "cone_step",
            Self::RelaxedConeStep { .. } => "relaxed_cone_step",
            Self::Exact => "exact",
        }
    }

    /// The settings by name.
    #[must_use]
    pub fn settings(self) -> Vec<(&'static str, u32)> {
        match self {
            Self::ParallaxOffsetLimited | Self::ParallaxOffset | Self::Exact => Vec::new(),
            Self::ParallaxIterative { iterations } => vec![("iterations", iterations)],
            Self::SteepParallax { layers } | Self::ParallaxOcclusion { layers } => vec![("layers", layers)],
            Self::Relief { layers, refinements } => vec![("layers", layers), ("refinements", refinements)],
            Self::ConeStep { steps } => vec![("steps", steps)],
            Self::RelaxedConeStep { steps, refinements } => {
                vec![("steps", steps), ("refinements", refinements)]
            }
        }
    }

    /// Where the view ray that crosses the polygon at `uv` is met; none where a map is missing that the technique reads.
    #[must_use]
    pub fn find(self, maps: &Maps<'_>, uv: DVec2, view_ts: DVec3, layer: &Layer) -> Option<Counted> {
        let reads = Cell::new(0);
        let height = |uv| {
            reads.set(reads.get() + 1);
            height_at(maps.height, maps.edge, uv)
        };
        let along = |find: &dyn Fn(&Ray) -> (f64, bool)| Entry::new(uv, view_ts, layer).search(find);
        let record = match self {
            Self::ParallaxOffsetLimited => shift(uv, view_ts, layer, height, parallax_offset_limited::offset),
            Self::ParallaxOffset => shift(uv, view_ts, layer, height, parallax_offset::hardened),
            Self::ParallaxIterative { iterations } => {
                let normal_z = maps.normal_z?;
                let sample = |uv| parallax_iterative::Sample {
                    height: height(uv),
                    normal_z: normal_z(uv),
                };
                parallax_iterative::shift(uv, view_ts, layer, iterations, sample)
            }
            Self::SteepParallax { layers } => {
                along(&|ray| (steep_parallax::first_below(ray, layers, height), true))
            }
            Self::ParallaxOcclusion { layers } => {
                along(&|ray| (parallax_occlusion::secant(ray, layers, height), true))
            }
            Self::Relief { layers, refinements } => {
                along(&|ray| (relief::bisect(ray, layers, refinements, height), true))
            }
            Self::ConeStep { steps } => {
                let sample = cones(maps, maps.cones?, &height);
                along(&|ray| cone_step::step(ray, reach(ray, maps), steps, &sample))
            }
            Self::RelaxedConeStep { steps, refinements } => {
                let sample = cones(maps, maps.relaxed_cones?, &height);
                along(&|ray| {
                    relaxed_cone_step::step_and_bisect(ray, reach(ray, maps), steps, refinements, &sample)
                })
            }
            Self::Exact => {
                return Some(exact(maps, uv, view_ts, layer));
            }
        };
        Some(Counted {
            record,
            steps: u32::saturating_sub(reads.get(), 1),
        })
    }
}

/// The shift of one height, by an offset's formula along one axis: (uv, V, h, scale, bias).
fn shift(
    uv: DVec2,
    view_ts: DVec3,
    layer: &Layer,
    height: impl Fn(DVec2) -> f64,
    offset: fn(DVec2, DVec3, f64, f64, f64) -> DVec2,
) -> HitRecord {
    let status = Entry::new(uv, view_ts, layer).status;
    if status == Status::NonFinite {
        return HitRecord { uv, t: 0.0, status };
    }
    let h = height(uv);
    let moved = |factor: f64| offset(uv, view_ts, h, factor * layer.scale, factor * layer.bias);
    HitRecord {
        uv: DVec2::new(moved(1.0).x, moved(layer.v_factor).y),
        t: 1.0 - h,
        status,
    }
}

fn exact(maps: &Maps<'_>, uv: DVec2, view_ts: DVec3, layer: &Layer) -> Counted {
    let cells = Cell::new(1);
    let record = Entry::new(uv, view_ts, layer).search(|ray| {
        let hit = relief_truth::first_hit(maps.height, maps.edge, ray);
        cells.set(hit.cells);
        (hit.t, hit.status == Status::Hit)
    });
    Counted {
        record,
        steps: cells.get() - 1,
    }
}

fn reach(ray: &Ray, maps: &Maps<'_>) -> f64 {
    let sides = DVec2::new(f64::from(maps.height.width), f64::from(maps.height.height));
    cone_step::reach(ray, sides)
}

/// Height and cone at a uv, both filtered.
fn cones<'a>(
    maps: &'a Maps<'_>,
    map: &'a ConeMap,
    height: &'a impl Fn(DVec2) -> f64,
) -> impl Fn(DVec2) -> cone_step::Sample + 'a {
    move |uv| cone_step::Sample {
        height: height(uv),
        ratio: ratio_at(map, maps.edge, uv),
    }
}

/// The filtered ratio at a uv.
fn ratio_at(map: &ConeMap, edge: EdgeMode, uv: DVec2) -> f64 {
    let p = uv * DVec2::new(f64::from(map.width), f64::from(map.height)) - 0.5;
    let (cell, f) = (p.floor(), p - p.floor());
    let ratio = |dx: i64, dy: i64| {
        let x = edge.resolve(cell.x as i64 + dx, map.width);
        let y = edge.resolve(cell.y as i64 + dy, map.height);
        f64::from(map.ratios[y as usize * map.width as usize + x as usize])
    };
    let row = |dy| ratio(0, dy) + f.x * (ratio(1, dy) - ratio(0, dy));
    row(0) + f.y * (row(1) - row(0))
}

#[cfg(test)]
mod tests;
