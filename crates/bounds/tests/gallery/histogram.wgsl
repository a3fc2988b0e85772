// Luminance of a picture in 64 bins, by logarithm, as exposure control has it.
@group(0) @binding(0) var picture: texture_2d<f32>;
@group(0) @binding(1) var<storage, read_write> bins: array<atomic<u32>, 64>;
var<workgroup> local_bins: array<atomic<u32>, 64>;

fn bin(colour: vec3f) -> u32 {
    let luminance = dot(colour, vec3f(0.2126, 0.7152, 0.0722));
    if (luminance < 0.005) { return 0u; }
    return u32(clamp((log2(luminance) + 8.0) / 12.0, 0.0, 1.0) * 62.0 + 1.0);
}

@compute @workgroup_size(8, 8)
fn main(@builtin(global_invocation_id) id: vec3u, @builtin(local_invocation_index) local: u32) {
    atomicStore(&local_bins[local], 0u);
    workgroupBarrier();
    if (all(id.xy < textureDimensions(picture))) {
        atomicAdd(&local_bins[bin(textureLoad(picture, id.xy, 0).rgb)], 1u);
    }
    workgroupBarrier();
    atomicAdd(&bins[local], atomicLoad(&local_bins[local]));
}
