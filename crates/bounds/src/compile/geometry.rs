//! Built-in functions of vectors and matrices, as the formulas whose accuracy they inherit; bit fields and packed dot products as
//! integer formulas.

use super::builder::{Builder, Frame, Val};
use super::code::{Op, Pack, Packing, Row};
use super::layout::unsupported;
use super::math::Args;
use crate::domain::ops::{Compare, FloatBinary, FloatUnary, IntBinary};
use crate::error::Result;
use crate::kind::{IntType, Kind};
use crate::width::Width;

impl<'m> Builder<'m> {
    fn mul(&mut self, frame: &mut Frame<'m>, w: Width, a: Row, b: Row) -> Result<Row> {
        self.float_binary(frame, FloatBinary::Multiply, w, a, b)
    }

    fn sub(&mut self, frame: &mut Frame<'m>, w: Width, a: Row, b: Row) -> Result<Row> {
        self.float_binary(frame, FloatBinary::Subtract, w, a, b)
    }

    fn neg(&mut self, frame: &mut Frame<'m>, w: Width, a: Row) -> Result<Row> {
        self.emit(frame, Kind::Float(w), |dst| Op::FloatUnary {
            op: FloatUnary::Negate,
            w,
            dst,
            a,
        })
    }

    fn sqrt(&mut self, frame: &mut Frame<'m>, w: Width, a: Row) -> Result<Row> {
        self.emit(frame, Kind::Float(w), |dst| Op::FloatUnary {
            op: FloatUnary::Sqrt,
            w,
            dst,
            a,
        })
    }

    fn choose(
        &mut self,
        frame: &mut Frame<'m>,
        kind: Kind,
        cond: Row,
        accept: Row,
        reject: Row,
    ) -> Result<Row> {
        self.emit(frame, kind, |dst| Op::Select {
            kind,
            dst,
            cond,
            accept,
            reject,
        })
    }

    pub(crate) fn dot_product(&mut self, frame: &mut Frame<'m>, args: &Args) -> Result<Val> {
        match args.kind {
            Kind::Float(w) => Ok(Val::Rows(vec![self.dot(
                frame,
                w,
                &args.rows[0],
                &args.rows[1],
            )?])),
            Kind::Int(t) => self.int_dot(frame, t, &args.rows[0], &args.rows[1]),
            Kind::Bool => unsupported("the dot product of truth values", args.span),
        }
    }

    fn int_dot(&mut self, frame: &mut Frame<'m>, t: IntType, a: &[Row], b: &[Row]) -> Result<Val> {
        let mut total = self.int(t, 0);
        for (&x, &y) in a.iter().zip(b) {
            let p = self.int_op(frame, IntBinary::Multiply, t, x, y)?;
            total = self.int_op(frame, IntBinary::Add, t, total, p)?;
        }
        Ok(Val::Rows(vec![total]))
    }

    pub(crate) fn packed_dot(&mut self, frame: &mut Frame<'m>, args: &Args, signed: bool) -> Result<Val> {
        let t = IntType { signed, bits: 32 };
        let mut sides = Vec::new();
        for k in 0..2 {
            let parts = self.rows(frame, &[Kind::Int(t); 4]);
            let packing = Packing::Int { signed, clamp: false };
            self.push(
                frame,
                Op::Unpack(Box::new(Pack {
                    packing,
                    word: args.at(k, 0),
                    parts: parts.clone(),
                })),
            )?;
            sides.push(parts);
        }
        self.int_dot(frame, t, &sides[0], &sides[1])
    }

    pub(crate) fn outer(&mut self, frame: &mut Frame<'m>, args: &Args) -> Result<Val> {
        let w = args.width()?;
        let mut out = Vec::new();
        for &column in &args.rows[1] {
            for &row in &args.rows[0] {
                out.push(self.mul(frame, w, row, column)?);
            }
        }
        Ok(Val::Rows(out))
    }

