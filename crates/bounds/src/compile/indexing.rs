//! Indexing: of pointers, which become offsets and run-time indices, and of values, which are picked apart.

use super::builder::{Builder, Frame, Val};
use super::code::{Count, Dim, Op, Pick, Place, Root, Row};
use super::layout::unsupported;
use crate::error::Result;
use crate::kind::{IntType, Kind};
use naga::{Expression, Handle, Span, TypeInner};

impl<'m> Builder<'m> {
    /// The type that indexing yields, its stride in scalars, and how many there are.
    pub(crate) fn element(&self, inner: &TypeInner, span: Span) -> Result<(u32, Option<u32>)> {
        match *inner {
            TypeInner::Vector { size, .. } => Ok((1, Some(size as u32))),
            TypeInner::Matrix { columns, rows, .. } => Ok((rows as u32, Some(columns as u32))),
            TypeInner::Array { base, size, .. } => Ok((
                self.types.scalars(self.types.inner(base))?,
                self.types.length(size)?,
            )),
            TypeInner::BindingArray { size, .. } => Ok((1, self.types.length(size)?)),
            TypeInner::Scalar(_)
            | TypeInner::Atomic(_)
            | TypeInner::Struct { .. }
            | TypeInner::Pointer { .. }
            | TypeInner::ValuePointer { .. }
            | TypeInner::Image { .. }
            | TypeInner::Sampler { .. }
            | TypeInner::CooperativeMatrix { .. }
            | TypeInner::AccelerationStructure { .. }
            | TypeInner::RayQuery { .. } => unsupported("indexing this type", span),
        }
    }

    /// The type a pointer points to; other types are themselves.
    pub(crate) fn pointee(&self, inner: &TypeInner) -> TypeInner {
        match *inner {
            TypeInner::Pointer { base, .. } => self.types.inner(base).clone(),
            TypeInner::ValuePointer {
                size: Some(size),
                scalar,
                ..
            } => TypeInner::Vector { size, scalar },
            TypeInner::ValuePointer {
                size: None, scalar, ..
            } => TypeInner::Scalar(scalar),
            ref other => other.clone(),
        }
    }

    pub(crate) fn access(
        &mut self,
        frame: &mut Frame<'m>,
        base: Handle<Expression>,
        index: Handle<Expression>,
        span: Span,
    ) -> Result<Val> {
        let inner = self.pointee(self.type_of(frame, base));
        let (stride, count) = self.element(&inner, span)?;
        let (index, int) = self.integer(frame, index)?;
        match self.value(frame, base)? {
            Val::Place(place) => Ok(Val::Place(indexed(place, index, int, stride, count))),
            Val::Rows(rows) => self.pick(frame, &rows, stride, index, int),
            Val::Handle(mut handle) => {
                handle.index = Some((index, int));
                Ok(Val::Handle(handle))
            }
        }
    }

    pub(crate) fn pick(
        &mut self,
        frame: &mut Frame<'m>,
        rows: &[Row],
        stride: u32,
        index: Row,
        int: IntType,
    ) -> Result<Val> {
        let groups: Vec<Vec<Row>> = rows.chunks(stride as usize).map(<[Row]>::to_vec).collect();
        let kinds: Vec<Kind> = groups[0]
            .iter()
            .map(|&row| self.code.kinds[row as usize])
            .collect();
        let out = self.rows(frame, &kinds);
        self.push(
            frame,
            Op::Pick(Box::new(Pick {
                dst: out[0],
                kinds,
                groups,
                index,
                int,
            })),
        )?;
        Ok(Val::Rows(out))
    }

    pub(crate) fn access_index(
        &mut self,
        frame: &mut Frame<'m>,
        base: Handle<Expression>,
        index: u32,
        span: Span,
    ) -> Result<Val> {
        let inner = self.pointee(self.type_of(frame, base));
        let (offset, len) = match inner {
            TypeInner::Struct { ref members, .. } => self.member(members, index)?,
            ref other => {
                let (stride, _) = self.element(other, span)?;
                (stride * index, stride)
            }
        };
        match self.value(frame, base)? {
            Val::Place(place) => Ok(Val::Place(self.advanced(place, &inner, index, offset))),
            Val::Rows(rows) => Ok(Val::Rows(rows[offset as usize..(offset + len) as usize].to_vec())),
            Val::Handle(mut handle) => {
                handle.index = Some((self.int(IntType::U32, i128::from(index)), IntType::U32));
                Ok(Val::Handle(handle))
            }
        }
    }

    pub(crate) fn member(&self, members: &[naga::StructMember], index: u32) -> Result<(u32, u32)> {
        let mut offset = 0;
        for member in &members[..index as usize] {
            offset += self.types.scalars(self.types.inner(member.ty))?;
        }
        Ok((
            offset,
            self.types.scalars(self.types.inner(members[index as usize].ty))?,
        ))
    }

    /// A constant index: an offset, but for run-time sized arrays, where it must be checked against the length.
    pub(crate) fn advanced(&mut self, mut place: Place, inner: &TypeInner, index: u32, offset: u32) -> Place {
        if let TypeInner::Array {
            size: naga::ArraySize::Dynamic,
            ..
        } = *inner
        {
            // A run-time sized array counts one element.
            let stride = self.types.scalars(inner).unwrap_or(1);
            let row = self.int(IntType::U32, i128::from(index));
            return indexed(place, row, IntType::U32, stride, None);
        }
        place.offset += offset;
        place
    }

    pub(crate) fn array_length(
        &mut self,
        frame: &mut Frame<'m>,
        pointer: Handle<Expression>,
        span: Span,
    ) -> Result<Val> {
        let inner = self.pointee(self.type_of(frame, pointer));
        let (stride, _) = self.element(&inner, span)?;
        let place = self.value(frame, pointer)?.place(span)?;
        let Root::Memory(region) = place.root else {
            return unsupported("the length of an array outside of a buffer", span);
        };
        let start = place.offset;
        let row = self.emit(frame, Kind::Int(IntType::U32), |dst| Op::ArrayLength {
            dst,
            region,
            start,
            stride,
        })?;
        Ok(Val::Rows(vec![row]))
    }
}

fn indexed(mut place: Place, index: Row, int: IntType, stride: u32, count: Option<u32>) -> Place {
    let count = count.map_or(Count::Runtime { start: place.offset }, Count::Fixed);
    place.dims.push(Dim {
        index,
        int,
        stride,
        count,
    });
    place
}
