// Workgroup memory, barriers, atomics.
var<workgroup> tile: array<u32, 64>;
var<workgroup> sum: atomic<u32>;
var<workgroup> leader: u32;
@group(0) @binding(0) var<storage, read> a: array<u32>;
@group(0) @binding(1) var<storage, read_write> o: array<u32>;
@group(0) @binding(2) var<storage, read_write> counters: array<atomic<i32>, 9>;

@compute @workgroup_size(64)
fn main(@builtin(local_invocation_index) l: u32, @builtin(workgroup_id) wg: vec3u, @builtin(global_invocation_id) g: vec3u) {
    tile[l] = a[g.x];
    workgroupBarrier();
    for (var half = 32u; half > 0u; half /= 2u) {
        if (l < half) { tile[l] += tile[l + half]; }
        workgroupBarrier();
    }
    atomicAdd(&sum, a[g.x]);
    storageBarrier();
    if (l == 0u) { leader = wg.x + 7u; }
    let shared_leader = workgroupUniformLoad(&leader);
    let x = i32(l);
    atomicAdd(&counters[0], x);
    atomicSub(&counters[1], 1);
    atomicMax(&counters[2], x);
    atomicMin(&counters[3], -x);
    atomicAnd(&counters[4], x | 64);
    atomicOr(&counters[5], x);
    atomicXor(&counters[6], x);
    let old = atomicExchange(&counters[7], x);
    let won = atomicCompareExchangeWeak(&counters[8], 0, x + 1);
    textureBarrier();
    if (l == 0u) {
        o[wg.x * 4u] = tile[0];
        o[wg.x * 4u + 1u] = atomicLoad(&sum);
        o[wg.x * 4u + 2u] = shared_leader + u32(old);
        o[wg.x * 4u + 3u] = u32(won.exchanged) + u32(won.old_value);
        atomicStore(&sum, 0u);
    }
}
