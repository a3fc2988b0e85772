//! What a condition says of the floats it compares: which comparisons hold where it is true, and which where it is false.
//!
//! Known by the row of the condition. An undecided invocation that goes both ways knows them on either way
//! (`exec::narrow`): behind `if (x < 1e-6) { return 0.0; }` stands an `x` of at least 1e-6, whatever its interval was.
//! A negated comparison is the opposite one: where a NaN may be, nothing is narrowed.

use super::code::{Op, Row};
use crate::domain::ops::{BoolBinary, Compare};
use crate::width::Width;
use std::collections::BTreeMap;

/// `a op b`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Fact {
    pub(crate) op: Compare,
    pub(crate) w: Width,
    pub(crate) a: Row,
    pub(crate) b: Row,
}

/// What holds where a condition does, and where it does not.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(crate) struct Facts {
    pub(crate) accept: Vec<Fact>,
    pub(crate) reject: Vec<Fact>,
}

/// The facts of all conditions of a program, by their rows.
pub(crate) type FactsByRow = BTreeMap<Row, Facts>;

/// Notes what an instruction says, if it makes a condition.
pub(crate) fn note(facts: &mut FactsByRow, op: &Op) {
    let of = |row: &Row| facts.get(row).cloned().unwrap_or_default();
    let (dst, new) = match op {
        Op::FloatCompare { op, w, dst, a, b } => {
            let (w, a, b) = (*w, *a, *b);
            let fact = |op| Fact { op, w, a, b };
            let new = Facts {
                accept: vec![fact(*op)],
                reject: vec![fact(opposite(*op))],
            };
            (dst, new)
        }
        Op::Not { dst, a } => {
            let Facts { accept, reject } = of(a);
            let swapped = Facts {
                accept: reject,
                reject: accept,
            };
            (dst, swapped)
        }
        Op::BoolBinary { op, dst, a, b } => {
            let (a, b) = (of(a), of(b));
            let both = match op {
                BoolBinary::And => Facts {
                    accept: [a.accept, b.accept].concat(),
                    ..Facts::default()
                },
                BoolBinary::Or => Facts {
                    reject: [a.reject, b.reject].concat(),
                    ..Facts::default()
                },
                BoolBinary::Equal | BoolBinary::NotEqual => Facts::default(),
            };
            (dst, both)
        }
        Op::Copy { .. }
        | Op::FloatUnary { .. }
        | Op::FloatBinary { .. }
        | Op::FloatTernary { .. }
        | Op::Sum { .. }
        | Op::Chain(_)
        | Op::Unit(_)
        | Op::FrexpExponent { .. }
        | Op::Ldexp { .. }
        | Op::IsNan { .. }
        | Op::IsInf { .. }
        | Op::IntUnary { .. }
        | Op::IntBinary { .. }
        | Op::IntCompare { .. }
        | Op::Select { .. }
        | Op::Convert { .. }
        | Op::ToBits { .. }
        | Op::FromBits { .. }
        | Op::Pick(_)
        | Op::Load(_)
        | Op::Store(_)
        | Op::ArrayLength { .. }
        | Op::Derivative { .. }
        | Op::Pack(_)
        | Op::Unpack(_)
        | Op::Atomic(_)
        | Op::Sample(_)
        | Op::ImageLoad(_)
        | Op::ImageStore(_)
        | Op::ImageQuery(_)
        | Op::Subgroup(_) => return,
    };
    if !(new.accept.is_empty() && new.reject.is_empty()) {
        facts.insert(*dst, new);
    }
}

fn opposite(op: Compare) -> Compare {
    match op {
        Compare::Equal => Compare::NotEqual,
        Compare::NotEqual => Compare::Equal,
        Compare::Less => Compare::GreaterEqual,
        Compare::LessEqual => Compare::Greater,
        Compare::Greater => Compare::LessEqual,
        Compare::GreaterEqual => Compare::Less,
    }
}
