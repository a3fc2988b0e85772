// Subgroup operations.
@group(0) @binding(0) var<storage, read_write> o: array<u32>;

@compute @workgroup_size(64)
fn main(@builtin(local_invocation_index) l: u32, @builtin(subgroup_size) size: u32, @builtin(subgroup_invocation_id) id: u32,
        @builtin(subgroup_id) sg: u32, @builtin(num_subgroups) n: u32) {
    let ballot = subgroupBallot((id & 1u) == 1u);
    let sum = subgroupAdd(id);
    let before = subgroupExclusiveAdd(1u);
    let upto = subgroupInclusiveAdd(1u);
    let product = subgroupMul(select(1u, 3u, id < 2u));
    let most = subgroupMax(id) + subgroupMin(id);
    let bits = subgroupAnd(id | 32u) + subgroupOr(id) + subgroupXor(id);
    let both = u32(subgroupAll(id < 99u)) + 2u * u32(subgroupAny(id == 3u));
    let first = subgroupBroadcastFirst(l) + subgroupBroadcast(id, 5u);
    let moved = subgroupShuffle(id, (id + 1u) % size) + 100u * subgroupShuffleXor(id, 1u);
    let shifted = subgroupShuffleDown(id, 0u) + subgroupShuffleUp(id, 0u);
    let quad = quadBroadcast(id, 2u) + 10u * quadSwapX(id) + 100u * quadSwapY(id) + 1000u * quadSwapDiagonal(id);
    let scan = subgroupExclusiveMul(2u) + subgroupInclusiveMul(1u);
    if (l == 33u) {
        o[0] = ballot.x; o[1] = sum; o[2] = before; o[3] = upto; o[4] = product; o[5] = most; o[6] = bits;
        o[7] = both; o[8] = first; o[9] = moved; o[10] = shifted; o[11] = quad; o[12] = sg + 10u * n; o[13] = scan;
    }
}
