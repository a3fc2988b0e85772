// Verlet integration of a sheet and a few rounds of its constraints.
struct Settings { delta: f32, damping: f32, width: u32, height: u32, wind: vec3f }
@group(0) @binding(0) var<uniform> settings: Settings;
@group(0) @binding(1) var<storage, read_write> now: array<vec4f>;
@group(0) @binding(2) var<storage, read_write> before: array<vec4f>;

fn keep(p: vec3f, other: u32, rest: f32) -> vec3f {
    if (other >= arrayLength(&now)) { return vec3f(0.0); }
    let d = now[other].xyz - p;
    let l = length(d);
    if (l < 1e-6) { return vec3f(0.0); }
    return d * ((l - rest) / l) * 0.25;
}

@compute @workgroup_size(16)
fn main(@builtin(global_invocation_id) id: vec3u) {
    let i = id.x;
    if (i >= arrayLength(&now) || i >= arrayLength(&before)) { return; }
    let p = now[i];
    if (p.w == 0.0) { return; }
    let velocity = (p.xyz - before[i].xyz) * (1.0 - settings.damping);
    var next = p.xyz + velocity + (vec3f(0.0, -9.8, 0.0) + settings.wind) * settings.delta * settings.delta;
    for (var round = 0; round < 3; round++) {
        next += keep(next, i - 1u, 0.1) + keep(next, i + 1u, 0.1);
        next += keep(next, i - settings.width, 0.1) + keep(next, i + settings.width, 0.1);
    }
    before[i] = p;
    now[i] = vec4f(next, p.w);
}
