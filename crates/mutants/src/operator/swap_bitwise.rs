//! Another operator on bits: | and &, ^ becomes |, << and >> for each other.

use wesl::syntax::BinaryOperator;

use super::{Operator, binary, with_operator};
use crate::mutant::Change;
use crate::syntax::Node;

pub(super) const OPERATOR: Operator = Operator {
    name: "swap_bitwise",
    about: "| and &, << and >> swapped; ^ becomes |",
    changes,
};

fn changes(node: &Node<'_>, text: &str) -> Vec<Change> {
    let change = binary(node).and_then(|(it, _)| Some(with_operator(it, text, &swapped(it.operator)?)));
    change.into_iter().collect()
}

fn swapped(operator: BinaryOperator) -> Option<BinaryOperator> {
    match operator {
        BinaryOperator::BitwiseOr => Some(BinaryOperator::BitwiseAnd),
        BinaryOperator::BitwiseAnd | BinaryOperator::BitwiseXor => Some(BinaryOperator::BitwiseOr),
        BinaryOperator::ShiftLeft => Some(BinaryOperator::ShiftRight),
        BinaryOperator::ShiftRight => Some(BinaryOperator::ShiftLeft),
        BinaryOperator::ShortCircuitOr
        | BinaryOperator::ShortCircuitAnd
        | BinaryOperator::Addition
        | BinaryOperator::Subtraction
        | BinaryOperator::Multiplication
        | BinaryOperator::Division
        | BinaryOperator::Remainder
        | BinaryOperator::Equality
        | BinaryOperator::Inequality
        | BinaryOperator::LessThan
        | BinaryOperator::LessThanEqual
        | BinaryOperator::GreaterThan
        | BinaryOperator::GreaterThanEqual => None,
    }
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
