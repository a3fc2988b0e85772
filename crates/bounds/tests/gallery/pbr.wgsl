// Metal and roughness by GGX, with a normal map, several lights, an environment and tone mapping.
struct Light { position: vec4f, colour: vec4f }
struct Frame { lights: array<Light, 4>, eye: vec3f, count: u32 }
struct In { @builtin(position) place: vec4f, @location(0) world: vec3f, @location(1) normal: vec3f, @location(2) tangent: vec4f, @location(3) uv: vec2f, @builtin(front_facing) front: bool }
@group(0) @binding(0) var<uniform> frame: Frame;
@group(1) @binding(0) var base_map: texture_2d<f32>;
@group(1) @binding(1) var normal_map: texture_2d<f32>;
@group(1) @binding(2) var surface_map: texture_2d<f32>;
@group(1) @binding(3) var environment: texture_cube<f32>;
@group(1) @binding(4) var smooth_sampler: sampler;

fn distribution(n_h: f32, roughness: f32) -> f32 {
    let a2 = pow(roughness, 4.0);
    let d = n_h * n_h * (a2 - 1.0) + 1.0;
    return a2 / max(3.14159265 * d * d, 1e-6);
}

fn visibility(n_v: f32, n_l: f32, roughness: f32) -> f32 {
    let k = (roughness + 1.0) * (roughness + 1.0) / 8.0;
    return 0.25 / ((n_v * (1.0 - k) + k) * (n_l * (1.0 - k) + k));
}

fn fresnel(v_h: f32, f0: vec3f) -> vec3f { return f0 + (1.0 - f0) * pow(saturate(1.0 - v_h), 5.0); }

fn aces(x: vec3f) -> vec3f {
    return saturate((x * (2.51 * x + 0.03)) / (x * (2.43 * x + 0.59) + 0.14));
}

@fragment
fn main(in: In) -> @location(0) vec4f {
    let base = textureSample(base_map, smooth_sampler, in.uv);
    if (base.a < 0.5) { discard; }
    let surface = textureSample(surface_map, smooth_sampler, in.uv);
    let m = textureSample(normal_map, smooth_sampler, in.uv).xyz * 2.0 - 1.0;
    let n0 = normalize(select(-in.normal, in.normal, in.front));
    let t = normalize(in.tangent.xyz - n0 * dot(n0, in.tangent.xyz));
    let n = normalize(mat3x3f(t, cross(n0, t) * in.tangent.w, n0) * m);
    let v = normalize(frame.eye - in.world);
    let roughness = clamp(surface.g, 0.04, 1.0);
    let f0 = mix(vec3f(0.04), base.rgb, surface.b);
    let n_v = max(dot(n, v), 1e-4);
    var colour = textureSampleLevel(environment, smooth_sampler, reflect(-v, n), roughness * 4.0).rgb * fresnel(n_v, f0) * surface.r;
    for (var i = 0u; i < min(frame.count, 4u); i++) {
        let to_light = frame.lights[i].position.xyz - in.world * frame.lights[i].position.w;
        let l = normalize(to_light);
        let h = normalize(l + v);
        let n_l = saturate(dot(n, l));
        let f = fresnel(dot(v, h), f0);
        let specular = f * distribution(saturate(dot(n, h)), roughness) * visibility(n_v, n_l, roughness);
        let diffuse = (1.0 - f) * (1.0 - surface.b) * base.rgb / 3.14159265;
        colour += (diffuse + specular) * frame.lights[i].colour.rgb * n_l / max(dot(to_light, to_light), 0.01);
    }
    return vec4f(pow(aces(colour), vec3f(1.0 / 2.2)), base.a);
}
