//! `textureNumLevels` and `textureNumSamples`, which OpenGL ES does not have.
//!
//! Why: naga refuses such a shader for every ES version, so it is lost for WebGL 2 and most mobile OpenGL; passing the
//! number in a uniform costs nothing.

use naga::{Expression, ImageQuery};

use crate::ir;
use crate::lint::{Finding, Rule, Severity};
use crate::shader::Shader;

pub(super) const RULE: Rule = Rule {
    id: "es_texture_query",
    severity: Severity::Note,
    find,
};

fn find(shader: &Shader) -> Vec<Finding> {
    let units = shader.units().iter();
    units
        .flat_map(ir::expressions)
        .filter_map(|(expression, span)| {
            let message = format!(
                "{} cannot be expressed in GLSL ES; pass the number in a uniform instead",
                lost(expression)?
            );
            Some(Finding::new(shader, span, message))
        })
        .collect()
}

const fn lost(expression: &Expression) -> Option<&'static str> {
    match expression {
        Expression::ImageQuery { query, .. } => match query {
            ImageQuery::NumLevels => Some("textureNumLevels"),
            ImageQuery::NumSamples => Some("textureNumSamples"),
            ImageQuery::Size { .. } | ImageQuery::NumLayers => None,
        },
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use crate::lint::testing::lines;

    fn querying(call: &str) -> Vec<u32> {
        lines(
            "es_texture_query",
            &format!(
                "@group(0) @binding(0) var t: texture_2d<f32>;
                 @fragment fn main() -> @location(0) vec4u {{
                     return vec4u({call});
                 }}"
            ),
        )
    }

    #[test]
    fn found() {
        assert_eq!(querying("textureNumLevels(t)"), [3]);
    }

    #[test]
    fn not_found() {
        assert!(querying("textureDimensions(t).x").is_empty());
    }
}
