// Gravity among all bodies, tile by tile, and a leapfrog step.
struct Body { position: vec4f, velocity: vec4f }
struct Settings { delta: f32, softening: f32, count: u32 }
@group(0) @binding(0) var<uniform> settings: Settings;
@group(0) @binding(1) var<storage, read> bodies: array<Body>;
@group(0) @binding(2) var<storage, read_write> moved: array<Body>;
const TILE = 16u;
var<workgroup> tile: array<vec4f, TILE>;

fn pull(start: vec3f, body: vec4f) -> vec3f {
    let d = body.xyz - start;
    let squared = dot(d, d) + settings.softening * settings.softening + 1e-6;
    return d * (body.w * inverseSqrt(squared * squared * squared));
}

@compute @workgroup_size(TILE)
fn main(@builtin(global_invocation_id) id: vec3u, @builtin(local_invocation_id) local: vec3u) {
    let count = min(settings.count, arrayLength(&bodies));
    let me = bodies[min(id.x, arrayLength(&bodies) - 1u)];
    var acceleration = vec3f(0.0);
    for (var start = 0u; start < min(count, 32u); start += TILE) {
        tile[local.x] = bodies[min(start + local.x, arrayLength(&bodies) - 1u)].position;
        workgroupBarrier();
        for (var k = 0u; k < TILE; k++) { acceleration += pull(me.position.xyz, tile[k]); }
        workgroupBarrier();
    }
    var next = me;
    next.velocity = vec4f(me.velocity.xyz + settings.delta * acceleration, 0.0);
    next.position += settings.delta * vec4f(next.velocity.xyz, 0.0);
    if (id.x < arrayLength(&moved)) { moved[id.x] = next; }
}
