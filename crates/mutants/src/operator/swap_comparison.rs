//! Another comparison: with or without the boundary, and the other way round.

use wesl::syntax::BinaryOperator;

use super::{Operator, Swaps, swapped};
use crate::mutant::Change;
use crate::syntax::Node;

pub(super) const OPERATOR: Operator = Operator {
    name: "swap_comparison",
    about: "< and <=, > and >= swapped; each comparison inverted",
    changes,
};

/// What stands in place of each operator: first the boundary moved, then the comparison inverted.
pub(super) const SWAPS: Swaps = &[
    (
        BinaryOperator::LessThan,
        &[BinaryOperator::LessThanEqual, BinaryOperator::GreaterThanEqual],
    ),
    (
        BinaryOperator::LessThanEqual,
        &[BinaryOperator::LessThan, BinaryOperator::GreaterThan],
    ),
    (
        BinaryOperator::GreaterThan,
        &[BinaryOperator::GreaterThanEqual, BinaryOperator::LessThanEqual],
    ),
    (
        BinaryOperator::GreaterThanEqual,
        &[BinaryOperator::GreaterThan, BinaryOperator::LessThan],
    ),
    (BinaryOperator::Equality, &[BinaryOperator::Inequality]),
    (BinaryOperator::Inequality, &[BinaryOperator::Equality]),
];

fn changes(node: &Node<'_>, text: &str) -> Vec<Change> {
    swapped(node, text, SWAPS)
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
