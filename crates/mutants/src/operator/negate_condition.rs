//! A condition negated: of `if`, `else if`, `while`, `for` and `break if`.
//!
//! A condition that is one comparison or begins with `!` is left to the operators that invert those.

use wesl::syntax::{Expression, ExpressionNode, Statement, UnaryOperator};

use super::{Operator, others, put, swap_comparison};
use crate::mutant::Change;
use crate::syntax::Node;

pub(super) const OPERATOR: Operator = Operator {
    name: "negate_condition",
    about: "the condition of a branch or loop negated",
    changes,
};

fn changes(node: &Node<'_>, text: &str) -> Vec<Change> {
    let Node::Statement { syntax, .. } = node else {
        return Vec::new();
    };
    conditions(syntax)
        .into_iter()
        .filter(|condition| !inverted_elsewhere(condition.node()))
        .map(|condition| {
            let range = condition.span().range();
            put(&range, format!("(!({}))", &text[range.clone()]))
        })
        .collect()
}

fn conditions(statement: &Statement) -> Vec<&ExpressionNode> {
    match statement {
        Statement::If(it) => {
            let chained = it.else_if_clauses.iter().map(|clause| &clause.expression);
            std::iter::once(&it.if_clause.expression).chain(chained).collect()
        }
        Statement::While(it) => vec![&it.condition],
        Statement::For(it) => it.condition.iter().collect(),
        Statement::Loop(it) => {
            let ends = it
                .continuing
                .iter()
                .filter_map(|continuing| continuing.break_if.as_ref());
            ends.map(|end| &end.expression).collect()
        }
        Statement::Void
        | Statement::Compound(_)
        | Statement::Assignment(_)
        | Statement::Increment(_)
        | Statement::Decrement(_)
        | Statement::Switch(_)
        | Statement::Break(_)
        | Statement::Continue(_)
        | Statement::Return(_)
        | Statement::Discard(_)
        | Statement::FunctionCall(_)
        | Statement::ConstAssert(_)
        | Statement::Declaration(_) => Vec::new(),
    }
}

fn inverted_elsewhere(condition: &Expression) -> bool {
    match condition {
        Expression::Parenthesized(it) => inverted_elsewhere(it.expression.node()),
        Expression::Unary(it) => it.operator == UnaryOperator::LogicalNegation,
        Expression::Binary(it) => !others(it.operator, swap_comparison::SWAPS).is_empty(),
        Expression::Literal(_)
        | Expression::NamedComponent(_)
        | Expression::Indexing(_)
        | Expression::FunctionCall(_)
        | Expression::TypeOrIdentifier(_) => false,
    }
}

#[cfg(test)]
mod tests {
    use super::OPERATOR;
    use crate::operator::testing::lines;

    #[test]
    fn branches_and_loops() {
        let text = "fn f() {\nif (a && b) { } else if c { }\nwhile any(d) { }\nloop { continuing { break if e; } }\n}";
        let made = lines(&OPERATOR, text);
        assert_eq!(
            made,
            [
                "if (!((a && b))) { } else if c { }",
                "if (a && b) { } else if (!(c)) { }",
                "while (!(any(d))) { }",
                "loop { continuing { break if (!(e)); } }"
            ]
        );
    }

    #[test]
    fn what_others_invert_is_left_to_them() {
        assert!(lines(&OPERATOR, "fn f() { if (a < b) { } if (!a) { } }").is_empty());
    }
}
