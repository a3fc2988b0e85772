//! A constant that is a little off: a float one per cent larger (zero becomes 0.01), an integer one more and one less.

use wesl::syntax::{Expression, LiteralExpression};

use super::{Operator, put};
use crate::mutant::Change;
use crate::syntax::Node;

pub(super) const OPERATOR: Operator = Operator {
    name: "scale_constant",
    about: "a float constant one per cent larger (0 becomes 0.01), an integer one more and one less",
    changes,
};

fn changes(node: &Node<'_>, text: &str) -> Vec<Change> {
    let Node::Expression {
        syntax: Expression::Literal(literal),
        range,
    } = node
    else {
        return Vec::new();
    };
    let others = match literal {
        LiteralExpression::Bool(_) => Vec::new(),
        LiteralExpression::AbstractInt(value) => neighbours(*value, true, ""),
        LiteralExpression::I32(value) => neighbours(i64::from(*value), true, "i"),
        LiteralExpression::U32(value) => neighbours(i64::from(*value), false, "u"),
        LiteralExpression::AbstractFloat(value) => vec![scaled(*value, "")],
        LiteralExpression::F32(value) => vec![scaled(shortest(*value), "f")],
        LiteralExpression::F16(value) => vec![scaled(shortest(*value), "h")],
    };
    others
        .into_iter()
        .filter(|other| *other != text[range.clone()])
        .map(|other| put(range, other))
        .collect()
}

fn neighbours(value: i64, signed: bool, suffix: &str) -> Vec<String> {
    let more = value.checked_add(1).map(|next| format!("{next}{suffix}"));
    let less = value.checked_sub(1).filter(|previous| signed || *previous >= 0);
    let less = less.map(|previous| match previous {
        0.. => format!("{previous}{suffix}"),
        _ => format!("({previous}{suffix})"),
    });
    more.into_iter().chain(less).collect()
}

fn scaled(value: f64, suffix: &str) -> String {
    let other = if value == 0.0 { 0.01 } else { value * 1.01 };
    // The product of two short decimals, without the noise of the binary product: 15 digits hold every decimal of 15.
    let decimal: f64 = format!("{other:.14e}").parse().unwrap_or(other);
    format!("{decimal:?}{suffix}")
}

/// The shortest decimal that reads back as the same number.
fn shortest(value: f32) -> f64 {
    value.to_string().parse().unwrap_or(f64::from(value))
}

#[cfg(test)]
mod tests {
    use super::OPERATOR;
    use crate::operator::testing::{expressions, lines};

    #[test]
    fn floats_by_one_per_cent() {
        assert_eq!(expressions(&OPERATOR, "127.0"), ["128.27"]);
        assert_eq!(expressions(&OPERATOR, "0.05f"), ["0.0505f"]);
        assert_eq!(expressions(&OPERATOR, "-1.0"), ["-1.01"]);
        assert_eq!(expressions(&OPERATOR, "0.0"), ["0.01"]);
        assert_eq!(expressions(&OPERATOR, "1.17549435e-38"), ["1.1872492935e-38"]);
    }

    #[test]
    fn integers_by_one() {
        assert_eq!(expressions(&OPERATOR, "8u"), ["9u", "7u"]);
        assert_eq!(expressions(&OPERATOR, "0u"), ["1u"]);
        assert_eq!(expressions(&OPERATOR, "0"), ["1", "(-1)"]);
        assert_eq!(expressions(&OPERATOR, "m[2]"), ["m[3]", "m[1]"]);
    }

    #[test]
    fn layout_is_no_constant() {
        assert!(
            lines(
                &OPERATOR,
                "@group(0) @binding(1) var<uniform> a: array<vec4f, 4>;"
            )
            .is_empty()
        );
    }
}
