// Cascaded shadow maps: a cascade by depth, nine comparisons, a bias by slope.
struct Shadows { matrices: array<mat4x4f, 3>, splits: vec4f, texel: f32 }
@group(0) @binding(0) var<uniform> shadows: Shadows;
@group(0) @binding(1) var maps: texture_depth_2d_array;
@group(0) @binding(2) var compare: sampler_comparison;

fn cascade(depth: f32) -> i32 {
    var index = 2;
    for (var k = 2; k >= 0; k--) { if (depth < shadows.splits[k]) { index = k; } }
    return index;
}

@fragment
fn main(@location(0) world: vec3f, @location(1) depth: f32, @location(2) n_l: f32) -> @location(0) vec4f {
    let index = cascade(depth);
    let clip = shadows.matrices[index] * vec4f(world, 1.0);
    let place = clip.xyz / clip.w;
    let uv = place.xy * vec2f(0.5, -0.5) + 0.5;
    let bias = max(0.005 * (1.0 - n_l), 0.0005);
    var lit = 0.0;
    for (var y = -1; y <= 1; y++) {
        for (var x = -1; x <= 1; x++) {
            let at = uv + vec2f(f32(x), f32(y)) * shadows.texel;
            lit += textureSampleCompareLevel(maps, compare, at, index, place.z - bias);
        }
    }
    return vec4f(vec3f(lit / 9.0), 1.0);
}
