//! Bake cases: a normal map made by a compute kernel against its twin on the CPU, byte for byte, and both against the f64
//! reference.
//!
//! A byte is a step function of the normal. Where the bound of what is truncated holds no whole number, exactly one byte is
//! allowed and the twins are equal. Where it does, the two neighbours are allowed, and twins that differ there are counted: the
//! rules leave the direction of rounding open.

use bossage_assets::height_to_normal::{self, Bake};
use bossage_assets::{EdgeMode, Error, HeightField, NormalCodec, NormalMap, height_to_normal_forward};
use bossage_reference as reference;
use bossage_runner::{BufferData, ComputeJob, Resources, TextureData};
use bossage_shaders::{Form, Kernel, Technique};
use glam::{DVec2, DVec3};
use rand::RngExt;

use crate::bench::Bench;
use crate::bounded::Bounded;
use crate::case::{Case, Outcome, with_causes};
use crate::case_id::CaseId;
use crate::compare::{Comparison, Expected};
use crate::generate::random::stream;
use crate::module::Module;
use crate::tolerance;

/// Elevation of h = 1 in UV units along u and v, for all fields here.
const HEIGHT_SCALE: [f32; 2] = [0.08, 0.05];
/// Texels of elevation a byte step, for the published bake.
const PUBLISHED_SCALE: f32 = 0.05;

/// One kernel on one field.
struct BakeCase {
    id: CaseId,
    kernel: Kernel,
    field: HeightField,
    edge: EdgeMode,
    codec: NormalCodec,
}

/// The fields by name: rough and smooth, with sides that are no multiples of a workgroup, and the smallest there are.
fn fields() -> Vec<(&'static str, HeightField)> {
    let mut rng = stream("bake", 1);
    let noise: Vec<f32> = (0..61 * 37)
        .map(|_| rng.random_range(0..=255u32) as f32 / 255.0)
        .collect();
    let waves = |x: u32, y: u32| {
        let phase = |i: u32, n: f32| std::f32::consts::TAU * i as f32 / n;
        0.5 + 0.25 * phase(x, 64.0).sin() + 0.25 * phase(y, 24.0).cos()
    };
    vec![
        (
            "noise",
            HeightField::from_fn(61, 37, |x, y| noise[(y * 61 + x) as usize]),
        ),
        ("waves", HeightField::from_fn(128, 96, waves)),
        ("flat", HeightField::from_fn(9, 9, |_, _| 0.25)),
        ("one", HeightField::from_fn(1, 1, |_, _| 1.0)),
        ("thin", HeightField::from_fn(2, 3, |x, y| (x + y) as f32 / 4.0)),
    ]
}

/// Every kernel on every field with every edge mode and codec that it has.
pub fn cases() -> impl Iterator<Item = Box<dyn Case>> {
    let mut cases: Vec<Box<dyn Case>> = Vec::new();
    for (name, field) in fields() {
        for kernel in [
            Kernel::HeightToNormal,
            Kernel::HeightToNormalForward,
            Kernel::HeightToNormalForwardPublished,
        ] {
            for (edge, codec) in variants(kernel) {
                cases.push(Box::new(BakeCase::new(name, kernel, field.clone(), edge, codec)));
            }
        }
    }
    cases.into_iter()
}

fn variants(kernel: Kernel) -> Vec<(EdgeMode, NormalCodec)> {
    if kernel == Kernel::HeightToNormalForwardPublished {
        return vec![(EdgeMode::Clamp, NormalCodec::Biased)];
    }
    let edges = [EdgeMode::Wrap, EdgeMode::Mirror, EdgeMode::Clamp];
    edges
        .into_iter()
        .flat_map(|edge| [NormalCodec::Unorm, NormalCodec::Biased].map(|codec| (edge, codec)))
        .collect()
}

