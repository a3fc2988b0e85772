//! The rules: which operands make an operation go wrong.
//!
//! Each takes bounds of the operands, equal for one number and apart for a range, and says whether the operation *may* go wrong
//! somewhere between them. Operands about which nothing is known raise nothing: what made them unknown was reported there.

use crate::domain::ops::{FloatBinary, FloatTernary, FloatUnary};
use crate::texture::Bounds;
use crate::width::Width;

/// What can go wrong.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Rule {
    /// A divisor that is zero, or small enough to be flushed to it.
    DivisionByZero,
    /// The direction of a vector without length: `normalize` divides by a length that is zero, as the squares of short vectors are.
    NormaliseZero,
    /// The root of a negative number, or the inverse root of zero.
    RootDomain,
    /// The logarithm of zero or of a negative number.
    LogarithmDomain,
    /// `pow` of a base that is not positive: the language defines it through the logarithm.
    PowerDomain,
    /// `asin`, `acos`, `acosh`, `atanh` outside of their domains, `atan2(0, 0)`.
    ArcDomain,
    /// A finite operation whose result is beyond the largest number.
    Overflow,
    /// A product too small for the format, because of which an output is no number.
    Underflow,
    /// A sum whose terms cancel to nothing, because of which an output is no number.
    VanishingSum,
    /// A NaN in an output.
    NanOutput,
    /// A loop that does not end within the operation budget, or whose end could not be shown.
    UnboundedLoop,
    /// A difference that loses its digits, so that an output is off by far more than rounding.
    Cancellation,
}

impl Rule {
    /// All rules.
    pub const ALL: [Self; 12] = [
        Self::DivisionByZero,
        Self::NormaliseZero,
        Self::RootDomain,
        Self::LogarithmDomain,
        Self::PowerDomain,
        Self::ArcDomain,
        Self::Overflow,
        Self::Underflow,
        Self::VanishingSum,
        Self::NanOutput,
        Self::UnboundedLoop,
        Self::Cancellation,
    ];

    /// The stable name.
    pub const fn id(self) -> &'static str {
        match self {
            Self::DivisionByZero => "division_by_zero",
            Self::NormaliseZero => "normalise_zero",
            Self::RootDomain => "root_domain",
            Self::LogarithmDomain => "logarithm_domain",
            Self::PowerDomain => "power_domain",
            Self::ArcDomain => "arc_domain",
            Self::Overflow => "overflow",
            Self::Underflow => "underflow",
            Self::VanishingSum => "vanishing_sum",
            Self::NanOutput => "nan_output",
            Self::UnboundedLoop => "unbounded_loop",
            Self::Cancellation => "cancellation",
        }
    }

    /// What is wrong and what to do, in two sentences.
    pub const fn about(self) -> &'static str {
        match self {
            Self::DivisionByZero => {
                "this divisor can be zero; guard it with a branch, or keep it away from zero with max"
            }
            Self::NormaliseZero => {
                "this vector can be too short for a direction (below about 1e-19 its squares vanish); branch on its largest \
                 component and scale by it first"
            }
            Self::RootDomain => {
                "this root can get a number outside of its domain; clamp it with max(x, 0.0), or branch"
            }
            Self::LogarithmDomain => {
                "this logarithm can get zero or less; keep the number above the smallest normal one"
            }
            Self::PowerDomain => {
                "this power can get a base of zero or less, which the language leaves open; branch on the base"
            }
            Self::ArcDomain => "this inverse function can get a number outside of its domain; clamp it",
            Self::Overflow => {
                "this can exceed the largest number; scale before squaring, or limit what goes in"
            }
            Self::Underflow => {
                "this product vanishes while its factors do not, and what is made of it is not finite; scale the factors first"
            }
            Self::VanishingSum => {
                "these terms can cancel to nothing, and what is made of the sum is not finite; branch where nothing is left"
            }
            Self::NanOutput => "a NaN that arises here reaches an output",
            Self::UnboundedLoop => "nothing bounds this loop; give it a hard number of steps",
            Self::Cancellation => {
                "this difference can lose nearly all of its digits, and what is made of it is far off; test the loss, or \
                 compute the difference another way"
            }
        }
    }
}

