// A compute shader that is not Bossage's: colours of any brightness are brought into [0, 1], brighter ones are compressed more. Run it on
// every route and adapter of this machine, on inputs from tone_map.ranges.toml:
//
//     bossage conform --shader examples/shaders/tone_map.wgsl

struct Settings {
    exposure: f32,
    // The least brightness that becomes white.
    white: f32,
}

@group(0) @binding(0) var<uniform> settings: Settings;
@group(0) @binding(1) var<storage, read> colors: array<vec4f>;
@group(0) @binding(2) var<storage, read_write> mapped: array<vec4f>;

fn luminance(color: vec3f) -> f32 {
    return dot(color, vec3f(0.2126, 0.7152, 0.0722));
}

@compute @workgroup_size(64)
fn tone_map(@builtin(global_invocation_id) id: vec3u) {
    if (id.x >= arrayLength(&colors)) {
        return;
    }
    let color = colors[id.x].rgb * exp2(settings.exposure);
    let bright = luminance(color);
    let compressed = bright * (1.0 + bright / (settings.white * settings.white)) / (1.0 + bright);
    let scale = select(0.0, compressed / bright, bright > 0.0);
    mapped[id.x] = vec4f(min(color * scale, vec3f(1.0)), colors[id.x].a);
}
