//! Built-in functions. Those of single floats are instructions; those of vectors and matrices are the formulas that the accuracy
//! table says they inherit from.

use super::builder::{Builder, Frame, Val};
use super::code::{Op, Pack, Packing, Row};
use super::layout::unsupported;
use crate::domain::ops::{FloatBinary, FloatTernary, FloatUnary, IntBinary, IntUnary};
use crate::error::Result;
use crate::kind::{IntType, Kind};
use crate::width::Width;
use naga::{Expression, Handle, MathFunction as M, Span};

/// The arguments of a call, taken apart.
pub(crate) struct Args {
    pub(crate) rows: Vec<Vec<Row>>,
    pub(crate) kind: Kind,
    pub(crate) span: Span,
}

impl Args {
    /// The scalar `i` of argument `k`; a scalar argument stands for all components.
    pub(crate) fn at(&self, k: usize, i: usize) -> Row {
        self.rows[k][i.min(self.rows[k].len() - 1)]
    }

    fn len(&self) -> usize {
        self.rows.iter().map(Vec::len).max().unwrap_or(0)
    }

    pub(crate) fn width(&self) -> Result<Width> {
        match self.kind {
            Kind::Float(w) => Ok(w),
            Kind::Int(_) | Kind::Bool => unsupported("a float function of integers", self.span),
        }
    }
}

impl<'m> Builder<'m> {
    pub(crate) fn math(
        &mut self,
        frame: &mut Frame<'m>,
        fun: M,
        args: [Option<Handle<Expression>>; 4],
        span: Span,
    ) -> Result<Val> {
        let kind = match args[0] {
            Some(first) => self.kind_of(frame, first)?,
            None => return unsupported("a function without arguments", span),
        };
        let mut rows = Vec::new();
        for handle in args.into_iter().flatten() {
            rows.push(self.scalars(frame, handle)?);
        }
        let columns = self.columns(frame, args[0]);
        let args = Args { rows, kind, span };
        match fun {
            M::Abs => self.abs_or_sign(frame, &args, FloatUnary::Abs, IntUnary::Abs),
            M::Sign => self.abs_or_sign(frame, &args, FloatUnary::Sign, IntUnary::Sign),
            M::Min => self.min_or_max(frame, &args, FloatBinary::Min, IntBinary::Min),
            M::Max => self.min_or_max(frame, &args, FloatBinary::Max, IntBinary::Max),
            M::Clamp => self.clamp(frame, &args),
            M::Saturate => self.each(frame, &args, FloatUnary::Saturate),
            M::Cos => self.each(frame, &args, FloatUnary::Cos),
            M::Cosh => self.each(frame, &args, FloatUnary::Cosh),
            M::Sin => self.each(frame, &args, FloatUnary::Sin),
            M::Sinh => self.each(frame, &args, FloatUnary::Sinh),
            M::Tan => self.each(frame, &args, FloatUnary::Tan),
            M::Tanh => self.each(frame, &args, FloatUnary::Tanh),
            M::Acos => self.each(frame, &args, FloatUnary::Acos),
            M::Asin => self.each(frame, &args, FloatUnary::Asin),
            M::Atan => self.each(frame, &args, FloatUnary::Atan),
            M::Atan2 => self.pairs(frame, &args, FloatBinary::Atan2),
            M::Asinh => self.each(frame, &args, FloatUnary::Asinh),
            M::Acosh => self.each(frame, &args, FloatUnary::Acosh),
            M::Atanh => self.each(frame, &args, FloatUnary::Atanh),
            M::Radians => self.each(frame, &args, FloatUnary::Radians),
            M::Degrees => self.each(frame, &args, FloatUnary::Degrees),
            M::Ceil => self.each(frame, &args, FloatUnary::Ceil),
            M::Floor => self.each(frame, &args, FloatUnary::Floor),
            M::Round => self.each(frame, &args, FloatUnary::Round),
            M::Fract => self.each(frame, &args, FloatUnary::Fract),
            M::Trunc => self.each(frame, &args, FloatUnary::Trunc),
            M::Modf => self.modf(frame, &args),
            M::Frexp => self.frexp(frame, &args),
            M::Ldexp => self.ldexp(frame, &args),
            M::Exp => self.each(frame, &args, FloatUnary::Exp),
            M::Exp2 => self.each(frame, &args, FloatUnary::Exp2),
            M::Log => self.each(frame, &args, FloatUnary::Log),
            M::Log2 => self.each(frame, &args, FloatUnary::Log2),
            M::Pow => self.pairs(frame, &args, FloatBinary::Pow),
            M::Dot => self.dot_product(frame, &args),
            M::Dot4I8Packed => self.packed_dot(frame, &args, true),
            M::Dot4U8Packed => self.packed_dot(frame, &args, false),
            M::Outer => self.outer(frame, &args),
            M::Cross => self.cross(frame, &args),
            M::Distance => self.distance(frame, &args),
            M::Length => self.length(frame, &args),
            M::Normalize => self.normalize(frame, &args),
            M::FaceForward => self.face_forward(frame, &args),
            M::Reflect => self.reflect(frame, &args),
            M::Refract => self.refract(frame, &args),
            M::Fma => self.triples(frame, &args, FloatTernary::Fma),
            M::Mix => self.triples(frame, &args, FloatTernary::Mix),
            M::Step => self.pairs(frame, &args, FloatBinary::Step),
            M::SmoothStep => self.triples(frame, &args, FloatTernary::SmoothStep),
            M::Sqrt => self.each(frame, &args, FloatUnary::Sqrt),
            M::InverseSqrt => self.each(frame, &args, FloatUnary::InverseSqrt),
            M::Inverse => self.inverse(frame, &args, columns),
            M::Transpose => Ok(transpose(&args, columns)),
            M::Determinant => self.determinant(frame, &args, columns),
            M::QuantizeToF16 => self.each(frame, &args, FloatUnary::QuantizeToF16),
            M::CountTrailingZeros => self.each_int(frame, &args, IntUnary::CountTrailingZeros),
            M::CountLeadingZeros => self.each_int(frame, &args, IntUnary::CountLeadingZeros),
            M::CountOneBits => self.each_int(frame, &args, IntUnary::CountOneBits),
            M::ReverseBits => self.each_int(frame, &args, IntUnary::ReverseBits),
            M::FirstTrailingBit => self.each_int(frame, &args, IntUnary::FirstTrailingBit),
            M::FirstLeadingBit => self.each_int(frame, &args, IntUnary::FirstLeadingBit),
            M::ExtractBits => self.extract_bits(frame, &args),
            M::InsertBits => self.insert_bits(frame, &args),
            M::Pack4x8snorm => self.pack(frame, &args, Packing::Snorm { bits: 8 }),
            M::Pack4x8unorm => self.pack(frame, &args, Packing::Unorm { bits: 8 }),
            M::Pack2x16snorm => self.pack(frame, &args, Packing::Snorm { bits: 16 }),
            M::Pack2x16unorm => self.pack(frame, &args, Packing::Unorm { bits: 16 }),
            M::Pack2x16float => self.pack(frame, &args, Packing::Half),
            M::Pack4xI8 => self.pack(
                frame,
                &args,
                Packing::Int {
                    signed: true,
                    clamp: false,
                },
            ),
            M::Pack4xU8 => self.pack(
                frame,
                &args,
                Packing::Int {
                    signed: false,
                    clamp: false,
                },
            ),
            M::Pack4xI8Clamp => self.pack(
                frame,
                &args,
                Packing::Int {
                    signed: true,
                    clamp: true,
                },
            ),
            M::Pack4xU8Clamp => self.pack(
                frame,
                &args,
                Packing::Int {
                    signed: false,
                    clamp: true,
                },
            ),
            M::Unpack4x8snorm => self.unpack(frame, &args, Packing::Snorm { bits: 8 }),
            M::Unpack4x8unorm => self.unpack(frame, &args, Packing::Unorm { bits: 8 }),
            M::Unpack2x16snorm => self.unpack(frame, &args, Packing::Snorm { bits: 16 }),
            M::Unpack2x16unorm => self.unpack(frame, &args, Packing::Unorm { bits: 16 }),
            M::Unpack2x16float => self.unpack(frame, &args, Packing::Half),
            M::Unpack4xI8 => self.unpack(
                frame,
                &args,
                Packing::Int {
                    signed: true,
                    clamp: false,
                },
            ),
            M::Unpack4xU8 => self.unpack(
                frame,
                &args,
                Packing::Int {
                    signed: false,
                    clamp: false,
                },
            ),
        }
    }

