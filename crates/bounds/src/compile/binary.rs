//! Binary operators, among them the matrix products, which are sums of products.

use super::builder::{Builder, Frame, Val};
use super::code::{Op, Row};
use super::layout::{opaque_type, unsupported};
use crate::domain::ops::{BoolBinary, Compare, FloatBinary, FloatUnary, IntBinary};
use crate::error::Result;
use crate::kind::Kind;
use crate::width::Width;
use naga::{BinaryOperator, Expression, Handle, Span, TypeInner};

/// The shape of a multiplication's operand.
#[derive(Clone, Copy)]
enum Shape {
    Scalar,
    Vector(usize),
    Matrix { columns: usize, rows: usize },
}

fn shape(inner: &TypeInner) -> Shape {
    match *inner {
        TypeInner::Vector { size, .. } => Shape::Vector(size as usize),
        TypeInner::Matrix { columns, rows, .. } => Shape::Matrix {
            columns: columns as usize,
            rows: rows as usize,
        },
        TypeInner::Scalar(_)
        | TypeInner::Atomic(_)
        | TypeInner::Array { .. }
        | TypeInner::Struct { .. }
        | opaque_type!() => Shape::Scalar,
    }
}

impl<'m> Builder<'m> {
    pub(crate) fn binary(
        &mut self,
        frame: &mut Frame<'m>,
        op: BinaryOperator,
        left: Handle<Expression>,
        right: Handle<Expression>,
        span: Span,
    ) -> Result<Val> {
        let k = self.kind_of(frame, left)?;
        let (a, b) = (self.scalars(frame, left)?, self.scalars(frame, right)?);
        if let (BinaryOperator::Multiply, Kind::Float(w)) = (op, k) {
            let shapes = (
                shape(self.type_of(frame, left)),
                shape(self.type_of(frame, right)),
            );
            return self.product(frame, w, shapes, &a, &b);
        }
        let n = a.len().max(b.len());
        let mut out = Vec::with_capacity(n);
        for i in 0..n {
            let (x, y) = (a[i.min(a.len() - 1)], b[i.min(b.len() - 1)]);
            out.push(self.scalar_binary(frame, op, k, x, y, span)?);
        }
        Ok(Val::Rows(out))
    }

    fn scalar_binary(
        &mut self,
        frame: &mut Frame<'m>,
        op: BinaryOperator,
        k: Kind,
        a: Row,
        b: Row,
        span: Span,
    ) -> Result<Row> {
        if let Some(op) = comparison(op) {
            return self.comparison(frame, op, k, a, b, span);
        }
        match k {
            Kind::Float(w) => match float_operator(op) {
                Some(op) => self.float_binary(frame, op, w, a, b),
                None => unsupported(format!("{op:?} of floats"), span),
            },
            Kind::Int(t) => match int_operator(op) {
                Some(op) => self.emit(frame, k, |dst| Op::IntBinary { op, t, dst, a, b }),
                None => unsupported(format!("{op:?} of integers"), span),
            },
            Kind::Bool => match bool_operator(op) {
                Some(op) => self.emit(frame, k, |dst| Op::BoolBinary { op, dst, a, b }),
                None => unsupported(format!("{op:?} of truth values"), span),
            },
        }
    }

    fn comparison(
        &mut self,
        frame: &mut Frame<'m>,
        op: Compare,
        k: Kind,
        a: Row,
        b: Row,
        span: Span,
    ) -> Result<Row> {
        match (k, op) {
            (Kind::Float(w), _) => self.emit(frame, Kind::Bool, |dst| Op::FloatCompare { op, w, dst, a, b }),
            (Kind::Int(t), _) => self.emit(frame, Kind::Bool, |dst| Op::IntCompare { op, t, dst, a, b }),
            (Kind::Bool, Compare::Equal) => self.emit(frame, k, |dst| Op::BoolBinary {
                op: BoolBinary::Equal,
                dst,
                a,
                b,
            }),
            (Kind::Bool, Compare::NotEqual) => self.emit(frame, k, |dst| Op::BoolBinary {
                op: BoolBinary::NotEqual,
                dst,
                a,
                b,
            }),
            (Kind::Bool, Compare::Less | Compare::LessEqual | Compare::Greater | Compare::GreaterEqual) => {
                unsupported("an order of truth values", span)
            }
        }
    }

