//! A matrix with three-component columns in a uniform or storage buffer.
//!
//! Why: each column takes 16 bytes in memory but has 12 of data, and languages differ about the last 4. naga pads such
//! members by hand in HLSL; DXC's own SPIR-V and glslang's reading of that HLSL then fetch wrong columns, and host code
//! that packs nine floats is wrong everywhere. A `mat4x4` or three `vec4`s read the same in every language.

use naga::{AddressSpace, TypeInner, VectorSize};

use crate::ir;
use crate::lint::{Finding, Rule, Severity};
use crate::shader::{Shader, Unit};

pub(super) const RULE: Rule = Rule {
    id: "mat3_in_buffer",
    severity: Severity::Warning,
    find,
};

fn find(shader: &Shader) -> Vec<Finding> {
    let units = shader.units().iter();
    units.flat_map(|unit| find_in(shader, unit)).collect()
}

fn find_in(shader: &Shader, unit: &Unit) -> Vec<Finding> {
    let variables = &unit.module.global_variables;
    variables
        .iter()
        .filter(|(_, variable)| is_buffer(variable.space))
        .filter(|(_, variable)| ir::type_contains(&unit.module, variable.ty, &has_three_rows))
        .map(|(handle, variable)| {
            let message = format!(
                "`{}` holds a matrix with three-component columns, whose padding compilers disagree about; \
                 use mat4x4 or vec4 columns",
                variable.name.as_deref().unwrap_or_default()
            );
            Finding::new(shader, variables.get_span(handle), message)
        })
        .collect()
}

const fn is_buffer(space: AddressSpace) -> bool {
    matches!(
        space,
        AddressSpace::Uniform | AddressSpace::Storage { .. } | AddressSpace::Immediate
    )
}

const fn has_three_rows(inner: &TypeInner) -> bool {
    matches!(
        inner,
        TypeInner::Matrix {
            rows: VectorSize::Tri,
            ..
        }
    )
}

#[cfg(test)]
mod tests {
    use crate::lint::testing::lines;

    fn holding(space: &str, ty: &str) -> Vec<u32> {
        lines(
            "mat3_in_buffer",
            &format!(
                "struct Inner {{ m: {ty} }}
                 struct Outer {{ list: array<Inner, 2>, s: f32 }}
                 @group(0) @binding(0) var<{space}> held: Outer;
                 @fragment fn main() -> @location(0) f32 {{ return held.list[0].m[0].x + held.s; }}"
            ),
        )
    }

    #[test]
    fn found_however_deep() {
        assert_eq!(holding("uniform", "mat3x3f"), [3]);
        assert_eq!(holding("storage", "mat4x3f"), [3]);
    }

    #[test]
    fn not_found() {
        assert!(holding("uniform", "mat4x4f").is_empty());
        assert!(holding("storage", "mat3x4f").is_empty());
        let local = "@fragment fn main(@location(0) n: vec3f) -> @location(0) vec3f {
            var frame = mat3x3f(n, n, n); return frame * n; }";
        assert!(lines("mat3_in_buffer", local).is_empty());
    }
}
