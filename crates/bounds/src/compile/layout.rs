//! How types are taken apart into scalars, and where those scalars lie in a buffer.

use crate::error::{Error, Result};
use crate::kind::Kind;
use naga::proc::GlobalCtx;
use naga::{ArraySize, Handle, Module, Scalar, Span, Type, TypeInner, VectorSize};

/// Types that are no numbers and hold none.
macro_rules! opaque_type {
    () => {
        TypeInner::Pointer { .. }
            | TypeInner::ValuePointer { .. }
            | TypeInner::Image { .. }
            | TypeInner::Sampler { .. }
            | TypeInner::CooperativeMatrix { .. }
            | TypeInner::AccelerationStructure { .. }
            | TypeInner::RayQuery { .. }
            | TypeInner::BindingArray { .. }
    };
}
pub(crate) use opaque_type;

/// Types larger than this many scalars are refused where they would have to be held by every invocation.
pub(crate) const MAX_SCALARS: u64 = 1 << 26;

/// Answers questions on types of one module.
#[derive(Clone, Copy)]
pub(crate) struct Types<'m> {
    pub(crate) module: &'m Module,
}

pub(crate) fn unsupported<T>(what: impl Into<String>, span: Span) -> Result<T> {
    Err(Error::Unsupported {
        what: what.into(),
        span,
    })
}

pub(crate) fn kind(scalar: Scalar) -> Result<Kind> {
    Kind::of(scalar).map_or_else(
        || unsupported(format!("the scalar type {scalar:?}"), Span::UNDEFINED),
        Ok,
    )
}

impl<'m> Types<'m> {
    pub(crate) fn inner(&self, ty: Handle<Type>) -> &'m TypeInner {
        &self.module.types[ty].inner
    }

    fn context(&self) -> GlobalCtx<'m> {
        self.module.to_ctx()
    }

    /// Elements of an array; `None` when the size is known at run time only.
    pub(crate) fn length(&self, size: ArraySize) -> Result<Option<u32>> {
        match size.resolve(self.context()) {
            Ok(naga::proc::IndexableLength::Known(n)) => Ok(Some(n)),
            Ok(naga::proc::IndexableLength::Dynamic) => Ok(None),
            Err(_) => unsupported("an array whose size is an unresolved override", Span::UNDEFINED),
        }
    }

    /// Number of scalars; a run-time sized array counts one element.
    pub(crate) fn scalars(&self, inner: &TypeInner) -> Result<u32> {
        let n = self.scalars_wide(inner)?;
        if n > MAX_SCALARS {
            return unsupported(format!("a type of {n} scalars"), Span::UNDEFINED);
        }
        Ok(n as u32)
    }

    fn scalars_wide(&self, inner: &TypeInner) -> Result<u64> {
        match *inner {
            TypeInner::Scalar(_) | TypeInner::Atomic(_) => Ok(1),
            TypeInner::Vector { size, .. } => Ok(size as u64),
            TypeInner::Matrix { columns, rows, .. } => Ok(columns as u64 * rows as u64),
            TypeInner::Array { base, size, .. } => {
                let one = self.scalars_wide(self.inner(base))?;
                Ok(one.saturating_mul(u64::from(self.length(size)?.unwrap_or(1))))
            }
            TypeInner::Struct { ref members, .. } => members.iter().try_fold(0, |n, m| {
                Ok(self.scalars_wide(self.inner(m.ty))?.saturating_add(n))
            }),
            TypeInner::Pointer { .. }
            | TypeInner::ValuePointer { .. }
            | TypeInner::Image { .. }
            | TypeInner::Sampler { .. } => Ok(0),
            TypeInner::CooperativeMatrix { .. } => unsupported("cooperative matrices", Span::UNDEFINED),
            TypeInner::AccelerationStructure { .. } => {
                unsupported("acceleration structures", Span::UNDEFINED)
            }
            TypeInner::RayQuery { .. } => unsupported("ray queries", Span::UNDEFINED),
            TypeInner::BindingArray { .. } => unsupported("a binding array of buffers", Span::UNDEFINED),
        }
    }

    /// Appends the kinds of all scalars in order.
    pub(crate) fn kinds(&self, inner: &TypeInner, out: &mut Vec<Kind>) -> Result<()> {
        match *inner {
            TypeInner::Scalar(s) | TypeInner::Atomic(s) => out.push(kind(s)?),
            TypeInner::Vector { size, scalar } => repeat(out, kind(scalar)?, size as usize),
            TypeInner::Matrix {
                columns,
                rows,
                scalar,
            } => repeat(out, kind(scalar)?, columns as usize * rows as usize),
            TypeInner::Array { base, size, .. } => {
                for _ in 0..self.length(size)?.unwrap_or(1) {
                    self.kinds(self.inner(base), out)?;
                }
            }
            TypeInner::Struct { ref members, .. } => {
                for member in members {
                    self.kinds(self.inner(member.ty), out)?;
                }
            }
            TypeInner::Pointer { .. }
            | TypeInner::ValuePointer { .. }
            | TypeInner::Image { .. }
            | TypeInner::Sampler { .. }
            | TypeInner::CooperativeMatrix { .. }
            | TypeInner::AccelerationStructure { .. }
            | TypeInner::RayQuery { .. }
            | TypeInner::BindingArray { .. } => {}
        }
        Ok(())
    }

    /// The kinds of a type as a list.
    pub(crate) fn kinds_of(&self, inner: &TypeInner) -> Result<Vec<Kind>> {
        self.scalars(inner)?;
        let mut out = Vec::new();
        self.kinds(inner, &mut out)?;
        Ok(out)
    }

    /// The layout of a buffer variable: byte offset and kind of every scalar of the fixed part, and of one element of the
    /// run-time sized tail.
    pub(crate) fn buffer(&self, ty: Handle<Type>) -> Result<BufferLayout> {
        let mut layout = BufferLayout::default();
        self.scalars(self.inner(ty))?;
        self.lay_out(ty, 0, &mut layout)?;
        layout.fixed_bytes = self.fixed_bytes(ty)?;
        Ok(layout)
    }

    fn fixed_bytes(&self, ty: Handle<Type>) -> Result<usize> {
        let inner = self.inner(ty);
        match *inner {
            TypeInner::Array { size, .. } if self.length(size)?.is_none() => Ok(0),
            TypeInner::Struct { ref members, .. } => match members.last() {
                Some(last) if self.is_runtime(last.ty)? => Ok(last.offset as usize),
                Some(_) | None => Ok(inner.size(self.context()) as usize),
            },
            TypeInner::Scalar(_)
            | TypeInner::Vector { .. }
            | TypeInner::Matrix { .. }
            | TypeInner::Atomic(_)
            | TypeInner::Array { .. }
            | opaque_type!() => Ok(inner.size(self.context()) as usize),
        }
    }

    fn is_runtime(&self, ty: Handle<Type>) -> Result<bool> {
        match *self.inner(ty) {
            TypeInner::Array { size, .. } => Ok(self.length(size)?.is_none()),
            TypeInner::Scalar(_)
            | TypeInner::Vector { .. }
            | TypeInner::Matrix { .. }
            | TypeInner::Atomic(_)
            | TypeInner::Struct { .. }
            | opaque_type!() => Ok(false),
        }
    }

    fn lay_out(&self, ty: Handle<Type>, at: usize, out: &mut BufferLayout) -> Result<()> {
        match *self.inner(ty) {
            TypeInner::Array { base, size, stride } => match self.length(size)? {
                Some(n) => {
                    (0..n as usize).try_for_each(|k| self.lay_out(base, at + k * stride as usize, out))
                }
                None => {
                    let mut element = BufferLayout::default();
                    self.lay_out(base, 0, &mut element)?;
                    out.tail = Some(Tail {
                        start: at,
                        stride: stride as usize,
                        element: element.fixed,
                    });
                    Ok(())
                }
            },
            TypeInner::Struct { ref members, .. } => members
                .iter()
                .try_for_each(|m| self.lay_out(m.ty, at + m.offset as usize, out)),
            ref inner => self.lay_out_numeric(inner, at, out),
        }
    }

    fn lay_out_numeric(&self, inner: &TypeInner, at: usize, out: &mut BufferLayout) -> Result<()> {
        let mut column = |k: Kind, n: usize, at: usize| {
            out.fixed.extend((0..n).map(|i| (at + i * k.bytes(), k)));
        };
        match *inner {
            TypeInner::Scalar(s) | TypeInner::Atomic(s) => column(kind(s)?, 1, at),
            TypeInner::Vector { size, scalar } => column(kind(scalar)?, size as usize, at),
            TypeInner::Matrix {
                columns,
                rows,
                scalar,
            } => {
                let k = kind(scalar)?;
                let stride = column_stride(rows) * k.bytes();
                (0..columns as usize).for_each(|c| column(k, rows as usize, at + c * stride));
            }
            TypeInner::Array { .. } | TypeInner::Struct { .. } | opaque_type!() => {
                return unsupported("a buffer of this type", Span::UNDEFINED);
            }
        }
        Ok(())
    }
}

