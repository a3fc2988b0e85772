//! Turns the vase of the example scenes, `vase.obj`: a body of revolution with two texture charts and a seam.
//!
//! The profile is a polygon of rings; v runs along it in proportion to its length, u round the axis. The bottom is a disc with
//! a chart of its own. Written with `vt` counted from the bottom of the image, as OBJ wants.
//!
//! ```text
//! cargo run -p bossage-assets --example make_vase -- examples/meshes
//! ```

use std::f64::consts::TAU;
use std::fmt::Write as _;
use std::path::PathBuf;

/// Radius and height of the rings, bottom to rim.
const PROFILE: [[f64; 2]; 12] = [
    [0.28, 0.00],
    [0.34, 0.06],
    [0.46, 0.22],
    [0.53, 0.42],
    [0.54, 0.60],
    [0.49, 0.78],
    [0.38, 0.94],
    [0.27, 1.08],
    [0.22, 1.20],
    [0.22, 1.30],
    [0.26, 1.40],
    [0.33, 1.46],
];
const SEGMENTS: usize = 24;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let folder = std::env::args()
        .nth(1)
        .map(PathBuf::from)
        .ok_or("usage: make_vase FOLDER")?;
    std::fs::write(folder.join("vase.obj"), vase()?)?;
    Ok(())
}

fn vase() -> Result<String, std::fmt::Error> {
    let mut text = String::from(
        "# A vase, open at the top. CC0 1.0. Made by crates/assets/examples/make_vase.rs\no vase\n",
    );
    let rings = PROFILE.len();
    let along = lengths();
    for [radius, height] in PROFILE {
        for i in 0..SEGMENTS {
            let (sin, cos) = (i as f64 / SEGMENTS as f64 * TAU).sin_cos();
            writeln!(text, "v {:.6} {:.6} {:.6}", radius * sin, height, radius * cos)?;
        }
    }
    writeln!(text, "v 0.000000 0.000000 0.000000")?;
    for v in &along {
        for i in 0..=SEGMENTS {
            writeln!(text, "vt {:.6} {:.6}", i as f64 / SEGMENTS as f64, 1.0 - v)?;
        }
    }
    for i in 0..SEGMENTS {
        let (sin, cos) = (i as f64 / SEGMENTS as f64 * TAU).sin_cos();
        writeln!(text, "vt {:.6} {:.6}", 0.5 + 0.5 * sin, 0.5 + 0.5 * cos)?;
    }
    writeln!(text, "vt 0.500000 0.500000")?;
    for j in 0..rings - 1 {
        for i in 0..SEGMENTS {
            let corner = |j: usize, i: usize| {
                format!(
                    "{}/{}",
                    j * SEGMENTS + i % SEGMENTS + 1,
                    j * (SEGMENTS + 1) + i + 1
                )
            };
            writeln!(
                text,
                "f {} {} {} {}",
                corner(j, i),
                corner(j, i + 1),
                corner(j + 1, i + 1),
                corner(j + 1, i)
            )?;
        }
    }
    let (center, disc) = (rings * SEGMENTS + 1, rings * (SEGMENTS + 1) + 1);
    for i in 0..SEGMENTS {
        let next = (i + 1) % SEGMENTS;
        writeln!(
            text,
            "f {center}/{} {}/{} {}/{}",
            disc + SEGMENTS,
            next + 1,
            disc + next,
            i + 1,
            disc + i
        )?;
    }
    Ok(text)
}

/// Share of the profile's length at each ring, 0 to 1.
fn lengths() -> Vec<f64> {
    let mut sums = vec![0.0];
    for pair in PROFILE.windows(2) {
        let step = ((pair[1][0] - pair[0][0]).powi(2) + (pair[1][1] - pair[0][1]).powi(2)).sqrt();
        sums.push(sums[sums.len() - 1] + step);
    }
    let total = sums[sums.len() - 1];
    sums.iter().map(|s| s / total).collect()
}
