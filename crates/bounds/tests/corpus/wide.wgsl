// Types beyond 32 bits, half precision, overrides.
enable f16;
override size: u32 = 3;
@id(7) override factor: f32;
@group(0) @binding(0) var<storage, read> a: array<f32>;
@group(0) @binding(1) var<storage, read_write> o: array<f32>;

@compute @workgroup_size(size)
fn main(@builtin(local_invocation_index) l: u32) {
    let third = f64(a[0]) / f64(a[1]);
    let product = third * 3.0lf;
    let big = i64(a[0]) * 5000000000li + i64(l);
    let huge = u64(a[1]) << 40u;
    let h = f16(a[0]) / f16(a[1]);
    let hv = vec2<f16>(h, 2.0h) * 2.0h;
    o[l * 6u] = f32(product);
    o[l * 6u + 1u] = f32(big % 7li);
    o[l * 6u + 2u] = f32(huge >> 38u);
    o[l * 6u + 3u] = f32(h);
    o[l * 6u + 4u] = f32(hv.y) * factor;
    o[l * 6u + 5u] = f32(size) * 2.0;
}
