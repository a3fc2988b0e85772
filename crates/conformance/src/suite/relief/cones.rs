//! Cones over many steps, by what safe maps promise.
//!
//! Values of such a march have no useful interval: each step builds on the one before. What is promised instead: `cone_step` never
//! passes the true first hit, and a record of either technique says hit exactly where the ray is within `CLOSE_HEIGHT` of the surface.

use bossage_assets::HeightField;
use bossage_reference::cone_step::CLOSE_HEIGHT;
use bossage_reference::relief_ray::Status;
use bossage_reference::relief_truth::{first_hit_lifted, height_at};
use bossage_shaders::{Kernel, ReliefSearch, ReliefTechnique};
use glam::DVec2;

use super::beside::Beside;
use super::hits::Rig;
use super::maps;
use super::setting::{self, HIT_FLOATS, Setting};
use super::truth::{entry, height_allowance};
use super::views::{View, views};
use crate::bench::Bench;
use crate::case::{Case, Outcome};
use crate::case_id::CaseId;
use crate::compare::Comparison;
use crate::dispatch::Filtering;
use crate::generate::random::stream;
use crate::suite::kernel_case::KernelCase;

/// Views of any azimuth at each angle, in each setting.
const VIEWS: usize = 20;

/// Steps and halvings: enough for most rays to reach the surface.
const STEPS: u32 = 48;
const REFINEMENTS: u32 = 16;

/// A cone technique on one map.
pub(super) struct ConeCase {
    id: CaseId,
    search: ReliefSearch,
    field: HeightField,
}

/// Both techniques and both ways to read maps, on every map.
pub(super) fn cases() -> impl Iterator<Item = Box<dyn Case>> {
    let on_maps = |search: ReliefSearch| {
        maps::all()
            .into_iter()
            .map(move |(name, field)| Box::new(ConeCase::new(search, name, field)) as Box<dyn Case>)
    };
    ReliefSearch::all()
        .filter(|search| {
            matches!(
                search.technique,
                ReliefTechnique::ConeStep | ReliefTechnique::RelaxedConeStep
            )
        })
        .flat_map(on_maps)
}

impl ConeCase {
    pub(super) fn new(search: ReliefSearch, map: &str, field: HeightField) -> Self {
        let id = CaseId::new(search.technique.id(), None, "promises")
            .with("heights", search.heights.id())
            .with("map", map);
        Self { id, search, field }
    }

    /// Holds one record to the promises.
    fn promises(
        &self,
        setting: &Setting,
        view: &View,
        [u, v, t, status]: &[f32; HIT_FLOATS],
        ideal: bool,
    ) -> Result<Verdict, String> {
        let entry = entry(setting, view);
        let (uv, t) = (DVec2::new(f64::from(*u), f64::from(*v)), f64::from(*t));
        if !(uv.is_finite() && (0.0..=1.0).contains(&t)) {
            return Err("no place in the layer".to_owned());
        }
        let allowance = height_allowance(&self.field, setting.edge, &entry.ray, ideal);
        let gap = (1.0 - t) - height_at(&self.field, setting.edge, entry.ray.at(t));
        let (met, capped) = (
            *status == entry.status.number() as f32,
            *status == Status::CapReached.number() as f32,
        );
        if (met && gap > CLOSE_HEIGHT + allowance) || (capped && gap < CLOSE_HEIGHT - allowance) {
            return Err(format!("a gap of {gap} heights does not fit the status"));
        }
        if !(met || capped) {
            return Err("another status".to_owned());
        }
        if self.search.technique == ReliefTechnique::ConeStep {
            // The surface lowered by what heights may be off is met no earlier.
            let furthest = first_hit_lifted(&self.field, setting.edge, &entry.ray, -allowance).t;
            if t > furthest + 8.0 * f64::from(f32::EPSILON) {
                return Err(format!("behind the first hit at t = {furthest}"));
            }
        }
        if (gap - CLOSE_HEIGHT).abs() <= allowance {
            Ok(Verdict::Open)
        } else if met {
            Ok(Verdict::Met)
        } else {
            Ok(Verdict::Short)
        }
    }
}

/// What became of a ray that kept the promises.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Verdict {
    /// Within `CLOSE_HEIGHT` of the surface.
    Met,
    /// Above it, and said so.
    Short,
    /// Within rounding of the limit: either status is right.
    Open,
}

impl KernelCase for ConeCase {
    fn id(&self) -> &CaseId {
        &self.id
    }

    fn basis(&self) -> Vec<&'static str> {
        vec!["reference f64", "cones hold none of the surface"]
    }

    fn kernels(&self) -> Vec<Kernel> {
        vec![Kernel::ReliefHits(self.search)]
    }

    fn judge(&self, bench: &Bench<'_>) -> Result<Outcome, String> {
        let (name, texture) = (self.id.to_string(), setting::texture(&self.field));
        let ideal = setting::filtering(bench.route, self.search.heights) == Filtering::Ideal;
        let mut rng = stream(&name, 1);
        let (mut rays, mut open, mut met) = (0, 0, 0);
        for setting in setting::of(self.search.technique) {
            let setting = Setting {
                steps: STEPS,
                refinements: REFINEMENTS,
                ..setting
            };
            let beside = Beside::of(self.search.technique, &self.field, setting.edge);
            let views = views(VIEWS, &mut rng);
            let rig = Rig {
                name: &name,
                search: self.search,
                setting: &setting,
                texture: &texture,
                beside: beside.as_ref(),
            };
            for (view, got) in views.iter().zip(rig.hits(bench, &views)?) {
                let verdict = self
                    .promises(&setting, view, &got, ideal)
                    .map_err(|broken| format!("{broken}: {view:?} in {setting:?} met {got:?}"))?;
                open += usize::from(verdict == Verdict::Open);
                met += usize::from(verdict == Verdict::Met);
            }
            rays += views.len();
        }
        let mut comparison = Comparison::of_property(rays);
        comparison.undecided = open;
        let note = format!("{met} of {rays} rays met the surface, {open} lie within rounding of the limit");
        Ok(Outcome {
            reason: Some(note),
            ..Outcome::of(rays, comparison, 1.0)
        })
    }
}
