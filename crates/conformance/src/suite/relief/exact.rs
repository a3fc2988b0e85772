//! `exact` against the true first hit.
//!
//! A result is right within 0.01 texel of the true hit, or of the true hit of a ray within 4 ULP of this one
//! (`relief_grazing`): rays with more than one answer are counted as undecided, and at most one in 10,000 may be. The status must be
//! the true one, so no ray may run into the cap, and the place must lie on the ray at the depth that the record says, and there on the
//! surface.

use std::fmt;
use std::sync::OnceLock;

use bossage_assets::HeightField;
use bossage_reference::relief_grazing::{Answers, Surface, TOLERANCE_TEXELS, steepest};
use bossage_reference::relief_ray::{Ray, Status};
use bossage_reference::relief_truth::height_at;
use bossage_shaders::{HeightRead, Kernel, ReliefSearch, ReliefTechnique};
use glam::DVec2;
use rayon::prelude::*;

use super::beside::Beside;
use super::hits::Rig;
use super::maps;
use super::setting::{self, HIT_FLOATS, Setting};
use super::truth::entry;
use super::views::{View, views};
use crate::bench::Bench;
use crate::case::{Case, Outcome};
use crate::case_id::CaseId;
use crate::compare::Comparison;
use crate::generate::random::stream;
use crate::suite::kernel_case::KernelCase;

/// Views of any azimuth at each angle, in each setting.
const VIEWS: usize = 120;

/// The share of rays that may graze.
const GRAZING_LIMIT: f64 = 1e-4;

/// `exact` on one map.
pub(super) struct ExactCase {
    id: CaseId,
    search: ReliefSearch,
    field: HeightField,
    parts: OnceLock<Vec<Part>>,
}

/// One setting's rays and their answers.
struct Part {
    setting: Setting,
    steepest: DVec2,
    beside: Option<Beside>,
    views: Vec<View>,
    truths: Vec<(Ray, Status, Answers)>,
}

/// Both ways to read corners, on every map.
pub(super) fn cases() -> impl Iterator<Item = Box<dyn Case>> {
    let on_maps = |heights| {
        maps::all()
            .into_iter()
            .map(move |(name, field)| Box::new(ExactCase::new(heights, name, field)) as Box<dyn Case>)
    };
    HeightRead::ALL.into_iter().flat_map(on_maps)
}

/// How a record differs from all that count.
#[derive(Debug, PartialEq)]
enum Fault {
    Status { got: f32, wanted: u32 },
    Place { texels: f64 },
    OffTheRay { texels: f64 },
    OffTheSurface { heights: f64 },
}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Status { got, wanted } => write!(f, "status {got} instead of {wanted}"),
            Self::Place { texels } => write!(f, "{texels:.4} texels from every hit that counts"),
            Self::OffTheRay { texels } => write!(f, "uv and t are {texels:.4} texels apart"),
            Self::OffTheSurface { heights } => write!(f, "t is {heights:.6} heights off the surface at uv"),
        }
    }
}

/// How far off the surface a record may be, in heights: what the steepest slope makes of the tolerance, and 16 roundings of numbers up
/// to 1, since the gap that the walk makes 0 is a sum of four weighted corners and the ray's height.
pub(crate) fn off_surface(steepest: DVec2) -> f64 {
    TOLERANCE_TEXELS * steepest.element_sum() + 16.0 * 0.5f64.powi(24)
}

impl ExactCase {
    pub(super) fn new(heights: HeightRead, map: &str, field: HeightField) -> Self {
        let search = ReliefSearch {
            technique: ReliefTechnique::Exact,
            heights,
        };
        let id = CaseId::new("exact", None, "hits")
            .with("heights", heights.id())
            .with("map", map);
        Self {
            id,
            search,
            field,
            parts: OnceLock::new(),
        }
    }

    fn parts(&self) -> &[Part] {
        self.parts.get_or_init(|| {
            let mut rng = stream(&self.id.to_string(), 1);
            let drawn = setting::of(ReliefTechnique::Exact).map(|setting| (setting, views(VIEWS, &mut rng)));
            drawn
                .into_iter()
                .map(|(setting, views)| self.part(setting, views))
                .collect()
        })
    }

    fn part(&self, setting: Setting, views: Vec<View>) -> Part {
        let surface = Surface::new(&self.field, setting.edge);
        let truth = |view: &View| {
            let entry = entry(&setting, view);
            (entry.ray, entry.status, surface.answers(&entry.ray))
        };
        Part {
            beside: Beside::of(ReliefTechnique::Exact, &self.field, setting.edge),
            truths: views.par_iter().map(truth).collect(),
            steepest: steepest(&self.field, setting.edge),
            setting,
            views,
        }
    }

    /// How far off a record is, in texels.
    fn error(
        &self,
        part: &Part,
        (ray, status, answers): &(Ray, Status, Answers),
        [u, v, t, got]: &[f32; HIT_FLOATS],
    ) -> Result<f64, Fault> {
        if *got != status.number() as f32 {
            return Err(Fault::Status {
                got: *got,
                wanted: status.number(),
            });
        }
        let uv = DVec2::new(f64::from(*u), f64::from(*v));
        let sides = DVec2::new(f64::from(self.field.width), f64::from(self.field.height));
        let apart = ((uv - ray.at(f64::from(*t))) * sides).length();
        let texels = answers.error_texels(uv);
        let off = (1.0 - f64::from(*t) - height_at(&self.field, part.setting.edge, uv)).abs();
        // Not a number is nowhere.
        if apart.is_nan() || apart > TOLERANCE_TEXELS {
            Err(Fault::OffTheRay { texels: apart })
        } else if texels > TOLERANCE_TEXELS {
            Err(Fault::Place { texels })
        } else if off > off_surface(part.steepest) {
            Err(Fault::OffTheSurface { heights: off })
        } else {
            Ok(texels)
        }
    }
}

impl KernelCase for ExactCase {
    fn id(&self) -> &CaseId {
        &self.id
    }

    fn basis(&self) -> Vec<&'static str> {
        vec!["reference f64", "0.01 texel of a hit of a ray within 4 ULP"]
    }

    fn kernels(&self) -> Vec<Kernel> {
        vec![Kernel::ReliefHits(self.search)]
    }

    fn judge(&self, bench: &Bench<'_>) -> Result<Outcome, String> {
        let (name, texture) = (self.id.to_string(), setting::texture(&self.field));
        let (mut rays, mut grazing, mut worst) = (0, 0, 0.0f64);
        for part in self.parts() {
            let rig = Rig {
                name: &name,
                search: self.search,
                setting: &part.setting,
                texture: &texture,
                beside: part.beside.as_ref(),
            };
            for ((view, truth), got) in part
                .views
                .iter()
                .zip(&part.truths)
                .zip(rig.hits(bench, &part.views)?)
            {
                let texels = self.error(part, truth, &got).map_err(|fault| {
                    format!(
                        "{fault}: {view:?} in {:?} met {got:?}; the truth is {:?}",
                        part.setting, truth.2
                    )
                })?;
                worst = worst.max(texels);
                grazing += usize::from(truth.2.is_grazing());
            }
            rig.not_finite(bench)?;
            rays += part.views.len();
        }
        let mut comparison = Comparison::of_property(rays);
        comparison.undecided = grazing;
        let outcome = Outcome::of(rays, comparison, GRAZING_LIMIT);
        let note = format!("at most {worst:.5} texels off; {grazing} of {rays} rays graze");
        let reason = outcome.reason.clone().or(Some(note));
        Ok(Outcome { reason, ..outcome })
    }
}
