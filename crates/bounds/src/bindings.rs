//! What a shader is bound to: buffers, textures, samplers.

use crate::domain::Domain;
use crate::interval::Interval;
use crate::kind::Kind;
use crate::texture::{Sampler, Texture};
use std::collections::BTreeMap;

/// The reserved key of immediate data ("push constants").
pub const IMMEDIATE: (u32, u32) = (u32::MAX, 0);

/// One scalar of a buffer, input or output, as callers see it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Scalar<D: Domain> {
    /// A float.
    Float(D::Float),
    /// An integer, as its bounds; equal in point domains.
    Int(i128, i128),
    /// A truth value.
    Bool(crate::Truth),
}

impl<D: Domain> Scalar<D> {
    pub(crate) fn from_cell(kind: Kind, cell: D::Cell) -> Self {
        match kind {
            Kind::Float(_) => Self::Float(D::to_float(cell)),
            Kind::Int(t) => {
                let (lo, hi) = D::int_bounds(t, cell);
                Self::Int(lo, hi)
            }
            Kind::Bool => Self::Bool(D::truth(cell)),
        }
    }

    /// The cell, if the scalar is of the kind.
    pub(crate) fn to_cell(self, kind: Kind) -> Option<D::Cell> {
        match (self, kind) {
            (Self::Float(x), Kind::Float(w)) => Some(D::from_float(w, x)),
            (Self::Int(lo, hi), Kind::Int(t)) => {
                (t.min() <= lo && lo <= hi && hi <= t.max()).then(|| D::int_range(t, lo, hi))
            }
            (Self::Bool(crate::Truth::Maybe), Kind::Bool) => Some(D::undecided(Kind::Bool)),
            (Self::Bool(b), Kind::Bool) => Some(D::bool(b == crate::Truth::True)),
            (Self::Float(_), Kind::Int(_) | Kind::Bool)
            | (Self::Int(..), Kind::Float(_) | Kind::Bool)
            | (Self::Bool(_), Kind::Float(_) | Kind::Int(_)) => None,
        }
    }

    /// The float, if it is one.
    pub fn float(&self) -> Option<D::Float> {
        match self {
            Self::Float(x) => Some(*x),
            Self::Int(..) | Self::Bool(_) => None,
        }
    }

    /// The integer, if it is one and known exactly.
    pub fn int(&self) -> Option<i128> {
        match self {
            Self::Int(lo, hi) if lo == hi => Some(*lo),
            Self::Int(..) | Self::Float(_) | Self::Bool(_) => None,
        }
    }
}

/// The contents of a buffer.
#[derive(Clone, Debug, PartialEq)]
pub enum BufferData<D: Domain> {
    /// Exact contents as a machine would see them.
    Bytes(Vec<u8>),
    /// Contents in the domain: one scalar for each scalar of the variable's type, in order, without padding. A run writes its
    /// results in this form.
    Scalars(Vec<Scalar<D>>),
}

/// Resources by bind group and binding number.
#[derive(Clone, Debug)]
pub struct Bindings<D: Domain> {
    /// Uniform and storage buffers.
    pub buffers: BTreeMap<(u32, u32), BufferData<D>>,
    /// Textures; a binding array has several, everything else one. Storage textures are read and written here.
    pub textures: BTreeMap<(u32, u32), Vec<Texture>>,
    /// Samplers; a binding array has several, everything else one.
    pub samplers: BTreeMap<(u32, u32), Vec<Sampler>>,
    /// What a run wrote to storage textures: four scalars a texel, rows from the top, layer by layer.
    pub written_textures: BTreeMap<(u32, u32), Vec<Scalar<D>>>,
}

impl<D: Domain> Default for Bindings<D> {
    fn default() -> Self {
        Self {
            buffers: BTreeMap::new(),
            textures: BTreeMap::new(),
            samplers: BTreeMap::new(),
            written_textures: BTreeMap::new(),
        }
    }
}

impl<D: Domain> Bindings<D> {
    /// No resources.
    pub fn new() -> Self {
        Self::default()
    }

    /// Binds a buffer of exact bytes.
    pub fn bytes(mut self, group: u32, binding: u32, bytes: impl Into<Vec<u8>>) -> Self {
        self.buffers
            .insert((group, binding), BufferData::Bytes(bytes.into()));
        self
    }

    /// Binds a buffer of exact `f32` values.
    pub fn floats(self, group: u32, binding: u32, values: &[f32]) -> Self {
        self.bytes(
            group,
            binding,
            values.iter().flat_map(|x| x.to_le_bytes()).collect::<Vec<_>>(),
        )
    }

    /// Binds a buffer of exact `u32` values.
    pub fn words(self, group: u32, binding: u32, values: &[u32]) -> Self {
        self.bytes(
            group,
            binding,
            values.iter().flat_map(|x| x.to_le_bytes()).collect::<Vec<_>>(),
        )
    }

    /// Binds a buffer of scalars of the domain.
    pub fn scalars(mut self, group: u32, binding: u32, values: Vec<Scalar<D>>) -> Self {
        self.buffers.insert((group, binding), BufferData::Scalars(values));
        self
    }

    /// Sets immediate data ("push constants").
    pub fn immediate(mut self, bytes: impl Into<Vec<u8>>) -> Self {
        self.buffers.insert(IMMEDIATE, BufferData::Bytes(bytes.into()));
        self
    }

    /// Binds a texture.
    pub fn texture(mut self, group: u32, binding: u32, texture: Texture) -> Self {
        self.textures.insert((group, binding), vec![texture]);
        self
    }

    /// Binds a sampler.
    pub fn sampler(mut self, group: u32, binding: u32, sampler: Sampler) -> Self {
        self.samplers.insert((group, binding), vec![sampler]);
        self
    }

    /// The floats of a buffer that a run has written; `None` when there is no such buffer or it holds other scalars.
    pub fn read_floats(&self, group: u32, binding: u32) -> Option<Vec<D::Float>> {
        match self.buffers.get(&(group, binding))? {
            BufferData::Scalars(list) => list.iter().map(Scalar::float).collect(),
            BufferData::Bytes(_) => None,
        }
    }

    /// The exactly known integers of a buffer that a run has written.
    pub fn read_ints(&self, group: u32, binding: u32) -> Option<Vec<i128>> {
        match self.buffers.get(&(group, binding))? {
            BufferData::Scalars(list) => list.iter().map(Scalar::int).collect(),
            BufferData::Bytes(_) => None,
        }
    }
}

/// The bytes of one scalar as a cell.
pub(crate) fn cell_from_bytes<D: Domain>(kind: Kind, bytes: &[u8]) -> D::Cell {
    let mut word = [0u8; 8];
    word[..bytes.len()].copy_from_slice(bytes);
    let bits = u64::from_le_bytes(word);
    match kind {
        Kind::Float(w) => D::float(w, crate::domain::point::float_from_bits(w, bits)),
        Kind::Int(t) => D::int(t, t.wrap(i128::from(bits))),
        Kind::Bool => D::bool(bits != 0),
    }
}

/// A declared input range, as a scalar of an interval domain.
pub fn range_scalar<D: Domain<Float = Interval>>(lo: f64, hi: f64) -> crate::Result<Scalar<D>> {
    Interval::declared(lo, hi).map(Scalar::Float)
}
