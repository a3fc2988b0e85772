//! Buffers that a run in a point domain has written, as the bytes that a machine would have left.

use crate::bindings::{Bindings, BufferData, Scalar};
use crate::compile::program::{Program, ResourceKind};
use crate::domain::Domain;
use crate::domain::point::float_to_bits;
use crate::kind::Kind;

impl<D: Domain<Float = f64>> Bindings<D> {
    /// Writes the scalars of a buffer to their places in `bytes`; padding stays as it is.
    ///
    /// `None` when the program has no such buffer, no run has written it, or `bytes` is too short for it; `bytes` may then hold
    /// a part.
    #[must_use]
    pub fn read_bytes(&self, program: &Program, group: u32, binding: u32, bytes: &mut [u8]) -> Option<()> {
        let at = Some((group, binding));
        let resource = program.resources.iter().find(|resource| resource.binding == at)?;
        let ResourceKind::Buffer { layout, .. } = &resource.kind else {
            return None;
        };
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
