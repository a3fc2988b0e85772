//! A loop that runs a step too few, or just once, or whose counter stands still.

use std::ops::Range;

use wesl::syntax::{BinaryOperator, CompoundStatement, Expression, ForStatement, Statement};

use super::{Operator, put};
use crate::mutant::Change;
use crate::syntax::Node;

pub(super) const OPERATOR: Operator = Operator {
    name: "shorten_loop",
    about: "a loop without its first step, without its last, with one step only, or without its update",
    changes,
};

fn changes(node: &Node<'_>, text: &str) -> Vec<Change> {
    let Node::Statement { syntax, range, .. } = node else {
        return Vec::new();
    };
    match syntax {
        Statement::For(it) => {
            let parts = [
                first_dropped(it, text),
                last_dropped(it, text),
                once(&it.body, range, text),
                update_dropped(it),
            ];
            parts.into_iter().flatten().collect()
        }
        Statement::While(it) => once(&it.body, range, text).into_iter().collect(),
        Statement::Loop(it) if it.continuing.is_none() => once(&it.body, range, text).into_iter().collect(),
        Statement::Loop(_)
        | Statement::Void
        | Statement::Compound(_)
        | Statement::Assignment(_)
        | Statement::Increment(_)
        | Statement::Decrement(_)
        | Statement::If(_)
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

/// `var i = a` becomes `var i = (a) + 1`.
fn first_dropped(it: &ForStatement, text: &str) -> Option<Change> {
    let Statement::Declaration(declaration) = it.initializer.as_ref()?.node() else {
        return None;
    };
    let range = declaration.initializer.as_ref()?.span().range();
    Some(put(&range, format!("({}) + 1", &text[range.clone()])))
}

/// `i < n` becomes `i + 1 < n`.
fn last_dropped(it: &ForStatement, text: &str) -> Option<Change> {
    let Expression::Binary(condition) = it.condition.as_ref()?.node() else {
        return None;
    };
    let sign = match condition.operator {
        BinaryOperator::LessThan | BinaryOperator::LessThanEqual => '+',
        BinaryOperator::GreaterThan | BinaryOperator::GreaterThanEqual => '-',
        _ => return None,
    };
    let range = condition.left.span().range();
    Some(put(&range, format!("({}) {sign} 1", &text[range.clone()])))
}

/// A `break` at the end of the body, which is the end of the loop's statement.
fn once(body: &CompoundStatement, range: &Range<usize>, text: &str) -> Option<Change> {
    let ends = matches!(
        body.statements.last()?.node(),
        Statement::Break(_) | Statement::Return(_)
    );
    let brace = range.end - 1;
    (!ends && text[brace..].starts_with('}')).then(|| put(&(brace..range.end), "break; }"))
}

fn update_dropped(it: &ForStatement) -> Option<Change> {
    Some(put(&it.update.as_ref()?.span().range(), ""))
}

#[cfg(test)]
mod tests {
    use super::OPERATOR;
    use crate::operator::testing::lines;

    #[test]
    fn a_counted_loop_in_four_ways() {
        let made = lines(&OPERATOR, "fn f() {\nfor (var i = 0u; i < n; i++) { a += 1; }\n}");
        assert_eq!(
            made,
            [
                "for (var i = (0u) + 1; i < n; i++) { a += 1; }",
                "for (var i = 0u; (i) + 1 < n; i++) { a += 1; }",
                "for (var i = 0u; i < n; i++) { a += 1; break; }",
                "for (var i = 0u; i < n; ) { a += 1; }",
            ]
        );
    }

    #[test]
    fn other_loops_run_once() {
        assert_eq!(
            lines(&OPERATOR, "fn f() { while a { b(); } }"),
            ["fn f() { while a { b(); break; } }"]
        );
        assert!(lines(&OPERATOR, "fn f() { loop { b(); continuing { break if c; } } }").is_empty());
        assert!(lines(&OPERATOR, "fn f() { loop { b(); break; } }").is_empty());
    }
}
