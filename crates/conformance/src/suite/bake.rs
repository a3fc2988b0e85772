//! Bake cases: a normal map made by a compute kernel against its twin on the CPU, byte for byte, and both against the f64
//! reference.
//!
//! What is allowed comes from the kernel's own IR over acceptance intervals (`dispatch.rs`). A byte is a step function of the
//! normal: where the interval of what is truncated holds no whole number, exactly one byte is allowed and the twins are equal.
//! Where it does, the neighbours are allowed, and twins that differ there are counted: the rules leave the direction of rounding
//! open.

use std::collections::BTreeMap;

use bossage_assets::height_to_normal::{self, Bake};
use bossage_assets::{EdgeMode, Error, HeightField, NormalCodec, NormalMap, height_to_normal_forward};
use bossage_reference as reference;
use bossage_runner::{BufferData, Resources, TextureData};
use bossage_shaders::{Form, Kernel, Technique};
use glam::{DVec2, DVec3};
use rand::RngExt;

use super::kernel_case::{KernelCase, twin_and_rules};
use crate::bench::Bench;
use crate::case::{Case, Outcome, with_causes};
use crate::case_id::CaseId;
use crate::compare::{Comparison, Expected};
use crate::dispatch::{Dispatch, Kept, byte_bounds};
use crate::generate::random::stream;
use crate::module::Module;
use crate::route::Prepared;
use crate::tolerance::UNDECIDED_LIMIT;

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
    expected: Kept<Vec<[Expected; 4]>>,
}

/// The fields by name: rough and smooth, with sides that are no multiples of a workgroup, and the smallest there are.
pub(crate) fn fields() -> Vec<(&'static str, HeightField)> {
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
            expected: Kept::default(),
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

    fn dispatch<'a>(&'a self, name: &'a str, texture: &'a TextureData) -> Result<Dispatch<'a>, String> {
        let mut resources = Resources::default();
        resources
            .uniforms
            .extend(self.uniforms().map_err(|error| with_causes(&error))?);
        resources.textures.insert("height_map".to_owned(), texture);
        let bytes = 4 * self.field.texels.len();
        resources
            .buffers
            .insert("texels".to_owned(), BufferData::Output(bytes));
        Ok(Dispatch {
            name,
            kernel: self.kernel,
            resources,
            invocations: [self.field.width, self.field.height, 1],
        })
    }

    /// What the bytes of each texel should be.
    fn expectations(&self, dispatch: &Dispatch<'_>, module: &Prepared) -> Result<Vec<[Expected; 4]>, String> {
        let mut left = dispatch.accepted(module, &BTreeMap::new())?;
        let words = left.remove("texels").ok_or("the kernel writes no texels")?;
        let texel = |(index, word): (usize, _)| {
            let (x, y) = (index as u32 % self.field.width, index as u32 / self.field.width);
            let truth = self.truth(x, y).map_err(|error| with_causes(&error))?;
            let bounds = byte_bounds(word);
            Ok(std::array::from_fn(|i| Expected {
                truth: truth[i],
                bound: bounds[i],
            }))
        };
        words.iter().enumerate().map(texel).collect()
    }

    /// The bytes of a texel: those of its normal, and its height.
    fn truth(&self, x: u32, y: u32) -> Result<[f64; 4], Error> {
        let bake = self.bake()?;
        let (field, edge) = (&self.field, self.edge);
        let slope = DVec2::new(f64::from(bake.slope[0]), f64::from(bake.slope[1]));
        let (normal, [k, o]) = match self.kernel {
            Kernel::HeightToNormalForwardPublished => {
                let scale = f64::from(PUBLISHED_SCALE);
                let normal = reference::height_to_normal_forward::published(field, x, y, scale);
                (normal, [127.0, 128.0])
            }
            Kernel::HeightToNormalForward => (
                reference::height_to_normal_forward::hardened(field, edge, x, y, slope),
                bake.byte_scale_offset(),
            ),
            _ => (
                reference::height_to_normal::central(field, edge, x, y, slope),
                bake.byte_scale_offset(),
            ),
        };
        let bytes = (normal * f64::from(k) + DVec3::splat(f64::from(o))).trunc();
        let alpha = (f64::from(field.texel(x, y)) * 255.0 + 0.5).trunc();
        Ok([bytes.x, bytes.y, bytes.z, alpha])
    }
}

impl KernelCase for BakeCase {
    fn id(&self) -> &CaseId {
        &self.id
    }

    fn basis(&self) -> Vec<&'static str> {
        twin_and_rules()
    }

    fn kernels(&self) -> Vec<Kernel> {
        vec![self.kernel]
    }

    fn judge(&self, bench: &Bench<'_>) -> Result<Outcome, String> {
        let module = bench.module(&Module::Kernel(self.kernel))?;
        let texture = TextureData::r32f(self.field.width, self.field.height, &self.field.texels);
        let name = self.id.to_string();
        let dispatch = self.dispatch(&name, &texture)?;
        let expected = self
            .expected
            .for_text(module.text(), || self.expectations(&dispatch, &module))?;
        let kernel = dispatch.run(bench)?.words("texels");
        let twin = self.twin().map_err(|error| with_causes(&error))?;
        if kernel.len() != twin.texels.len() {
            return Err(format!(
                "the kernel wrote {} texels of {}",
                kernel.len(),
                twin.texels.len()
            ));
        }
        let (mut comparison, mut different) = (Comparison::default(), 0);
        for (index, ((got, twin), expected)) in kernel.iter().zip(&twin.texels).zip(&*expected).enumerate() {
            let got = got.to_le_bytes();
            let place = [index as u32 % self.field.width, index as u32 / self.field.width].map(|i| i as f32);
            comparison.item(&place, &got.map(f32::from), expected);
            comparison.item(&place, &twin.map(f32::from), expected);
            different += got.iter().zip(twin).filter(|(a, b)| a != b).count();
        }
        // The published codec truncates 127·1 + 128 = 255, so each flat texel lies on a boundary: its border alone is undecided.
        let published = self.kernel == Kernel::HeightToNormalForwardPublished;
        let limit = if published { 1.0 } else { UNDECIDED_LIMIT };
        let outcome = Outcome::of(kernel.len(), comparison, limit);
        let note = format!(
            "{different} of {} bytes differ from the twin, each next to a rounding boundary",
            4 * kernel.len()
        );
        let reason = outcome.reason.clone().or((different > 0).then_some(note));
        Ok(Outcome { reason, ..outcome })
    }
}