    pub(crate) fn cross(&mut self, frame: &mut Frame<'m>, args: &Args) -> Result<Val> {
        let w = args.width()?;
        let (a, b) = (&args.rows[0], &args.rows[1]);
        let mut out = Vec::new();
        for (i, j) in [(1, 2), (2, 0), (0, 1)] {
            out.push(self.minor(frame, w, [a[i], b[j], a[j], b[i]])?);
        }
        Ok(Val::Rows(out))
    }

    /// `a * b - c * d`.
    fn minor(&mut self, frame: &mut Frame<'m>, w: Width, [a, b, c, d]: [Row; 4]) -> Result<Row> {
        let (p, q) = (self.mul(frame, w, a, b)?, self.mul(frame, w, c, d)?);
        self.sub(frame, w, p, q)
    }

    fn norm(&mut self, frame: &mut Frame<'m>, w: Width, v: &[Row]) -> Result<Row> {
        let square = self.dot(frame, w, v, v)?;
        self.sqrt(frame, w, square)
    }

    pub(crate) fn length(&mut self, frame: &mut Frame<'m>, args: &Args) -> Result<Val> {
        let w = args.width()?;
        if let [a] = args.rows[0][..] {
            // The length of a scalar is its magnitude; the inherited formula's error is the root's.
            return self.map(frame, args.kind, &[a], |dst, a| Op::FloatUnary {
                op: FloatUnary::Abs,
                w,
                dst,
                a,
            });
        }
        Ok(Val::Rows(vec![self.norm(frame, w, &args.rows[0])?]))
    }

    pub(crate) fn distance(&mut self, frame: &mut Frame<'m>, args: &Args) -> Result<Val> {
        let w = args.width()?;
        let mut difference = Vec::new();
        for i in 0..args.rows[0].len() {
            difference.push(self.sub(frame, w, args.at(0, i), args.at(1, i))?);
        }
        Ok(Val::Rows(vec![self.norm(frame, w, &difference)?]))
    }

    pub(crate) fn normalize(&mut self, frame: &mut Frame<'m>, args: &Args) -> Result<Val> {
        let w = args.width()?;
        self.code.normalises.insert(frame.span);
        let length = self.norm(frame, w, &args.rows[0])?;
        let mut out = Vec::new();
        for &a in &args.rows[0] {
            out.push(self.float_binary(frame, FloatBinary::Divide, w, a, length)?);
        }
        Ok(Val::Rows(out))
    }

    /// `select(-x, x, dot(z, y) < 0)`.
    pub(crate) fn face_forward(&mut self, frame: &mut Frame<'m>, args: &Args) -> Result<Val> {
        let w = args.width()?;
        let a = self.dot(frame, w, &args.rows[2], &args.rows[1])?;
        let b = self.float(w, 0.0);
        let cond = self.emit(frame, Kind::Bool, |dst| Op::FloatCompare {
            op: Compare::Less,
            w,
            dst,
            a,
            b,
        })?;
        let mut out = Vec::new();
        for &x in &args.rows[0] {
            let flipped = self.neg(frame, w, x)?;
            out.push(self.choose(frame, args.kind, cond, x, flipped)?);
        }
        Ok(Val::Rows(out))
    }

    /// `x - 2 * dot(x, y) * y`.
    pub(crate) fn reflect(&mut self, frame: &mut Frame<'m>, args: &Args) -> Result<Val> {
        let w = args.width()?;
        let dot = self.dot(frame, w, &args.rows[0], &args.rows[1])?;
        let two = self.float(w, 2.0);
        let twice = self.mul(frame, w, two, dot)?;
        let mut out = Vec::new();
        for i in 0..args.rows[0].len() {
            let along = self.mul(frame, w, twice, args.at(1, i))?;
            out.push(self.sub(frame, w, args.at(0, i), along)?);
        }
        Ok(Val::Rows(out))
    }

