// Parallax occlusion mapping: a linear march of 32 layers and one secant step, filtered by the sampler.
@group(0) @binding(0) var height_map: texture_2d<f32>;
@group(0) @binding(1) var height_sampler: sampler;

const LAYERS = 32;
const SCALE = 0.05;

@fragment
fn main(@location(0) uv: vec2f, @location(1) view: vec3f) -> @location(0) vec4f {
    let v = normalize(view);
    let shift = -SCALE * v.xy / max(v.z, 0.05);
    let step = 1.0 / f32(LAYERS);
    var t = 0.0;
    var above = 1.0 - textureSampleLevel(height_map, height_sampler, uv, 0.0).r;
    var previous = above;
    for (var k = 0; k < LAYERS; k++) {
        let depth = 1.0 - textureSampleLevel(height_map, height_sampler, uv + t * shift, 0.0).r;
        above = depth - t;
        if (above <= 0.0) { break; }
        previous = above;
        t += step;
    }
    let weight = previous / max(previous - above, 1e-6);
    let hit = clamp(t - step + step * clamp(weight, 0.0, 1.0), 0.0, 1.0);
    return vec4f(uv + hit * shift, hit, 1.0);
}
