//! Expressions: one function an arm, each turning an IR expression into rows, a place or a handle.

use super::builder::{Builder, Frame, Global, Val};
use super::code::{Constant, Count, Dim, Op, Pick, Place, Root, Row};
use super::layout::{kind, unsupported};
use crate::domain::ops::{BoolBinary, FloatUnary, IntUnary};
use crate::error::Result;
use crate::kind::{IntType, Kind};
use crate::width::Width;
use naga::{
    Expression, Handle, Literal, RelationalFunction, ScalarKind, Span, SwizzleComponent, TypeInner,
    UnaryOperator, VectorSize,
};

impl<'m> Builder<'m> {
    /// The compiled form of an expression: what an `Emit` computed, or a constant, argument or variable.
    pub(crate) fn value(&mut self, frame: &mut Frame<'m>, handle: Handle<Expression>) -> Result<Val> {
        if let Some(value) = frame.values.get(&handle) {
            return Ok(value.clone());
        }
        let before = frame.pending.len();
        let value = self.expression(frame, handle)?;
        // Computed on demand: keep it only when that took no instructions, since those run under the current branch.
        if frame.pending.len() == before {
            frame.values.insert(handle, value.clone());
        }
        Ok(value)
    }

    /// The scalars of an expression.
    pub(crate) fn scalars(&mut self, frame: &mut Frame<'m>, handle: Handle<Expression>) -> Result<Vec<Row>> {
        self.value(frame, handle)?
            .rows(frame.function.expressions.get_span(handle))
    }

    /// The one scalar of an expression.
    pub(crate) fn scalar(&mut self, frame: &mut Frame<'m>, handle: Handle<Expression>) -> Result<Row> {
        let span = frame.function.expressions.get_span(handle);
        self.scalars(frame, handle)?
            .first()
            .copied()
            .map_or_else(|| unsupported("an empty value", span), Ok)
    }

    /// A scalar integer expression and its type.
    pub(crate) fn integer(
        &mut self,
        frame: &mut Frame<'m>,
        handle: Handle<Expression>,
    ) -> Result<(Row, IntType)> {
        let row = self.scalar(frame, handle)?;
        let t = self.int_type(frame, handle)?;
        Ok((row, t))
    }

    /// The type of an expression.
    pub(crate) fn type_of<'a>(&self, frame: &'a Frame<'m>, handle: Handle<Expression>) -> &'a TypeInner
    where
        'm: 'a,
    {
        frame.info[handle].ty.inner_with(&self.module.types)
    }

    /// The kind of the scalars of a scalar, vector or matrix expression.
    pub(crate) fn kind_of(&self, frame: &Frame<'m>, handle: Handle<Expression>) -> Result<Kind> {
        let span = frame.function.expressions.get_span(handle);
        self.type_of(frame, handle)
            .scalar()
            .map_or_else(|| unsupported("arithmetic on this type", span), kind)
    }

    pub(crate) fn int_type(&self, frame: &Frame<'m>, handle: Handle<Expression>) -> Result<IntType> {
        match self.kind_of(frame, handle)? {
            Kind::Int(t) => Ok(t),
            Kind::Float(_) | Kind::Bool => unsupported(
                "an index that is no integer",
                frame.function.expressions.get_span(handle),
            ),
        }
    }

