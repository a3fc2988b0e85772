//! Expressions: the dispatch, one function an arm, and the arms for constants, variables and composition; the others are in
//! `indexing`, `elementwise`, `binary`, `math`, `access` and `image`.

use super::builder::{Builder, Frame, Global, Val};
use super::code::{Constant, Place, Root, Row};
use super::layout::{kind, unsupported};
use crate::error::Result;
use crate::kind::{IntType, Kind};
use crate::width::Width;
use naga::{Expression, Handle, Literal, Span, SwizzleComponent, TypeInner, VectorSize};

impl<'m> Builder<'m> {
    /// The compiled form of an expression: what an `Emit` computed, or a constant, argument or variable.
    pub(crate) fn value(&mut self, frame: &mut Frame<'m>, handle: Handle<Expression>) -> Result<Val> {
        if let Some(value) = frame.values.get(&handle) {
            return Ok(value.clone());
        }
        let (before, span) = (frame.pending.len(), frame.span);
        let value = self.expression(frame, handle)?;
        // What is computed around it stands where it stood.
        frame.span = span;
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
}
