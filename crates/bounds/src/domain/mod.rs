//! What a number domain must be able to do.
//!
//! A domain gives a meaning to the scalars of a shader: one IEEE value ([`F32`](crate::F32)), the real-number formula
//! ([`F64`](crate::F64)), the set of values an implementation may return ([`Accept`](crate::Accept)), the values reachable from
//! declared input ranges ([`Range`](crate::Range)). The evaluator above it moves [`Domain::Cell`]s about and never looks inside.
//!
//! A cell is untyped; the evaluator knows the [`Kind`] of every cell at compile time and passes it where it matters.

pub(crate) mod integer;
pub mod ops;
pub(crate) mod point;

use crate::kind::{IntType, Kind};
use crate::width::Width;
use ops::{BoolBinary, Compare, FloatBinary, FloatTernary, FloatUnary, IntBinary, IntUnary};

/// A truth value that may be open.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Truth {
    /// Certainly false.
    False,
    /// Certainly true.
    True,
    /// Either.
    Maybe,
}

impl Truth {
    /// The truth of a decided condition.
    #[inline(always)]
    pub const fn from_bool(b: bool) -> Self {
        if b { Self::True } else { Self::False }
    }

    /// What is known when either of two cases may hold.
    pub fn hull(self, other: Self) -> Self {
        if self == other { self } else { Self::Maybe }
    }
}

/// One component of a vector that is divided by its length.
#[derive(Clone, Copy, Debug)]
pub struct Component<C> {
    /// As it is squared and divided by the length.
    pub scaled: C,
    /// As it was before all were divided by one divisor; the same as `scaled` where none was.
    pub whole: C,
    /// Whether it may be a product, which another use may reassociate.
    pub product: bool,
}

/// A vector that is divided by its length.
#[derive(Clone, Copy, Debug)]
pub struct OverLength<'a, C> {
    /// The sum of squares.
    pub sum: C,
    /// The components.
    pub components: &'a [Component<C>],
    /// What they were divided by before.
    pub divisor: Option<C>,
    /// Which component's quotient is meant.
    pub at: usize,
}