    /// Compiles an expression now.
    pub(crate) fn expression(&mut self, frame: &mut Frame<'m>, handle: Handle<Expression>) -> Result<Val> {
        let function = frame.function;
        let span = function.expressions.get_span(handle);
        frame.span = self.span(span);
        match &function.expressions[handle] {
            Expression::Literal(literal) => self.literal(*literal, span),
            Expression::Constant(constant) => self.global_expression(self.module.constants[*constant].init),
            Expression::Override(_) => unsupported("an override without a value", span),
            Expression::ZeroValue(ty) => self.zero_value(self.types.inner(*ty)),
            Expression::Compose { components, .. } => self.compose(frame, components),
            Expression::Access { base, index } => self.access(frame, *base, *index, span),
            Expression::AccessIndex { base, index } => self.access_index(frame, *base, *index, span),
            Expression::Splat { size, value } => self.splat(frame, *size, *value),
            Expression::Swizzle {
                size,
                vector,
                pattern,
            } => self.swizzle(frame, *size, *vector, pattern),
            Expression::FunctionArgument(index) => Ok(frame.arguments[*index as usize].clone()),
            Expression::GlobalVariable(global) => self.global(*global, span),
            Expression::LocalVariable(local) => {
                let (base, len) = frame.locals[local.index()];
                Ok(Val::Place(Place {
                    root: Root::Rows { base, len },
                    offset: 0,
                    dims: Vec::new(),
                }))
            }
            Expression::Load { pointer } => self.load(frame, *pointer, span),
            Expression::ImageSample { .. } => self.image_sample(frame, handle, span),
            Expression::ImageLoad { .. } => self.image_load(frame, handle, span),
            Expression::ImageQuery { image, query } => self.image_query(frame, *image, *query, span),
            Expression::Unary { op, expr } => self.unary(frame, *op, *expr),
            Expression::Binary { op, left, right } => self.binary(frame, *op, *left, *right, span),
            Expression::Select {
                condition,
                accept,
                reject,
            } => self.select(frame, *condition, *accept, *reject),
            Expression::Derivative { axis, ctrl, expr } => self.derivative(frame, *axis, *ctrl, *expr),
            Expression::Relational { fun, argument } => self.relational(frame, *fun, *argument),
            Expression::Math {
                fun,
                arg,
                arg1,
                arg2,
                arg3,
            } => self.math(frame, *fun, [Some(*arg), *arg1, *arg2, *arg3], span),
            Expression::As { expr, kind, convert } => self.cast(frame, *expr, *kind, *convert, span),
            Expression::CallResult(_)
            | Expression::AtomicResult { .. }
            | Expression::WorkGroupUniformLoadResult { .. }
            | Expression::SubgroupBallotResult
            | Expression::SubgroupOperationResult { .. } => {
                unsupported("the result of a statement before the statement", span)
            }
            Expression::ArrayLength(pointer) => self.array_length(frame, *pointer, span),
            Expression::RayQueryVertexPositions { .. }
            | Expression::RayQueryProceedResult
            | Expression::RayQueryGetIntersection { .. } => unsupported("ray queries", span),
            Expression::CooperativeLoad { .. } | Expression::CooperativeMultiplyAdd { .. } => {
                unsupported("cooperative matrices", span)
            }
        }
    }

    fn literal(&mut self, literal: Literal, span: Span) -> Result<Val> {
        let row = match literal {
            Literal::F64(x) => self.float(Width::F64, x),
            Literal::F32(x) => self.float(Width::F32, f64::from(x)),
            Literal::F16(x) => self.float(Width::F16, x.to_f64()),
            Literal::U16(x) => self.int(
                IntType {
                    signed: false,
                    bits: 16,
                },
                i128::from(x),
            ),
            Literal::I16(x) => self.int(
                IntType {
                    signed: true,
                    bits: 16,
                },
                i128::from(x),
            ),
            Literal::U32(x) => self.int(IntType::U32, i128::from(x)),
            Literal::I32(x) => self.int(IntType::I32, i128::from(x)),
            Literal::U64(x) => self.int(
                IntType {
                    signed: false,
                    bits: 64,
                },
                i128::from(x),
            ),
            Literal::I64(x) => self.int(
                IntType {
                    signed: true,
                    bits: 64,
                },
                i128::from(x),
            ),
            Literal::Bool(b) => self.bool(b),
            Literal::AbstractInt(_) | Literal::AbstractFloat(_) => {
                return unsupported("an abstract literal", span);
            }
        };
        Ok(Val::Rows(vec![row]))
    }

    pub(crate) fn zero_value(&mut self, inner: &TypeInner) -> Result<Val> {
        let kinds = self.types.kinds_of(inner)?;
        Ok(Val::Rows(
            kinds
                .into_iter()
                .map(|k| self.constant(Constant { kind: k, bits: 0 }))
                .collect(),
        ))
    }

    /// An expression of the module's own arena: constants and initial values.
    pub(crate) fn global_expression(&mut self, handle: Handle<Expression>) -> Result<Val> {
        if let Some(value) = self.global_values.get(&handle) {
            return Ok(value.clone());
        }
        let span = self.module.global_expressions.get_span(handle);
        let value = match &self.module.global_expressions[handle] {
            Expression::Literal(literal) => self.literal(*literal, span)?,
            Expression::Constant(constant) => {
                self.global_expression(self.module.constants[*constant].init)?
            }
            Expression::ZeroValue(ty) => self.zero_value(self.types.inner(*ty))?,
            Expression::Compose { components, .. } => {
                let mut rows = Vec::new();
                for &c in components {
                    rows.extend(self.global_expression(c)?.rows(span)?);
                }
                Val::Rows(rows)
            }
            Expression::Splat { size, value } => {
                let row = self.global_expression(*value)?.rows(span)?[0];
                Val::Rows(vec![row; *size as usize])
            }
            other => {
                return unsupported(
                    format!("a constant expression that is not folded: {other:?}"),
                    span,
                );
            }
        };
        self.global_values.insert(handle, value.clone());
        Ok(value)
    }

