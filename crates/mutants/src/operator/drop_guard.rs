//! A guard left out: clamp, saturate, max, min, abs and select replaced by what they guard.
//!
//! Of `max(a, b)` either may be the guard, so each is dropped once; of a clamp each side and both.

use super::{Operator, argument, call, enclosed, put};
use crate::mutant::Change;
use crate::syntax::Node;

pub(super) const OPERATOR: Operator = Operator {
    name: "drop_guard",
    about: "saturate, clamp (either side and both), max, min, abs and select dropped",
    changes,
};

fn changes(node: &Node<'_>, text: &str) -> Vec<Change> {
    let Some((it, range)) = call(node) else {
        return Vec::new();
    };
    let only = |index: usize| put(range, enclosed(text, argument(it, index)));
    let side = |name: &str, index: usize| {
        let (value, bound) = (&text[argument(it, 0)], &text[argument(it, index)]);
        put(range, format!("{name}({value}, {bound})"))
    };
    match (it.ty.ident.name().as_str(), it.arguments.len()) {
        ("saturate" | "abs", 1) => vec![only(0)],
        ("max" | "min", 2) | ("select", 3) => vec![only(0), only(1)],
        ("clamp", 3) => vec![only(0), side("max", 1), side("min", 2)],
        _ => Vec::new(),
    }
}

#[cfg(test)]
mod tests {
    use super::OPERATOR;
    use crate::operator::testing::expressions;

    #[test]
    fn each_guard_once() {
        assert_eq!(
            expressions(&OPERATOR, "a / max(b.z, c + d)"),
            ["a / (b.z)", "a / (c + d)"]
        );
        assert_eq!(expressions(&OPERATOR, "saturate(a - b)"), ["(a - b)"]);
        assert_eq!(
            expressions(&OPERATOR, "clamp(a, lo, hi)"),
            ["(a)", "max(a, lo)", "min(a, hi)"]
        );
        assert_eq!(expressions(&OPERATOR, "select(a, b, c)"), ["(a)", "(b)"]);
        assert!(expressions(&OPERATOR, "sqrt(a)").is_empty());
    }
}
