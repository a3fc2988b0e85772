//! How long the maps for tracing relief take to bake, by size: the time a texel must hardly grow.
//!
//! Goal: the safe cones of 1024² texels in at most 20 s on two cores, which is 40 s of one core: that is what is counted, since the
//! clock on the wall also tells what else the machine does. `cargo bench --profile dev -p bossage-assets`; a number as argument bakes the
//! drawn fields of that side only, a path to an image bakes that instead.

#![allow(clippy::print_stdout, reason = "a benchmark prints")]

use std::path::Path;
use std::time::Instant;

use bossage_assets::{Channel, EdgeMode, HeightField, cone_map, load_image, max_mip, relaxed_cone_map};

/// Goal for the safe cones of 1024², in seconds of one core.
const GOAL_S: f64 = 40.0;

fn main() {
    let argument = std::env::args()
        .skip(1)
        .find(|argument| !argument.starts_with('-'));
    match argument.as_deref().map(|argument| (argument, argument.parse())) {
        Some((_, Ok(side))) => drawn(side),
        Some((path, Err(_))) => report("file", &read(Path::new(path))),
        None => [256, 512, 1024, 2048].into_iter().for_each(drawn),
    }
}

/// The drawn fields of a side.
fn drawn(side: u32) {
    report("courses of stones", &courses(side));
    report("hills", &hills(side));
    report("noise", &noise(side));
}

fn read(path: &Path) -> HeightField {
    let image = load_image(path).unwrap_or_else(|error| panic!("{error}"));
    HeightField::from_image(&image, Channel::Red).unwrap_or_else(|error| panic!("{error}"))
}

/// Stones of 64 by 32 texels with rough faces and joints between them.
fn courses(side: u32) -> HeightField {
    HeightField::from_fn(side, side, |x, y| {
        let shifted = x + 32 * (y / 32 % 2);
        let joint = shifted % 64 < 5 || y % 32 < 5;
        let rough = lot(x, y) * 0.05;
        if joint { 0.1 + rough } else { 0.85 + rough }
    })
}

/// The hard case for a search: smooth, with far horizons.
fn hills(side: u32) -> HeightField {
    HeightField::from_fn(side, side, |x, y| {
        let phase = |i: u32| std::f32::consts::TAU * (i as f32 + 0.5) / side as f32;
        0.5 + 0.3 * phase(x).sin() * (2.0 * phase(y)).cos() + 0.15 * (5.0 * phase(x) + 3.0 * phase(y)).sin()
    })
}

fn noise(side: u32) -> HeightField {
    HeightField::from_fn(side, side, lot)
}

/// Evenly in [0, 1), by place.
fn lot(x: u32, y: u32) -> f32 {
    let n = (x.wrapping_mul(0x9E37_79B1) ^ y.wrapping_mul(0x85EB_CA77)).wrapping_mul(0xC2B2_AE3D);
    ((n ^ (n >> 15)) % 4096) as f32 / 4096.0
}

fn report(name: &str, field: &HeightField) {
    let texels = f64::from(field.width) * f64::from(field.height);
    let row = |map: &str, bake: &dyn Fn()| {
        let (start, before) = (Instant::now(), core_seconds());
        bake();
        let wall = start.elapsed().as_secs_f64();
        let seconds = core_seconds()
            .zip(before)
            .map_or(wall, |(after, before)| after - before);
        let verdict = match (map, field.width.max(field.height)) {
            ("cone_map", 1024) if seconds <= GOAL_S => "  goal of 40 s met",
            ("cone_map", 1024) => "  goal of 40 s MISSED",
            _ => "",
        };
        println!(
            "{name:18} {:>5} × {:<5} {map:18} {seconds:7.2} s of a core, {wall:7.2} s  {:7.0} ns a texel{verdict}",
            field.width,
            field.height,
            1e9 * seconds / texels
        );
    };
    row("max_mip", &|| drop(max_mip::bake(field, EdgeMode::Wrap)));
    row("cone_map", &|| drop(cone_map::bake(field, EdgeMode::Wrap)));
    row("relaxed_cone_map", &|| {
        drop(relaxed_cone_map::bake(field, EdgeMode::Wrap))
    });
}

/// Seconds that this process has used of all cores, where the system says.
fn core_seconds() -> Option<f64> {
    let stat = std::fs::read_to_string("/proc/self/stat").ok()?;
    // After the name in brackets: fields 3 and on; 14 and 15 are user and system time in hundredths of a second.
    let mut fields = stat.rsplit_once(')')?.1.split_whitespace().skip(11);
    let mut ticks = || fields.next()?.parse::<f64>().ok();
    Some((ticks()? + ticks()?) / 100.0)
}
