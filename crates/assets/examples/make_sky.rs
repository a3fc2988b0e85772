//! Draws the sky of the example scenes: `sky_px.png`, `sky_nx.png`, `sky_py.png`, `sky_ny.png`, `sky_pz.png`, `sky_nz.png`.
//!
//! y is up: a blue sky that pales toward the horizon, a low sun between +x and +z with its glow, paving below in squares of two
//! tones, lighter toward −z, so that every face can be told from the others and a mirrored or turned one shows. Deterministic on
//! every machine but for the last bit of a byte: only the sRGB curve of the encoder is not an operation that IEEE 754 rounds.
//!
//! ```text
//! cargo run -p bossage-assets --example make_sky -- examples/textures
//! ```

use std::path::PathBuf;

use bossage_assets::{CubeFace, CubeMap, encode};
use glam::DVec3;

/// Texels along an edge.
const SIZE: u32 = 128;
/// Samples a texel, each way.
const SAMPLES: u32 = 4;
const ZENITH: DVec3 = DVec3::new(0.06, 0.16, 0.45);
const HORIZON: DVec3 = DVec3::new(0.55, 0.62, 0.68);
const SUNLIGHT: DVec3 = DVec3::new(1.0, 0.85, 0.55);
/// Squares of the paving to a unit below the eye.
const PAVING: f64 = 3.0;
/// Unit: (0.48, 0.36, 0.8).
const SUN: DVec3 = DVec3::new(0.48, 0.36, 0.8);

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let folder = std::env::args()
        .nth(1)
        .map(PathBuf::from)
        .ok_or("usage: make_sky FOLDER")?;
    let sky = CubeMap::from_fn(SIZE, SAMPLES, light);
    for (face, map) in CubeFace::ALL.into_iter().zip(&sky.faces) {
        std::fs::write(folder.join(file_name(face)), encode::color_png(map)?)?;
    }
    Ok(())
}

fn file_name(face: CubeFace) -> &'static str {
    match face {
        CubeFace::PositiveX => "sky_px.png",
        CubeFace::NegativeX => "sky_nx.png",
        CubeFace::PositiveY => "sky_py.png",
        CubeFace::NegativeY => "sky_ny.png",
        CubeFace::PositiveZ => "sky_pz.png",
        CubeFace::NegativeZ => "sky_nz.png",
    }
}

fn light(direction: DVec3) -> DVec3 {
    if direction.y >= 0.0 {
        sky(direction)
    } else {
        ground(direction)
    }
}

fn sky(d: DVec3) -> DVec3 {
    let haze = (1.0 - d.y) * (1.0 - d.y);
    let cosine = d.dot(SUN).max(0.0);
    // cos⁶⁴ by squaring: a glow of about ten degrees.
    let glow = (0..6).fold(cosine, |power, _| power * power);
    let disc = if cosine > 0.9986 { 1.0 } else { 0.0 };
    ZENITH.lerp(HORIZON, haze) + SUNLIGHT * (0.5 * glow + disc)
}

/// Paving one unit below the eye, lost in haze toward the horizon.
fn ground(d: DVec3) -> DVec3 {
    let (x, z) = (PAVING * d.x / -d.y, PAVING * d.z / -d.y);
    let odd = (x.floor() + z.floor()) / 2.0 % 1.0 != 0.0;
    let tone = if odd { 0.10 } else { 0.22 };
    let tone = tone + 0.05 * (-d.z).max(0.0);
    let near = (-d.y * 2.0).min(1.0);
    (HORIZON * 0.6).lerp(DVec3::new(tone, tone * 0.95, tone * 0.85), near)
}
