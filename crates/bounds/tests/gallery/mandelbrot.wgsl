// A fractal in a storage texture: a loop that leaves early, colours by a cosine palette.
struct View { centre: vec2f, scale: f32, iterations: u32 }
@group(0) @binding(0) var<uniform> view: View;
@group(0) @binding(1) var image: texture_storage_2d<rgba8unorm, write>;

fn palette(t: f32) -> vec3f {
    return 0.5 + 0.5 * cos(6.28318 * (t + vec3f(0.0, 0.33, 0.67)));
}

@compute @workgroup_size(8, 8)
fn main(@builtin(global_invocation_id) id: vec3u) {
    let size = textureDimensions(image);
    if (any(id.xy >= size)) { return; }
    let c = view.centre + (vec2f(id.xy) / vec2f(size) - 0.5) * view.scale;
    var z = vec2f(0.0);
    var n = 0u;
    let most = min(view.iterations, 64u);
    loop {
        if (n >= most || dot(z, z) > 4.0) { break; }
        z = vec2f(z.x * z.x - z.y * z.y, 2.0 * z.x * z.y) + c;
        continuing { n += 1u; }
    }
    let colour = select(palette(f32(n) / 64.0), vec3f(0.0), n == most);
    textureStore(image, id.xy, vec4f(colour, 1.0));
}