    /// `z * x - (z * dot(y, x) + sqrt(k)) * y`, zero where `k = 1 - z * z * (1 - dot(y, x) * dot(y, x))` is negative.
    pub(crate) fn refract(&mut self, frame: &mut Frame<'m>, args: &Args) -> Result<Val> {
        let w = args.width()?;
        let (one, zero, z) = (self.float(w, 1.0), self.float(w, 0.0), args.at(2, 0));
        let d = self.dot(frame, w, &args.rows[1], &args.rows[0])?;
        let dd = self.mul(frame, w, d, d)?;
        let sine = self.sub(frame, w, one, dd)?;
        let zz = self.mul(frame, w, z, z)?;
        let bent = self.mul(frame, w, zz, sine)?;
        let k = self.sub(frame, w, one, bent)?;
        let total = self.emit(frame, Kind::Bool, |dst| Op::FloatCompare {
            op: Compare::Less,
            w,
            dst,
            a: k,
            b: zero,
        })?;
        let guarded = self.float_binary(frame, FloatBinary::Max, w, k, zero)?;
        let root = self.sqrt(frame, w, guarded)?;
        let zd = self.mul(frame, w, z, d)?;
        let factor = self.sum(frame, w, &[zd, root])?;
        let mut out = Vec::new();
        for i in 0..args.rows[0].len() {
            let (p, q) = (
                self.mul(frame, w, z, args.at(0, i))?,
                self.mul(frame, w, factor, args.at(1, i))?,
            );
            let value = self.sub(frame, w, p, q)?;
            out.push(self.choose(frame, args.kind, total, zero, value)?);
        }
        Ok(Val::Rows(out))
    }

    /// The determinant by expansion along the first column. WGSL states no accuracy for it; the bounds are those of this formula.
    pub(crate) fn determinant(
        &mut self,
        frame: &mut Frame<'m>,
        args: &Args,
        (n, _): (usize, usize),
    ) -> Result<Val> {
        let w = args.width()?;
        let all: Vec<usize> = (0..n).collect();
        Ok(Val::Rows(vec![self.cofactor_sum(
            frame,
            w,
            &args.rows[0],
            n,
            &all,
            &all,
        )?]))
    }

    /// The determinant of the given columns and rows of an `n` by `n` matrix.
    fn cofactor_sum(
        &mut self,
        frame: &mut Frame<'m>,
        w: Width,
        m: &[Row],
        n: usize,
        columns: &[usize],
        rows: &[usize],
    ) -> Result<Row> {
        let at = |c: usize, r: usize| m[c * n + r];
        if let (&[c0, c1], &[r0, r1]) = (columns, rows) {
            return self.minor(frame, w, [at(c0, r0), at(c1, r1), at(c1, r0), at(c0, r1)]);
        }
        if let (&[c], &[r]) = (columns, rows) {
            return Ok(at(c, r));
        }
        let mut terms = Vec::new();
        for (i, &r) in rows.iter().enumerate() {
            let rest: Vec<usize> = rows.iter().copied().filter(|&x| x != r).collect();
            let minor = self.cofactor_sum(frame, w, m, n, &columns[1..], &rest)?;
            let term = self.mul(frame, w, at(columns[0], r), minor)?;
            terms.push(if i % 2 == 0 {
                term
            } else {
                self.neg(frame, w, term)?
            });
        }
        self.sum(frame, w, &terms)
    }

    /// The adjugate over the determinant.
    pub(crate) fn inverse(
        &mut self,
        frame: &mut Frame<'m>,
        args: &Args,
        (n, _): (usize, usize),
    ) -> Result<Val> {
        let w = args.width()?;
        let determinant = self.determinant(frame, args, (n, n))?.rows(args.span)?[0];
        let mut out = Vec::new();
        for column in 0..n {
            for row in 0..n {
                let without = |x: usize| (0..n).filter(|&k| k != x).collect::<Vec<_>>();
                let minor = self.cofactor_sum(frame, w, &args.rows[0], n, &without(row), &without(column))?;
                let signed = if (column + row) % 2 == 0 {
                    minor
                } else {
                    self.neg(frame, w, minor)?
                };
                out.push(self.float_binary(frame, FloatBinary::Divide, w, signed, determinant)?);
            }
        }
        Ok(Val::Rows(out))
    }

