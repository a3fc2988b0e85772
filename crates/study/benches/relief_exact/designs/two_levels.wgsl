// Two fixed levels: blocks of 8 cells while the ray is above their maxima, then the cells of the block that it may meet, each loop left
// by all lanes together. relief_map: the greatest corner of each block's cells; blocks begin with cell 0, or with the cell before the border.

const BLOCK: f32 = 8.0;

fn block_top(block: vec2f) -> f32 {
    let count = vec2i(textureDimensions(relief_map, 0));
    let at = vec2i(block);
    return textureLoad(relief_map, vec2i(resolve_edge(at.x, count.x), resolve_edge(at.y, count.y)), 0).r;
}

fn search_ray(uv_top: vec2f, delta: vec2f) -> Found {
    let size = vec2f(textureDimensions(height_map, 0));
    let origin = uv_top * size - 0.5 + select(1.0, 0.0, search.edge_mode == 0u);
    let first = select(1.0, 0.0, search.edge_mode == 0u);
    let along = delta * size;
    let forward = along >= vec2f(0.0);
    let way = select(vec2f(-1.0), vec2f(1.0), forward);
    let inverse = way / max(abs(along), vec2f(1e-18));
    let side = select(vec2f(0.0), vec2f(1.0), forward);
    var t = 0.0;
    var block = floor(origin / BLOCK);
    var steps = 0u;
    loop {
        var leaves = ((block + side) * BLOCK - origin) * inverse;
        var block_end = clamp(min(leaves.x, leaves.y), t, 1.0);
        var top = block_top(block);
        while (1.0 - block_end > top && block_end < 1.0 && steps < CAP) {
            t = block_end;
            block += select(vec2f(0.0, way.y), vec2f(way.x, 0.0), leaves.x <= leaves.y);
            leaves = ((block + side) * BLOCK - origin) * inverse;
            block_end = clamp(min(leaves.x, leaves.y), t, 1.0);
            top = block_top(block);
            steps++;
        }
        t = max(t, min(1.0 - top, block_end));
        var cell = clamp(floor(origin + t * along), block * BLOCK, (block + 1.0) * BLOCK - 1.0);
        var end = t;
        loop {
            let sides = (cell + side - origin) * inverse;
            end = clamp(min(sides.x, sides.y), t, block_end);
            let gap = patch_along(cell_corners(cell - first), origin + t * along - cell, along, t);
            if (is_met(gap, end - t)) {
                return Found(t + first_root(gap, end - t), false);
            }
            if (end >= block_end || steps >= CAP) {
                break;
            }
            t = end;
            cell += select(vec2f(0.0, way.y), vec2f(way.x, 0.0), sides.x <= sides.y);
            steps++;
        }
        t = block_end;
        if (t >= 1.0 || steps >= CAP) {
            return Found(t, steps >= CAP);
        }
        block += select(vec2f(0.0, way.y), vec2f(way.x, 0.0), leaves.x <= leaves.y);
        steps++;
        if (steps >= CAP) {
            break;
        }
    }
    return Found(t, true);
}
