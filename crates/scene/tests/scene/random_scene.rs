//! Scenes at random: a seed gives a scene with one material, seen somehow, and a budget that may be hard or easy.

use std::sync::Arc;

use bossage_assets::HeightField;
use bossage_scene::Scene;
use rand::{Rng, RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;

use crate::fixture::Folder;

/// The scene of a seed.
pub(crate) fn scene(seed: u64) -> Scene {
    let random = &mut Pcg64Mcg::seed_from_u64(seed);
    let folder = Folder::new();
    folder.height("h.png", |x, y| f32::from((x ^ y) & 1 == 1));
    folder.color("c.png", |x, y| [20 * x as u8, 20 * y as u8, 0, 255]);
    let mut scene = folder.scene(&text(random));
    let height = scene.materials[0].height.as_mut().expect("the text has heights");
    height.field = Arc::new(field(random));
    scene
}

fn text(random: &mut impl Rng) -> String {
    let [fov, tilt, turn] = [25.0..65.0, 0.0..75.0, 0.0..360.0].map(|range| random.random_range(range));
    let distance: f64 = random.random_range(1.5..6.0);
    let side = random.random_range(100..900);
    let scale: f64 = random.random_range(0.02..0.12);
    let bias = -scale * random.random_range(0.0..=1.0);
    // From a twentieth of a pixel to 5.
    let error_px = 0.05 * 100f64.powf(random.random_range(0.0..1.0));
    let address = ["wrap", "mirror", "clamp"][random.random_range(0..3)];
    let repeat: f64 = random.random_range(0.6..3.0);
    let shape = match random.random_range(0..4) {
        0 => "shape = \"sphere\"".to_owned(),
        1 => "shape = \"torus\"".to_owned(),
        _ => format!(
            "shape = \"plane\"\nrotate = {{ axis = [1.0, 0.0, 0.0], angle_deg = {} }}",
            -tilt
        ),
    };
    let (sin, cos) = f64::to_radians(turn).sin_cos();
    format!(
        "schema = 1
[camera]
position = [{}, {}, {distance}]
target = [0.0, 0.0, 0.0]
fov_deg = {fov}
near = 0.05
far = 50.0
size = [{side}, {side}]
[budget]
error_px = {error_px}
[[materials]]
name = \"m\"
albedo = {{ map = \"c.png\" }}
height = {{ map = \"h.png\", scale = {scale}, bias = {bias} }}
address = \"{address}\"
[[objects]]
name = \"o\"
material = \"m\"
uv_repeat = [{repeat}, {repeat}]
{shape}
",
        0.3 * sin,
        0.3 * cos
    )
}

/// Bricks, hills, steps, spikes or noise, of any sides.
fn field(random: &mut impl Rng) -> HeightField {
    let [width, height] = [0; 2].map(|_| random.random_range(24..160u32));
    let kind = random.random_range(0..5);
    let [a, b, c, d] = [0; 4].map(|_| random.random_range(1..6u32));
    let sharp: f32 = random.random_range(0.0..1.0);
    let noise: Vec<f32> = (0..width * height).map(|_| random.random()).collect();
    HeightField::from_fn(width, height, |x, y| {
        let grain = noise[(y * width + x) as usize];
        let (u, v) = (x as f32 / width as f32, y as f32 / height as f32);
        let wave = |n: u32, at: f32| (std::f32::consts::TAU * n as f32 * at).sin();
        match kind {
            0 => bricks(u * a as f32, v * b as f32, 0.02 + 0.1 * sharp) * (1.0 - 0.1 * grain),
            1 => 0.5 + 0.25 * wave(a, u) * wave(b, v) + 0.2 * wave(c, u + v) + 0.05 * wave(3 * d, u - v),
            2 => ((0.5 + 0.5 * wave(a, u) * wave(b, v)) * 4.0).floor() / 4.0,
            3 if grain > 0.97 => 1.0,
            3 => 0.2 * sharp,
            _ => 0.5 + (grain - 0.5) * sharp + 0.25 * wave(a, u) * wave(b, v) * (1.0 - sharp),
        }
    })
}

/// Courses of stones with sloping edges.
fn bricks(u: f32, v: f32, edge: f32) -> f32 {
    let course = (4.0 * v).floor();
    let across = (2.0 * u + 0.5 * (course % 2.0)).fract();
    let rise = |at: f32, edge: f32| (at.min(1.0 - at) / edge).min(1.0);
    rise(across, edge).min(rise((4.0 * v).fract(), 2.0 * edge))
}
