//! A term left out of a sum or difference: the second of either, the first of a sum.

use wesl::syntax::BinaryOperator;

use super::{Operator, binary, enclosed, put};
use crate::mutant::Change;
use crate::syntax::Node;

pub(super) const OPERATOR: Operator = Operator {
    name: "drop_bias",
    about: "an added or subtracted term dropped",
    changes,
};

fn changes(node: &Node<'_>, text: &str) -> Vec<Change> {
    let Some((it, range)) = binary(node) else {
        return Vec::new();
    };
    let is_sum = it.operator == BinaryOperator::Addition;
    let mut changes = Vec::new();
    if is_sum || it.operator == BinaryOperator::Subtraction {
        changes.push(put(range, enclosed(text, it.left.span().range())));
    }
    if is_sum {
        changes.push(put(range, enclosed(text, it.right.span().range())));
    }
    changes
}

#[cfg(test)]
mod tests {
    use super::OPERATOR;
    use crate::operator::testing::expressions;

    #[test]
    fn a_term_is_left() {
        assert_eq!(expressions(&OPERATOR, "a * b + c"), ["(a * b)", "(c)"]);
        assert_eq!(expressions(&OPERATOR, "a - b - c"), ["(a - b)", "(a) - c"]);
        assert!(expressions(&OPERATOR, "-a * b").is_empty());
    }
}
