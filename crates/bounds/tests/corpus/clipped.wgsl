// A vertex stage that clips, with a value for each of two planes.
enable clip_distances;
struct Out { @builtin(position) at: vec4f, @builtin(clip_distances) planes: array<f32, 2> }

@vertex
fn main(@location(0) x: f32) -> Out {
    var out: Out;
    out.at = vec4f(x, 0.0, 0.0, 1.0);
    out.planes = array<f32, 2>(x - 1.0, 2.0 - x);
    return out;
}
