//! The two point domains: `F32`, a perfect IEEE machine, and `F64`, the formula in double precision.
//!
//! Both carry every float in an `f64`. [`F32`] rounds the result of each operation to nearest in the format of the shader, so
//! that an `f32` shader gives exactly what a machine with correctly rounded operations gives: `f64` has more than twice the
//! bits of `f32` plus two, hence + − × ÷ and sqrt rounded twice equal the operation rounded once. Functions such as `sin` are
//! the platform's `f64` functions, rounded. [`F64`] does not round at all: it is what the formula says, up to 2⁻⁵³.

use super::integer;
use super::ops::{BoolBinary, Compare, FloatBinary, FloatTernary, FloatUnary, IntBinary, IntUnary};
use super::{Domain, Truth, sealed};
use crate::kind::{IntType, Kind};
use crate::width::{Width, exp2i, exponent_of};

/// IEEE arithmetic, rounded to nearest: a perfect machine, and the `embedded` route of conformance.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct F32;

/// The formula in `f64`, whatever format the shader declares.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct F64;

impl sealed::Sealed for F32 {}
impl sealed::Sealed for F64 {}

#[inline(always)]
fn f(c: u64) -> f64 {
    f64::from_bits(c)
}

#[inline(always)]
fn i(t: IntType, c: u64) -> i128 {
    if t.signed {
        i128::from(c as i64)
    } else {
        i128::from(c)
    }
}

#[inline(always)]
fn put(x: i128) -> u64 {
    x as u64
}

/// A float function of one argument on `f64`, with the roundings of the formula given by `r`.
#[inline(always)]
pub(crate) fn float_unary(op: FloatUnary, w: Width, a: f64, r: impl Fn(f64) -> f64) -> f64 {
    match op {
        FloatUnary::Negate => -a,
        FloatUnary::Abs => a.abs(),
        FloatUnary::Sign => sign(a),
        FloatUnary::Saturate => minimum(maximum(a, 0.0), 1.0),
        FloatUnary::Floor => a.floor(),
        FloatUnary::Ceil => a.ceil(),
        FloatUnary::Round => a.round_ties_even(),
        FloatUnary::Trunc => a.trunc(),
        FloatUnary::Fract => r(a - a.floor()),
        FloatUnary::Square => r(a * a),
        FloatUnary::Sqrt => r(a.sqrt()),
        FloatUnary::InverseSqrt => r(1.0 / a.sqrt()),
        FloatUnary::Sin => r(a.sin()),
        FloatUnary::Cos => r(a.cos()),
        FloatUnary::Tan => r(a.tan()),
        FloatUnary::Asin => r(a.asin()),
        FloatUnary::Acos => r(a.acos()),
        FloatUnary::Atan => r(a.atan()),
        FloatUnary::Sinh => r(a.sinh()),
        FloatUnary::Cosh => r(a.cosh()),
        FloatUnary::Tanh => r(a.tanh()),
        FloatUnary::Asinh => r(a.asinh()),
        FloatUnary::Acosh => r(a.acosh()),
        FloatUnary::Atanh => r(a.atanh()),
        FloatUnary::Exp => r(a.exp()),
        FloatUnary::Exp2 => r(a.exp2()),
        FloatUnary::Log => r(a.ln()),
        FloatUnary::Log2 => r(a.log2()),
        FloatUnary::Radians => r(a * (std::f64::consts::PI / 180.0)),
        FloatUnary::Degrees => r(a * (180.0 / std::f64::consts::PI)),
        FloatUnary::QuantizeToF16 => Width::F16.round(a),
        FloatUnary::ModfFract => r(a - a.trunc()),
        FloatUnary::FrexpFract => frexp(w, a).0,
    }
}

fn sign(a: f64) -> f64 {
    if a > 0.0 {
        1.0
    } else if a < 0.0 {
        -1.0
    } else {
        a
    }
}

/// Fraction in [0.5, 1) and exponent; zero, infinity and NaN keep exponent zero.
pub(crate) fn frexp(_w: Width, a: f64) -> (f64, i32) {
    if a == 0.0 || !a.is_finite() {
        return (a, 0);
    }
    let e = exponent_of(a.abs()) + 1;
    let half = e / 2;
    (a / exp2i(half) / exp2i(e - half), e)
}

