//! A sign or a `!` left out.

use wesl::syntax::{Expression, UnaryOperator};

use super::{Operator, enclosed, put};
use crate::mutant::Change;
use crate::syntax::Node;

pub(super) const OPERATOR: Operator = Operator {
    name: "drop_negation",
    about: "-, ! and ~ before an operand dropped",
    changes,
};

fn changes(node: &Node<'_>, text: &str) -> Vec<Change> {
    let Node::Expression {
        syntax: Expression::Unary(it),
        range,
    } = node
    else {
        return Vec::new();
    };
    match it.operator {
        UnaryOperator::Negation | UnaryOperator::LogicalNegation | UnaryOperator::BitwiseComplement => {
            vec![put(range, enclosed(text, it.operand.span().range()))]
        }
        UnaryOperator::AddressOf | UnaryOperator::Indirection => Vec::new(),
    }
}

#[cfg(test)]
mod tests {
    use super::OPERATOR;
    use crate::operator::testing::expressions;

    #[test]
    fn the_operand_is_left() {
        assert_eq!(expressions(&OPERATOR, "a * -b.x"), ["a * (b.x)"]);
        assert_eq!(
            expressions(&OPERATOR, "!(a && !b)"),
            ["((a && !b))", "!(a && (b))"]
        );
        assert!(expressions(&OPERATOR, "*p").is_empty());
    }
}
