// Every texture built-in, in a fragment stage.
@group(0) @binding(0) var t2: texture_2d<f32>;
@group(0) @binding(1) var s: sampler;
@group(0) @binding(2) var t1: texture_1d<f32>;
@group(0) @binding(3) var t3: texture_3d<f32>;
@group(0) @binding(4) var ta: texture_2d_array<f32>;
@group(0) @binding(5) var tc: texture_cube<f32>;
@group(0) @binding(6) var td: texture_depth_2d;
@group(0) @binding(7) var sc: sampler_comparison;
@group(0) @binding(8) var ti: texture_2d<u32>;
@group(0) @binding(9) var tm: texture_multisampled_2d<f32>;
@group(0) @binding(10) var tw: texture_storage_2d<rgba8unorm, write>;
@group(0) @binding(11) var tr: texture_storage_2d<r32uint, read_write>;
@group(0) @binding(12) var tca: texture_cube_array<f32>;
@group(0) @binding(13) var tda: texture_depth_2d_array;
@group(0) @binding(14) var tdc: texture_depth_cube;
@group(0) @binding(15) var tat: texture_storage_2d<r32uint, atomic>;
@group(0) @binding(16) var<storage, read_write> o: array<f32>;

@fragment
fn main(@location(0) uv: vec2f) -> @location(0) vec4f {
    o[0] = textureSample(t2, s, uv).x;
    o[1] = textureSampleLevel(t2, s, uv, 1.0).x;
    o[2] = textureSampleBias(t2, s, uv, 1.0).x;
    o[3] = textureSampleGrad(t2, s, uv, vec2f(0.25, 0.0), vec2f(0.0, 0.5)).x;
    o[4] = textureSampleLevel(t2, s, uv, 0.0, vec2i(1, 0)).x;
    o[5] = textureLoad(t2, vec2i(1, 2), 0).x;
    let g = textureGather(0, t2, s, vec2f(0.5));
    o[6] = g.x + 10.0 * g.y + 100.0 * g.z + 1000.0 * g.w;
    o[7] = textureLoad(t1, 2, 0).x + textureSample(t1, s, 0.1).y;
    o[8] = textureSampleLevel(t3, s, vec3f(0.5), 0.0).x + textureLoad(t3, vec3i(1, 0, 1), 0).x;
    o[9] = textureSampleLevel(ta, s, vec2f(0.5), 1, 0.0).x + textureLoad(ta, vec2i(0), 7, 0).x;
    o[10] = textureSampleLevel(tc, s, vec3f(0.0, -1.0, 0.0), 0.0).x;
    o[11] = textureSampleCompare(td, sc, vec2f(0.5), 0.5);
    o[12] = textureSampleCompareLevel(td, sc, vec2f(0.25, 0.25), 0.1);
    o[13] = textureSample(td, s, vec2f(0.25, 0.25)) + textureLoad(td, vec2i(1, 1), 0);
    let gc = textureGatherCompare(td, sc, vec2f(0.5), 0.5);
    o[14] = gc.x + 10.0 * gc.y + 100.0 * gc.z + 1000.0 * gc.w;
    o[15] = f32(textureLoad(ti, vec2i(1, 0), 0).x);
    o[16] = textureLoad(tm, vec2i(1, 0), 2).x;
    o[17] = f32(textureDimensions(t2).x + 10u * textureDimensions(t2, 1).y + 100u * textureNumLevels(t2) + 1000u * textureNumLayers(ta) + 10000u * textureNumSamples(tm));
    textureStore(tw, vec2i(1, 0), vec4f(0.5, 2.0, -1.0, 1.0));
    textureStore(tr, vec2i(0, 1), vec4u(textureLoad(tr, vec2i(0, 1)).x + 41u));
    textureAtomicMax(tat, vec2i(1, 1), 9u);
    textureAtomicAdd(tat, vec2i(0, 1), 2u);
    o[18] = textureSampleBaseClampToEdge(t2, s, vec2f(-3.0, 0.125)).x;
    o[19] = textureSampleLevel(tca, s, vec3f(0.0, 0.0, 1.0), 1, 0.0).x;
    o[20] = textureSampleCompareLevel(tda, sc, vec2f(0.25, 0.25), 1, 0.1);
    o[21] = textureSampleCompareLevel(tdc, sc, vec3f(1.0, 0.0, 0.0), 0.5);
    o[22] = textureSample(t2, s, uv, vec2i(0, 1)).x + textureSampleBias(ta, s, uv, 0, 0.0).x + textureSampleGrad(tc, s, vec3f(1.0, 0.0, 0.0), vec3f(0.0), vec3f(0.0)).x;
    return vec4f(uv, 0.0, 1.0);
}
