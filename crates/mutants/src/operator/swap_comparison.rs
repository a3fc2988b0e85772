//! Another comparison: with or without the boundary, and the other way round.

use wesl::syntax::BinaryOperator;

use super::{Operator, binary, with_operator};
use crate::mutant::Change;
use crate::syntax::Node;

pub(super) const OPERATOR: Operator = Operator {
    name: "swap_comparison",
    about: "< and <=, > and >= swapped; each comparison inverted",
    changes,
};

fn changes(node: &Node<'_>, text: &str) -> Vec<Change> {
    let Some((it, _)) = binary(node) else {
        return Vec::new();
    };
    let others = others(it.operator);
    others
        .iter()
        .map(|other| with_operator(it, text, other))
        .collect()
}

/// First the boundary moved, then the comparison inverted.
fn others(operator: BinaryOperator) -> &'static [BinaryOperator] {
    match operator {
        BinaryOperator::LessThan => &[BinaryOperator::LessThanEqual, BinaryOperator::GreaterThanEqual],
        BinaryOperator::LessThanEqual => &[BinaryOperator::LessThan, BinaryOperator::GreaterThan],
        BinaryOperator::GreaterThan => &[BinaryOperator::GreaterThanEqual, BinaryOperator::LessThanEqual],
        BinaryOperator::GreaterThanEqual => &[BinaryOperator::GreaterThan, BinaryOperator::LessThan],
        BinaryOperator::Equality => &[BinaryOperator::Inequality],
        BinaryOperator::Inequality => &[BinaryOperator::Equality],
        BinaryOperator::ShortCircuitOr
        | BinaryOperator::ShortCircuitAnd
        | BinaryOperator::Addition
        | BinaryOperator::Subtraction
        | BinaryOperator::Multiplication
        | BinaryOperator::Division
        | BinaryOperator::Remainder
        | BinaryOperator::BitwiseOr
        | BinaryOperator::BitwiseAnd
        | BinaryOperator::BitwiseXor
        | BinaryOperator::ShiftLeft
        | BinaryOperator::ShiftRight => &[],
    }
}

#[cfg(test)]
mod tests {
    use super::OPERATOR;
    use crate::operator::testing::expressions;

    #[test]
    fn the_boundary_and_the_inverse() {
        assert_eq!(expressions(&OPERATOR, "a < b"), ["a <= b", "a >= b"]);
        assert_eq!(expressions(&OPERATOR, "a >= b"), ["a > b", "a < b"]);
        assert_eq!(expressions(&OPERATOR, "a == b"), ["a != b"]);
        assert!(expressions(&OPERATOR, "a << b").is_empty());
    }
}
