// Composite values: structs, arrays, matrices, swizzles, constants, private variables, pointers to all of them.
struct Inner { v: vec3f, k: i32 }
struct Outer { m: mat3x2f, list: array<Inner, 2>, flag: u32 }
struct Uniforms { transform: mat4x4f, scale: vec2f, count: u32, weights: array<vec4f, 2> }

const TABLE = array<f32, 4>(1.0, 2.0, 4.0, 8.0);
var<private> total: f32 = 3.0;
var<private> scratch: array<vec2f, 3>;

@group(0) @binding(0) var<storage, read> a: array<f32>;
@group(0) @binding(1) var<storage, read_write> o: array<f32>;
@group(0) @binding(2) var<uniform> u: Uniforms;
@group(0) @binding(3) var<storage, read_write> s: Outer;
var<immediate> shift: f32;

fn add_to(p: ptr<function, f32>, x: f32) { *p += x; }
fn bump(p: ptr<private, f32>) -> f32 { *p = *p * 2.0; return *p; }
fn third(p: ptr<function, array<vec2f, 3>>, i: i32) -> f32 { return (*p)[i].y; }
fn make(x: f32) -> Inner { return Inner(vec3f(x, x + 1.0, x + 2.0), i32(x)); }

@compute @workgroup_size(1)
fn main(@builtin(workgroup_id) wg: vec3u, @builtin(num_workgroups) n: vec3u) {
    var local = array<vec2f, 3>(vec2f(1.0, 2.0), vec2f(3.0, 4.0), vec2f(5.0, 6.0));
    let i = i32(a[0]);
    o[0] = local[i].x + TABLE[i + 1];
    local[i].y = 40.0;
    o[1] = third(&local, i);
    var m = mat2x3f(vec3f(1.0, 2.0, 3.0), vec3f(4.0, 5.0, 6.0));
    m[i][2] = 9.0;
    o[2] = (m * vec2f(1.0, 10.0)).z;
    o[3] = (vec3f(1.0, 1.0, 1.0) * m).y;
    o[4] = (transpose(m) * m)[0][1];
    var x = 1.5;
    add_to(&x, 2.0);
    o[5] = x + bump(&total);
    let inner = make(7.0);
    o[6] = inner.v.zyx.y + f32(inner.k);
    s.list[1] = inner;
    s.m[2] = vec2f(8.0, 9.0);
    s.flag = arrayLength(&a);
    o[7] = s.list[1].v.z + s.m[2].y + f32(s.flag);
    o[8] = (u.transform * vec4f(1.0, 2.0, 3.0, 1.0)).x * u.scale.y + u.weights[u.count].z;
    var copy = s;
    copy.list[0].v = vec3f(1.0);
    o[9] = copy.list[0].v.x + s.list[0].v.x;
    let v = vec4f(1.0, 2.0, 3.0, 4.0);
    o[10] = v[i + 1] + v.wz.x;
    scratch[1] = vec2f(x);
    o[11] = scratch[i].y + scratch[2].x;
    o[12] = select(1.0, 2.0, i == 1) + dot(select(vec2f(1.0), vec2f(10.0), vec2<bool>(true, false)), vec2f(1.0, 2.0));
    o[13] = f32(n.x) + f32(wg.x) + shift;
    let zero = Outer();
    o[14] = f32(zero.flag) + f32(any(vec2<bool>(false, i == 1))) + f32(all(vec2<bool>(true, i == 2)));
    o[15] = (m + m)[1].x - (m - m - m)[0].y + (m * 2.0)[0].x + (2.0 * vec2f(3.0)).x;
    let flags = vec2<bool>(i == 1, i == 2);
    o[16] = f32(!flags.x) + f32(flags.x != flags.y) * 2.0 + f32(flags.x & flags.y) * 4.0 + f32(flags.x | flags.y) * 8.0;
}
