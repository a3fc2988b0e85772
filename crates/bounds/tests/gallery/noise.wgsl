// Gradient noise by hashing integers, summed over octaves.
fn hash(p: vec3u) -> u32 {
    var h = p * vec3u(1664525u) + vec3u(1013904223u);
    h.x += h.y * h.z; h.y += h.z * h.x; h.z += h.x * h.y;
    h ^= h >> vec3u(16u);
    h.x += h.y * h.z;
    return h.x;
}

fn gradient(cell: vec2i, offset: vec2f, seed: u32) -> f32 {
    let h = hash(vec3u(bitcast<vec2u>(cell), seed));
    let angle = f32(h & 1023u) * (6.2831855 / 1024.0);
    return dot(vec2f(cos(angle), sin(angle)), offset);
}

fn noise(p: vec2f, seed: u32) -> f32 {
    let cell = vec2i(floor(p));
    let f = fract(p);
    let u = f * f * f * (f * (f * 6.0 - 15.0) + 10.0);
    let bottom = mix(gradient(cell, f, seed), gradient(cell + vec2i(1, 0), f - vec2f(1.0, 0.0), seed), u.x);
    let top = mix(gradient(cell + vec2i(0, 1), f - vec2f(0.0, 1.0), seed), gradient(cell + vec2i(1, 1), f - vec2f(1.0), seed), u.x);
    return mix(bottom, top, u.y);
}

@fragment
fn main(@location(0) uv: vec2f, @location(1) @interpolate(flat) seed: u32) -> @location(0) vec4f {
    var sum = 0.0;
    var weight = 0.5;
    var p = uv * 4.0;
    for (var octave = 0u; octave < 4u; octave++) {
        sum += weight * noise(p, seed + octave);
        p = mat2x2f(1.6, 1.2, -1.2, 1.6) * p;
        weight *= 0.5;
    }
    let width = fwidth(sum);
    return vec4f(vec3f(smoothstep(-width, width, sum)), 1.0);
}
