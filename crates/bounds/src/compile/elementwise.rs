//! Expressions that work scalar by scalar: unary operators, selection, derivatives, relations, conversions.

use super::builder::{Builder, Frame, Val};
use super::code::{Op, Row};
use super::layout::{kind, unsupported};
use crate::domain::ops::{BoolBinary, FloatUnary, IntUnary};
use crate::error::Result;
use crate::kind::{IntType, Kind};
use crate::width::Width;
use naga::{Expression, Handle, RelationalFunction, ScalarKind, Span, UnaryOperator};

impl<'m> Builder<'m> {
    pub(crate) fn unary(
        &mut self,
        frame: &mut Frame<'m>,
        op: UnaryOperator,
        expr: Handle<Expression>,
    ) -> Result<Val> {
        let k = self.kind_of(frame, expr)?;
        let rows = self.scalars(frame, expr)?;
        let out = self.map(frame, k, &rows, |dst, a| match (op, k) {
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
        })?;
        if let (UnaryOperator::Negate, Kind::Float(_), Val::Rows(negated)) = (op, k, &out) {
            for (&row, &of) in negated.iter().zip(&rows) {
                self.chains.negated(row, of);
            }
        }
        Ok(out)
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

    pub(crate) fn select(
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

    pub(crate) fn derivative(
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

    pub(crate) fn relational(
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

    pub(crate) fn fold_bool(&mut self, frame: &mut Frame<'m>, rows: &[Row], op: BoolBinary) -> Result<Val> {
        let mut total = rows[0];
        for &b in &rows[1..] {
            let a = total;
            total = self.emit(frame, Kind::Bool, |dst| Op::BoolBinary { op, dst, a, b })?;
        }
        Ok(Val::Rows(vec![total]))
    }

    pub(crate) fn cast(
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

    pub(crate) fn bitcast(
        &mut self,
        frame: &mut Frame<'m>,
        from: Kind,
        to: Kind,
        rows: &[Row],
    ) -> Result<Val> {
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
