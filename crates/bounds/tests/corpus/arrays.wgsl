// Arrays of bindings.
enable wgpu_binding_array;
@group(0) @binding(0) var pictures: binding_array<texture_2d<f32>, 2>;
@group(0) @binding(1) var samplers: binding_array<sampler, 2>;
@group(0) @binding(2) var<storage, read_write> o: array<f32>;

@compute @workgroup_size(2)
fn main(@builtin(local_invocation_index) l: u32) {
    o[l] = textureLoad(pictures[l], vec2i(0, 0), 0).x;
    o[2u + l] = textureSampleLevel(pictures[l], samplers[1], vec2f(0.5), 0.0).x;
}
