//! A statement left out: an assignment, a return, a discard, a call, a break or continue.
//!
//! An empty block stands in its place, so that a condition before it (`@if`) has something to hold. Declarations stay, since
//! what follows needs them; the heads of loops belong to another operator; a final return does not validate without.

use wesl::syntax::Statement;

use super::{Operator, put};
use crate::mutant::Change;
use crate::syntax::Node;

pub(super) const OPERATOR: Operator = Operator {
    name: "drop_statement",
    about: "an assignment, return, discard, call, break or continue dropped",
    changes,
};

fn changes(node: &Node<'_>, _text: &str) -> Vec<Change> {
    match node {
        Node::Statement {
            syntax,
            range,
            in_head: false,
        } if droppable(syntax) => vec![put(range, "{}")],
        Node::Statement { .. } | Node::Expression { .. } => Vec::new(),
    }
}

fn droppable(statement: &Statement) -> bool {
    match statement {
        Statement::Assignment(_)
        | Statement::Increment(_)
        | Statement::Decrement(_)
        | Statement::Break(_)
        | Statement::Continue(_)
        | Statement::Return(_)
        | Statement::Discard(_)
        | Statement::FunctionCall(_) => true,
        Statement::Void
        | Statement::Compound(_)
        | Statement::If(_)
        | Statement::Switch(_)
        | Statement::Loop(_)
        | Statement::For(_)
        | Statement::While(_)
        | Statement::ConstAssert(_)
        | Statement::Declaration(_) => false,
    }
}

#[cfg(test)]
mod tests {
    use super::OPERATOR;
    use crate::operator::testing::lines;

    #[test]
    fn an_empty_block_is_left() {
        let text =
            "fn f() {\nlet a = 1.0;\n@if(b) c = a;\nif (d) { discard; }\nfor (; e; f += 1) { g(); }\n}";
        assert_eq!(
            lines(&OPERATOR, text),
            ["@if(b) {}", "if (d) { {} }", "for (; e; f += 1) { {} }"]
        );
    }
}
