// A fragment stage: built-ins, derivatives, discard, several outputs.
struct In {
    @builtin(position) at: vec4f,
    @builtin(front_facing) front: bool,
    @builtin(sample_index) sample: u32,
    @builtin(sample_mask) mask: u32,
    @location(0) uv: vec2f,
    @location(1) @interpolate(flat) id: u32,
}
struct Out {
    @location(0) color: vec4f,
    @location(1) other: vec4f,
    @builtin(frag_depth) depth: f32,
    @builtin(sample_mask) mask: u32,
}

@fragment
fn main(in: In) -> Out {
    var out: Out;
    let f = in.uv.x * in.uv.x + 3.0 * in.uv.y;
    out.color = vec4f(dpdx(f), dpdy(f), fwidth(f), dpdxFine(f));
    out.other = vec4f(dpdyFine(f), dpdxCoarse(f), dpdyCoarse(f), fwidthFine(f) + fwidthCoarse(f));
    out.depth = in.at.z + select(0.0, 0.5, in.front) + f32(in.sample);
    out.mask = in.mask & in.id;
    if (in.uv.x > 2.0) { discard; }
    return out;
}
