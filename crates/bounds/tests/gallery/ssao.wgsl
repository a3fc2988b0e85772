// Occlusion in screen space: a turned kernel of samples against the depth buffer.
struct Settings { projection: mat4x4f, inverse_projection: mat4x4f, kernel: array<vec4f, 16>, radius: f32, bias: f32 }
@group(0) @binding(0) var<uniform> settings: Settings;
@group(0) @binding(1) var depths: texture_depth_2d;
@group(0) @binding(2) var normals: texture_2d<f32>;
@group(0) @binding(3) var noise: texture_2d<f32>;

fn view_position(uv: vec2f, depth: f32) -> vec3f {
    let p = settings.inverse_projection * vec4f(uv * vec2f(2.0, -2.0) + vec2f(-1.0, 1.0), depth, 1.0);
    return p.xyz / p.w;
}

@fragment
fn main(@builtin(position) place: vec4f) -> @location(0) f32 {
    let size = vec2f(textureDimensions(depths));
    let uv = place.xy / size;
    let at = vec2i(place.xy);
    let origin = view_position(uv, textureLoad(depths, at, 0));
    let n = normalize(textureLoad(normals, at, 0).xyz * 2.0 - 1.0);
    let turn = textureLoad(noise, at & vec2i(3), 0).xyz * 2.0 - 1.0;
    let t = normalize(turn - n * dot(turn, n));
    let frame = mat3x3f(t, cross(n, t), n);
    var occlusion = 0.0;
    for (var i = 0; i < 8; i++) {
        let p = origin + frame * settings.kernel[i].xyz * settings.radius;
        let clip = settings.projection * vec4f(p, 1.0);
        let suv = clip.xy / clip.w * vec2f(0.5, -0.5) + 0.5;
        let texel = vec2i(clamp(suv, vec2f(0.0), vec2f(0.999)) * size);
        let there = view_position(suv, textureLoad(depths, texel, 0)).z;
        let range = smoothstep(0.0, 1.0, settings.radius / max(abs(origin.z - there), 1e-4));
        occlusion += select(0.0, range, there >= p.z + settings.bias);
    }
    return 1.0 - occlusion / 8.0;
}
