// Fragment inputs beyond the usual ones, and every way to interpolate.
enable primitive_index;
struct In {
    @builtin(primitive_index) primitive: u32,
    @builtin(view_index) view: u32,
    @builtin(barycentric) weights: vec3f,
    @location(0) @interpolate(linear, centroid) a: f32,
    @location(1) @interpolate(perspective, sample) b: f32,
    @location(2) @interpolate(flat, first) c: f32,
    @location(3) @interpolate(flat, either) d: i32,
    @location(4) @interpolate(linear, center) e: f32,
}

@fragment
fn main(in: In) -> @location(0) vec4f {
    let ids = f32(in.primitive) + 10.0 * f32(in.view);
    return vec4f(ids, in.weights.y, in.a + in.b + in.c + f32(in.d), in.e);
}
