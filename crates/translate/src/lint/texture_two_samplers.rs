//! A texture that is used with more than one sampler.
//!
//! Why: GLSL has textures and samplers only as pairs, so naga's writer refuses the shader for OpenGL; the message comes
//! late, when the texture units have been planned.

use std::collections::{BTreeMap, BTreeSet};

use naga::{GlobalVariable, Handle};

use crate::lint::{Finding, Rule, Severity};
use crate::shader::{Shader, Unit};

pub(super) const RULE: Rule = Rule {
    id: "texture_two_samplers",
    severity: Severity::Note,
    find,
};

fn find(shader: &Shader) -> Vec<Finding> {
    let units = shader.units().iter();
    units.flat_map(|unit| find_in(shader, unit)).collect()
}

fn find_in(shader: &Shader, unit: &Unit) -> Vec<Finding> {
    let mut samplers: BTreeMap<Handle<GlobalVariable>, BTreeSet<Handle<GlobalVariable>>> = BTreeMap::new();
    for pair in &unit.entry_info().sampling_set {
        samplers.entry(pair.image).or_default().insert(pair.sampler);
    }
    let variables = &unit.module.global_variables;
    samplers
        .iter()
        .filter(|(_, with)| with.len() > 1)
        .map(|(image, with)| {
            let name = variables[*image].name.as_deref().unwrap_or_default();
            let message = format!(
                "texture `{name}` is used with {} samplers and cannot be emitted to GLSL; bind it once for each",
                with.len()
            );
            Finding::new(shader, variables.get_span(*image), message)
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use crate::lint::testing::lines;

    fn sampling(second: &str) -> Vec<u32> {
        lines(
            "texture_two_samplers",
            &format!(
                "@group(0) @binding(0) var t: texture_2d<f32>;
                 @group(0) @binding(1) var a: sampler;
                 @group(0) @binding(2) var b: sampler;
                 fn fetch(s: sampler) -> vec4f {{ return textureSampleLevel(t, s, vec2f(0.5), 0.0); }}
                 @fragment fn main() -> @location(0) vec4f {{ return fetch(a) + fetch({second}); }}"
            ),
        )
    }

    #[test]
    fn found_through_calls() {
        assert_eq!(sampling("b"), [1]);
    }

    #[test]
    fn not_found() {
        assert!(sampling("a").is_empty());
    }
}