    /// A float operation on two scalars; the product of a value with itself is a square.
    pub(crate) fn float_binary(
        &mut self,
        frame: &mut Frame<'m>,
        op: FloatBinary,
        w: Width,
        a: Row,
        b: Row,
    ) -> Result<Row> {
        let k = Kind::Float(w);
        if op == FloatBinary::Multiply && a == b {
            return self.emit(frame, k, |dst| Op::FloatUnary {
                op: FloatUnary::Square,
                w,
                dst,
                a,
            });
        }
        let row = self.reorderable(frame, op, w, a, b)?;
        if op == FloatBinary::Divide {
            return self.over_length(frame, w, row, a, b);
        }
        Ok(row)
    }

    fn product(
        &mut self,
        frame: &mut Frame<'m>,
        w: Width,
        shapes: (Shape, Shape),
        a: &[Row],
        b: &[Row],
    ) -> Result<Val> {
        match shapes {
            (Shape::Matrix { columns, rows }, Shape::Vector(_)) => {
                self.matrix_vector(frame, w, (columns, rows), a, b)
            }
            (Shape::Vector(n), Shape::Matrix { .. }) => {
                let mut out = Vec::new();
                for column in b.chunks(n) {
                    out.push(self.dot(frame, w, a, column)?);
                }
                Ok(Val::Rows(out))
            }
            (Shape::Matrix { columns, rows }, Shape::Matrix { .. }) => {
                let mut out = Vec::new();
                for column in b.chunks(columns) {
                    out.extend(
                        self.matrix_vector(frame, w, (columns, rows), a, column)?
                            .rows(Span::UNDEFINED)?,
                    );
                }
                Ok(Val::Rows(out))
            }
            (Shape::Scalar, _) | (_, Shape::Scalar) | (Shape::Vector(_), Shape::Vector(_)) => {
                self.scaled(frame, w, a, b)
            }
        }
    }

    fn scaled(&mut self, frame: &mut Frame<'m>, w: Width, a: &[Row], b: &[Row]) -> Result<Val> {
        let n = a.len().max(b.len());
        let mut out = Vec::with_capacity(n);
        for i in 0..n {
            let (x, y) = (a[i.min(a.len() - 1)], b[i.min(b.len() - 1)]);
            out.push(self.float_binary(frame, FloatBinary::Multiply, w, x, y)?);
        }
        Ok(Val::Rows(out))
    }

    fn matrix_vector(
        &mut self,
        frame: &mut Frame<'m>,
        w: Width,
        (columns, rows): (usize, usize),
        m: &[Row],
        v: &[Row],
    ) -> Result<Val> {
        let mut out = Vec::with_capacity(rows);
        for r in 0..rows {
            let line: Vec<Row> = (0..columns).map(|c| m[c * rows + r]).collect();
            out.push(self.dot(frame, w, &line, v)?);
        }
        Ok(Val::Rows(out))
    }

    /// The sum of the products of two lists of floats.
    pub(crate) fn dot(&mut self, frame: &mut Frame<'m>, w: Width, a: &[Row], b: &[Row]) -> Result<Row> {
        let mut products = Vec::with_capacity(a.len());
        for (&x, &y) in a.iter().zip(b) {
            products.push(self.float_binary(frame, FloatBinary::Multiply, w, x, y)?);
        }
        self.sum(frame, w, &products)
    }

    /// The sum of up to four floats.
    pub(crate) fn sum(&mut self, frame: &mut Frame<'m>, w: Width, list: &[Row]) -> Result<Row> {
        if let [only] = list {
            return Ok(*only);
        }
        let mut terms = [list[0]; 4];
        terms[..list.len()].copy_from_slice(list);
        let row = self.emit(frame, Kind::Float(w), |dst| Op::Sum {
            w,
            dst,
            terms,
            n: list.len() as u8,
        })?;
        self.chains.sum_of(row, list);
        Ok(row)
    }
}

