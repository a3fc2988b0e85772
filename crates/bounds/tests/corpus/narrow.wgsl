// Integers of 16 bits: they wrap at their own width.
enable wgpu_int16;
@group(0) @binding(0) var<storage, read> a: array<i32>;
@group(0) @binding(1) var<storage, read_write> o: array<i32>;

@compute @workgroup_size(1)
fn main() {
    let x = i16(a[0]);
    let y = u16(a[1]);
    o[0] = i32(x * i16(7));
    o[1] = i32(y + u16(40000));
    o[2] = i32(x / i16(3)) + i32(x % i16(3));
    o[3] = i32(max(x, i16(-5))) + i32(select(0u, 1u, y > u16(2)));
}