impl BakeCase {
    fn new(name: &str, kernel: Kernel, field: HeightField, edge: EdgeMode, codec: NormalCodec) -> Self {
        let (technique, form) = match kernel {
            Kernel::HeightToNormalForward => ("height_to_normal_forward", Form::Hardened),
            Kernel::HeightToNormalForwardPublished => ("height_to_normal_forward", Form::Published),
            _ => ("height_to_normal", Form::Hardened),
        };
        let both = Technique::find(technique).is_some_and(|technique| technique.forms.len() > 1);
        let mut id = CaseId::new(technique, both.then(|| form.as_str()), "bake").with("field", name);
        if kernel != Kernel::HeightToNormalForwardPublished {
            let codec = match codec {
                NormalCodec::Unorm => "unorm",
                NormalCodec::Biased => "biased",
            };
            id = id.with("edge", edge.name()).with("codec", codec);
        }
        Self {
            id,
            kernel,
            field,
            edge,
            codec,
        }
    }

    /// The settings of the hardened bakes.
    fn bake(&self) -> Result<Bake, Error> {
        match self.kernel {
            Kernel::HeightToNormalForward => Bake::forward(&self.field, HEIGHT_SCALE, self.edge, self.codec),
            _ => Bake::central(&self.field, HEIGHT_SCALE, self.edge, self.codec),
        }
    }

    fn twin(&self) -> Result<NormalMap, Error> {
        match self.kernel {
            Kernel::HeightToNormalForwardPublished => {
                Ok(height_to_normal_forward::bake(&self.field, PUBLISHED_SCALE))
            }
            _ => Ok(height_to_normal::bake(&self.field, &self.bake()?)),
        }
    }

    fn uniforms(&self) -> Result<[(String, Vec<f32>); 4], Error> {
        let bake = self.bake()?;
        let edge = [EdgeMode::Wrap, EdgeMode::Mirror, EdgeMode::Clamp]
            .iter()
            .position(|edge| *edge == self.edge);
        Ok([
            ("bake.slope".to_owned(), bake.slope.to_vec()),
            (
                "bake.byte_scale_offset".to_owned(),
                bake.byte_scale_offset().to_vec(),
            ),
            ("bake.edge_mode".to_owned(), vec![edge.unwrap_or(0) as f32]),
            ("bake.height_scale".to_owned(), vec![PUBLISHED_SCALE]),
        ])
    }

    fn texels(&self, bench: &Bench<'_>) -> Result<Vec<[u8; 4]>, String> {
        let kernel = self.kernel;
        let module = bench.module(&Module::Kernel(kernel))?;
        let texture = TextureData::r32f(self.field.width, self.field.height, &self.field.texels);
        let mut resources = Resources::default();
        resources
            .uniforms
            .extend(self.uniforms().map_err(|error| with_causes(&error))?);
        resources.textures.insert("height_map".to_owned(), &texture);
        resources.buffers.insert(
            "texels".to_owned(),
            BufferData::Output(4 * self.field.texels.len()),
        );
        let [x, y, _] = kernel.workgroup_size();
        let workgroups = [self.field.width.div_ceil(x), self.field.height.div_ceil(y), 1];
        let name = self.id.to_string();
        let job = ComputeJob {
            name: &name,
            shader: module.shader(kernel.entry())?,
            resources,
            workgroups,
        };
        let output = job.run(bench.device).map_err(|error| with_causes(&error))?;
        Ok(output.words("texels").into_iter().map(u32::to_le_bytes).collect())
    }

    /// What the bytes of a texel should be.
    fn expected(&self, x: u32, y: u32) -> Result<[Expected; 4], Error> {
        if self.kernel == Kernel::HeightToNormalForwardPublished {
            return Ok(self.expected_published(x, y));
        }
        let bake = self.bake()?;
        let h = |dx: i64, dy: i64| {
            let (i, j) = (i64::from(x) + dx, i64::from(y) + dy);
            self.field.texel(
                self.edge.resolve(i, self.field.width),
                self.edge.resolve(j, self.field.height),
            )
        };
        let slope = DVec2::new(f64::from(bake.slope[0]), f64::from(bake.slope[1]));
        let (truth, function, heights) = match self.kernel {
            Kernel::HeightToNormalForward => (
                reference::height_to_normal_forward::hardened(&self.field, self.edge, x, y, slope),
                "height_to_normal_forward",
                vec![h(0, 0), h(1, 0), h(0, 1)],
            ),
            _ => (
                reference::height_to_normal::central(&self.field, self.edge, x, y, slope),
                "height_to_normal",
                vec![h(-1, 0), h(1, 0), h(0, -1), h(0, 1)],
            ),
        };
        let arguments = [heights.as_slice(), &bake.slope].concat();
        Ok(self.bytes(truth, function, &arguments, bake.byte_scale_offset(), h(0, 0)))
    }

