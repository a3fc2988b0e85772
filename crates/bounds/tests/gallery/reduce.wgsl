// The sum, least and greatest of many numbers, in shared memory; one atomic a group.
struct Totals { count: atomic<u32>, bits: atomic<i32> }
@group(0) @binding(0) var<storage, read> numbers: array<f32>;
@group(0) @binding(1) var<storage, read_write> totals: Totals;
@group(0) @binding(2) var<storage, read_write> sums: array<vec3f>;
var<workgroup> shared_sum: array<vec3f, 64>;

@compute @workgroup_size(64)
fn main(@builtin(local_invocation_index) local: u32, @builtin(workgroup_id) group: vec3u,
        @builtin(global_invocation_id) id: vec3u) {
    var x = 0.0;
    if (id.x < arrayLength(&numbers)) {
        x = numbers[id.x];
        atomicAdd(&totals.count, 1u);
    }
    shared_sum[local] = vec3f(x);
    workgroupBarrier();
    for (var step = 32u; step > 0u; step >>= 1u) {
        if (local < step) {
            let a = shared_sum[local];
            let b = shared_sum[local + step];
            shared_sum[local] = vec3f(a.x + b.x, min(a.y, b.y), max(a.z, b.z));
        }
        workgroupBarrier();
    }
    if (local == 0u) {
        sums[group.x] = shared_sum[0];
        atomicMax(&totals.bits, bitcast<i32>(shared_sum[0].z));
    }
}
