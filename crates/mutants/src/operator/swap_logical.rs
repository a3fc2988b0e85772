//! Another logic: && and ||, true and false, any and all for each other.

use wesl::syntax::{BinaryOperator, Expression, LiteralExpression};

use super::{Operator, Swaps, call, put, swapped};
use crate::mutant::Change;
use crate::syntax::Node;

pub(super) const OPERATOR: Operator = Operator {
    name: "swap_logical",
    about: "&& and ||, true and false, any and all swapped",
    changes,
};

/// What stands in place of each operator.
pub(super) const SWAPS: Swaps = &[
    (BinaryOperator::ShortCircuitOr, &[BinaryOperator::ShortCircuitAnd]),
    (BinaryOperator::ShortCircuitAnd, &[BinaryOperator::ShortCircuitOr]),
];

fn changes(node: &Node<'_>, text: &str) -> Vec<Change> {
    let mut changes = swapped(node, text, SWAPS);
    changes.extend(quantified(node));
    changes.extend(literal(node));
    changes
}

fn quantified(node: &Node<'_>) -> Option<Change> {
    let (it, range) = call(node)?;
    let name = it.ty.ident.to_string();
    let other = match name.as_str() {
        "any" => "all",
        "all" => "any",
        _ => return None,
    };
    Some(put(&(range.start..range.start + name.len()), other))
}

fn literal(node: &Node<'_>) -> Option<Change> {
    match node {
        Node::Expression {
            syntax: Expression::Literal(LiteralExpression::Bool(value)),
            range,
        } => Some(put(range, (!value).to_string())),
        Node::Expression { .. } | Node::Statement { .. } => None,
    }
}

#[cfg(test)]
mod tests {
    use super::OPERATOR;
    use crate::operator::testing::expressions;

    #[test]
    fn each_in_its_place() {
        assert_eq!(
            expressions(&OPERATOR, "a && (b || true)"),
            ["a || (b || true)", "a && (b && true)", "a && (b || false)"]
        );
        assert_eq!(expressions(&OPERATOR, "any(a >= b)"), ["all(a >= b)"]);
        assert!(expressions(&OPERATOR, "(a & b) | c").is_empty());
    }
}
