// Edges smoothed after the fact: luminance of neighbours, a direction, two and four taps.
@group(0) @binding(0) var picture: texture_2d<f32>;
@group(0) @binding(1) var edge: sampler;

fn luma(c: vec3f) -> f32 { return dot(c, vec3f(0.299, 0.587, 0.114)); }
fn tap(uv: vec2f) -> vec3f { return textureSampleLevel(picture, edge, uv, 0.0).rgb; }

@fragment
fn main(@location(0) uv: vec2f) -> @location(0) vec4f {
    let texel = 1.0 / vec2f(textureDimensions(picture));
    let here = tap(uv);
    let g = vec4f(luma(tap(uv + vec2f(-1.0, -1.0) * texel)), luma(tap(uv + vec2f(1.0, -1.0) * texel)),
        luma(tap(uv + vec2f(-1.0, 1.0) * texel)), luma(tap(uv + vec2f(1.0, 1.0) * texel)));
    let m = luma(here);
    let lowest = min(m, min(min(g.x, g.y), min(g.z, g.w)));
    let highest = max(m, max(max(g.x, g.y), max(g.z, g.w)));
    if (highest - lowest < max(0.03, highest * 0.125)) { return vec4f(here, 1.0); }
    var d = vec2f(-((g.x + g.y) - (g.z + g.w)), (g.x + g.z) - (g.y + g.w));
    let reduce = max((g.x + g.y + g.z + g.w) * 0.03125, 0.0078125);
    d = clamp(d / (min(abs(d.x), abs(d.y)) + reduce), vec2f(-8.0), vec2f(8.0)) * texel;
    let a = 0.5 * (tap(uv - d / 6.0) + tap(uv + d / 6.0));
    let b = a * 0.5 + 0.25 * (tap(uv - d * 0.5) + tap(uv + d * 0.5));
    let l = luma(b);
    return vec4f(select(b, a, l < lowest || l > highest), 1.0);
}
