// Conway's game of life on a torus, cells in words.
@group(0) @binding(0) var<storage, read> size: vec2u;
@group(0) @binding(1) var<storage, read> before: array<u32>;
@group(0) @binding(2) var<storage, read_write> after: array<u32>;

fn cell(x: u32, y: u32) -> u32 {
    return before[(y % max(size.y, 1u)) * size.x + x % max(size.x, 1u)] & 1u;
}

fn neighbours(x: u32, y: u32) -> u32 {
    return cell(x - 1u, y - 1u) + cell(x, y - 1u) + cell(x + 1u, y - 1u) + cell(x - 1u, y) + cell(x + 1u, y)
        + cell(x - 1u, y + 1u) + cell(x, y + 1u) + cell(x + 1u, y + 1u);
}

@compute @workgroup_size(4, 4)
fn main(@builtin(global_invocation_id) id: vec3u) {
    let at = id.y * size.x + id.x;
    switch neighbours(id.x, id.y) {
        case 2u: { after[at] = cell(id.x, id.y); }
        case 3u: { after[at] = 1u; }
        default: { after[at] = 0u; }
    }
}