/// Whether bounds say anything.
fn known((lo, hi): Bounds) -> bool {
    lo.is_finite() && hi.is_finite()
}

/// Whether a number between the bounds is zero or may be flushed to it.
fn may_vanish(w: Width, (lo, hi): Bounds) -> bool {
    lo < w.min_normal() && hi > -w.min_normal()
}

fn overflows(w: Width, (lo, hi): Bounds) -> bool {
    hi > w.max_finite() || lo < -w.max_finite()
}

/// A function of one argument.
pub(crate) fn unary(op: FloatUnary, w: Width, a: Bounds, result: Bounds) -> Option<Rule> {
    if !known(a) {
        return None;
    }
    let found = match op {
        FloatUnary::Sqrt => (a.0 < 0.0).then_some(Rule::RootDomain),
        FloatUnary::InverseSqrt => (a.0 < w.min_normal()).then_some(Rule::RootDomain),
        FloatUnary::Log | FloatUnary::Log2 => (a.0 < w.min_normal()).then_some(Rule::LogarithmDomain),
        FloatUnary::Asin | FloatUnary::Acos => (a.0 < -1.0 || a.1 > 1.0).then_some(Rule::ArcDomain),
        FloatUnary::Acosh => (a.0 < 1.0).then_some(Rule::ArcDomain),
        FloatUnary::Atanh => (a.0 <= -1.0 || a.1 >= 1.0).then_some(Rule::ArcDomain),
        FloatUnary::Negate
        | FloatUnary::Abs
        | FloatUnary::Sign
        | FloatUnary::Saturate
        | FloatUnary::Floor
        | FloatUnary::Ceil
        | FloatUnary::Round
        | FloatUnary::Trunc
        | FloatUnary::Fract
        | FloatUnary::Square
        | FloatUnary::Sin
        | FloatUnary::Cos
        | FloatUnary::Tan
        | FloatUnary::Atan
        | FloatUnary::Sinh
        | FloatUnary::Cosh
        | FloatUnary::Tanh
        | FloatUnary::Asinh
        | FloatUnary::Exp
        | FloatUnary::Exp2
        | FloatUnary::Radians
        | FloatUnary::Degrees
        | FloatUnary::QuantizeToF16
        | FloatUnary::ModfFract
        | FloatUnary::FrexpFract => None,
    };
    found.or_else(|| overflows(w, result).then_some(Rule::Overflow))
}

/// A function of two arguments.
pub(crate) fn binary(op: FloatBinary, w: Width, a: Bounds, b: Bounds, result: Bounds) -> Option<Rule> {
    let found = match op {
        FloatBinary::Divide | FloatBinary::Remainder => {
            (known(b) && may_vanish(w, b)).then_some(Rule::DivisionByZero)
        }
        FloatBinary::Pow => (known(a) && a.0 < w.min_normal()).then_some(Rule::PowerDomain),
        FloatBinary::Atan2 => {
            (known(a) && known(b) && may_vanish(w, a) && may_vanish(w, b)).then_some(Rule::ArcDomain)
        }
        FloatBinary::Add
        | FloatBinary::Subtract
        | FloatBinary::Multiply
        | FloatBinary::Min
        | FloatBinary::Max
        | FloatBinary::Step => None,
    };
    found.or_else(|| (known(a) && known(b) && overflows(w, result)).then_some(Rule::Overflow))
}

/// A function of three arguments.
pub(crate) fn ternary(op: FloatTernary, w: Width, args: [Bounds; 3], result: Bounds) -> Option<Rule> {
    let [a, b, _] = args;
    let steps = op == FloatTernary::SmoothStep && known(a) && known(b);
    if steps && may_vanish(w, (b.0 - a.1, b.1 - a.0)) {
        return Some(Rule::DivisionByZero);
    }
    (args.into_iter().all(known) && overflows(w, result)).then_some(Rule::Overflow)
}

/// The sum of terms.
pub(crate) fn sum(w: Width, terms: impl IntoIterator<Item = Bounds>, result: Bounds) -> Option<Rule> {
    (terms.into_iter().all(known) && overflows(w, result)).then_some(Rule::Overflow)
}
