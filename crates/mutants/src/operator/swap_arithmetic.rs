//! Another arithmetic operator: + and −, × and ÷ for each other, in expressions and in assignments.

use wesl::syntax::{AssignmentOperator, BinaryOperator, Statement};

use super::{Operator, Swaps, put, swapped};
use crate::mutant::Change;
use crate::syntax::Node;

pub(super) const OPERATOR: Operator = Operator {
    name: "swap_arithmetic",
    about: "+ and -, * and / swapped; % becomes *; ++ and -- swapped",
    changes,
};

/// What stands in place of each operator.
pub(super) const SWAPS: Swaps = &[
    (BinaryOperator::Addition, &[BinaryOperator::Subtraction]),
    (BinaryOperator::Subtraction, &[BinaryOperator::Addition]),
    (BinaryOperator::Multiplication, &[BinaryOperator::Division]),
    (BinaryOperator::Division, &[BinaryOperator::Multiplication]),
    (BinaryOperator::Remainder, &[BinaryOperator::Multiplication]),
];

fn changes(node: &Node<'_>, text: &str) -> Vec<Change> {
    match node {
        Node::Statement { syntax, range, .. } => statement(syntax, range.end, text).into_iter().collect(),
        Node::Expression { .. } => swapped(node, text, SWAPS),
    }
}

fn statement(syntax: &Statement, end: usize, text: &str) -> Option<Change> {
    match syntax {
        Statement::Assignment(it) => {
            let other = assigned(it.operator)?;
            let between = it.lhs.span().end..it.rhs.span().start;
            let changed = text[between.clone()].replacen(&it.operator.to_string(), other, 1);
            Some(put(&between, changed))
        }
        Statement::Increment(it) => {
            let after = it.expression.span().end..end;
            Some(put(&after, text[after.clone()].replacen("++", "--", 1)))
        }
        Statement::Decrement(it) => {
            let after = it.expression.span().end..end;
            Some(put(&after, text[after.clone()].replacen("--", "++", 1)))
        }
        Statement::Void
        | Statement::Compound(_)
        | Statement::If(_)
        | Statement::Switch(_)
        | Statement::Loop(_)
        | Statement::For(_)
        | Statement::While(_)
        | Statement::Break(_)
        | Statement::Continue(_)
        | Statement::Return(_)
        | Statement::Discard(_)
        | Statement::FunctionCall(_)
        | Statement::ConstAssert(_)
        | Statement::Declaration(_) => None,
    }
}

fn assigned(operator: AssignmentOperator) -> Option<&'static str> {
    match operator {
        AssignmentOperator::PlusEqual => Some("-="),
        AssignmentOperator::MinusEqual => Some("+="),
        AssignmentOperator::TimesEqual => Some("/="),
        AssignmentOperator::DivisionEqual | AssignmentOperator::ModuloEqual => Some("*="),
        AssignmentOperator::Equal
        | AssignmentOperator::AndEqual
        | AssignmentOperator::OrEqual
        | AssignmentOperator::XorEqual
        | AssignmentOperator::ShiftRightAssign
        | AssignmentOperator::ShiftLeftAssign => None,
    }
}

#[cfg(test)]
mod tests {
    use super::OPERATOR;
    use crate::operator::testing::{expressions, lines};

    #[test]
    fn each_operator_in_its_place() {
        assert_eq!(expressions(&OPERATOR, "a + b * -c"), ["a - b * -c", "a + b / -c"]);
        assert_eq!(
            expressions(&OPERATOR, "(a - b) / c"),
            ["(a - b) * c", "(a + b) / c"]
        );
        assert_eq!(expressions(&OPERATOR, "a % n"), ["a * n"]);
        assert!(expressions(&OPERATOR, "a < b && c == (d | e)").is_empty());
    }

    #[test]
    fn assignments_too() {
        assert_eq!(lines(&OPERATOR, "fn f() { a += 1.0; }"), ["fn f() { a -= 1.0; }"]);
        let text = "fn f() { for (;; i++) { } }";
        assert_eq!(lines(&OPERATOR, text), ["fn f() { for (;; i--) { } }"]);
        assert!(lines(&OPERATOR, "fn f() { a = b; }").is_empty());
    }
}