/// `x * 2^e` in two exact steps, so that intermediate powers stay finite.
pub(crate) fn scale(x: f64, e: i32) -> f64 {
    let e = e.clamp(-4300, 4300);
    let mut x = x;
    let mut left = e;
    while left != 0 {
        let step = left.clamp(-1000, 1000);
        x *= exp2i(step);
        left -= step;
    }
    x
}

/// A float function of two arguments on `f64`, with the roundings of the formula given by `r`.
#[inline(always)]
pub(crate) fn float_binary(op: FloatBinary, a: f64, b: f64, r: impl Fn(f64) -> f64) -> f64 {
    match op {
        FloatBinary::Add => r(a + b),
        FloatBinary::Subtract => r(a - b),
        FloatBinary::Multiply => r(a * b),
        FloatBinary::Divide => r(a / b),
        FloatBinary::Remainder => r(a % b),
        FloatBinary::Min => minimum(a, b),
        FloatBinary::Max => maximum(a, b),
        FloatBinary::Atan2 => r(a.atan2(b)),
        FloatBinary::Pow => r(power(a, b)),
        FloatBinary::Step => {
            if a <= b {
                1.0
            } else {
                0.0
            }
        }
    }
}

#[inline(always)]
fn minimum(a: f64, b: f64) -> f64 {
    if b < a || a.is_nan() { b } else { a }
}

#[inline(always)]
fn maximum(a: f64, b: f64) -> f64 {
    if a < b || a.is_nan() { b } else { a }
}

/// The domain of `pow` is that of `exp2(y * log2(x))`: a negative base gives NaN, and so does 0 to the power 0.
fn power(a: f64, b: f64) -> f64 {
    if a < 0.0 || (a == 0.0 && b == 0.0) {
        f64::NAN
    } else {
        a.abs().powf(b)
    }
}

/// A float function of three arguments on `f64`, with the roundings of the formula given by `r`.
#[inline(always)]
fn float_ternary(
    op: FloatTernary,
    w: Width,
    exact: bool,
    [a, b, c]: [f64; 3],
    r: impl Fn(f64) -> f64,
) -> f64 {
    match op {
        FloatTernary::Fma => fused(w, exact, a, b, c),
        FloatTernary::Clamp => minimum(maximum(a, b), c),
        FloatTernary::Mix => r(r(a * r(1.0 - c)) + r(b * c)),
        FloatTernary::SmoothStep => {
            let t = minimum(maximum(r(r(c - a) / r(b - a)), 0.0), 1.0);
            r(r(t * t) * r(3.0 - r(2.0 * t)))
        }
    }
}

/// One rounding in the format of the shader.
fn fused(w: Width, exact: bool, a: f64, b: f64, c: f64) -> f64 {
    match w {
        Width::F32 if !exact => f64::from((a as f32).mul_add(b as f32, c as f32)),
        // The product of two f16 is exact in 22 bits and the sum in f64 is exact but for extreme exponents, where the
        // residual is far below half a unit of f16.
        Width::F16 if !exact => Width::F16.round(a.mul_add(b, c)),
        Width::F16 | Width::F32 | Width::F64 => a.mul_add(b, c),
    }
}

/// Conversion of a float to an integer type: truncated and clamped to the values the float format can represent.
pub(crate) fn float_to_int(w: Width, t: IntType, x: f64) -> i128 {
    if x.is_nan() {
        return 0;
    }
    let (lo, hi) = (
        t.min() as f64,
        w.round_down(t.max() as f64, if t.bits == 64 { -1.0 } else { 0.0 }),
    );
    let hi = hi.min(w.max_finite());
    x.trunc().clamp(lo.max(-w.max_finite()), hi) as i128
}

/// The bit pattern of a float in its format.
pub(crate) fn float_to_bits(w: Width, x: f64) -> u64 {
    match w {
        Width::F16 => u64::from(half::f16::from_f64(w.round(x)).to_bits()),
        Width::F32 => u64::from(nan_bits(x).unwrap_or((x as f32).to_bits())),
        Width::F64 => x.to_bits(),
    }
}