    fn expected_published(&self, x: u32, y: u32) -> [Expected; 4] {
        let (field, scale) = (&self.field, f64::from(PUBLISHED_SCALE));
        let truth = reference::height_to_normal_forward::published(field, x, y, scale);
        let inner = x > 0 && y > 0 && x + 1 < field.width && y + 1 < field.height;
        let byte = |x, y| (f64::from(field.texel(x, y)) * 255.0).round() as f32;
        let here = byte(x, y);
        // The flat border is the normal of three equal heights.
        let (row, column) = if inner {
            (byte(x, y + 1), byte(x + 1, y))
        } else {
            (here, here)
        };
        let arguments = [here, row, column, PUBLISHED_SCALE];
        self.bytes(
            truth,
            "height_to_normal_forward_published",
            &arguments,
            [127.0, 128.0],
            field.texel(x, y),
        )
    }

    /// Bytes of the normal by trunc(n·k + o), and of the height.
    fn bytes(
        &self,
        truth: DVec3,
        function: &str,
        arguments: &[f32],
        [k, o]: [f32; 2],
        height: f32,
    ) -> [Expected; 4] {
        let arguments: Vec<Bounded> = arguments.iter().copied().map(Bounded::input).collect();
        let bounds =
            tolerance::find(function).map(|row| (row.bound)(&mut crate::oracle::Args::new(&arguments)));
        let bounds = bounds.unwrap_or_default();
        let byte = |n: f64, bound: Bounded, [k, o]: [f32; 2]| {
            let coded = bound * Bounded::exact(k) + Bounded::exact(o);
            Expected {
                truth: (n * f64::from(k) + f64::from(o)).trunc(),
                bound: coded.trunc().into(),
            }
        };
        let of = |i: usize| byte(truth[i], bounds.get(i).copied().unwrap_or(Bounded::OPEN), [k, o]);
        let alpha = byte(f64::from(height), Bounded::input(height), [255.0, 0.5]);
        [of(0), of(1), of(2), alpha]
    }

    fn judge(&self, bench: &Bench<'_>) -> Result<Outcome, String> {
        let (kernel, twin) = (
            self.texels(bench)?,
            self.twin().map_err(|error| with_causes(&error))?,
        );
        if kernel.len() != twin.texels.len() {
            return Err(format!(
                "the kernel wrote {} texels of {}",
                kernel.len(),
                twin.texels.len()
            ));
        }
        let (mut comparison, mut different) = (Comparison::default(), 0);
        for (index, (got, twin)) in kernel.iter().zip(&twin.texels).enumerate() {
            let (x, y) = (index as u32 % self.field.width, index as u32 / self.field.width);
            let expected = self.expected(x, y).map_err(|error| with_causes(&error))?;
            let place = [x as f32, y as f32];
            comparison.item(&place, &got.map(f32::from), &expected);
            comparison.item(&place, &twin.map(f32::from), &expected);
            different += got.iter().zip(twin).filter(|(a, b)| a != b).count();
        }
        // The published codec truncates 127·1 + 128 = 255, so each flat texel lies on a boundary: its border alone is undecided.
        let published = self.kernel == Kernel::HeightToNormalForwardPublished;
        let limit = if published {
            1.0
        } else {
            tolerance::UNDECIDED_LIMIT
        };
        let outcome = Outcome::of(kernel.len(), comparison, limit);
        let note = format!(
            "{different} of {} bytes differ from the twin, each next to a rounding boundary",
            4 * kernel.len()
        );
        let reason = outcome.reason.clone().or((different > 0).then_some(note));
        Ok(Outcome { reason, ..outcome })
    }
}

impl Case for BakeCase {
    fn id(&self) -> &CaseId {
        &self.id
    }

    fn basis(&self) -> Vec<&'static str> {
        vec!["twin on the CPU", "reference f64", "accuracy rules at the input"]
    }

    fn modules(&self) -> Result<Vec<Module>, String> {
        Ok(vec![Module::Kernel(self.kernel)])
    }

    fn run(&self, bench: &Bench<'_>) -> Outcome {
        self.judge(bench).unwrap_or_else(Outcome::failed)
    }
}