/// Scalars from one matrix column to the next.
fn column_stride(rows: VectorSize) -> usize {
    match rows {
        VectorSize::Bi => 2,
        VectorSize::Tri | VectorSize::Quad => 4,
    }
}

fn repeat(out: &mut Vec<Kind>, k: Kind, n: usize) {
    out.extend(std::iter::repeat_n(k, n));
}

/// Where the scalars of a buffer lie.
#[derive(Clone, Debug, Default)]
pub(crate) struct BufferLayout {
    /// Byte offset and kind of every scalar before the tail.
    pub(crate) fixed: Vec<(usize, Kind)>,
    /// Bytes the fixed part takes.
    pub(crate) fixed_bytes: usize,
    /// The run-time sized array at the end.
    pub(crate) tail: Option<Tail>,
}

/// A run-time sized array.
#[derive(Clone, Debug)]
pub(crate) struct Tail {
    pub(crate) start: usize,
    pub(crate) stride: usize,
    pub(crate) element: Vec<(usize, Kind)>,
}

impl BufferLayout {
    /// Elements of the tail in a buffer of that many bytes.
    pub(crate) fn elements(&self, bytes: usize) -> usize {
        self.tail
            .as_ref()
            .map_or(0, |t| bytes.saturating_sub(t.start) / t.stride.max(1))
    }

    /// Scalars of a buffer with that many tail elements.
    pub(crate) fn scalars(&self, elements: usize) -> usize {
        self.fixed.len() + self.tail.as_ref().map_or(0, |t| t.element.len() * elements)
    }

    /// Bytes of a buffer with that many tail elements.
    pub(crate) fn bytes(&self, elements: usize) -> usize {
        self.tail
            .as_ref()
            .map_or(self.fixed_bytes, |t| t.start + t.stride * elements)
    }

    /// Byte offset and kind of the scalar with the given number.
    pub(crate) fn scalar(&self, number: usize) -> Option<(usize, Kind)> {
        if let Some(&entry) = self.fixed.get(number) {
            return Some(entry);
        }
        let tail = self.tail.as_ref()?;
        let rest = number - self.fixed.len();
        let n = tail.element.len().max(1);
        let (at, kind) = *tail.element.get(rest % n)?;
        Some((tail.start + (rest / n) * tail.stride + at, kind))
    }
}
