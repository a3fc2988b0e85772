// A tiled product of matrices with a bias and a rectifier.
struct Shape { m: u32, n: u32, k: u32 }
@group(0) @binding(0) var<uniform> shape: Shape;
@group(0) @binding(1) var<storage, read> a: array<f32>;
@group(0) @binding(2) var<storage, read> b: array<f32>;
@group(0) @binding(3) var<storage, read> bias: array<f32>;
@group(0) @binding(4) var<storage, read_write> c: array<f32>;
var<workgroup> tile_a: array<array<f32, 8>, 8>;
var<workgroup> tile_b: array<array<f32, 8>, 8>;

@compute @workgroup_size(8, 8)
fn main(@builtin(global_invocation_id) id: vec3u, @builtin(local_invocation_id) local: vec3u) {
    var sum = 0.0;
    let tiles = min((shape.k + 7u) / 8u, 4u);
    for (var t = 0u; t < tiles; t++) {
        let column = t * 8u + local.x;
        let row = t * 8u + local.y;
        tile_a[local.y][local.x] = select(0.0, a[id.y * shape.k + column], id.y < shape.m && column < shape.k);
        tile_b[local.y][local.x] = select(0.0, b[row * shape.n + id.x], row < shape.k && id.x < shape.n);
        workgroupBarrier();
        for (var k = 0u; k < 8u; k++) { sum = fma(tile_a[local.y][k], tile_b[k][local.x], sum); }
        workgroupBarrier();
    }
    if (id.x < shape.n && id.y < shape.m) { c[id.y * shape.n + id.x] = max(sum + bias[id.x], 0.0); }
}
