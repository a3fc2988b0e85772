// Text from signed distances in three channels, a vertex and a fragment stage in one file.
struct Glyph { place: vec4f, uv: vec4f, colour: u32 }
struct Varyings { @builtin(position) clip: vec4f, @location(0) uv: vec2f, @location(1) @interpolate(flat) colour: vec4f }
@group(0) @binding(0) var<storage, read> glyphs: array<Glyph>;
@group(0) @binding(1) var atlas: texture_2d<f32>;
@group(0) @binding(2) var smooth_sampler: sampler;

@vertex
fn vertex(@builtin(vertex_index) vertex: u32, @builtin(instance_index) instance: u32) -> Varyings {
    let corner = vec2f(f32(vertex & 1u), f32(vertex >> 1u));
    let glyph = glyphs[instance];
    var out: Varyings;
    out.clip = vec4f(mix(glyph.place.xy, glyph.place.zw, corner), 0.0, 1.0);
    out.uv = mix(glyph.uv.xy, glyph.uv.zw, corner);
    out.colour = unpack4x8unorm(glyph.colour);
    return out;
}

fn median(v: vec3f) -> f32 { return max(min(v.r, v.g), min(max(v.r, v.g), v.b)); }

@fragment
fn fragment(in: Varyings) -> @location(0) vec4f {
    let distance = median(textureSample(atlas, smooth_sampler, in.uv).rgb) - 0.5;
    let unit = vec2f(4.0) / vec2f(textureDimensions(atlas));
    let pixels = max(0.5 * dot(unit, 1.0 / max(fwidth(in.uv), vec2f(1e-5))), 1.0);
    return in.colour * saturate(pixels * distance + 0.5);
}
