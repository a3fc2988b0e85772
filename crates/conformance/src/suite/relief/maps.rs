//! The height maps of relief cases: small, and each hard in a way of its own.

use bossage_assets::HeightField;
use rand::RngExt;

use crate::generate::random::stream;

/// The maps by name.
pub(super) fn all() -> Vec<(&'static str, HeightField)> {
    vec![
        ("one", HeightField::from_fn(1, 1, |_, _| 0.625)),
        ("column", noise(1, 7)),
        ("row", noise(7, 1)),
        ("flat", HeightField::from_fn(4, 4, |_, _| 0.25)),
        ("noise", noise(13, 8)),
        ("waves", waves()),
        ("walls", walls()),
        ("spikes", spikes()),
    ]
}

/// Bytes without any relation.
fn noise(width: u32, height: u32) -> HeightField {
    let mut rng = stream("relief", 1);
    let texels: Vec<f32> = (0..width * height)
        .map(|_| rng.random_range(0..=255u32) as f32 / 255.0)
        .collect();
    HeightField::from_fn(width, height, |x, y| texels[(y * width + x) as usize])
}

/// Smooth floats that tile, on sides that are no powers of two.
fn waves() -> HeightField {
    let phase = |i: u32, n: f32| std::f32::consts::TAU * (i as f32 + 0.25) / n;
    HeightField::from_fn(24, 18, |x, y| {
        0.5 + 0.25 * phase(x, 24.0).sin() + 0.2 * phase(y, 9.0).cos()
    })
}

/// Walls one texel wide along both axes, over ground of two heights.
fn walls() -> HeightField {
    HeightField::from_fn(16, 32, |x, y| match (x % 8, y % 16) {
        (3, _) => 1.0,
        (_, 11) => 0.75,
        (0..4, _) => 0.0,
        _ => 0.25,
    })
}

/// Single texels of full height.
fn spikes() -> HeightField {
    HeightField::from_fn(16, 16, |x, y| f32::from(u8::from((x * 7 + y * 11) % 31 == 0)))
}
