//! Another operator on bits: | and &, ^ becomes |, << and >> for each other.

use wesl::syntax::BinaryOperator;

use super::{Operator, Swaps, swapped};
use crate::mutant::Change;
use crate::syntax::Node;

pub(super) const OPERATOR: Operator = Operator {
    name: "swap_bitwise",
    about: "| and &, << and >> swapped; ^ becomes |",
    changes,
};

/// What stands in place of each operator.
pub(super) const SWAPS: Swaps = &[
    (BinaryOperator::BitwiseOr, &[BinaryOperator::BitwiseAnd]),
    (BinaryOperator::BitwiseAnd, &[BinaryOperator::BitwiseOr]),
    (BinaryOperator::BitwiseXor, &[BinaryOperator::BitwiseOr]),
    (BinaryOperator::ShiftLeft, &[BinaryOperator::ShiftRight]),
    (BinaryOperator::ShiftRight, &[BinaryOperator::ShiftLeft]),
];

fn changes(node: &Node<'_>, text: &str) -> Vec<Change> {
    swapped(node, text, SWAPS)
}

#[cfg(test)]
mod tests {
    use super::OPERATOR;
    use crate::operator::testing::expressions;

    #[test]
    fn each_operator_in_its_place() {
        assert_eq!(
            expressions(&OPERATOR, "a | (b << 8u)"),
            ["a & (b << 8u)", "a | (b >> 8u)"]
        );
        assert_eq!(expressions(&OPERATOR, "a & b"), ["a | b"]);
        assert!(expressions(&OPERATOR, "a || (b && c)").is_empty());
    }
}