    /// Bits `offset .. offset + count`, both clamped to the size, with the sign extended for signed integers.
    pub(crate) fn extract_bits(&mut self, frame: &mut Frame<'m>, args: &Args) -> Result<Val> {
        let Kind::Int(t) = args.kind else {
            return unsupported("a bit field of floats", args.span);
        };
        let field = self.field(frame, t, args.at(1, 0), args.at(2, 0))?;
        let mut out = Vec::new();
        for &e in &args.rows[0] {
            let high = self.int_op(frame, IntBinary::ShiftLeft, t, e, field.left)?;
            let low = self.int_op(frame, IntBinary::ShiftRight, t, high, field.right)?;
            let zero = self.int(t, 0);
            out.push(self.choose(frame, args.kind, field.empty, zero, low)?);
        }
        Ok(Val::Rows(out))
    }

    /// Replaces bits `offset .. offset + count` by the low bits of the second argument.
    pub(crate) fn insert_bits(&mut self, frame: &mut Frame<'m>, args: &Args) -> Result<Val> {
        let Kind::Int(t) = args.kind else {
            return unsupported("a bit field of floats", args.span);
        };
        let u = IntType {
            signed: false,
            bits: t.bits,
        };
        let field = self.field(frame, t, args.at(2, 0), args.at(3, 0))?;
        let ones = self.int(u, u.max());
        let run = self.int_op(frame, IntBinary::ShiftRight, u, ones, field.right)?;
        let mask = self.int_op(frame, IntBinary::ShiftLeft, u, run, field.offset)?;
        let mask = self.emit(frame, args.kind, |dst| Op::Convert {
            from: Kind::Int(u),
            to: Kind::Int(t),
            dst,
            a: mask,
        })?;
        let mut out = Vec::new();
        for i in 0..args.rows[0].len() {
            let moved = self.int_op(frame, IntBinary::ShiftLeft, t, args.at(1, i), field.offset)?;
            let difference = self.int_op(frame, IntBinary::Xor, t, moved, args.at(0, i))?;
            let inside = self.int_op(frame, IntBinary::And, t, difference, mask)?;
            let value = self.int_op(frame, IntBinary::Xor, t, args.at(0, i), inside)?;
            out.push(self.choose(frame, args.kind, field.empty, args.at(0, i), value)?);
        }
        Ok(Val::Rows(out))
    }

    /// Shift amounts of a bit field: to its place, to the top, and down again.
    fn field(&mut self, frame: &mut Frame<'m>, t: IntType, offset: Row, count: Row) -> Result<Field> {
        let u = IntType::U32;
        let size = self.int(u, i128::from(t.bits));
        let zero = self.int(u, 0);
        let offset = self.int_op(frame, IntBinary::Min, u, offset, size)?;
        let room = self.int_op(frame, IntBinary::Subtract, u, size, offset)?;
        let count = self.int_op(frame, IntBinary::Min, u, count, room)?;
        let left = self.int_op(frame, IntBinary::Subtract, u, room, count)?;
        let right = self.int_op(frame, IntBinary::Subtract, u, size, count)?;
        let empty = self.emit(frame, Kind::Bool, |dst| Op::IntCompare {
            op: Compare::Equal,
            t: u,
            dst,
            a: count,
            b: zero,
        })?;
        Ok(Field {
            offset,
            left,
            right,
            empty,
        })
    }
}

struct Field {
    offset: Row,
    left: Row,
    right: Row,
    empty: Row,
}
