//! A loop that nothing ever leaves.
//!
//! Why: a driver's watchdog ends it by losing the device, and every resource with it. Only the plain case is decided here:
//! no `break` that belongs to the loop, no `break if`, no `return` and no `discard` inside. A loop whose exit exists but is
//! never taken is not seen.

use naga::{Block, Statement};

use crate::ir;
use crate::lint::{Finding, Rule, Severity};
use crate::shader::Shader;

pub(super) const RULE: Rule = Rule {
    id: "endless_loop",
    severity: Severity::Warning,
    find,
};

fn find(shader: &Shader) -> Vec<Finding> {
    let mut found = Vec::new();
    for unit in shader.units() {
        for (function, _) in ir::functions(unit) {
            ir::each_statement(&function.body, &mut |statement, span| {
                if is_endless(statement) {
                    let message = "nothing ends this loop: there is no break, return or discard in it";
                    found.push(Finding::new(shader, span, message.to_owned()));
                }
            });
        }
    }
    found
}

fn is_endless(statement: &Statement) -> bool {
    match statement {
        Statement::Loop {
            body,
            continuing,
            break_if: None,
        } => !leaves(body, true) && !leaves(continuing, true),
        _ => false,
    }
}

/// Whether a block can leave the loop it is in; `own` says that a `break` here belongs to that loop.
fn leaves(block: &Block, own: bool) -> bool {
    block.iter().any(|statement| match statement {
        Statement::Break => own,
        Statement::Return { .. } | Statement::Kill => true,
        Statement::Loop { .. } | Statement::Switch { .. } => ir::inner_blocks(statement)
            .into_iter()
            .any(|inner| leaves(inner, false)),
        _ => ir::inner_blocks(statement)
            .into_iter()
            .any(|inner| leaves(inner, own)),
    })
}

#[cfg(test)]
mod tests {
    use crate::lint::testing::lines;

    fn in_main(body: &str) -> Vec<u32> {
        lines(
            "endless_loop",
            &format!("var<workgroup> x: atomic<u32>;\n@compute @workgroup_size(1) fn main() {{\n{body}\n}}"),
        )
    }

    #[test]
    fn found() {
        assert_eq!(in_main("loop { atomicAdd(&x, 1u); }"), [3]);
        // The break belongs to the switch.
        assert_eq!(
            in_main("loop { switch atomicLoad(&x) { case 1u: { break; } default: {} } }"),
            [3]
        );
    }

    #[test]
    fn not_found() {
        for body in [
            "loop { if atomicLoad(&x) > 3u { break; } }",
            "loop { if atomicLoad(&x) > 3u { return; } }",
            "loop { continuing { break if atomicLoad(&x) > 3u; } }",
            "for (var i = 0u; i < 4u; i++) { atomicAdd(&x, i); }",
        ] {
            assert!(in_main(body).is_empty(), "{body}");
        }
    }
}
