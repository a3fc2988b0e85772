// Gerstner waves over a grid, one draw for many instances.
struct Wave { direction: vec2f, length: f32, steepness: f32 }
struct Out { @builtin(position) clip: vec4f, @location(0) normal: vec3f, @location(1) height: f32 }
@group(0) @binding(0) var<uniform> view_projection: mat4x4f;
@group(0) @binding(1) var<uniform> waves: array<Wave, 3>;
@group(0) @binding(2) var<uniform> time: f32;
const SIDE = 16u;
const CORNERS = array<vec2u, 6>(vec2u(0, 0), vec2u(1, 0), vec2u(0, 1), vec2u(0, 1), vec2u(1, 0), vec2u(1, 1));

@vertex
fn main(@builtin(vertex_index) vertex: u32, @builtin(instance_index) instance: u32) -> Out {
    let cell = vertex / 6u;
    var corners = CORNERS;
    let corner = corners[vertex % 6u];
    var p = vec3f(f32(cell % SIDE + corner.x), 0.0, f32(cell / SIDE % SIDE + corner.y));
    p.x += f32(instance) * f32(SIDE);
    var du = vec3f(1.0, 0.0, 0.0);
    var dv = vec3f(0.0, 0.0, 1.0);
    for (var i = 0; i < 3; i++) {
        let wave = waves[i];
        let k = 6.2831855 / max(wave.length, 0.1);
        let d = normalize(wave.direction + vec2f(1e-4, 0.0));
        let f = k * (dot(d, p.xz) - sqrt(9.8 / k) * time);
        let a = wave.steepness / k;
        let s = sin(f);
        let c = cos(f);
        p += vec3f(d.x * a * c, a * s, d.y * a * c);
        du += vec3f(-d.x * d.x * wave.steepness * s, d.x * wave.steepness * c, -d.x * d.y * wave.steepness * s);
        dv += vec3f(-d.x * d.y * wave.steepness * s, d.y * wave.steepness * c, -d.y * d.y * wave.steepness * s);
    }
    return Out(view_projection * vec4f(p, 1.0), normalize(cross(dv, du)), p.y);
}
