//! Buffers as bytes and as scalars: what a run in a point domain has written as the bytes that a machine would have left, and what
//! a machine has left as scalars.

use crate::bindings::cell_from_bytes;
use crate::bindings::{Bindings, BufferData, Scalar};
use crate::compile::layout::BufferLayout;
use crate::compile::program::{Program, ResourceKind};
use crate::domain::Domain;
use crate::domain::point::float_to_bits;
use crate::kind::Kind;

/// A uniform or storage buffer of a program.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct BufferUse {
    /// Bind group and binding number.
    pub binding: (u32, u32),
    /// The variable's name; empty where the shader has no names.
    pub name: String,
    /// Whether the shader may write it.
    pub writable: bool,
}

impl Program {
    /// The buffers that the entry point uses, by bind group and binding number.
    #[must_use]
    pub fn buffers(&self) -> Vec<BufferUse> {
        let mut list: Vec<BufferUse> = self
            .resources
            .iter()
            .filter_map(|resource| match (&resource.kind, resource.binding) {
                (ResourceKind::Buffer { writable, .. }, Some(binding)) => Some(BufferUse {
                    binding,
                    name: resource.name.clone(),
                    writable: *writable,
                }),
                (
                    ResourceKind::Buffer { .. }
                    | ResourceKind::Workgroup { .. }
                    | ResourceKind::Texture { .. }
                    | ResourceKind::StorageTexture { .. }
                    | ResourceKind::Sampler { .. },
                    _,
                ) => None,
            })
            .collect();
        list.sort_by_key(|buffer| buffer.binding);
        list
    }

    /// The scalars in the bytes that a machine left in a buffer, in the order of its type and without padding; `None` when the
    /// program has no such buffer, or the bytes are too few for its type.
    #[must_use]
    pub fn scalars_of<D: Domain>(&self, binding: (u32, u32), bytes: &[u8]) -> Option<Vec<Scalar<D>>> {
        let layout = self.layout_of(binding)?;
        let count = layout.scalars(layout.elements(bytes.len()));
        let scalar = |number| {
            let (offset, kind) = layout.scalar(number)?;
            let word = bytes.get(offset..offset + kind.bytes())?;
            Some(Scalar::from_cell(kind, cell_from_bytes::<D>(kind, word)))
        };
        (0..count).map(scalar).collect()
    }

    fn layout_of(&self, binding: (u32, u32)) -> Option<&BufferLayout> {
        let resource = self
            .resources
            .iter()
            .find(|resource| resource.binding == Some(binding))?;
        match &resource.kind {
            ResourceKind::Buffer { layout, .. } => Some(layout),
            ResourceKind::Workgroup { .. }
            | ResourceKind::Texture { .. }
            | ResourceKind::StorageTexture { .. }
            | ResourceKind::Sampler { .. } => None,
        }
    }
}

impl<D: Domain<Float = f64>> Bindings<D> {
    /// Writes the scalars of a buffer to their places in `bytes`; padding stays as it is.
    ///
    /// `None` when the program has no such buffer, no run has written it, or `bytes` is too short for it; `bytes` may then hold
    /// a part.
    #[must_use]
    pub fn read_bytes(&self, program: &Program, group: u32, binding: u32, bytes: &mut [u8]) -> Option<()> {
        let layout = program.layout_of((group, binding))?;
        let BufferData::Scalars(scalars) = self.buffers.get(&(group, binding))? else {
            return None;
        };
        for (number, scalar) in scalars.iter().enumerate() {
            let (offset, kind) = layout.scalar(number)?;
            let word = bits(kind, scalar)?.to_le_bytes();
            bytes
                .get_mut(offset..offset + kind.bytes())?
                .copy_from_slice(&word[..kind.bytes()]);
        }
        Some(())
    }
}

impl<D: Domain<Float = f64>> Bindings<D> {
    /// The bytes of a buffer that is bound as scalars, as large as a machine needs it: whole elements of a run-time sized array,
    /// whole words. `None` when the program has no such buffer, or it is bound as bytes.
    #[must_use]
    pub fn to_bytes(&self, program: &Program, group: u32, binding: u32) -> Option<Vec<u8>> {
        let layout = program.layout_of((group, binding))?;
        let BufferData::Scalars(scalars) = self.buffers.get(&(group, binding))? else {
            return None;
        };
        let element = layout.tail.as_ref().map_or(1, |tail| tail.element.len().max(1));
        let elements = scalars.len().saturating_sub(layout.fixed.len()) / element;
        let mut bytes = vec![0; layout.bytes(elements).next_multiple_of(4)];
        self.read_bytes(program, group, binding, &mut bytes)?;
        Some(bytes)
    }
}

fn bits<D: Domain<Float = f64>>(kind: Kind, scalar: &Scalar<D>) -> Option<u64> {
    match (kind, scalar) {
        (Kind::Float(width), Scalar::Float(x)) => Some(float_to_bits(width, *x)),
        (Kind::Int(ty), Scalar::Int(..)) => scalar.int().map(|x| ty.to_bits(x)),
        (Kind::Bool, Scalar::Bool(truth)) => Some(u64::from(*truth == crate::Truth::True)),
        (
            Kind::Float(_) | Kind::Int(_) | Kind::Bool,
            Scalar::Float(_) | Scalar::Int(..) | Scalar::Bool(_),
        ) => None,
    }
}
