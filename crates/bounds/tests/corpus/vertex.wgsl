// A vertex stage.
struct Out { @builtin(position) @invariant at: vec4f, @location(0) uv: vec2f, @location(1) @interpolate(flat) id: u32 }

@vertex
fn main(@location(0) position: vec3f, @builtin(vertex_index) v: u32, @builtin(instance_index) i: u32) -> Out {
    let corner = vec2f(f32((v << 1u) & 2u), f32(v & 2u));
    return Out(vec4f(position * 2.0, 1.0), corner, v + 10u * i);
}
