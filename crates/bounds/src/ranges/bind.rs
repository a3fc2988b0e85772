//! Inputs as the evaluator takes them: at a point, or as ranges.

use super::layout::Target;
use super::{Inputs, Point, TextureInput, Values};
use crate::bindings::{Bindings, BufferData, Scalar};
use crate::domain::{Domain, Truth};
use crate::error::Result;
use crate::kind::Kind;
use crate::stage::{Slot, StageInputs};
use crate::texture::{AddressMode, CompareFunction, Sampler, Texture};
use std::collections::BTreeMap;

/// What a buffer that the shader only writes holds before: a number that every format has and few formulas return, so that what was
/// never written can be told.
pub const UNWRITTEN: f64 = 23136.0;

impl Inputs {
    /// Bindings and stage inputs at points: buffers, textures and samplers of the first, one invocation of a vertex or fragment
    /// shader for each.
    ///
    /// # Errors
    /// [`crate::Error::Texture`] for sizes that no texture has.
    pub fn at<D: Domain>(&self, points: &[&Point]) -> Result<(Bindings<D>, StageInputs<D>)> {
        let chosen = |point: &Point, k: usize| exact::<D>(self.scalars[k].kind, point.values[k]);
        let mut bindings = Bindings::new();
        let Some(first) = points.first() else {
            return Ok((bindings, StageInputs::new(0)));
        };
        for buffer in &self.buffers {
            let values = buffer
                .kinds
                .iter()
                .enumerate()
                .map(|(n, &kind)| match buffer.first {
                    Some(start) => chosen(first, start + n),
                    None => exact::<D>(kind, UNWRITTEN),
                });
            bindings
                .buffers
                .insert(buffer.binding, BufferData::Scalars(values.collect()));
        }
        self.bind_handles(first, &mut bindings)?;
        let mut columns: BTreeMap<Slot, usize> = BTreeMap::new();
        for scalar in &self.scalars {
            if let Target::Stage { slot, component } = scalar.target {
                let n = columns.entry(slot).or_default();
                *n = (*n).max(component + 1);
            }
        }
        let mut inputs = StageInputs::new(points.len());
        for (slot, components) in columns {
            let values = points
                .iter()
                .flat_map(|point| self.of_slot(slot).map(|k| chosen(point, k)));
            inputs = inputs.set(slot, components, values.collect());
        }
        Ok((bindings, inputs))
    }

    /// The scalars of a stage input, in order.
    fn of_slot(&self, wanted: Slot) -> impl Iterator<Item = usize> {
        let scalars = self.scalars.iter().enumerate();
        scalars.filter_map(move |(k, scalar)| match scalar.target {
            Target::Stage { slot, .. } if slot == wanted => Some(k),
            Target::Stage { .. } | Target::Buffer { .. } => None,
        })
    }

    fn bind_handles<D: Domain>(&self, point: &Point, bindings: &mut Bindings<D>) -> Result<()> {
        for (texture, texels) in self.textures.iter().zip(&point.texels) {
            let one = texture.filled(texels)?;
            bindings
                .textures
                .insert(texture.binding, vec![one; texture.count as usize]);
        }
        for sampler in &self.samplers {
            let plain = Sampler::linear(AddressMode::Repeat);
            let one = if sampler.comparison {
                plain.comparing(CompareFunction::LessEqual)
            } else {
                plain
            };
            bindings
                .samplers
                .insert(sampler.binding, vec![one; sampler.count as usize]);
        }
        Ok(())
    }

    /// The bounds of every scalar.
    pub fn bounds(&self) -> Vec<(f64, f64)> {
        let mut out = Vec::with_capacity(self.scalars.len());
        for group in &self.groups {
            let n = group.scalars.len();
            match &group.values {
                Values::Between(bounds) => out.extend(bounds),
                Values::Unit => out.extend(std::iter::repeat_n((-1.0, 1.0), n)),
                Values::OneOf(list) => {
                    let lo = list.iter().copied().fold(f64::INFINITY, f64::min);
                    let hi = list.iter().copied().fold(f64::NEG_INFINITY, f64::max);
                    out.extend(std::iter::repeat_n((lo, hi), n));
                }
            }
        }
        out
    }

    /// Whether the shader reads what a buffer holds before it runs; otherwise that is [`UNWRITTEN`].
    pub fn is_read(&self, binding: (u32, u32)) -> bool {
        self.buffers
            .iter()
            .any(|buffer| buffer.binding == binding && buffer.first.is_some())
    }

    /// How many elements the run-time sized array of a buffer has; zero where it has none.
    pub fn elements(&self, binding: (u32, u32)) -> u32 {
        let buffer = self.buffers.iter().find(|buffer| buffer.binding == binding);
        buffer.map_or(0, |buffer| buffer.elements)
    }

    /// Elements of the longest run-time sized array; zero where there is none.
    pub fn longest_array(&self) -> u32 {
        self.buffers
            .iter()
            .map(|buffer| buffer.elements)
            .max()
            .unwrap_or(0)
    }

    /// The scalars of a buffer at a point, in the order of its type and without padding; `None` where the shader reads nothing
    /// of it.
    pub fn buffer_scalars(&self, point: &Point, binding: (u32, u32)) -> Option<Vec<(Kind, f64)>> {
        let buffer = self.buffers.iter().find(|buffer| buffer.binding == binding)?;
        let first = buffer.first?;
        let kinds = buffer.kinds.iter().enumerate();
        Some(kinds.map(|(n, &kind)| (kind, point.values[first + n])).collect())
    }
}

/// An exactly known scalar.
fn exact<D: Domain>(kind: Kind, x: f64) -> Scalar<D> {
    match kind {
        Kind::Float(w) => Scalar::Float(D::to_float(D::float(w, x))),
        Kind::Int(t) => {
            let n = (x.round() as i128).clamp(t.min(), t.max());
            Scalar::Int(n, n)
        }
        Kind::Bool => Scalar::Bool(Truth::from_bool(x >= 0.5)),
    }
}

impl TextureInput {
    /// Texels of the whole texture, samples counted apart.
    pub fn texel_count(&self) -> usize {
        self.size.iter().map(|&n| n as usize).product::<usize>()
            * self.layers as usize
            * self.samples as usize
    }

    /// Its texels as bytes in its format, from four channels each.
    pub fn bytes(&self, texels: &[f64]) -> Vec<u8> {
        let mut bytes: Vec<u8> = texels
            .as_chunks::<4>()
            .0
            .iter()
            .flat_map(|texel| self.format.encode(*texel))
            .collect();
        bytes.resize(self.texel_count() * self.format.bytes(), 0);
        bytes
    }

    /// The texture with the given channels, four for each texel.
    fn filled(&self, texels: &[f64]) -> Result<Texture> {
        let bytes = self.bytes(texels);
        let layers = if self.samples > 1 {
            self.samples
        } else {
            self.layers
        };
        let texture = Texture::new(self.dimension, self.format, self.size, layers, bytes)?;
        if self.samples > 1 {
            return texture.multisampled(self.samples);
        }
        Ok(texture)
    }
}
