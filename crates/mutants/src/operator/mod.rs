//! Mutation operators: the kinds of fault that are put in. One file an operator.
//!
//! An operator looks at one node of the syntax and proposes changes of the text. It need not know types: a proposal that does
//! not validate is not counted. It keeps to two rules: what it puts in place of an operand stands in parentheses, so that the
//! tree around it stays as it was; and what two operators would both propose in the same words is counted once, for the first
//! of the table.

mod drop_bias;
mod drop_guard;
mod drop_negation;
mod drop_normalise;
mod drop_statement;
mod negate_condition;
mod scale_constant;
mod shorten_loop;
mod swap_arguments;
mod swap_arithmetic;
mod swap_bitwise;
mod swap_comparison;
mod swap_components;
mod swap_logical;
mod swap_min_max;

use std::ops::Range;

use wesl::syntax::{BinaryExpression, BinaryOperator, Expression, FunctionCall};

use crate::mutant::Change;
use crate::syntax::Node;

/// A kind of fault.
#[derive(Clone, Copy, Debug)]
pub struct Operator {
    /// Its name, also of its file.
    pub name: &'static str,
    /// What it does, in a few words.
    pub about: &'static str,
    /// The changes that it makes at a node of a text.
    pub changes: fn(&Node<'_>, &str) -> Vec<Change>,
}

/// All of them. Of two that make the same text, the first has it.
pub const OPERATORS: &[Operator] = &[
    swap_arithmetic::OPERATOR,
    swap_bitwise::OPERATOR,
    swap_comparison::OPERATOR,
    swap_logical::OPERATOR,
    swap_components::OPERATOR,
    swap_min_max::OPERATOR,
    swap_arguments::OPERATOR,
    scale_constant::OPERATOR,
    drop_normalise::OPERATOR,
    drop_guard::OPERATOR,
    drop_bias::OPERATOR,
    drop_negation::OPERATOR,
    negate_condition::OPERATOR,
    shorten_loop::OPERATOR,
    drop_statement::OPERATOR,
];

/// A change of a place.
fn put(range: &Range<usize>, text: impl Into<String>) -> Change {
    Change {
        range: range.clone(),
        text: text.into(),
    }
}

/// The text of a place, in parentheses.
fn enclosed(text: &str, range: Range<usize>) -> String {
    format!("({})", &text[range])
}

/// A binary expression and its place.
fn binary<'a>(node: &'a Node<'_>) -> Option<(&'a BinaryExpression, &'a Range<usize>)> {
    match node {
        Node::Expression {
            syntax: Expression::Binary(it),
            range,
        } => Some((it, range)),
        Node::Expression { .. } | Node::Statement { .. } => None,
    }
}

/// The same operands with another operator between them.
fn with_operator(it: &BinaryExpression, text: &str, operator: &BinaryOperator) -> Change {
    let between = it.left.span().end..it.right.span().start;
    let changed = text[between.clone()].replacen(&it.operator.to_string(), &operator.to_string(), 1);
    put(&between, changed)
}

/// What stands in place of binary operators: for each that is swapped, the others.
type Swaps = &'static [(BinaryOperator, &'static [BinaryOperator])];

/// What a table has in place of an operator.
fn others(operator: BinaryOperator, swaps: Swaps) -> &'static [BinaryOperator] {
    let found = swaps.iter().find(|(swapped, _)| *swapped == operator);
    found.map_or(&[], |(_, others)| others)
}

/// A binary expression with each operator that a table has in place of its own.
fn swapped(node: &Node<'_>, text: &str, swaps: Swaps) -> Vec<Change> {
    binary(node).map_or_else(Vec::new, |(it, _)| {
        let others = others(it.operator, swaps);
        others
            .iter()
            .map(|other| with_operator(it, text, other))
            .collect()
    })
}

/// A call in an expression and its place.
fn call<'a>(node: &'a Node<'_>) -> Option<(&'a FunctionCall, &'a Range<usize>)> {
    match node {
        Node::Expression {
            syntax: Expression::FunctionCall(it),
            range,
        } => Some((it, range)),
        Node::Expression { .. } | Node::Statement { .. } => None,
    }
}

/// The place of an argument.
fn argument(call: &FunctionCall, index: usize) -> Range<usize> {
    call.arguments[index].span().range()
}

#[cfg(test)]
pub(crate) mod testing {
    use super::Operator;
    use crate::syntax::File;

    /// The lines that an operator makes of a text, in order.
    pub(crate) fn lines(operator: &Operator, text: &str) -> Vec<String> {
        let file = File::parse("x.wesl", text).unwrap();
        let mut found = Vec::new();
        file.walk(&mut |_, node| {
            let changes = (operator.changes)(&node, text);
            found.extend(changes.iter().map(|change| change.lines(text).2));
        });
        found
    }

    /// What an operator makes of an expression.
    pub(crate) fn expressions(operator: &Operator, expression: &str) -> Vec<String> {
        let text = format!("fn f() {{\nlet x = {expression};\n}}");
        let mut made = lines(operator, &text);
        for line in &mut made {
            *line = line
                .trim_start_matches("let x = ")
                .trim_end_matches(';')
                .to_owned();
        }
        made
    }
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use wesl::syntax::BinaryOperator as B;

    use super::{OPERATORS, Swaps, others, swap_arithmetic, swap_bitwise, swap_comparison, swap_logical};

    /// The table that has an operator. One that the language gets anew has to be put into one of them.
    fn table(operator: B) -> Swaps {
        match operator {
            B::ShortCircuitOr | B::ShortCircuitAnd => swap_logical::SWAPS,
            B::Addition | B::Subtraction | B::Multiplication | B::Division | B::Remainder => {
                swap_arithmetic::SWAPS
            }
            B::Equality
            | B::Inequality
            | B::LessThan
            | B::LessThanEqual
            | B::GreaterThan
            | B::GreaterThanEqual => swap_comparison::SWAPS,
            B::BitwiseOr | B::BitwiseAnd | B::BitwiseXor | B::ShiftLeft | B::ShiftRight => {
                swap_bitwise::SWAPS
            }
        }
    }

    #[test]
    fn every_binary_operator_is_swapped_by_one_kind_of_fault_for_its_like() {
        let tables = [
            swap_logical::SWAPS,
            swap_arithmetic::SWAPS,
            swap_comparison::SWAPS,
            swap_bitwise::SWAPS,
        ];
        let listed: Vec<B> = tables.concat().iter().map(|(operator, _)| *operator).collect();
        let names: BTreeSet<String> = listed.iter().map(ToString::to_string).collect();
        assert_eq!((names.len(), listed.len()), (18, 18));
        for operator in listed {
            let own = table(operator);
            let others = others(operator, own);
            assert!(!others.is_empty() && !others.contains(&operator), "{operator}");
            assert!(others.iter().all(|other| table(*other) == own), "{operator}");
        }
    }

    #[test]
    fn names_are_unique_and_described() {
        let names: BTreeSet<&str> = OPERATORS.iter().map(|it| it.name).collect();
        assert_eq!(names.len(), OPERATORS.len());
        assert!(OPERATORS.iter().all(|it| !it.about.is_empty()));
    }
}
