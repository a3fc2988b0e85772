//! Neighbouring arguments of a call swapped: of built-ins, constructors and the library's own functions. Calls whose
//! arguments commute are left alone; arguments of different types do not validate and do not count.

use super::{Operator, argument, call, put};
use crate::mutant::Change;
use crate::syntax::Node;

pub(super) const OPERATOR: Operator = Operator {
    name: "swap_arguments",
    about: "neighbouring arguments of a call swapped, where their order matters",
    changes,
};

/// Built-ins of two arguments that give the same for both orders.
const COMMUTATIVE: &[&str] = &["distance", "dot", "max", "min"];

fn changes(node: &Node<'_>, text: &str) -> Vec<Change> {
    let Some((it, _)) = call(node) else {
        return Vec::new();
    };
    if COMMUTATIVE.contains(&it.ty.ident.name().as_str()) {
        return Vec::new();
    }
    // clamp(e, low, high) is min(max(e, low), high), and max commutes.
    let first = if *it.ty.ident.name() == "clamp" { 2 } else { 1 };
    let pairs = (first..it.arguments.len()).map(|second| (argument(it, second - 1), argument(it, second)));
    pairs
        .filter(|(a, b)| text[a.clone()] != text[b.clone()])
        .map(|(a, b)| {
            let between = &text[a.end..b.start];
            put(
                &(a.start..b.end),
                format!("{}{between}{}", &text[b.clone()], &text[a.clone()]),
            )
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::OPERATOR;
    use crate::operator::testing::expressions;

    #[test]
    fn neighbours_change_places() {
        assert_eq!(expressions(&OPERATOR, "cross(a, b.xyz)"), ["cross(b.xyz, a)"]);
        assert_eq!(
            expressions(&OPERATOR, "select(a, b, c < d)"),
            ["select(b, a, c < d)", "select(a, c < d, b)"]
        );
        assert_eq!(
            expressions(&OPERATOR, "f(g(a, b), c)"),
            ["f(c, g(a, b))", "f(g(b, a), c)"]
        );
    }

    #[test]
    fn what_commutes_or_is_equal_stays() {
        assert!(expressions(&OPERATOR, "dot(a, b)").is_empty());
        assert_eq!(expressions(&OPERATOR, "clamp(a, b, c)"), ["clamp(a, c, b)"]);
        assert_eq!(
            expressions(&OPERATOR, "vec3f(0.0, 0.0, 1.0)"),
            ["vec3f(0.0, 1.0, 0.0)"]
        );
        assert!(expressions(&OPERATOR, "f(a)").is_empty());
    }
}
