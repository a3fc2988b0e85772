//! Integer arithmetic of WGSL on exact numbers: wrapping, the rule for division by zero, masked shifts, bit built-ins.
//!
//! Numbers are mathematical integers in an `i128`; arguments and results are values of the type.

use super::ops::{Compare, IntBinary, IntUnary};
use crate::kind::IntType;

/// `op(a)`.
#[inline(always)]
pub(crate) fn unary(op: IntUnary, t: IntType, a: i128) -> i128 {
    match op {
        IntUnary::Negate => t.wrap(-a),
        IntUnary::Not => t.wrap(!a),
        IntUnary::Abs => t.wrap(a.abs()),
        IntUnary::Sign => a.signum(),
        IntUnary::CountOneBits => i128::from(t.to_bits(a).count_ones()),
        IntUnary::CountLeadingZeros => i128::from(leading_zeros(t, t.to_bits(a))),
        IntUnary::CountTrailingZeros => i128::from(t.to_bits(a).trailing_zeros().min(t.bits)),
        IntUnary::FirstLeadingBit => first_leading_bit(t, a),
        IntUnary::FirstTrailingBit => first_trailing_bit(t, a),
        IntUnary::ReverseBits => t.wrap(i128::from(t.to_bits(a).reverse_bits() >> (64 - t.bits))),
    }
}

fn leading_zeros(t: IntType, bits: u64) -> u32 {
    bits.leading_zeros() - (64 - t.bits)
}

/// The highest bit that differs from the sign bit (signed) or is set (unsigned); minus one, wrapped, where there is none.
fn first_leading_bit(t: IntType, a: i128) -> i128 {
    let bits = t.to_bits(if t.signed && a < 0 { !a } else { a });
    if bits == 0 {
        t.wrap(-1)
    } else {
        i128::from(t.bits - 1 - leading_zeros(t, bits))
    }
}

fn first_trailing_bit(t: IntType, a: i128) -> i128 {
    let bits = t.to_bits(a);
    if bits == 0 {
        t.wrap(-1)
    } else {
        i128::from(bits.trailing_zeros())
    }
}

/// `a op b`; the second operand of a shift is taken modulo the size.
#[inline(always)]
pub(crate) fn binary(op: IntBinary, t: IntType, a: i128, b: i128) -> i128 {
    match op {
        IntBinary::Add => t.wrap(a + b),
        IntBinary::Subtract => t.wrap(a - b),
        IntBinary::Multiply => t.wrap(a.wrapping_mul(b)),
        IntBinary::Divide => divide(t, a, b),
        IntBinary::Remainder => remainder(t, a, b),
        IntBinary::And => a & b,
        IntBinary::Or => a | b,
        IntBinary::Xor => a ^ b,
        IntBinary::ShiftLeft => t.wrap(a << shift_amount(t, b)),
        IntBinary::ShiftRight => a >> shift_amount(t, b),
        IntBinary::Min => a.min(b),
        IntBinary::Max => a.max(b),
    }
}

#[inline(always)]
pub(crate) fn shift_amount(t: IntType, b: i128) -> u32 {
    (b & i128::from(t.bits - 1)) as u32
}

/// Division by zero gives the dividend, and so does the one quotient that overflows.
fn divide(t: IntType, a: i128, b: i128) -> i128 {
    match (i64::try_from(a), i64::try_from(b)) {
        (_, Ok(0)) => a,
        (Ok(a), Ok(b)) => t.wrap(i128::from(a.wrapping_div(b))),
        (Err(_), Ok(_)) | (_, Err(_)) => t.wrap(a / b),
    }
}

/// The remainder by zero, and that of the one quotient that overflows, is zero.
fn remainder(t: IntType, a: i128, b: i128) -> i128 {
    match (i64::try_from(a), i64::try_from(b)) {
        (_, Ok(0)) => 0,
        (Ok(a), Ok(b)) => t.wrap(i128::from(a.wrapping_rem(b))),
        (Err(_), Ok(_)) | (_, Err(_)) => t.wrap(a % b),
    }
}

/// A comparison of anything ordered.
#[inline(always)]
pub(crate) fn compare<T: PartialOrd>(op: Compare, a: T, b: T) -> bool {
    match op {
        Compare::Equal => a == b,
        Compare::NotEqual => a != b,
        Compare::Less => a < b,
        Compare::LessEqual => a <= b,
        Compare::Greater => a > b,
        Compare::GreaterEqual => a >= b,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const I: IntType = IntType::I32;
    const U: IntType = IntType::U32;

    #[test]
    fn arithmetic_wraps_and_division_has_its_rule() {
        assert_eq!(
            binary(IntBinary::Add, I, i128::from(i32::MAX), 1),
            i128::from(i32::MIN)
        );
        assert_eq!(binary(IntBinary::Subtract, U, 0, 1), i128::from(u32::MAX));
        assert_eq!(binary(IntBinary::Divide, I, 7, 0), 7);
        assert_eq!(
            binary(IntBinary::Divide, I, i128::from(i32::MIN), -1),
            i128::from(i32::MIN)
        );
        assert_eq!(binary(IntBinary::Remainder, I, i128::from(i32::MIN), -1), 0);
        assert_eq!(binary(IntBinary::Remainder, I, -7, 3), -1);
    }

    #[test]
    fn shifts_are_masked() {
        assert_eq!(binary(IntBinary::ShiftLeft, U, 1, 33), 2);
        assert_eq!(binary(IntBinary::ShiftRight, I, -8, 1), -4);
        // Negative control: an unmasked shift by 33 would give 0.
        assert_ne!(binary(IntBinary::ShiftLeft, U, 1, 33), 0);
    }

    #[test]
    fn bit_functions_match_the_standard_library() {
        for a in [0i32, 1, -1, 5, i32::MIN, i32::MAX, 0x00f0_1200] {
            let x = i128::from(a);
            assert_eq!(unary(IntUnary::CountOneBits, I, x), i128::from(a.count_ones()));
            assert_eq!(
                unary(IntUnary::CountLeadingZeros, I, x),
                i128::from(a.leading_zeros())
            );
            assert_eq!(
                unary(IntUnary::CountTrailingZeros, I, x),
                i128::from(a.trailing_zeros())
            );
            assert_eq!(unary(IntUnary::ReverseBits, I, x), i128::from(a.reverse_bits()));
        }
        assert_eq!(unary(IntUnary::FirstLeadingBit, I, -1), -1);
        assert_eq!(unary(IntUnary::FirstLeadingBit, I, -2), 0);
        assert_eq!(unary(IntUnary::FirstLeadingBit, U, 0), i128::from(u32::MAX));
        assert_eq!(unary(IntUnary::FirstTrailingBit, U, 8), 3);
    }
}
