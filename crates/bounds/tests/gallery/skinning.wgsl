// Four bones a vertex, and a morph target; the normal by the same matrices.
struct In { @location(0) position: vec3f, @location(1) normal: vec3f, @location(2) joints: vec4u, @location(3) weights: vec4f, @builtin(vertex_index) index: u32 }
struct Out { @builtin(position) clip: vec4f, @location(0) normal: vec3f, @location(1) @interpolate(flat) bone: u32 }
@group(0) @binding(0) var<uniform> view_projection: mat4x4f;
@group(0) @binding(1) var<storage, read> bones: array<mat4x4f>;
@group(0) @binding(2) var<storage, read> morph: array<vec3f>;
@group(0) @binding(3) var<uniform> morph_weight: f32;

@vertex
fn main(in: In) -> Out {
    var skin = mat4x4f();
    for (var k = 0; k < 4; k++) { skin = skin + in.weights[k] * bones[in.joints[k]]; }
    let moved = in.position + morph_weight * morph[in.index];
    let world = skin * vec4f(moved, 1.0);
    let turn = mat3x3f(skin[0].xyz, skin[1].xyz, skin[2].xyz);
    return Out(view_projection * world, normalize(turn * in.normal), in.joints.x);
}