    fn compose(&mut self, frame: &mut Frame<'m>, components: &[Handle<Expression>]) -> Result<Val> {
        let mut rows = Vec::new();
        for &component in components {
            rows.extend(self.scalars(frame, component)?);
        }
        Ok(Val::Rows(rows))
    }

    fn splat(&mut self, frame: &mut Frame<'m>, size: VectorSize, value: Handle<Expression>) -> Result<Val> {
        let row = self.scalar(frame, value)?;
        Ok(Val::Rows(vec![row; size as usize]))
    }

    fn swizzle(
        &mut self,
        frame: &mut Frame<'m>,
        size: VectorSize,
        vector: Handle<Expression>,
        pattern: &[SwizzleComponent; 4],
    ) -> Result<Val> {
        let rows = self.scalars(frame, vector)?;
        Ok(Val::Rows(
            pattern[..size as usize]
                .iter()
                .map(|c| rows[*c as usize])
                .collect(),
        ))
    }

    fn global(&mut self, handle: Handle<naga::GlobalVariable>, span: Span) -> Result<Val> {
        match self.globals.get(&handle) {
            Some(Global::Place(root)) => Ok(Val::Place(Place {
                root: *root,
                offset: 0,
                dims: Vec::new(),
            })),
            Some(Global::Handle(resource)) => Ok(Val::Handle(super::code::HandleRef {
                resource: *resource,
                index: None,
            })),
            None => unsupported("a variable of this address space", span),
        }
    }

