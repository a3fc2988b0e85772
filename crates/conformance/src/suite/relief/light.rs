//! Light on the relief, from the places that views meet: `self_shadow` and `soft_shadow` against the same march in f64.
//!
//! The records are those of the true first hits, rounded to f32; lights stand at all heights over the horizon and below it. The
//! share that is seen must lie in the acceptance interval of the kernel's own IR, and so must the reference's. Whether a sample
//! stands over the ray by more than the bias is a comparison: as many answers may be undecided as the reference gives another way
//! when heights are off by what they may be.

use std::collections::BTreeMap;

use bossage_assets::HeightField;
use bossage_reference::relief_grazing::steepest;
use bossage_reference::relief_ray::{HitRecord, Layer, Ray, Status};
use bossage_reference::relief_truth::{height_at, trace};
use bossage_reference::{self_shadow, soft_shadow};
use bossage_runner::{BufferData, Resources, TextureData};
use bossage_shaders::{Kernel, LightTechnique, ReliefLight};
use glam::{DVec2, DVec3};
use rand::RngExt;

use super::maps;
use super::setting::{self, Setting};
use super::truth::height_allowance;
use super::views::{View, views};
use crate::bench::Bench;
use crate::case::{Case, Outcome};
use crate::case_id::CaseId;
use crate::compare::{Comparison, Expected};
use crate::dispatch::{Dispatch, Filtering, Kept, float_bounds};
use crate::generate::random::stream;
use crate::module::Module;
use crate::oracle;
use crate::route::Prepared;
use crate::suite::kernel_case::KernelCase;
use crate::tolerance::UNDECIDED_LIMIT;

/// Views of any azimuth at each angle, for each light.
const VIEWS: usize = 2;

/// Records that lie off the surface, for each light.
const STRAYS: usize = 6;

/// What the kernel writes.
const SEEN: &str = "seen";

/// One light.
#[derive(Clone, Copy, Debug)]
struct Light {
    dir_ts: [f32; 3],
    half_width: f32,
    samples: u32,
}

/// From above, aslant, grazing, at the horizon and below; more samples and fewer, one, none. Of two samples the second lies at the
/// layer's top, where nothing stands over it, so that the first decides alone.
const LIGHTS: [Light; 7] = [
    Light {
        dir_ts: [0.0, 0.0, 1.0],
        half_width: 0.25,
        samples: 8,
    },
    Light {
        dir_ts: [0.6, 0.0, 0.8],
        half_width: 0.25,
        samples: 16,
    },
    Light {
        dir_ts: [-0.48, 0.64, 0.6],
        half_width: 0.125,
        samples: 11,
    },
    Light {
        dir_ts: [0.0, -0.995, 0.0998],
        half_width: 1.0,
        samples: 24,
    },
    Light {
        dir_ts: [0.8, 0.6, 0.01],
        half_width: 0.5,
        samples: 1,
    },
    Light {
        dir_ts: [0.6, 0.0, -0.8],
        half_width: 0.5,
        samples: 0,
    },
    Light {
        dir_ts: [-0.768, 0.576, 0.28],
        half_width: 0.5,
        samples: 2,
    },
];

/// One technique on one map.
pub(super) struct LightCase {
    id: CaseId,
    light: ReliefLight,
    field: HeightField,
    /// Of the adapters' own filter, and of the evaluator's.
    expected: [Kept<Vec<Part>>; 2],
}

/// One light's records, and what is expected of each.
struct Part {
    setting: Setting,
    light: Light,
    hits: Vec<[u32; 4]>,
    expected: Vec<Expected>,
    touchy: usize,
}

/// Both techniques and ways to read heights, on every map.
pub(super) fn cases() -> impl Iterator<Item = Box<dyn Case>> {
    let on_maps = |light| {
        maps::all()
            .into_iter()
            .map(move |(name, field)| Box::new(LightCase::new(light, name, field)) as Box<dyn Case>)
    };
    ReliefLight::all().flat_map(on_maps)
}

impl LightCase {
    pub(super) fn new(light: ReliefLight, map: &str, field: HeightField) -> Self {
        let id = CaseId::new(
            light.technique.id(),
            crate::suite::probe::form_of(light.technique.id()),
            "light",
        )
        .with("heights", light.heights.id())
        .with("map", map);
        Self {
            id,
            light,
            field,
            expected: Default::default(),
        }
    }