    fn columns(&self, frame: &Frame<'m>, handle: Option<Handle<Expression>>) -> (usize, usize) {
        match handle.map(|h| self.type_of(frame, h)) {
            Some(naga::TypeInner::Matrix { columns, rows, .. }) => (*columns as usize, *rows as usize),
            Some(_) | None => (1, 1),
        }
    }

    fn each(&mut self, frame: &mut Frame<'m>, args: &Args, op: FloatUnary) -> Result<Val> {
        let w = args.width()?;
        self.map(frame, args.kind, &args.rows[0], |dst, a| Op::FloatUnary {
            op,
            w,
            dst,
            a,
        })
    }

    fn each_int(&mut self, frame: &mut Frame<'m>, args: &Args, op: IntUnary) -> Result<Val> {
        let Kind::Int(t) = args.kind else {
            return unsupported("a bit function of floats", args.span);
        };
        self.map(frame, args.kind, &args.rows[0], |dst, a| Op::IntUnary {
            op,
            t,
            dst,
            a,
        })
    }

    fn pairs(&mut self, frame: &mut Frame<'m>, args: &Args, op: FloatBinary) -> Result<Val> {
        let w = args.width()?;
        let mut out = Vec::new();
        for i in 0..args.len() {
            out.push(self.float_binary(frame, op, w, args.at(0, i), args.at(1, i))?);
        }
        Ok(Val::Rows(out))
    }

