//! Integer intervals: exact on points, bounded elsewhere.
//!
//! Bounds are mathematical integers. A result that wraps as a whole stays an interval; one that wraps in part is the whole type.
//! Where no rule bounds an operation well, few enough combinations are enumerated.

use crate::domain::Truth;
use crate::domain::integer;
use crate::domain::ops::{Compare, IntBinary, IntUnary};
use crate::kind::IntType;

/// A set of integers, from the first to the second.
pub(crate) type Bounds = (i128, i128);

/// How many combinations are enumerated before a coarse bound is taken.
const ENUMERATED: i128 = 1024;

pub(crate) fn whole(t: IntType) -> Bounds {
    (t.min(), t.max())
}

/// Bounds of a mathematical result reduced into the type.
fn wrapped(t: IntType, lo: i128, hi: i128) -> Bounds {
    let (a, b) = (t.wrap(lo), t.wrap(hi));
    if hi - lo <= t.max() - t.min() && a <= b {
        (a, b)
    } else {
        whole(t)
    }
}

fn corners(f: impl Fn(i128, i128) -> i128, a: Bounds, b: Bounds) -> Bounds {
    let c = [f(a.0, b.0), f(a.0, b.1), f(a.1, b.0), f(a.1, b.1)];
    (
        c.into_iter().fold(c[0], i128::min),
        c.into_iter().fold(c[0], i128::max),
    )
}

fn union(a: Bounds, b: Bounds) -> Bounds {
    (a.0.min(b.0), a.1.max(b.1))
}

/// A function of one argument.
pub(crate) fn unary(op: IntUnary, t: IntType, a: Bounds) -> Bounds {
    if a.1 - a.0 < ENUMERATED {
        let mut values = (a.0..=a.1).map(|x| integer::unary(op, t, x));
        let first = values.next().unwrap_or(0);
        return values.fold((first, first), |b, x| union(b, (x, x)));
    }
    match op {
        IntUnary::Negate => wrapped(t, -a.1, -a.0),
        IntUnary::Not => (t.wrap(!a.1), t.wrap(!a.0)),
        IntUnary::Abs => absolute(t, a),
        IntUnary::Sign => (a.0.signum(), a.1.signum()),
        IntUnary::CountOneBits | IntUnary::CountLeadingZeros | IntUnary::CountTrailingZeros => {
            (0, i128::from(t.bits))
        }
        IntUnary::FirstLeadingBit | IntUnary::FirstTrailingBit | IntUnary::ReverseBits => whole(t),
    }
}

fn absolute(t: IntType, a: Bounds) -> Bounds {
    if a.0 >= 0 {
        a
    } else if a.0 == t.min() {
        whole(t)
    } else if a.1 <= 0 {
        (-a.1, -a.0)
    } else {
        (0, a.1.max(-a.0))
    }
}

/// A function of two arguments.
pub(crate) fn binary(op: IntBinary, t: IntType, a: Bounds, b: Bounds) -> Bounds {
    match op {
        IntBinary::Add => wrapped(t, a.0 + b.0, a.1 + b.1),
        IntBinary::Subtract => wrapped(t, a.0 - b.1, a.1 - b.0),
        IntBinary::Multiply => multiply(t, a, b),
        IntBinary::Divide => divide(t, a, b),
        IntBinary::Remainder => remainder(t, a, b),
        IntBinary::And | IntBinary::Or | IntBinary::Xor => bitwise(op, t, a, b),
        IntBinary::ShiftLeft => shift_left(t, a, b),
        IntBinary::ShiftRight => shift_right(t, a, b),
        IntBinary::Min => (a.0.min(b.0), a.1.min(b.1)),
        IntBinary::Max => (a.0.max(b.0), a.1.max(b.1)),
    }
}

fn multiply(t: IntType, a: Bounds, b: Bounds) -> Bounds {
    // The product of two u64 may exceed an i128 only beyond the whole type, where the answer is the type anyway.
    let fits = |x: Bounds| x.0 > -(1 << 62) && x.1 < (1 << 62);
    if fits(a) && fits(b) {
        let (lo, hi) = corners(|x, y| x * y, a, b);
        wrapped(t, lo, hi)
    } else if a.0 == a.1 && b.0 == b.1 {
        let x = integer::binary(IntBinary::Multiply, t, a.0, b.0);
        (x, x)
    } else {
        whole(t)
    }
}

fn divide(t: IntType, a: Bounds, b: Bounds) -> Bounds {
    let mut result: Option<Bounds> = None;
    let mut include = |x: Bounds| result = Some(result.map_or(x, |r| union(r, x)));
    if b.0 <= 0 && b.1 >= 0 {
        include(a);
    }
    if b.0 < 0 {
        include(corners(|x, y| x / y, a, (b.0, b.1.min(-1))));
    }
    if b.1 > 0 {
        include(corners(|x, y| x / y, a, (b.0.max(1), b.1)));
    }
    let (lo, hi) = result.unwrap_or(whole(t));
    if hi > t.max() { whole(t) } else { (lo, hi) }
}

fn remainder(t: IntType, a: Bounds, b: Bounds) -> Bounds {
    if a.0 == a.1 && b.0 == b.1 {
        let x = integer::binary(IntBinary::Remainder, t, a.0, b.0);
        return (x, x);
    }
    if b.0 == b.1 && b.0 != 0 && a.0 / b.0 == a.1 / b.0 && (a.0 >= 0) == (a.1 >= 0) {
        return (a.0 % b.0, a.1 % b.0);
    }
    let most = (b.0.abs().max(b.1.abs()) - 1).max(0);
    let lo = if a.0 < 0 { (-most).max(a.0) } else { 0 };
    let hi = if a.1 > 0 { most.min(a.1) } else { 0 };
    (lo, hi)
}

