// One butterfly of a radix-2 transform, and the twiddle factors as a function that returns through a pointer.
struct Stage { span: u32, inverse: u32 }
@group(0) @binding(0) var<uniform> stage: Stage;
@group(0) @binding(1) var<storage, read_write> values: array<vec2f>;

fn times(a: vec2f, b: vec2f) -> vec2f {
    return mat2x2f(a.x, a.y, -a.y, a.x) * b;
}

fn twiddle(k: u32, n: u32, out: ptr<function, vec2f>) {
    let sign = select(-1.0, 1.0, stage.inverse == 1u);
    let angle = sign * 6.2831855 * f32(k) / f32(max(n, 1u));
    *out = vec2f(cos(angle), sin(angle));
}

@compute @workgroup_size(16)
fn main(@builtin(global_invocation_id) id: vec3u) {
    let span = clamp(stage.span, 1u, 64u);
    let k = id.x % span;
    let low = (id.x / span) * span * 2u + k;
    if (low + span >= arrayLength(&values)) { return; }
    var w: vec2f;
    twiddle(k, span * 2u, &w);
    let a = values[low];
    let b = times(w, values[low + span]);
    values[low] = a + b;
    values[low + span] = a - b;
}
