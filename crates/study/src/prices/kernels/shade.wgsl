// Runs `shade` over a frame of items in one of the arithmetics: inputs are f32, everything else is `real`.

@group(0) @binding(0) var<storage, read> inputs: array<f32>;
@group(0) @binding(1) var<storage, read_write> outputs: array<real>;

fn input3(at: u32) -> vec3<real> {
    return vec3<real>(real(inputs[at]), real(inputs[at + 1u]), real(inputs[at + 2u]));
}

@compute @workgroup_size(64)
fn shade_frame(@builtin(global_invocation_id) id: vec3u) {
    if (id.x >= arrayLength(&outputs) / 3u) {
        return;
    }
    let at = 16u * id.x;
    let colour = shade(
        input3(at), input3(at + 3u), input3(at + 6u), input3(at + 9u), input3(at + 12u), real(inputs[at + 15u]),
    );
    outputs[3u * id.x] = colour.x;
    outputs[3u * id.x + 1u] = colour.y;
    outputs[3u * id.x + 2u] = colour.z;
}