    /// Both oracles of every record.
    fn parts(
        &self,
        module: &Prepared,
        texture: &TextureData,
        filtering: Filtering,
    ) -> Result<Vec<Part>, String> {
        let name = self.id.to_string();
        let mut rng = stream(&name, 1);
        let settings = setting::SETTINGS;
        let mut parts = Vec::new();
        for (index, light) in LIGHTS.into_iter().enumerate() {
            let setting = settings[index % settings.len()];
            let mut part = Part {
                setting,
                light,
                hits: views(VIEWS, &mut rng)
                    .iter()
                    .map(|view| self.record(&setting, view))
                    .collect(),
                expected: Vec::new(),
                touchy: 0,
            };
            // A record of nothing is lit; where a search stopped over the surface or under it, the surface is what counts.
            part.hits.push(packed([0.25, 0.5], 0.0, Status::NonFinite));
            let stray = |_| packed([rng.random(), rng.random()], rng.random(), Status::CapReached);
            part.hits.extend((0..STRAYS).map(stray));
            let dispatch = self.dispatch(&name, &part, texture);
            let mut left = dispatch.accepted_by(module, &BTreeMap::new(), filtering)?;
            let bounds = float_bounds(&left.remove(SEEN).ok_or("the kernel leaves no answers")?);
            let is_touchy = |hit: &&[u32; 4]| {
                let allowance = self.allowance(&part, hit, filtering);
                match self.light.technique {
                    LightTechnique::SelfShadow => {
                        let lift = self.lift(&part, hit, allowance);
                        self.seen(&part, hit, lift) != self.seen(&part, hit, -lift)
                    }
                    // The share is continuous but for the layer's top.
                    LightTechnique::SoftShadow => {
                        let depth = 1.0 - self.height(&part, hit);
                        (depth - self_shadow::BIAS_HEIGHT).abs() <= allowance
                    }
                }
            };
            part.touchy = part.hits.iter().filter(is_touchy).count();
            let of = |(hit, bound): (&[u32; 4], &crate::bound::Bound)| Expected {
                truth: self.seen(&part, hit, 0.0),
                bound: *bound,
            };
            part.expected = part.hits.iter().zip(&bounds).map(of).collect();
            parts.push(part);
        }
        Ok(parts)
    }

    /// The true first hit of a view, as a machine has it.
    fn record(&self, setting: &Setting, view: &View) -> [u32; 4] {
        let [u, v] = view.uv.map(f64::from);
        let direction = DVec3::from_array(view.dir_ts.map(f64::from));
        let hit = trace(
            &self.field,
            setting.edge,
            DVec2::new(u, v),
            direction,
            &setting.layer(),
        );
        packed(hit.uv.as_vec2().to_array(), hit.t as f32, hit.status)
    }

    /// The height of the surface at a record's uv.
    fn height(&self, part: &Part, hit: &[u32; 4]) -> f64 {
        height_at(&self.field, part.setting.edge, place(hit).uv)
    }

    /// The share that is seen, where heights on the way are lifted by `lift` and that of the place is lowered by as much.
    fn seen(&self, part: &Part, hit: &[u32; 4], lift: f64) -> f64 {
        if hit[3] == Status::NonFinite.number() {
            return 1.0;
        }
        let record = self_shadow::on_surface(&place(hit), self.height(part, hit) - lift);
        let layer: Layer = part.setting.layer();
        let direction = DVec3::from_array(part.light.dir_ts.map(f64::from));
        let Some(ray) = self_shadow::light_ray(&record, direction, &layer) else {
            return 0.0;
        };
        let height = |uv| height_at(&self.field, part.setting.edge, uv) + lift;
        let samples = part.light.samples.max(1);
        match self.light.technique {
            LightTechnique::SelfShadow => {
                f64::from(u8::from(!self_shadow::march(&record, &ray, samples, height)))
            }
            LightTechnique::SoftShadow => {
                let horizon = soft_shadow::sampled_horizon(&record, &ray, samples, height);
                soft_shadow::seen(horizon, f64::from(part.light.half_width))
            }
        }
    }

    /// By what lift [`Self::seen`] goes as wrong as heights that are off by `allowance` may make it. The evaluator takes the three uses of
    /// the place's height for independent: the ray begins there, its steps are the rest of the layer, and with the steps their ends move
    /// along a surface so steep. With the sample's own height that is 3 + slope allowances, and a lift counts twice.
    fn lift(&self, part: &Part, hit: &[u32; 4], allowance: f64) -> f64 {
        let sides = DVec2::new(f64::from(self.field.width), f64::from(self.field.height));
        let steepest = steepest(&self.field, part.setting.edge);
        let slope = (self.ray(part, hit).delta * sides).abs().dot(steepest);
        allowance * (3.0 + slope) / 2.0
    }

