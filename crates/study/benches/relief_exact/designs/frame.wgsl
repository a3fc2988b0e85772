// What all designs share: bindings, the ray, the record. Behind it stands a design's
// `fn search_ray(uv_top: vec2f, delta: vec2f) -> Found`.

struct Search {
    scale: f32,
    bias: f32,
    v_factor: f32,
    level: f32,
    steps: u32,
    refinements: u32,
    edge_mode: u32,
}

struct View {
    uv: vec2f,
    dir_ts: vec3f,
}

struct HitRecord {
    uv: vec2f,
    t: f32,
    status: u32,
}

struct Found {
    t: f32,
    capped: bool,
}

@group(0) @binding(0) var height_map: texture_2d<f32>;
@group(0) @binding(1) var surface_sampler: sampler;
// What is baked from the heights; each design says what it holds.
@group(0) @binding(2) var relief_map: texture_2d<f32>;
@group(0) @binding(3) var<uniform> search: Search;
@group(0) @binding(4) var<storage, read> rays: array<View>;
@group(0) @binding(5) var<storage, read_write> hits: array<HitRecord>;
@group(0) @binding(6) var patch_map: texture_2d<f32>;

@compute @workgroup_size(64)
fn relief_hits(@builtin(global_invocation_id) id: vec3u) {
    if (id.x >= arrayLength(&hits)) {
        return;
    }
    let view = rays[id.x];
    let slope = vec2f(view.dir_ts.x, search.v_factor * view.dir_ts.y) / max(view.dir_ts.z, 0.05);
    let status = select(0u, 1u, view.dir_ts.z < 0.05);
    let uv_top = view.uv + (search.scale + search.bias) * slope;
    let delta = -search.scale * slope;
    let found = search_ray(uv_top, delta);
    hits[id.x] = HitRecord(uv_top + found.t * delta, found.t, select(status, 2u, found.capped));
}

const CAP: u32 = 65536u;

// Below all that a root within a cell is divided by: gaps are sums of heights and t, and no smaller than their last digits.
const SMALLEST_DIVISOR: f32 = 1e-30;

// The corners of a cell on level 0: h00, h10, h01, h11.
fn cell_corners(cell: vec2f) -> vec4f {
    return textureGather(0, height_map, surface_sampler, (cell + 1.0) / vec2f(textureDimensions(height_map, 0))).wzxy;
}

// The texel in 0..size that stands for an index.
fn resolve_edge(index: i32, size: i32) -> i32 {
    if (search.edge_mode == 0u) {
        return index - size * i32(floor((f32(index) + 0.5) / f32(size)));
    }
    if (search.edge_mode == 1u) {
        let k = index - 2 * size * i32(floor((f32(index) + 0.5) / f32(2 * size)));
        return min(k, 2 * size - 1 - k);
    }
    return clamp(index, 0, size - 1);
}

// How far the patch stands over the ray: x + y * s + z * s² at s behind t, from the corners h00, h10, h01, h11 and the place in
// the cell at t.
fn patch_along(h: vec4f, place: vec2f, along: vec2f, t: f32) -> vec3f {
    let rise = vec2f(h.y - h.x, h.z - h.x);
    let twist = (h.w - h.z) - rise.x;
    let height = h.x + rise.x * place.x + (rise.y + twist * place.x) * place.y;
    let slope = dot(rise, along) + twist * (place.x * along.y + place.y * along.x);
    return vec3f(height - (1.0 - t), slope + 1.0, twist * along.x * along.y);
}

// Whether x + y * s + z * s² reaches 0 for an s in [0, length]: at an end, or at a summit between them.
fn is_met(gap: vec3f, length: f32) -> bool {
    let at_end = gap.x + length * (gap.y + length * gap.z);
    let summit = gap.y > 0.0 && gap.y + 2.0 * length * gap.z < 0.0;
    return gap.x >= 0.0 || at_end >= 0.0 || (summit && gap.y * gap.y >= 4.0 * gap.z * gap.x);
}

// The smallest s in [0, length] at which x + y * s + z * s² >= 0, in the form that cancels nothing; length where there is none.
fn first_root(gap: vec3f, length: f32) -> f32 {
    if (gap.x >= 0.0) {
        return 0.0;
    }
    let root = sqrt(max(gap.y * gap.y - 4.0 * gap.z * gap.x, 0.0));
    let rises = gap.y >= 0.0;
    let dividend = select(root - gap.y, -2.0 * gap.x, rises);
    let divisor = select(2.0 * gap.z, gap.y + root, rises);
    // Told before it is divided whether the root lies within, so that what is divided by is never nearly 0.
    if (dividend >= divisor * length) {
        return length;
    }
    return dividend / max(divisor, SMALLEST_DIVISOR);
}
