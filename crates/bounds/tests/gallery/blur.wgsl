// A separable blur: a strip in shared memory, weights that sum to one, a direction by a flag.
struct Settings { along_y: u32, sigma: f32 }
@group(0) @binding(0) var source: texture_2d<f32>;
@group(0) @binding(1) var blurred: texture_storage_2d<rgba16float, write>;
@group(0) @binding(2) var<uniform> settings: Settings;
@group(0) @binding(3) var edge: sampler;
var<workgroup> strip: array<vec4f, 41>;

@compute @workgroup_size(32)
fn main(@builtin(global_invocation_id) id: vec3u, @builtin(local_invocation_id) local: vec3u, @builtin(workgroup_id) group: vec3u) {
    let size = vec2f(textureDimensions(source));
    for (var k = local.x; k < 41u; k += 32u) {
        let along = f32(group.x * 32u + k) - 3.5;
        let at = select(vec2f(along, f32(id.y) + 0.5), vec2f(f32(id.y) + 0.5, along), settings.along_y != 0u);
        strip[k] = textureSampleLevel(source, edge, at / size, 0.0);
    }
    workgroupBarrier();
    var sum = vec4f(0.0);
    var weights = 0.0;
    for (var k = -4; k <= 4; k++) {
        let weight = exp(-f32(k * k) / (2.0 * max(settings.sigma * settings.sigma, 0.01)));
        sum += weight * strip[i32(local.x) + 4 + k];
        weights += weight;
    }
    let at = select(id.xy, id.yx, settings.along_y != 0u);
    textureStore(blurred, at, sum / weights);
}
