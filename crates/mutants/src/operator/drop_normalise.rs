//! A vector taken as it is where it should be made unit.

use super::{Operator, argument, call, enclosed, put};
use crate::mutant::Change;
use crate::syntax::Node;

pub(super) const OPERATOR: Operator = Operator {
    name: "drop_normalise",
    about: "normalize, and the library's normalise functions, replaced by their argument",
    changes,
};

fn changes(node: &Node<'_>, text: &str) -> Vec<Change> {
    let change = call(node).and_then(|(it, range)| {
        let name = it.ty.ident.name();
        let normalises = *name == "normalize" || name.starts_with("normalise");
        (normalises && it.arguments.len() == 1).then(|| put(range, enclosed(text, argument(it, 0))))
    });
    change.into_iter().collect()
}

#[cfg(test)]
mod tests {
    use super::OPERATOR;
    use crate::operator::testing::expressions;

    #[test]
    fn the_argument_is_left() {
        assert_eq!(
            expressions(&OPERATOR, "2.0 * normalise(a + b).x"),
            ["2.0 * (a + b).x"]
        );
        assert_eq!(
            expressions(&OPERATOR, "normalize(normalise_published(a))"),
            ["(normalise_published(a))", "normalize((a))"]
        );
        assert!(expressions(&OPERATOR, "length(a)").is_empty());
    }
}
