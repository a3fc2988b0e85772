//! `min` for `max` and the other way round.

use super::{Operator, call, put};
use crate::mutant::Change;
use crate::syntax::Node;

pub(super) const OPERATOR: Operator = Operator {
    name: "swap_min_max",
    about: "min and max swapped",
    changes,
};

fn changes(node: &Node<'_>, _text: &str) -> Vec<Change> {
    let change = call(node).and_then(|(it, range)| {
        let other = match it.ty.ident.name().as_str() {
            "min" => "max",
            "max" => "min",
            _ => return None,
        };
        Some(put(&(range.start..range.start + 3), other))
    });
    change.into_iter().collect()
}

#[cfg(test)]
mod tests {
    use super::OPERATOR;
    use crate::operator::testing::expressions;

    #[test]
    fn each_in_its_place() {
        assert_eq!(
            expressions(&OPERATOR, "max(min(a, b), c)"),
            ["min(min(a, b), c)", "max(max(a, b), c)"]
        );
        assert!(expressions(&OPERATOR, "maximum(a, b)").is_empty());
    }
}
