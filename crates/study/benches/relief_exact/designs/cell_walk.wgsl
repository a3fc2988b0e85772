// Cell by cell, each tested. No map.

// Texels along the side of a block.
const BLOCK: f32 = 2.0;

// What less travel than this along an axis counts as, in texels: such a ray never leaves its column.
const SMALLEST_TRAVEL: f32 = 1e-18;

// The ray in texels of the map, 0 at the tile's corner, and how the map goes on beyond the tile.
struct Course {
    origin: vec2f,
    along: vec2f,
    // Depth by which the ray goes on by a texel.
    inverse: vec2f,
    size: vec2f,
    // After how many texels the map repeats, and one over it; 0 where it never does.
    period: vec2f,
    frequency: vec2f,
    // Where a place is mirrored to 0; beyond all places where none is.
    turn: vec2f,
}

fn search_ray(uv_top: vec2f, delta: vec2f) -> Found {
    let course = ray_course(uv_top, delta);
    var t = 0.0;
    var runs = 0u;
    let forward = course.along >= vec2f(0.0);
    let way = select(vec2f(-1.0), vec2f(1.0), forward);
    let inverse = way * course.inverse;
    let side = select(vec2f(0.5), vec2f(1.5), forward);
    var cell = floor(course.origin + t * course.along - 0.5);
    var gap = vec3f(0.0);
    var end = t;
    loop {
        let sides = (cell + side - course.origin) * inverse;
        end = clamp(min(sides.x, sides.y), t, 1.0);
        let corners = cell_corners(cell);
        gap = patch_along(corners, course.origin + t * course.along - 0.5 - cell, course.along, t);
        if (is_met(gap, end - t) || end >= 1.0 || runs >= CAP) {
            break;
        }
        runs++;
        let next = cell + select(vec2f(0.0, way.y), vec2f(way.x, 0.0), sides.x <= sides.y);
        t = end;
        cell = next;
    }
    return Found(t + first_root(gap, end - t), runs >= CAP);
}

fn ray_course(uv_top: vec2f, delta: vec2f) -> Course {
    let size = vec2f(textureDimensions(height_map, 0));
    let along = delta * size;
    let mirrors = search.edge_mode == 1u;
    let repeats = mirrors || search.edge_mode == 0u;
    let period = size * select(1.0, 2.0, mirrors);
    return Course(
        uv_top * size,
        along,
        1.0 / max(abs(along), vec2f(SMALLEST_TRAVEL)),
        size,
        period,
        select(vec2f(0.0), 1.0 / period, repeats),
        select(vec2f(1e30), period, mirrors),
    );
}

// How far the ray may run from t on over the windows of its block, all of which lie ahead of it: t or less where the block itself is
// not free.
