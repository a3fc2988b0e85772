// A shader that is not Bossage's: steep parallax mapping in one file, as an engine might bring it. Both stages, a texture with its
// sampler, a uniform, a loop with a cap. Check and emit it:
//
//     bossage check examples/user_shader.wgsl
//     bossage emit examples/user_shader.wgsl -t hlsl,msl -o out
//
// Run both stages on every route and adapter of this machine, judged by the accuracy rules:
//
//     bossage conform --shader examples/user_shader.wgsl

struct Scene {
    clip_from_world: mat4x4f,
    eye: vec4f,
    // xyz: unit, toward the light.
    light: vec4f,
    // x: depth of the relief in texture units, y: layers.
    relief: vec4f,
}

@group(0) @binding(0) var<uniform> scene: Scene;
@group(0) @binding(1) var height_map: texture_2d<f32>;
@group(0) @binding(2) var height_sampler: sampler;

struct Varyings {
    @builtin(position) clip: vec4f,
    @location(0) world: vec3f,
    @location(1) normal: vec3f,
    @location(2) tangent: vec4f,
    @location(3) uv: vec2f,
}

@vertex
fn vertex_main(
    @location(0) position: vec3f,
    @location(1) normal: vec3f,
    @location(2) uv: vec2f,
    @location(3) tangent: vec4f,
) -> Varyings {
    return Varyings(scene.clip_from_world * vec4f(position, 1.0), position, normal, tangent, uv);
}

const MAX_LAYERS: i32 = 64;

// Marches from the top of the relief downward and stops at the first layer that lies under the surface.
fn march(uv: vec2f, step_uv: vec2f, layers: i32, dx: vec2f, dy: vec2f) -> vec2f {
    let step_height = 1.0 / f32(layers);
    var at = uv;
    var ray_height = 1.0;
    for (var layer = 0; layer < MAX_LAYERS; layer++) {
        let surface = textureSampleGrad(height_map, height_sampler, at, dx, dy).r;
        if (layer >= layers || surface >= ray_height) {
            break;
        }
        at += step_uv;
        ray_height -= step_height;
    }
    return at;
}

// The surface normal from four neighbours, in tangent space.
fn relief_normal(uv: vec2f, depth: f32, dx: vec2f, dy: vec2f) -> vec3f {
    let texel = 1.0 / vec2f(textureDimensions(height_map));
    let left = textureSampleGrad(height_map, height_sampler, uv - vec2f(texel.x, 0.0), dx, dy).r;
    let right = textureSampleGrad(height_map, height_sampler, uv + vec2f(texel.x, 0.0), dx, dy).r;
    let below = textureSampleGrad(height_map, height_sampler, uv - vec2f(0.0, texel.y), dx, dy).r;
    let above = textureSampleGrad(height_map, height_sampler, uv + vec2f(0.0, texel.y), dx, dy).r;
    let slope = depth * vec2f(right - left, above - below) / (2.0 * texel);
    return normalize(vec3f(-slope, 1.0));
}

@fragment
fn fragment_main(in: Varyings) -> @location(0) vec4f {
    let dx = dpdx(in.uv);
    let dy = dpdy(in.uv);
    let normal = normalize(in.normal);
    let tangent = normalize(in.tangent.xyz - dot(in.tangent.xyz, normal) * normal);
    let bitangent = in.tangent.w * cross(normal, tangent);
    let view = normalize(scene.eye.xyz - in.world);
    let view_ts = vec3f(dot(view, tangent), dot(view, bitangent), max(dot(view, normal), 0.05));
    let layers = clamp(i32(scene.relief.y), 1, MAX_LAYERS);
    let step_uv = -scene.relief.x * view_ts.xy / (view_ts.z * f32(layers));
    let uv = march(in.uv, step_uv, layers, dx, dy);
    let n = relief_normal(uv, scene.relief.x, dx, dy);
    let light_ts = vec3f(dot(scene.light.xyz, tangent), dot(scene.light.xyz, bitangent), dot(scene.light.xyz, normal));
    let diffuse = max(dot(n, light_ts), 0.0);
    return vec4f(vec3f(0.1 + 0.9 * diffuse), 1.0);
}