/// A number domain. Sealed: the evaluator relies on the laws below.
///
/// Laws: for every operation, if the argument cells contain the arguments of a machine's operation, the result cell contains the
/// result (for point domains: is the domain's own result); [`Domain::hull`] contains both arguments.
pub trait Domain: sealed::Sealed + Copy + PartialEq + std::fmt::Debug + Send + Sync + 'static {
    /// One scalar of any kind.
    type Cell: Copy + Default + PartialEq + std::fmt::Debug + Send + Sync + 'static;
    /// A float as callers see it.
    type Float: Copy + PartialEq + std::fmt::Debug + Send + Sync + 'static;
    /// Whether a condition can be open, so that invocations may fork.
    const UNCERTAIN: bool;
    /// Whether sums and products may be computed in another order than they are written in.
    const REORDERS: bool;
    /// The name used in reports.
    const NAME: &'static str;

    /// The cell of one exactly known float (subnormal values may count as zero where the domain says so).
    fn float(w: Width, x: f64) -> Self::Cell;
    /// The cell of one exactly known integer.
    fn int(t: IntType, x: i128) -> Self::Cell;
    /// The cell of a known truth value.
    fn bool(b: bool) -> Self::Cell;
    /// The float in a cell, for the caller.
    fn to_float(c: Self::Cell) -> Self::Float;
    /// The cell of a float that the caller gives.
    fn from_float(w: Width, x: Self::Float) -> Self::Cell;

    /// Bounds of a float; both ends are NaN where nothing is known.
    fn float_bounds(c: Self::Cell) -> (f64, f64);
    /// Bounds of an integer.
    fn int_bounds(t: IntType, c: Self::Cell) -> (i128, i128);
    /// The truth in a cell.
    fn truth(c: Self::Cell) -> Truth;
    /// The integers `lo..=hi`, each of which must be a value of the type.
    fn int_range(t: IntType, lo: i128, hi: i128) -> Self::Cell;
    /// The float that results when real numbers in `[lo, hi]` are rounded to the format; point domains round `lo`.
    fn real(w: Width, lo: f64, hi: f64) -> Self::Cell;
    /// A value that the language leaves open (an *indeterminate value*); point domains pick zero, floats NaN.
    fn indeterminate(kind: Kind) -> Self::Cell;
    /// A value given up on because a limit was reached.
    fn undecided(kind: Kind) -> Self::Cell;
    /// A cell that contains both.
    fn hull(kind: Kind, a: Self::Cell, b: Self::Cell) -> Self::Cell;

    /// A float function of one argument.
    fn unary(op: FloatUnary, w: Width, a: Self::Cell) -> Self::Cell;
    /// A float function of two arguments.
    fn binary(op: FloatBinary, w: Width, a: Self::Cell, b: Self::Cell) -> Self::Cell;
    /// A float function of three arguments.
    fn ternary(op: FloatTernary, w: Width, a: Self::Cell, b: Self::Cell, c: Self::Cell) -> Self::Cell;
    /// The sum of two to four terms, in any order of additions an implementation may choose.
    fn sum(w: Width, terms: &[Self::Cell]) -> Self::Cell;
    /// What a sum (or difference) or a product that came out as `written` may be in any order of its terms, of which there are
    /// more than two. Asked only of a domain that [`Domain::REORDERS`].
    fn reordered(op: FloatBinary, w: Width, written: Self::Cell, terms: &[Self::Cell]) -> Self::Cell;
    /// What `quotient` may be, given that it is a component of a vector over the vector's length. Asked only of a domain that
    /// [`Domain::REORDERS`]; the others have nothing to add.
    fn over_length(_w: Width, quotient: Self::Cell, _vector: &OverLength<'_, Self::Cell>) -> Self::Cell {
        quotient
    }
    /// A comparison of floats.
    fn compare(op: Compare, w: Width, a: Self::Cell, b: Self::Cell) -> Self::Cell;
    /// What two floats are where a comparison of them holds that could go either way. `products` tells which of them may be a
    /// product, of which other uses may not be rounded.
    fn narrow(
        op: Compare,
        w: Width,
        a: Self::Cell,
        b: Self::Cell,
        products: [bool; 2],
    ) -> (Self::Cell, Self::Cell);
    /// A cell that contains both parts of what [`Domain::narrow`] has divided, as it was before.
    fn unite(a: Self::Cell, b: Self::Cell) -> Self::Cell;
    /// The exponent that `frexp` returns, as an `i32`.
    fn frexp_exponent(w: Width, a: Self::Cell) -> Self::Cell;
    /// `x * 2^e` for an `i32` exponent.
    fn ldexp(w: Width, x: Self::Cell, e: Self::Cell) -> Self::Cell;

    /// An integer function of one argument.
    fn int_unary(op: IntUnary, t: IntType, a: Self::Cell) -> Self::Cell;
    /// An integer function of two arguments (the second of a shift is a `u32`).
    fn int_binary(op: IntBinary, t: IntType, a: Self::Cell, b: Self::Cell) -> Self::Cell;
    /// A comparison of integers.
    fn int_compare(op: Compare, t: IntType, a: Self::Cell, b: Self::Cell) -> Self::Cell;
    /// Logical negation.
    fn not(a: Self::Cell) -> Self::Cell;
    /// A function of two truth values.
    fn bool_binary(op: BoolBinary, a: Self::Cell, b: Self::Cell) -> Self::Cell;
    /// `accept` where the condition holds, else `reject`.
    fn select(kind: Kind, condition: Self::Cell, accept: Self::Cell, reject: Self::Cell) -> Self::Cell;

    /// A value conversion by the rules of WGSL.
    fn convert(from: Kind, to: Kind, a: Self::Cell) -> Self::Cell;
    /// The bit pattern of a scalar as an unsigned integer of its size.
    fn to_bits(from: Kind, a: Self::Cell) -> Self::Cell;
    /// The scalar with the given bit pattern (an unsigned integer of its size).
    fn from_bits(to: Kind, a: Self::Cell) -> Self::Cell;
}

pub(crate) mod sealed {
    /// Keeps [`super::Domain`] closed.
    pub trait Sealed {}
}