/// The bits of a NaN as an `f32`, sign and payload kept, which a conversion need not do.
fn nan_bits(x: f64) -> Option<u32> {
    let bits = x.to_bits();
    x.is_nan()
        .then_some(((bits >> 32) as u32 & 0x8000_0000) | 0x7fc0_0000 | ((bits >> 29) as u32 & 0x003f_ffff))
}

/// The float with a bit pattern.
pub(crate) fn float_from_bits(w: Width, bits: u64) -> f64 {
    match w {
        Width::F16 => half::f16::from_bits(bits as u16).to_f64(),
        Width::F32 => f32_from_bits(bits as u32),
        Width::F64 => f64::from_bits(bits),
    }
}

/// An `f32` by its bits; of a NaN sign and payload are kept, which a conversion need not do.
fn f32_from_bits(bits: u32) -> f64 {
    let x = f32::from_bits(bits);
    if !x.is_nan() {
        return f64::from(x);
    }
    let sign = u64::from(bits >> 31) << 63;
    f64::from_bits(sign | 0x7ff8_0000_0000_0000 | (u64::from(bits & 0x003f_ffff) << 29))
}

/// The unsigned integer type of a scalar's size.
pub(crate) fn bits_type(kind: Kind) -> IntType {
    IntType {
        signed: false,
        bits: kind.bytes() as u32 * 8,
    }
}

macro_rules! point_domain {
    ($name:ident, $label:literal, $exact:literal, $round:expr) => {
        impl Domain for $name {
            type Cell = u64;
            type Float = f64;
            const UNCERTAIN: bool = false;
            const REORDERS: bool = false;
            const NAME: &'static str = $label;

            #[inline(always)]
            fn float(_w: Width, x: f64) -> u64 {
                x.to_bits()
            }
            #[inline(always)]
            fn int(_t: IntType, x: i128) -> u64 {
                put(x)
            }
            #[inline(always)]
            fn bool(b: bool) -> u64 {
                u64::from(b)
            }
            fn to_float(c: u64) -> f64 {
                f(c)
            }
            fn from_float(w: Width, x: f64) -> u64 {
                w.round(x).to_bits()
            }
            #[inline(always)]
            fn float_bounds(c: u64) -> (f64, f64) {
                (f(c), f(c))
            }
            #[inline(always)]
            fn int_bounds(t: IntType, c: u64) -> (i128, i128) {
                (i(t, c), i(t, c))
            }
            #[inline(always)]
            fn truth(c: u64) -> Truth {
                Truth::from_bool(c != 0)
            }
            fn int_range(_t: IntType, lo: i128, _hi: i128) -> u64 {
                put(lo)
            }
            fn real(w: Width, lo: f64, _hi: f64) -> u64 {
                $round(w, lo).to_bits()
            }
            fn indeterminate(kind: Kind) -> u64 {
                match kind {
                    Kind::Float(_) => f64::NAN.to_bits(),
                    Kind::Int(_) | Kind::Bool => 0,
                }
            }
            fn undecided(kind: Kind) -> u64 {
                Self::indeterminate(kind)
            }
            fn hull(_kind: Kind, a: u64, _b: u64) -> u64 {
                a
            }
            fn narrow(_op: Compare, _w: Width, a: u64, b: u64, _products: [bool; 2]) -> (u64, u64) {
                (a, b)
            }
            fn unite(a: u64, _b: u64) -> u64 {
                a
            }
            #[inline(always)]
            fn unary(op: FloatUnary, w: Width, a: u64) -> u64 {
                float_unary(op, w, f(a), |x| $round(w, x)).to_bits()
            }
            #[inline(always)]
            fn binary(op: FloatBinary, w: Width, a: u64, b: u64) -> u64 {
                float_binary(op, f(a), f(b), |x| $round(w, x)).to_bits()
            }
            #[inline(always)]
            fn ternary(op: FloatTernary, w: Width, a: u64, b: u64, c: u64) -> u64 {
                float_ternary(op, w, $exact, [f(a), f(b), f(c)], |x| $round(w, x)).to_bits()
            }
            #[inline(always)]
            fn sum(w: Width, terms: &[u64]) -> u64 {
                let mut total = f(terms[0]);
                for &t in &terms[1..] {
                    total = $round(w, total + f(t));
                }
                total.to_bits()
            }
            fn reordered(_op: FloatBinary, _w: Width, written: u64, _terms: &[u64]) -> u64 {
                written
            }
            #[inline(always)]
            fn compare(op: Compare, _w: Width, a: u64, b: u64) -> u64 {
                u64::from(integer::compare(op, f(a), f(b)))
            }
            fn frexp_exponent(w: Width, a: u64) -> u64 {
                put(i128::from(frexp(w, f(a)).1))
            }
            fn ldexp(w: Width, x: u64, e: u64) -> u64 {
                $round(w, scale(f(x), i(IntType::I32, e) as i32)).to_bits()
            }
            #[inline(always)]
            fn int_unary(op: IntUnary, t: IntType, a: u64) -> u64 {
                put(integer::unary(op, t, i(t, a)))
            }
            #[inline(always)]
            fn int_binary(op: IntBinary, t: IntType, a: u64, b: u64) -> u64 {
                put(integer::binary(op, t, i(t, a), i(t, b)))
            }
            #[inline(always)]
            fn int_compare(op: Compare, t: IntType, a: u64, b: u64) -> u64 {
                u64::from(integer::compare(op, i(t, a), i(t, b)))
            }
            #[inline(always)]
            fn not(a: u64) -> u64 {
                a ^ 1
            }
            #[inline(always)]
            fn bool_binary(op: BoolBinary, a: u64, b: u64) -> u64 {
                match op {
                    BoolBinary::And => a & b,
                    BoolBinary::Or => a | b,
                    BoolBinary::Equal => u64::from(a == b),
                    BoolBinary::NotEqual => u64::from(a != b),
                }
            }
            #[inline(always)]
            fn select(_kind: Kind, condition: u64, accept: u64, reject: u64) -> u64 {
                if condition != 0 { accept } else { reject }
            }
            fn convert(from: Kind, to: Kind, a: u64) -> u64 {
                point_convert(from, to, a, |w, x| $round(w, x))
            }
            fn to_bits(from: Kind, a: u64) -> u64 {
                match from {
                    Kind::Float(w) => float_to_bits(w, f(a)),
                    Kind::Int(t) => t.to_bits(i(t, a)),
                    Kind::Bool => a,
                }
            }
            fn from_bits(to: Kind, a: u64) -> u64 {
                match to {
                    Kind::Float(w) => float_from_bits(w, a).to_bits(),
                    Kind::Int(t) => put(t.wrap(i128::from(a))),
                    Kind::Bool => u64::from(a != 0),
                }
            }
        }
    };
}

