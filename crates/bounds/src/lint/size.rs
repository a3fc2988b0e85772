//! Powers of two made from the bits of a number, `bitcast<f32>(c - (bitcast<u32>(m) & 0x7f800000))`: with them a number is brought to size
//! exactly, where a division by it would round.
//!
//! With the exponent of m in its bits as E, that is 2^(C − E − 127) for c = C · 2²³, so that m times it lies between 2^(C − 254) and twice that. `c` is
//! recognised as 2^126 (C = 253), by which m comes to [½, 1), and a limit on the exponent's bits from above may stand between.

use super::table::{Def, Pure, Table, Vn};
use crate::domain::ops::IntBinary;

/// The bits of 2^126.
const SUM: u64 = 0x7e80_0000;
/// The bits of an exponent.
const EXPONENT: u64 = 0x7f80_0000;
/// What the exponent's bits are limited to: those of 2^125.
const LIMIT: u64 = 0x7e00_0000;
/// From here on the limit acts.
const UNLIMITED: f64 = 8.507_059_173_023_462e37;

/// A number that a factor brings to size, and whether its exponent is limited.
pub(super) struct Sized {
    pub(super) number: Vn,
    limited: bool,
}

/// What a factor brings to size.
pub(super) fn brought_to_size(table: &Table, factor: Vn) -> Option<Sized> {
    let Def::Pure(Pure::FromBits(_), bits) = table.def(factor) else {
        return None;
    };
    let exponent = with_constant(table, *bits.first()?, IntBinary::Subtract, SUM)?;
    let limit = with_constant(table, exponent, IntBinary::Min, LIMIT);
    let word = with_constant(table, limit.unwrap_or(exponent), IntBinary::And, EXPONENT)?;
    let Def::Pure(Pure::ToBits(_), of) = table.def(word) else {
        return None;
    };
    Some(Sized {
        number: *of.first()?,
        limited: limit.is_some(),
    })
}

impl Sized {
    /// How large the number is when it was brought to size, if it lies within such bounds.
    pub(super) fn largest(&self, (lo, hi): (f64, f64)) -> Option<f64> {
        match (lo >= 0.0, hi < UNLIMITED, self.limited) {
            (true, true, _) => Some(1.0),
            // Up to 2^128 times 2^-126.
            (true, false, true) => Some(4.0),
            (false, _, _) | (true, false, false) => None,
        }
    }
}

/// The other operand of an operation on integers, one operand of which is that constant (of a difference the first).
fn with_constant(table: &Table, vn: Vn, op: IntBinary, constant: u64) -> Option<Vn> {
    let Def::Pure(Pure::IntBinary(found, _), operands) = table.def(vn) else {
        return None;
    };
    let &[a, b] = &operands[..] else {
        return None;
    };
    let is = |vn: Vn| matches!(table.def(vn), Def::Constant(_, bits) if *bits == constant);
    match (*found == op, is(a), is(b)) {
        (true, true, _) => Some(b),
        (true, false, true) if op != IntBinary::Subtract => Some(a),
        _ => None,
    }
}