fn comparison(op: BinaryOperator) -> Option<Compare> {
    match op {
        BinaryOperator::Equal => Some(Compare::Equal),
        BinaryOperator::NotEqual => Some(Compare::NotEqual),
        BinaryOperator::Less => Some(Compare::Less),
        BinaryOperator::LessEqual => Some(Compare::LessEqual),
        BinaryOperator::Greater => Some(Compare::Greater),
        BinaryOperator::GreaterEqual => Some(Compare::GreaterEqual),
        BinaryOperator::Add
        | BinaryOperator::Subtract
        | BinaryOperator::Multiply
        | BinaryOperator::Divide
        | BinaryOperator::Modulo
        | BinaryOperator::And
        | BinaryOperator::ExclusiveOr
        | BinaryOperator::InclusiveOr
        | BinaryOperator::LogicalAnd
        | BinaryOperator::LogicalOr
        | BinaryOperator::ShiftLeft
        | BinaryOperator::ShiftRight => None,
    }
}

fn float_operator(op: BinaryOperator) -> Option<FloatBinary> {
    match op {
        BinaryOperator::Add => Some(FloatBinary::Add),
        BinaryOperator::Subtract => Some(FloatBinary::Subtract),
        BinaryOperator::Multiply => Some(FloatBinary::Multiply),
        BinaryOperator::Divide => Some(FloatBinary::Divide),
        BinaryOperator::Modulo => Some(FloatBinary::Remainder),
        BinaryOperator::Equal
        | BinaryOperator::NotEqual
        | BinaryOperator::Less
        | BinaryOperator::LessEqual
        | BinaryOperator::Greater
        | BinaryOperator::GreaterEqual
        | BinaryOperator::And
        | BinaryOperator::ExclusiveOr
        | BinaryOperator::InclusiveOr
        | BinaryOperator::LogicalAnd
        | BinaryOperator::LogicalOr
        | BinaryOperator::ShiftLeft
        | BinaryOperator::ShiftRight => None,
    }
}

fn int_operator(op: BinaryOperator) -> Option<IntBinary> {
    match op {
        BinaryOperator::Add => Some(IntBinary::Add),
        BinaryOperator::Subtract => Some(IntBinary::Subtract),
        BinaryOperator::Multiply => Some(IntBinary::Multiply),
        BinaryOperator::Divide => Some(IntBinary::Divide),
        BinaryOperator::Modulo => Some(IntBinary::Remainder),
        BinaryOperator::And => Some(IntBinary::And),
        BinaryOperator::ExclusiveOr => Some(IntBinary::Xor),
        BinaryOperator::InclusiveOr => Some(IntBinary::Or),
        BinaryOperator::ShiftLeft => Some(IntBinary::ShiftLeft),
        BinaryOperator::ShiftRight => Some(IntBinary::ShiftRight),
        BinaryOperator::Equal
        | BinaryOperator::NotEqual
        | BinaryOperator::Less
        | BinaryOperator::LessEqual
        | BinaryOperator::Greater
        | BinaryOperator::GreaterEqual
        | BinaryOperator::LogicalAnd
        | BinaryOperator::LogicalOr => None,
    }
}

fn bool_operator(op: BinaryOperator) -> Option<BoolBinary> {
    match op {
        BinaryOperator::And | BinaryOperator::LogicalAnd => Some(BoolBinary::And),
        BinaryOperator::InclusiveOr | BinaryOperator::LogicalOr => Some(BoolBinary::Or),
        BinaryOperator::ExclusiveOr => Some(BoolBinary::NotEqual),
        BinaryOperator::Add
        | BinaryOperator::Subtract
        | BinaryOperator::Multiply
        | BinaryOperator::Divide
        | BinaryOperator::Modulo
        | BinaryOperator::Equal
        | BinaryOperator::NotEqual
        | BinaryOperator::Less
        | BinaryOperator::LessEqual
        | BinaryOperator::Greater
        | BinaryOperator::GreaterEqual
        | BinaryOperator::ShiftLeft
        | BinaryOperator::ShiftRight => None,
    }
}
