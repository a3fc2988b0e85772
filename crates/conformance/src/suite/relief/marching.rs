//! Techniques that march, step or shift, against the same search in f64.
//!
//! Every map with every technique and both ways to read heights, in four settings. uv, t and status of each ray must lie in the
//! acceptance interval of the kernel's own IR, and so must the reference's. Where a comparison lies within what a height may be
//! off, both ways are accepted and the ray counts as undecided; that many rays may be undecided as the reference finds touchy:
//! those that heights off by the same allowance lead another way.

use std::collections::BTreeMap;

use bossage_assets::HeightField;
use bossage_bounds::{Accept, Scalar};
use bossage_runner::TextureData;
use bossage_shaders::{Kernel, ReliefSearch, ReliefTechnique};
use rayon::prelude::*;

use super::beside::Beside;
use super::hits::Rig;
use super::maps;
use super::setting::{self, HIT_FLOATS, HITS, Setting};
use super::truth::Search;
use super::views::{View, views};
use crate::bench::Bench;
use crate::bound::Bound;
use crate::case::{Case, Outcome};
use crate::case_id::CaseId;
use crate::compare::{Comparison, Expected};
use crate::dispatch::{Filtering, Kept};
use crate::generate::random::stream;
use crate::module::Module;
use crate::oracle;
use crate::route::Prepared;
use crate::suite::kernel_case::KernelCase;
use crate::suite::probe::form_of;
use crate::tolerance::UNDECIDED_LIMIT;

/// Views of any azimuth at each angle, in each setting.
const VIEWS: usize = 3;

/// One technique on one map.
pub(super) struct MarchCase {
    id: CaseId,
    search: ReliefSearch,
    field: HeightField,
    /// Of the adapters' own filter, and of the evaluator's.
    expected: [Kept<Vec<Part>>; 2],
}

/// One setting's rays, and what is expected of each.
struct Part {
    setting: Setting,
    beside: Option<Beside>,
    views: Vec<View>,
    expected: Vec<[Expected; HIT_FLOATS]>,
    touchy: usize,
}

/// Every technique but `exact`, and way to read heights, on every map.
pub(super) fn cases() -> impl Iterator<Item = Box<dyn Case>> {
    let on_maps = |search| {
        maps::all()
            .into_iter()
            .map(move |(name, field)| Box::new(MarchCase::new(search, name, field)) as Box<dyn Case>)
    };
    ReliefSearch::all()
        .filter(|search| search.technique != ReliefTechnique::Exact)
        .flat_map(on_maps)
}

impl MarchCase {
    pub(super) fn new(search: ReliefSearch, map: &str, field: HeightField) -> Self {
        let id = CaseId::new(search.technique.id(), form_of(search.technique.id()), "hits")
            .with("heights", search.heights.id())
            .with("map", map);
        Self {
            id,
            search,
            field,
            expected: Default::default(),
        }
    }

    /// Both oracles of every ray.
    fn parts(
        &self,
        module: &Prepared,
        texture: &TextureData,
        filtering: Filtering,
    ) -> Result<Vec<Part>, String> {
        let name = self.id.to_string();
        let mut rng = stream(&name, 1);
        let drawn = setting::of(self.search.technique).map(|setting| (setting, views(VIEWS, &mut rng)));
        let part = |(setting, views): (Setting, Vec<View>)| {
            let rays = setting::packed(&views);
            let beside = Beside::of(self.search.technique, &self.field, setting.edge);
            let dispatch = setting.dispatch(&name, self.search, texture, beside.as_ref(), &rays);
            let mut left = dispatch.accepted_by(module, &BTreeMap::new(), filtering)?;
            let hits = left.remove(HITS).ok_or("the kernel leaves no hits")?;
            let search = Search {
                technique: self.search.technique,
                field: &self.field,
                setting: &setting,
                beside: beside.as_ref(),
                lift: 0.0,
            };
            let touchy = views
                .iter()
                .filter(|view| search.is_touchy(view, search.allowance(view, filtering == Filtering::Ideal)))
                .count();
            let expected = expectations(&search, &views, &bounds(&hits));
            Ok(Part {
                setting,
                beside,
                views,
                expected,
                touchy,
            })
        };
        drawn.into_par_iter().map(part).collect()
    }
}

fn expectations(
    search: &Search<'_>,
    views: &[View],
    bounds: &[[Bound; HIT_FLOATS]],
) -> Vec<[Expected; HIT_FLOATS]> {
    let of = |(view, bounds): (&View, &[Bound; HIT_FLOATS])| {
        let hit = search.record(view);
        let truth = [hit.uv.x, hit.uv.y, hit.t, f64::from(hit.status.number())];
        std::array::from_fn(|output| Expected {
            truth: truth[output],
            bound: bounds[output],
        })
    };
    views.iter().zip(bounds).map(of).collect()
}

/// The bounds of each record: of a status those of its number.
fn bounds(hits: &[Scalar<Accept>]) -> Vec<[Bound; HIT_FLOATS]> {
    let of = |scalar: &Scalar<Accept>| match *scalar {
        Scalar::Float(interval) => Bound::from(interval),
        Scalar::Int(low, high) if low == high => Bound::exactly(low as f64),
        Scalar::Int(low, high) => Bound::between(low as f64, high as f64).forked(),
        Scalar::Bool(_) => Bound::OPEN,
    };
    hits.as_chunks::<HIT_FLOATS>()
        .0
        .iter()
        .map(|record| record.each_ref().map(of))
        .collect()
}

impl KernelCase for MarchCase {
    fn id(&self) -> &CaseId {
        &self.id
    }

    fn basis(&self) -> Vec<&'static str> {
        oracle::BASIS.to_vec()
    }

    fn kernels(&self) -> Vec<Kernel> {
        vec![Kernel::ReliefHits(self.search)]
    }

    fn judge(&self, bench: &Bench<'_>) -> Result<Outcome, String> {
        let module = bench.module(&Module::Kernel(Kernel::ReliefHits(self.search)))?;
        let texture = setting::texture(&self.field);
        let filtering = setting::filtering(bench.route, self.search.heights);
        let parts = self.expected[usize::from(filtering == Filtering::Ideal)]
            .for_text(module.text(), || self.parts(&module, &texture, filtering))?;
        let name = self.id.to_string();
        let (mut comparison, mut rays, mut touchy) = (Comparison::default(), 0, 0);
        for part in parts.iter() {
            let rig = Rig {
                name: &name,
                search: self.search,
                setting: &part.setting,
                texture: &texture,
                beside: part.beside.as_ref(),
            };
            let got = rig.hits(bench, &part.views)?;
            for ((view, got), expected) in part.views.iter().zip(&got).zip(&part.expected) {
                comparison.item(&part.setting.item(view), got, expected);
            }
            rig.not_finite(bench)?;
            rays += part.views.len();
            touchy += part.touchy;
        }
        let limit = UNDECIDED_LIMIT + touchy as f64 / rays as f64;
        Ok(Outcome::of(rays, comparison, limit))
    }
}
