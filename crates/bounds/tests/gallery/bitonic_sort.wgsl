// One pass of a bitonic sort of keys with values.
struct Pass { block: u32, step: u32 }
struct Item { key: f32, value: u32 }
@group(0) @binding(0) var<uniform> stage: Pass;
@group(0) @binding(1) var<storage, read_write> items: array<Item>;

@compute @workgroup_size(32)
fn main(@builtin(global_invocation_id) id: vec3u) {
    let other = id.x ^ stage.step;
    if (other <= id.x || other >= arrayLength(&items)) { return; }
    let ascending = (id.x & stage.block) == 0u;
    let a = items[id.x];
    let b = items[other];
    if ((a.key > b.key) == ascending) {
        items[id.x] = b;
        items[other] = a;
    }
}
