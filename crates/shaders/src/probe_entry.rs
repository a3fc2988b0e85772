//! Writes the WESL text of a probe's entry point from its row of the table.

use std::fmt::Write;

use crate::probe::{Field, Probe, Shape, WORKGROUP_SIZE};

/// The root module of a probe.
pub(crate) fn source(probe: &Probe) -> String {
    let (function, module) = (
        probe.function(),
        probe.file.trim_end_matches(".wesl").replace('/', "::"),
    );
    let (stride_in, stride_out) = (probe.input_floats, probe.output_floats);
    let mut text = format!(
        "import package::{module}::{function};\n\
         @group(0) @binding(0) var<storage, read> inputs: array<f32>;\n\
         @group(0) @binding(1) var<storage, read_write> outputs: array<f32>;\n\
         @compute @workgroup_size({WORKGROUP_SIZE})\n\
         fn {}(@builtin(global_invocation_id) id: vec3u) {{\n\
         if (id.x >= arrayLength(&outputs) / {stride_out}u) {{ return; }}\n\
         let input = id.x * {stride_in}u;\n\
         let output = id.x * {stride_out}u;\n\
         let result = {function}({});\n",
        probe.entry,
        arguments(probe.inputs),
    );
    write_outputs(&mut text, probe.outputs);
    text.push_str("}\n");
    text
}

fn arguments(fields: &[Field]) -> String {
    let mut at = 0;
    let mut list = Vec::new();
    for field in fields {
        list.push(argument(field.shape, at));
        at += field.shape.floats();
    }
    list.join(", ")
}

fn argument(shape: Shape, at: usize) -> String {
    let floats: Vec<String> = (at..at + shape.floats())
        .map(|index| format!("inputs[input + {index}u]"))
        .collect();
    match shape {
        Shape::F32 => floats[0].clone(),
        Shape::U32 => format!("u32({})", floats[0]),
        Shape::I32 => format!("i32({})", floats[0]),
        Shape::Bool => format!("{} != 0.0", floats[0]),
        Shape::Vec2 => format!("vec2f({})", floats.join(", ")),
        Shape::Vec3 => format!("vec3f({})", floats.join(", ")),
        Shape::Vec4 => format!("vec4f({})", floats.join(", ")),
        Shape::Mat3 => format!("mat3x3f({})", floats.join(", ")),
        Shape::Mat4 => format!("mat4x4f({})", floats.join(", ")),
    }
}

fn write_outputs(text: &mut String, fields: &[Field]) {
    let mut at = 0;
    for field in fields {
        let value = if fields.len() == 1 {
            "result".to_owned()
        } else {
            format!("result.{}", field.name)
        };
        for component in components(field.shape, &value) {
            // Writing to a string cannot fail.
            let _ = writeln!(text, "outputs[output + {at}u] = {component};");
            at += 1;
        }
    }
}

fn components(shape: Shape, value: &str) -> Vec<String> {
    let vector = |n: usize| {
        ["x", "y", "z", "w"][..n]
            .iter()
            .map(|c| format!("{value}.{c}"))
            .collect()
    };
    let matrix = |n: usize| {
        (0..n * n)
            .map(|i| format!("{value}[{}][{}]", i / n, i % n))
            .collect()
    };
    match shape {
        Shape::F32 => vec![value.to_owned()],
        Shape::U32 | Shape::I32 | Shape::Bool => vec![format!("f32({value})")],
        Shape::Vec2 => vector(2),
        Shape::Vec3 => vector(3),
        Shape::Vec4 => vector(4),
        Shape::Mat3 => matrix(3),
        Shape::Mat4 => matrix(4),
    }
}
