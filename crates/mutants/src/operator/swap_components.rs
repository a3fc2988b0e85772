//! Another component of a vector: .x and .y for each other, .z and .w become .x, a swizzle begins with its first two
//! components swapped; likewise with r, g, b, a.

use wesl::syntax::Expression;

use super::{Operator, put};
use crate::mutant::Change;
use crate::syntax::{Node, component_range};

pub(super) const OPERATOR: Operator = Operator {
    name: "swap_components",
    about: ".x and .y swapped, .z and .w become .x; .xy becomes .yx",
    changes,
};

fn changes(node: &Node<'_>, _text: &str) -> Vec<Change> {
    let Node::Expression {
        syntax: Expression::NamedComponent(it),
        ..
    } = node
    else {
        return Vec::new();
    };
    let swapped = swapped(&it.component.name());
    swapped
        .map(|name| put(&component_range(it), name))
        .into_iter()
        .collect()
}

/// The other components; `None` for the member of a structure, and for swizzles that begin with one component twice.
fn swapped(name: &str) -> Option<String> {
    let set = ["xyzw", "rgba"]
        .into_iter()
        .find(|set| name.chars().all(|c| set.contains(c)))?;
    let mut letters = name.chars();
    match (letters.next()?, letters.next()) {
        (first, None) => {
            let other = if set.starts_with(first) { 1..2 } else { 0..1 };
            Some(set[other].to_owned())
        }
        (first, Some(second)) if first != second => {
            Some([second, first].into_iter().chain(letters).collect())
        }
        (_, Some(_)) => None,
    }
}

#[cfg(test)]
mod tests {
    use super::OPERATOR;
    use crate::operator::testing::expressions;

    #[test]
    fn components_and_swizzles() {
        assert_eq!(expressions(&OPERATOR, "a.x"), ["a.y"]);
        assert_eq!(expressions(&OPERATOR, "a.w"), ["a.x"]);
        assert_eq!(expressions(&OPERATOR, "m[0].xyz"), ["m[0].yxz"]);
        assert_eq!(expressions(&OPERATOR, "a.b.g"), ["a.b.r", "a.r.g"]);
    }

    #[test]
    fn members_stay() {
        assert!(expressions(&OPERATOR, "light.vector").is_empty());
        assert!(expressions(&OPERATOR, "a.xx").is_empty());
    }
}