    fn triples(&mut self, frame: &mut Frame<'m>, args: &Args, op: FloatTernary) -> Result<Val> {
        let w = args.width()?;
        let mut out = Vec::new();
        for i in 0..args.len() {
            let (a, b, c) = (args.at(0, i), args.at(1, i), args.at(2, i));
            out.push(self.emit(frame, args.kind, |dst| Op::FloatTernary { op, w, dst, a, b, c })?);
        }
        Ok(Val::Rows(out))
    }

    fn abs_or_sign(
        &mut self,
        frame: &mut Frame<'m>,
        args: &Args,
        float: FloatUnary,
        int: IntUnary,
    ) -> Result<Val> {
        match args.kind {
            Kind::Float(_) => self.each(frame, args, float),
            Kind::Int(_) => self.each_int(frame, args, int),
            Kind::Bool => unsupported("the magnitude of a truth value", args.span),
        }
    }

    fn min_or_max(
        &mut self,
        frame: &mut Frame<'m>,
        args: &Args,
        float: FloatBinary,
        int: IntBinary,
    ) -> Result<Val> {
        match args.kind {
            Kind::Float(_) => self.pairs(frame, args, float),
            Kind::Int(t) => self.int_pairs(frame, args, int, t),
            Kind::Bool => unsupported("the minimum of truth values", args.span),
        }
    }

    fn int_pairs(&mut self, frame: &mut Frame<'m>, args: &Args, op: IntBinary, t: IntType) -> Result<Val> {
        let mut out = Vec::new();
        for i in 0..args.len() {
            out.push(self.int_op(frame, op, t, args.at(0, i), args.at(1, i))?);
        }
        Ok(Val::Rows(out))
    }

    pub(crate) fn int_op(
        &mut self,
        frame: &mut Frame<'m>,
        op: IntBinary,
        t: IntType,
        a: Row,
        b: Row,
    ) -> Result<Row> {
        self.emit(frame, Kind::Int(t), |dst| Op::IntBinary { op, t, dst, a, b })
    }

    fn clamp(&mut self, frame: &mut Frame<'m>, args: &Args) -> Result<Val> {
        let Kind::Int(t) = args.kind else {
            return self.triples(frame, args, FloatTernary::Clamp);
        };
        let mut out = Vec::new();
        for i in 0..args.len() {
            let low = self.int_op(frame, IntBinary::Max, t, args.at(0, i), args.at(1, i))?;
            out.push(self.int_op(frame, IntBinary::Min, t, low, args.at(2, i))?);
        }
        Ok(Val::Rows(out))
    }

    fn modf(&mut self, frame: &mut Frame<'m>, args: &Args) -> Result<Val> {
        let mut out = self.each(frame, args, FloatUnary::ModfFract)?.rows(args.span)?;
        out.extend(self.each(frame, args, FloatUnary::Trunc)?.rows(args.span)?);
        Ok(Val::Rows(out))
    }

    fn frexp(&mut self, frame: &mut Frame<'m>, args: &Args) -> Result<Val> {
        let w = args.width()?;
        let mut out = self.each(frame, args, FloatUnary::FrexpFract)?.rows(args.span)?;
        let exponent = Kind::Int(IntType::I32);
        out.extend(
            self.map(frame, exponent, &args.rows[0], |dst, a| Op::FrexpExponent {
                w,
                dst,
                a,
            })?
            .rows(args.span)?,
        );
        Ok(Val::Rows(out))
    }

    fn ldexp(&mut self, frame: &mut Frame<'m>, args: &Args) -> Result<Val> {
        let w = args.width()?;
        let mut out = Vec::new();
        for i in 0..args.len() {
            let (a, b) = (args.at(0, i), args.at(1, i));
            out.push(self.emit(frame, args.kind, |dst| Op::Ldexp { w, dst, a, b })?);
        }
        Ok(Val::Rows(out))
    }

    fn pack(&mut self, frame: &mut Frame<'m>, args: &Args, packing: Packing) -> Result<Val> {
        let parts = args.rows[0].clone();
        let word = self.emit(frame, Kind::Int(IntType::U32), |word| {
            Op::Pack(Box::new(Pack { packing, word, parts }))
        })?;
        Ok(Val::Rows(vec![word]))
    }

    fn unpack(&mut self, frame: &mut Frame<'m>, args: &Args, packing: Packing) -> Result<Val> {
        let kind = match packing {
            Packing::Int { signed, .. } => Kind::Int(IntType { signed, bits: 32 }),
            Packing::Unorm { .. } | Packing::Snorm { .. } | Packing::Half => Kind::Float(Width::F32),
        };
        let parts = self.rows(frame, &vec![kind; 32 / packing.bits() as usize]);
        let word = args.at(0, 0);
        self.push(
            frame,
            Op::Unpack(Box::new(Pack {
                packing,
                word,
                parts: parts.clone(),
            })),
        )?;
        Ok(Val::Rows(parts))
    }
}

fn transpose(args: &Args, (columns, rows): (usize, usize)) -> Val {
    let m = &args.rows[0];
    Val::Rows(
        (0..rows)
            .flat_map(|r| (0..columns).map(move |c| m[c * rows + r]))
            .collect(),
    )
}
