//! 16- and 64-bit floats, which not every target has.
//!
//! Why: a shader with f64 is valid here and is emitted to SPIR-V and HLSL, but Metal and GLSL ES have no such type; f16
//! needs shader model 6.2 and cannot be emitted to GLSL. Better to know when it is written than when the port fails.

use crate::features::Feature;
use crate::lint::{Finding, Rule, Severity};
use crate::shader::{Shader, Unit};

pub(super) const RULE: Rule = Rule {
    id: "float_width",
    severity: Severity::Note,
    find,
};

fn find(shader: &Shader) -> Vec<Finding> {
    let units = shader.units().iter();
    units
        .flat_map(|unit| WIDTHS.iter().filter_map(|width| find_width(shader, unit, width)))
        .collect()
}

const WIDTHS: [(Feature, &str); 2] = [
    (
        Feature::Float64,
        "f64 cannot be expressed in MSL, WGSL or GLSL ES",
    ),
    (
        Feature::Float16,
        "f16 cannot be expressed in GLSL, nor in HLSL before shader model 6.2",
    ),
];

fn find_width(shader: &Shader, unit: &Unit, (width, message): &(Feature, &str)) -> Option<Finding> {
    if !unit.features.contains(*width) {
        return None;
    }
    let span = width.find(unit).unwrap_or_default();
    Some(Finding::new(shader, span, (*message).to_owned()))
}

#[cfg(test)]
mod tests {
    use crate::lint::testing::findings;

    fn with(declarations: &str, value: &str) -> usize {
        let text = format!(
            "{declarations}\n@fragment fn main(@location(0) x: f32) -> @location(0) f32 {{ return f32({value}); }}"
        );
        findings("float_width", &text).len()
    }

    #[test]
    fn found() {
        assert_eq!(with("enable f16;", "f16(x) * 2.0h"), 1);
        assert_eq!(with("", "f64(x) * 2.0lf"), 1);
    }

    #[test]
    fn not_found() {
        assert_eq!(with("", "x * 2.0"), 0);
        // Allowed, but not used.
        assert_eq!(with("enable f16;", "x * 2.0"), 0);
    }
}
