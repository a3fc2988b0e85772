//! Scalar types of the shading language, reduced to what arithmetic needs to know.

use crate::width::Width;
use naga::{Scalar, ScalarKind};

/// An integer type: signedness and size in bits (16, 32 or 64).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct IntType {
    /// Two's complement when true.
    pub signed: bool,
    /// Size in bits.
    pub bits: u32,
}

impl IntType {
    /// `i32`.
    pub const I32: Self = Self {
        signed: true,
        bits: 32,
    };
    /// `u32`.
    pub const U32: Self = Self {
        signed: false,
        bits: 32,
    };

    /// The least value.
    #[inline(always)]
    pub const fn min(self) -> i128 {
        if self.signed {
            -(1i128 << (self.bits - 1))
        } else {
            0
        }
    }

    /// The greatest value.
    #[inline(always)]
    pub const fn max(self) -> i128 {
        if self.signed {
            (1i128 << (self.bits - 1)) - 1
        } else {
            (1i128 << self.bits) - 1
        }
    }

    /// Reduces a number modulo `2^bits` into the type.
    #[inline(always)]
    pub const fn wrap(self, x: i128) -> i128 {
        let low = x & ((1i128 << self.bits) - 1);
        if self.signed && (low >> (self.bits - 1)) & 1 == 1 {
            low - (1i128 << self.bits)
        } else {
            low
        }
    }

    /// The bit pattern of a value of the type.
    #[inline(always)]
    pub const fn to_bits(self, x: i128) -> u64 {
        (x & ((1i128 << self.bits) - 1)) as u64
    }
}

/// What a scalar is, as far as its arithmetic goes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Kind {
    /// A float of the given format.
    Float(Width),
    /// An integer.
    Int(IntType),
    /// A truth value.
    Bool,
}

impl Kind {
    /// The kind of a naga scalar; `None` for abstract types, which validation removes, and for sizes that no shader has.
    pub fn of(scalar: Scalar) -> Option<Self> {
        let bits = u32::from(scalar.width) * 8;
        match scalar.kind {
            ScalarKind::Bool => Some(Self::Bool),
            ScalarKind::Sint if matches!(bits, 16 | 32 | 64) => {
                Some(Self::Int(IntType { signed: true, bits }))
            }
            ScalarKind::Uint if matches!(bits, 16 | 32 | 64) => {
                Some(Self::Int(IntType { signed: false, bits }))
            }
            ScalarKind::Float => match bits {
                16 => Some(Self::Float(Width::F16)),
                32 => Some(Self::Float(Width::F32)),
                64 => Some(Self::Float(Width::F64)),
                0..=15 | 17..=31 | 33..=63 | 65.. => None,
            },
            ScalarKind::Sint | ScalarKind::Uint | ScalarKind::AbstractInt | ScalarKind::AbstractFloat => None,
        }
    }

    /// Bytes of the scalar in a buffer.
    pub fn bytes(self) -> usize {
        match self {
            Self::Float(Width::F16) => 2,
            Self::Float(Width::F32) | Self::Bool => 4,
            Self::Float(Width::F64) => 8,
            Self::Int(t) => t.bits as usize / 8,
        }
    }
}