    /// The type that indexing yields, its stride in scalars, and how many there are.
    fn element(&self, inner: &TypeInner, span: Span) -> Result<(u32, Option<u32>)> {
        match *inner {
            TypeInner::Vector { size, .. } => Ok((1, Some(size as u32))),
            TypeInner::Matrix { columns, rows, .. } => Ok((rows as u32, Some(columns as u32))),
            TypeInner::Array { base, size, .. } => Ok((
                self.types.scalars(self.types.inner(base))?,
                self.types.length(size)?,
            )),
            TypeInner::BindingArray { size, .. } => Ok((1, self.types.length(size)?)),
            _ => unsupported("indexing this type", span),
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

    fn access(
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

    fn pick(
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

    fn access_index(
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

    fn member(&self, members: &[naga::StructMember], index: u32) -> Result<(u32, u32)> {
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
    fn advanced(&mut self, mut place: Place, inner: &TypeInner, index: u32, offset: u32) -> Place {
        if let TypeInner::Array {
            size: naga::ArraySize::Dynamic,
            ..
        } = *inner
        {
            let stride = if index == 0 {
                self.types.scalars(inner).unwrap_or(1)
            } else {
                offset / index
            };
            let row = self.int(IntType::U32, i128::from(index));
            return indexed(place, row, IntType::U32, stride, None);
        }
        place.offset += offset;
        place
    }

    fn array_length(
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

    fn unary(&mut self, frame: &mut Frame<'m>, op: UnaryOperator, expr: Handle<Expression>) -> Result<Val> {
        let k = self.kind_of(frame, expr)?;
        let rows = self.scalars(frame, expr)?;
        self.map(frame, k, &rows, |dst, a| match (op, k) {
            (UnaryOperator::Negate, Kind::Float(w)) => Op::FloatUnary {
                op: FloatUnary::Negate,
                w,
                dst,
                a,
            },
            (UnaryOperator::Negate, Kind::Int(t)) => Op::IntUnary {
                op: IntUnary::Negate,
                t,
                dst,
                a,
            },
            (UnaryOperator::BitwiseNot, Kind::Int(t)) => Op::IntUnary {
                op: IntUnary::Not,
                t,
                dst,
                a,
            },
            (UnaryOperator::Negate | UnaryOperator::LogicalNot, Kind::Bool)
            | (UnaryOperator::LogicalNot | UnaryOperator::BitwiseNot, Kind::Float(_) | Kind::Bool)
            | (UnaryOperator::LogicalNot, Kind::Int(_)) => Op::Not { dst, a },
        })
    }

    /// One instruction for each scalar of an operand.
    pub(crate) fn map(
        &mut self,
        frame: &mut Frame<'m>,
        k: Kind,
        rows: &[Row],
        op: impl Fn(Row, Row) -> Op,
    ) -> Result<Val> {
        let mut out = Vec::with_capacity(rows.len());
        for &a in rows {
            out.push(self.emit(frame, k, |dst| op(dst, a))?);
        }
        Ok(Val::Rows(out))
    }

    fn select(
        &mut self,
        frame: &mut Frame<'m>,
        condition: Handle<Expression>,
        accept: Handle<Expression>,
        reject: Handle<Expression>,
    ) -> Result<Val> {
        let cond = self.scalars(frame, condition)?;
        let (accept, reject) = (self.scalars(frame, accept)?, self.scalars(frame, reject)?);
        let mut out = Vec::with_capacity(accept.len());
        for (i, (&accept, &reject)) in accept.iter().zip(&reject).enumerate() {
            let k = self.code.kinds[accept as usize];
            let cond = *cond.get(i).unwrap_or(&cond[0]);
            out.push(self.emit(frame, k, |dst| Op::Select {
                kind: k,
                dst,
                cond,
                accept,
                reject,
            })?);
        }
        Ok(Val::Rows(out))
    }

    fn derivative(
        &mut self,
        frame: &mut Frame<'m>,
        axis: naga::DerivativeAxis,
        control: naga::DerivativeControl,
        expr: Handle<Expression>,
    ) -> Result<Val> {
        self.code.uses_derivatives = true;
        let k = self.kind_of(frame, expr)?;
        let w = if let Kind::Float(w) = k { w } else { Width::F32 };
        let rows = self.scalars(frame, expr)?;
        self.map(frame, k, &rows, |dst, a| Op::Derivative {
            axis,
            control,
            w,
            dst,
            a,
        })
    }

    fn relational(
        &mut self,
        frame: &mut Frame<'m>,
        fun: RelationalFunction,
        argument: Handle<Expression>,
    ) -> Result<Val> {
        let rows = self.scalars(frame, argument)?;
        match fun {
            RelationalFunction::All => self.fold_bool(frame, &rows, BoolBinary::And),
            RelationalFunction::Any => self.fold_bool(frame, &rows, BoolBinary::Or),
            RelationalFunction::IsNan => self.map(frame, Kind::Bool, &rows, |dst, a| Op::IsNan { dst, a }),
            RelationalFunction::IsInf => self.map(frame, Kind::Bool, &rows, |dst, a| Op::IsInf { dst, a }),
        }
    }

    fn fold_bool(&mut self, frame: &mut Frame<'m>, rows: &[Row], op: BoolBinary) -> Result<Val> {
        let mut total = rows[0];
        for &b in &rows[1..] {
            let a = total;
            total = self.emit(frame, Kind::Bool, |dst| Op::BoolBinary { op, dst, a, b })?;
        }
        Ok(Val::Rows(vec![total]))
    }

    fn cast(
        &mut self,
        frame: &mut Frame<'m>,
        expr: Handle<Expression>,
        to: ScalarKind,
        convert: Option<u8>,
        span: Span,
    ) -> Result<Val> {
        let from = self.kind_of(frame, expr)?;
        let rows = self.scalars(frame, expr)?;
        match convert {
            Some(width) => {
                let to = kind(naga::Scalar { kind: to, width })?;
                if to == from {
                    return Ok(Val::Rows(rows));
                }
                self.map(frame, to, &rows, |dst, a| Op::Convert { from, to, dst, a })
            }
            None => {
                let to = kind(naga::Scalar {
                    kind: to,
                    width: from.bytes() as u8,
                })?;
                if from == to {
                    return Ok(Val::Rows(rows));
                }
                if from == Kind::Bool || to == Kind::Bool {
                    return unsupported("a bitcast of a truth value", span);
                }
                self.bitcast(frame, from, to, &rows)
            }
        }
    }

    fn bitcast(&mut self, frame: &mut Frame<'m>, from: Kind, to: Kind, rows: &[Row]) -> Result<Val> {
        let unsigned = Kind::Int(IntType {
            signed: false,
            bits: from.bytes() as u32 * 8,
        });
        let bits = if from == unsigned {
            rows.to_vec()
        } else {
            self.map(frame, unsigned, rows, |dst, a| Op::ToBits { from, dst, a })?
                .rows(Span::UNDEFINED)?
        };
        if to == unsigned {
            return Ok(Val::Rows(bits));
        }
        self.map(frame, to, &bits, |dst, a| Op::FromBits { to, dst, a })
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
