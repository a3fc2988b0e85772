//! Neighbouring arguments of a call swapped: of built-ins, constructors and the library's own functions. Arguments of different
//! types do not validate and do not count.
//!
//! Left alone is what is the same program by the language: arguments that commute (`dot`, `max`, `min`, `distance`, and the first
//! two of `clamp(e, low, high)`, which is min(max(e, low), high) or the median), and what is no program: constant bounds of a
//! clamp, the lower above the upper, are an error that only some compilers report.

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
    let clamp = *it.ty.ident.name() == "clamp";
    let first = if clamp { 2 } else { 1 };
    let pairs = (first..it.arguments.len()).map(|second| (argument(it, second - 1), argument(it, second)));
    pairs
        .filter(|(a, b)| text[a.clone()] != text[b.clone()])
        .filter(|(a, b)| !(clamp && is_constant(&text[a.clone()]) && is_constant(&text[b.clone()])))
        .map(|(a, b)| {
            let between = &text[a.end..b.start];
            put(
                &(a.start..b.end),
                format!("{}{between}{}", &text[b.clone()], &text[a.clone()]),
            )
        })
        .collect()
}

/// Whether an expression is made of numbers and float vectors of them alone.
fn is_constant(expression: &str) -> bool {
    let vectors = ["vec2f", "vec3f", "vec4f"].iter();
    let bare = vectors.fold(expression.to_owned(), |text, vector| text.replace(vector, ""));
    !bare.contains(|c: char| c == '_' || c.is_alphabetic())
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
            expressions(&OPERATOR, "clamp(a, vec2f(0.0), last)"),
            ["clamp(a, last, vec2f(0.0))"]
        );
        assert!(expressions(&OPERATOR, "clamp(a, vec3f(-1.0), vec3f(1.0))").is_empty());
        assert_eq!(
            expressions(&OPERATOR, "vec3f(0.0, 0.0, 1.0)"),
            ["vec3f(0.0, 1.0, 0.0)"]
        );
        assert!(expressions(&OPERATOR, "f(a)").is_empty());
    }
}
