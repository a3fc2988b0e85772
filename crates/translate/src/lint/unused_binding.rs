//! A resource that no entry point uses.
//!
//! Why: it is dropped from every emitted file, so an engine that binds by the source's declarations binds something that
//! the shader has not got; in Direct3D 12 and Vulkan the layouts then differ.

use crate::lint::{Finding, Rule, Severity};
use crate::shader::Shader;

pub(super) const RULE: Rule = Rule {
    id: "unused_binding",
    severity: Severity::Note,
    find,
};

fn find(shader: &Shader) -> Vec<Finding> {
    shader
        .unused()
        .iter()
        .map(|unused| Finding {
            range: unused.range.clone(),
            message: format!(
                "`{}` is used by no entry point and is left out of the output",
                unused.name
            ),
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use crate::lint::testing::lines;

    fn returning(value: &str) -> Vec<u32> {
        lines(
            "unused_binding",
            &format!(
                "@group(0) @binding(0) var<uniform> a: vec4f;
                 @group(0) @binding(1) var<uniform> b: vec4f;
                 fn helper() -> vec4f {{ return b; }}
                 @fragment fn main() -> @location(0) vec4f {{ return {value}; }}"
            ),
        )
    }

    #[test]
    fn found() {
        // A function that nothing calls is no use.
        assert_eq!(returning("a"), [2]);
    }

    #[test]
    fn not_found() {
        assert!(returning("a + helper()").is_empty());
    }
}
