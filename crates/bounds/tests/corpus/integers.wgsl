// Integer operators and built-ins, bit fields, packing, conversions.
@group(0) @binding(0) var<storage, read> a: array<i32>;
@group(0) @binding(1) var<storage, read_write> o: array<u32>;

@compute @workgroup_size(1)
fn main() {
    let x = a[0];
    let y = a[1];
    let u = bitcast<u32>(x);
    let v = u32(y);
    o[0] = bitcast<u32>(x + y) ^ bitcast<u32>(x - y);
    o[1] = bitcast<u32>(x * y);
    o[2] = bitcast<u32>(x / y) + bitcast<u32>(x % y);
    o[3] = (u & v) | (u << 3u);
    o[4] = bitcast<u32>(x >> 2u) + (u >> 2u);
    o[5] = ~u;
    o[6] = countOneBits(u) + 100u * countLeadingZeros(v) + 10000u * countTrailingZeros(v);
    o[7] = reverseBits(v);
    o[8] = firstLeadingBit(v) + 100u * firstTrailingBit(v) + 10000u * bitcast<u32>(firstLeadingBit(x));
    o[9] = extractBits(u, 4u, 8u);
    o[10] = bitcast<u32>(extractBits(x, 4u, 8u));
    o[11] = insertBits(u, v, 8u, 4u);
    o[12] = bitcast<u32>(min(x, y)) + bitcast<u32>(max(x, y)) + bitcast<u32>(clamp(x, -5, 5));
    o[13] = bitcast<u32>(abs(x)) + bitcast<u32>(sign(x));
    o[14] = bitcast<u32>(dot(vec3i(x, y, 1), vec3i(2, 3, 4)));
    o[15] = dot4U8Packed(u, v) + bitcast<u32>(dot4I8Packed(u, v));
    o[16] = pack4x8unorm(vec4f(0.0, 0.5, 1.0, 2.0));
    o[17] = pack4x8snorm(vec4f(-1.0, 0.5, 1.0, -0.25));
    o[18] = pack2x16unorm(vec2f(0.25, 1.0));
    o[19] = pack2x16snorm(vec2f(-0.25, 1.0));
    o[20] = pack2x16float(vec2f(1.0, -2.0));
    o[21] = pack4xU8(vec4u(1u, 2u, 259u, 4u)) ^ pack4xI8(vec4i(-1, 2, 3, 4));
    o[22] = pack4xU8Clamp(vec4u(1u, 2u, 259u, 4u)) ^ pack4xI8Clamp(vec4i(-200, 2, 300, 4));
    let bytes = unpack4xU8(u);
    let signed = unpack4xI8(u);
    o[23] = bytes.x + bytes.w + bitcast<u32>(signed.x + signed.w);
    o[24] = bitcast<u32>(unpack4x8unorm(0xff008000u).y) ^ bitcast<u32>(unpack4x8snorm(0x81u).x);
    o[25] = bitcast<u32>(unpack2x16unorm(0xffffu).x) ^ bitcast<u32>(unpack2x16snorm(0x8001u).x);
    o[26] = bitcast<u32>(unpack2x16float(0xc0003c00u).y);
    o[27] = u32(-3.9) + u32(3.9);
    o[28] = bitcast<u32>(i32(f32(y) * 1e20)) ^ bitcast<u32>(i32(f32(x) * 0.5));
    o[29] = u32(bool(x)) + u32(x < y) * 2u + u32(x <= y) * 4u + u32(x > y) * 8u + u32(x >= y) * 16u + u32(x == y) * 32u + u32(x != y) * 64u;
    o[30] = bitcast<u32>(-x) + bitcast<u32>(f32(v));
    o[31] = bitcast<u32>(x / (y - y)) + u % (v - v) + (u ^ v);
}