    /// The ray toward the light; one that stays where it is where there is none.
    fn ray(&self, part: &Part, hit: &[u32; 4]) -> Ray {
        let record = place(hit);
        let direction = DVec3::from_array(part.light.dir_ts.map(f64::from));
        let still = Ray {
            uv_top: record.uv,
            delta: DVec2::ZERO,
        };
        self_shadow::light_ray(&record, direction, &part.setting.layer()).unwrap_or(still)
    }

    /// What heights may be off by where the light's ray reads them.
    fn allowance(&self, part: &Part, hit: &[u32; 4], filtering: Filtering) -> f64 {
        let ray = self.ray(part, hit);
        height_allowance(
            &self.field,
            part.setting.edge,
            &ray,
            filtering == Filtering::Ideal,
        )
    }

    fn dispatch<'a>(&self, name: &'a str, part: &'a Part, texture: &'a TextureData) -> Dispatch<'a> {
        let mut resources = Resources::default();
        let [scale, bias, v_factor] = [part.setting.scale, part.setting.bias, part.setting.v_factor];
        let uniforms = [
            ("light.dir_ts", part.light.dir_ts.to_vec()),
            ("light.half_width", vec![part.light.half_width]),
            ("light.scale", vec![scale]),
            ("light.bias", vec![bias]),
            ("light.v_factor", vec![v_factor]),
            ("light.level", vec![0.0]),
            ("light.samples", vec![part.light.samples as f32]),
            ("light.edge_mode", vec![part.setting.edge_number()]),
        ];
        resources
            .uniforms
            .extend(uniforms.map(|(name, values)| (name.to_owned(), values)));
        resources.textures.insert("height_map".to_owned(), texture);
        resources
            .samplers
            .insert("surface_sampler".to_owned(), part.setting.sampler());
        let hits = BufferData::Bytes(bytemuck::cast_slice(&part.hits));
        resources.buffers.insert("hits".to_owned(), hits);
        let outputs = BufferData::Output(4 * part.hits.len());
        resources.buffers.insert(SEEN.to_owned(), outputs);
        Dispatch {
            name,
            kernel: Kernel::ReliefLight(self.light),
            resources,
            // One more than there are records: nothing may come of it.
            invocations: [part.hits.len() as u32 + 1, 1, 1],
        }
    }
}

/// The record as a machine has it.
fn place(hit: &[u32; 4]) -> HitRecord {
    let [u, v, t, _] = hit.map(|word| f64::from(f32::from_bits(word)));
    HitRecord {
        uv: DVec2::new(u, v),
        t,
        status: Status::Hit,
    }
}

/// A record as the kernel takes it.
fn packed([u, v]: [f32; 2], t: f32, status: Status) -> [u32; 4] {
    [u.to_bits(), v.to_bits(), t.to_bits(), status.number()]
}

impl KernelCase for LightCase {
    fn id(&self) -> &CaseId {
        &self.id
    }

    fn basis(&self) -> Vec<&'static str> {
        oracle::BASIS.to_vec()
    }

    fn kernels(&self) -> Vec<Kernel> {
        vec![Kernel::ReliefLight(self.light)]
    }

    fn judge(&self, bench: &Bench<'_>) -> Result<Outcome, String> {
        let module = bench.module(&Module::Kernel(Kernel::ReliefLight(self.light)))?;
        let texture = setting::texture(&self.field);
        let filtering = setting::filtering(bench.route, self.light.heights);
        let parts = self.expected[usize::from(filtering == Filtering::Ideal)]
            .for_text(module.text(), || self.parts(&module, &texture, filtering))?;
        let name = self.id.to_string();
        let (mut comparison, mut records, mut touchy) = (Comparison::default(), 0, 0);
        for part in parts.iter() {
            let seen = self.dispatch(&name, part, &texture).run(bench)?.floats(SEEN);
            if seen.len() != part.hits.len() {
                return Err(format!("{} answers of {}", seen.len(), part.hits.len()));
            }
            for ((hit, got), expected) in part.hits.iter().zip(&seen).zip(&part.expected) {
                let [u, v, t, _] = hit.map(f32::from_bits);
                let [x, y, z] = part.light.dir_ts;
                let samples = part.light.samples as f32;
                comparison.item(&[u, v, t, x, y, z, samples], &[*got], &[*expected]);
            }
            records += part.hits.len();
            touchy += part.touchy;
        }
        let limit = UNDECIDED_LIMIT + touchy as f64 / records as f64;
        Ok(Outcome::of(records, comparison, limit))
    }
}
