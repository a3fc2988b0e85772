//! Another arithmetic operator: + and −, × and ÷ for each other, in expressions and in assignments.

use wesl::syntax::{AssignmentOperator, BinaryOperator, Statement};

use super::{Operator, binary, put, with_operator};
use crate::mutant::Change;
use crate::syntax::Node;

pub(super) const OPERATOR: Operator = Operator {
    name: "swap_arithmetic",
    about: "+ and -, * and / swapped; % becomes *; ++ and -- swapped",
    changes,
};

fn changes(node: &Node<'_>, text: &str) -> Vec<Change> {
    if let Some((it, _)) = binary(node) {
        return swapped(it.operator)
            .map(|other| with_operator(it, text, &other))
            .into_iter()
            .collect();
    }
    match node {
        Node::Statement { syntax, range, .. } => statement(syntax, range.end, text).into_iter().collect(),
        Node::Expression { .. } => Vec::new(),
    }
}

fn swapped(operator: BinaryOperator) -> Option<BinaryOperator> {
    match operator {
        BinaryOperator::Addition => Some(BinaryOperator::Subtraction),
        BinaryOperator::Subtraction => Some(BinaryOperator::Addition),
        BinaryOperator::Multiplication => Some(BinaryOperator::Division),
        BinaryOperator::Division | BinaryOperator::Remainder => Some(BinaryOperator::Multiplication),
        BinaryOperator::ShortCircuitOr
        | BinaryOperator::ShortCircuitAnd
        | BinaryOperator::Equality
        | BinaryOperator::Inequality
        | BinaryOperator::LessThan
        | BinaryOperator::LessThanEqual
        | BinaryOperator::GreaterThan
        | BinaryOperator::GreaterThanEqual
        | BinaryOperator::BitwiseOr
        | BinaryOperator::BitwiseAnd
        | BinaryOperator::BitwiseXor
        | BinaryOperator::ShiftLeft
        | BinaryOperator::ShiftRight => None,
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