#[inline(always)]
fn point_convert(from: Kind, to: Kind, a: u64, r: impl Fn(Width, f64) -> f64) -> u64 {
    match (from, to) {
        (Kind::Float(_), Kind::Float(w)) => r(w, f(a)).to_bits(),
        (Kind::Float(w), Kind::Int(t)) => put(float_to_int(w, t, f(a))),
        (Kind::Float(_), Kind::Bool) => u64::from(f(a) != 0.0),
        (Kind::Int(t), Kind::Float(w)) => r(w, int_to_f64(i(t, a))).to_bits(),
        (Kind::Int(t), Kind::Int(u)) => put(u.wrap(i(t, a))),
        (Kind::Int(t), Kind::Bool) => u64::from(i(t, a) != 0),
        (Kind::Bool, Kind::Float(_)) => (a as f64).to_bits(),
        (Kind::Bool, Kind::Int(_) | Kind::Bool) => a,
    }
}

/// An integer as `f64`, to odd where it does not fit, so that a second rounding to a shorter format is the right one.
pub(crate) fn int_to_f64(x: i128) -> f64 {
    let y = x as f64;
    let back = y as i128;
    if back == x || y.to_bits() & 1 == 1 {
        y
    } else if (back > x) == (x >= 0) {
        f64::from_bits(y.to_bits() - 1)
    } else {
        f64::from_bits(y.to_bits() + 1)
    }
}

point_domain!(F32, "f32", false, |w: Width, x: f64| w.round(x));
point_domain!(F64, "f64", true, |_: Width, x: f64| x);
