// parallax_occlusion, the price to compare with: the library's own form.

fn search_ray(uv_top: vec2f, delta: vec2f) -> Found {
    let step = 1.0 / f32(search.steps);
    var t = 0.0;
    var gap_before = 0.0;
    var gap = textureSampleLevel(height_map, surface_sampler, uv_top, search.level).r - 1.0;
    for (var layer = 1u; gap < 0.0 && layer <= search.steps; layer++) {
        gap_before = gap;
        t = f32(layer) * step;
        gap = textureSampleLevel(height_map, surface_sampler, uv_top + t * delta, search.level).r - (1.0 - t);
    }
    if (t > 0.0) {
        let above = max(-gap_before, 1.17549435e-38);
        t -= step * (1.0 - above / (above + max(gap, 0.0)));
    }
    return Found(t, false);
}
