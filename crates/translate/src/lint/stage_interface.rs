//! A fragment input that no vertex entry point of the same module writes, or writes as another type.
//!
//! Why: each stage is valid alone. Vulkan and Direct3D refuse the pair when the pipeline is made, on the user's machine;
//! OpenGL links it and reads undefined values.

use std::collections::BTreeMap;

use naga::Binding;

use crate::ir;
use crate::lint::{Finding, Rule, Severity};
use crate::shader::{Shader, Unit};
use crate::target::Stage;
use crate::type_name::type_name;

pub(super) const RULE: Rule = Rule {
    id: "stage_interface",
    severity: Severity::Warning,
    find,
};

/// Type and name by location.
type Interface = BTreeMap<u32, (String, String)>;

fn find(shader: &Shader) -> Vec<Finding> {
    let of_stage = |stage| shader.units().iter().filter(move |unit| unit.stage == stage);
    let written: Vec<Interface> = of_stage(Stage::Vertex).map(|u| interface(u, true)).collect();
    if written.is_empty() {
        // The vertex shader is elsewhere.
        return Vec::new();
    }
    of_stage(Stage::Fragment)
        .filter_map(|unit| mismatch(shader, unit, &written))
        .collect()
}

fn interface(unit: &Unit, output: bool) -> Interface {
    ir::interface(unit, output)
        .into_iter()
        .filter_map(|(name, ty, binding)| match binding {
            Binding::Location { location, .. } => Some((location, (type_name(&unit.module, ty), name))),
            Binding::BuiltIn(_) => None,
        })
        .collect()
}

/// What keeps a fragment entry point from being paired with any vertex entry point.
fn mismatch(shader: &Shader, unit: &Unit, written: &[Interface]) -> Option<Finding> {
    let read = interface(unit, false);
    let mut problems = written.iter().map(|outputs| problem(&read, outputs));
    let first = problems.next()??;
    if problems.any(|problem| problem.is_none()) {
        return None;
    }
    let name = &unit.entry().name;
    let text = shader.text();
    let range = text
        .find(&format!("fn {name}("))
        .map(|at| at + 3..at + 3 + name.len());
    Some(Finding {
        range,
        message: format!("`{name}` fits no vertex entry point: {first}"),
    })
}

fn problem(read: &Interface, written: &Interface) -> Option<String> {
    read.iter()
        .find_map(|(location, (ty, name))| match written.get(location) {
            None => Some(format!("nothing is written to location {location} (`{name}`)")),
            Some((other, _)) if other != ty => Some(format!(
                "location {location} (`{name}`) is read as {ty} but written as {other}"
            )),
            Some(_) => None,
        })
}

#[cfg(test)]
mod tests {
    use crate::lint::testing::findings;

    const VERTEX: &str = "
        struct Out { @builtin(position) p: vec4f, @location(0) uv: vec2f, @location(1) n: vec3f }
        @vertex fn vs() -> Out { return Out(); }";

    fn messages(fragment: &str) -> Vec<String> {
        let found = findings("stage_interface", &format!("{VERTEX}\n{fragment}"));
        found.into_iter().map(|l| l.message).collect()
    }

    #[test]
    fn a_missing_location_is_found() {
        let found = messages("@fragment fn fs(@location(2) x: f32) -> @location(0) f32 { return x; }");
        assert_eq!(found.len(), 1);
        assert!(
            found[0].contains("nothing is written to location 2 (`x`)"),
            "{found:?}"
        );
    }

    #[test]
    fn another_type_is_found() {
        let found = messages("@fragment fn fs(@location(1) x: vec2f) -> @location(0) vec2f { return x; }");
        assert_eq!(found.len(), 1);
        assert!(
            found[0].contains("read as vec2<f32> but written as vec3<f32>"),
            "{found:?}"
        );
    }

    #[test]
    fn not_found() {
        // Reading less than is written is fine.
        assert!(
            messages("@fragment fn fs(@location(1) x: vec3f) -> @location(0) vec3f { return x; }").is_empty()
        );
        let alone = "@fragment fn fs(@location(7) x: f32) -> @location(0) f32 { return x; }";
        assert!(findings("stage_interface", alone).is_empty());
    }

    #[test]
    fn one_fitting_vertex_entry_is_enough() {
        let second = "@vertex fn other(@location(0) p: vec4f) -> Two { return Two(p, 1.0); }
            struct Two { @builtin(position) p: vec4f, @location(2) x: f32 }
            @fragment fn fs(@location(2) x: f32) -> @location(0) f32 { return x; }";
        assert!(messages(second).is_empty());
    }
}