fn bitwise(op: IntBinary, t: IntType, a: Bounds, b: Bounds) -> Bounds {
    let (n, m) = (a.1 - a.0 + 1, b.1 - b.0 + 1);
    if n <= ENUMERATED && m <= ENUMERATED && n * m <= ENUMERATED {
        return enumerate(op, t, a, b);
    }
    if a.0 < 0 || b.0 < 0 {
        return match (op, a.0 >= 0, b.0 >= 0) {
            (IntBinary::And, true, _) => (0, a.1),
            (IntBinary::And, _, true) => (0, b.1),
            _ => whole(t),
        };
    }
    match op {
        IntBinary::And => masked(a, b),
        IntBinary::Or => (a.0.max(b.0), all_ones(a.1.max(b.1))),
        _ => (0, all_ones(a.1.max(b.1))),
    }
}

/// The least number of the form 2ᵏ − 1 that is not below `x`.
fn all_ones(x: i128) -> i128 {
    (1i128 << (128 - x.leading_zeros())) - 1
}

/// The bits that two numbers have in common. A mask that clears lower bits and none between is monotone: it rounds down.
fn masked(a: Bounds, b: Bounds) -> Bounds {
    for (x, mask) in [(a, b), (b, a)] {
        let cleared = all_ones(x.1) & !mask.0;
        if mask.0 == mask.1 && cleared & (cleared + 1) == 0 {
            return (x.0 & mask.0, x.1 & mask.0);
        }
    }
    (0, a.1.min(b.1))
}

fn enumerate(op: IntBinary, t: IntType, a: Bounds, b: Bounds) -> Bounds {
    let first = integer::binary(op, t, a.0, b.0);
    let mut result = (first, first);
    for x in a.0..=a.1 {
        for y in b.0..=b.1 {
            let v = integer::binary(op, t, x, y);
            result = union(result, (v, v));
        }
    }
    result
}

fn shift_left(t: IntType, a: Bounds, b: Bounds) -> Bounds {
    let most = i128::from(t.bits) - 1;
    let (lo, hi) = if b.0 >= 0 && b.1 <= most {
        b
    } else if b.0 == b.1 {
        (b.0 & most, b.0 & most)
    } else {
        (0, most)
    };
    let (l, h) = corners(|x, s| x << s, a, (lo, hi));
    wrapped(t, l, h)
}

fn shift_right(t: IntType, a: Bounds, b: Bounds) -> Bounds {
    let most = i128::from(t.bits) - 1;
    let (lo, hi) = if b.0 >= 0 && b.1 <= most {
        b
    } else if b.0 == b.1 {
        (b.0 & most, b.0 & most)
    } else {
        (0, most)
    };
    corners(|x, s| x >> s, a, (lo, hi))
}

/// A comparison of anything ordered, given bounds.
#[inline(always)]
pub(crate) fn compare<T: PartialOrd>(op: Compare, a: (T, T), b: (T, T)) -> Truth {
    match op {
        Compare::Equal => equal(&a, &b),
        Compare::NotEqual => negate(equal(&a, &b)),
        Compare::Less => ordered(a.1 < b.0, a.0 >= b.1),
        Compare::LessEqual => ordered(a.1 <= b.0, a.0 > b.1),
        Compare::Greater => ordered(a.0 > b.1, a.1 <= b.0),
        Compare::GreaterEqual => ordered(a.0 >= b.1, a.1 < b.0),
    }
}

#[inline(always)]
fn ordered(yes: bool, no: bool) -> Truth {
    if yes {
        Truth::True
    } else if no {
        Truth::False
    } else {
        Truth::Maybe
    }
}

fn equal<T: PartialOrd>(a: &(T, T), b: &(T, T)) -> Truth {
    ordered(a.0 == a.1 && b.0 == b.1 && a.0 == b.0, a.1 < b.0 || b.1 < a.0)
}

pub(crate) fn negate(t: Truth) -> Truth {
    match t {
        Truth::False => Truth::True,
        Truth::True => Truth::False,
        Truth::Maybe => Truth::Maybe,
    }
}

#[cfg(test)]
mod tests {
    use super::masked;

    #[test]
    fn a_mask_of_upper_bits_rounds_down() {
        assert_eq!(masked((0x1234, 0x5678), (0xff00, 0xff00)), (0x1200, 0x5600));
        assert_eq!(masked((0xf0, 0xf0), (0x1234, 0x5678)), (0, 0xf0));
        // Whole numbers of 5 and above but below 16: bit by bit.
        for mask in [0b1110, 0b1100, 0b1000, 0b1111, 0] {
            let values: Vec<i128> = (5..=13).map(|x| x & mask).collect();
            let bounds = masked((5, 13), (mask, mask));
            assert_eq!(Some(&bounds.0), values.iter().min(), "{mask:b}");
            assert_eq!(Some(&bounds.1), values.iter().max(), "{mask:b}");
        }
    }

    #[test]
    fn a_mask_with_gaps_is_bounded_only() {
        let bounds = masked((5, 13), (0b1010, 0b1010));
        assert!((5..=13).all(|x| bounds.0 <= x & 0b1010 && x & 0b1010 <= bounds.1));
        assert_eq!(bounds, (0, 0b1010));
    }
}
