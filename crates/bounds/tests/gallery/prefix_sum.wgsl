// An exclusive scan by Blelloch within a group.
override GROUP: u32 = 32;
@group(0) @binding(0) var<storage, read_write> numbers: array<u32>;
var<workgroup> partial: array<u32, 64>;

@compute @workgroup_size(GROUP)
fn main(@builtin(local_invocation_id) local: vec3u, @builtin(workgroup_id) group: vec3u) {
    let base = group.x * GROUP * 2u;
    partial[local.x * 2u] = numbers[base + local.x * 2u];
    partial[local.x * 2u + 1u] = numbers[base + local.x * 2u + 1u];
    var offset = 1u;
    for (var d = GROUP; d > 0u; d = d / 2u) {
        workgroupBarrier();
        if (local.x < d) {
            let a = offset * (2u * local.x + 1u) - 1u;
            let b = offset * (2u * local.x + 2u) - 1u;
            partial[b] += partial[a];
        }
        offset *= 2u;
    }
    if (local.x == 0u) { partial[GROUP * 2u - 1u] = 0u; }
    for (var d = 1u; d < GROUP * 2u; d *= 2u) {
        offset >>= 1u;
        workgroupBarrier();
        if (local.x < d) {
            let a = offset * (2u * local.x + 1u) - 1u;
            let b = offset * (2u * local.x + 2u) - 1u;
            let before = partial[a];
            partial[a] = partial[b];
            partial[b] += before;
        }
    }
    workgroupBarrier();
    numbers[base + local.x * 2u] = partial[local.x * 2u];
    numbers[base + local.x * 2u + 1u] = partial[local.x * 2u + 1u];
}
