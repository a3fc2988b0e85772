//! Draws the small maps of the example scenes: `flat_height.png` and `flat_normal.png`, which ask for nothing, and
//! `grating_albedo.png`, whose holes need a discard.
//!
//! ```text
//! cargo run -p bossage-assets --example make_plain_maps -- examples/textures
//! ```

use std::path::PathBuf;

use bossage_assets::{HeightField, encode};

const GRATING: u32 = 128;
/// Bars are 6 texels wide, every 32 texels.
const CELL: u32 = 32;
const BAR: u32 = 6;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let folder = std::env::args()
        .nth(1)
        .map(PathBuf::from)
        .ok_or("usage: make_plain_maps FOLDER")?;
    let flat = HeightField::from_fn(16, 16, |_, _| 0.5);
    std::fs::write(folder.join("flat_height.png"), encode::height_png(&flat)?)?;
    let up = encode::rgba8_png(16, 16, &[[128, 128, 255, 255]; 256])?;
    std::fs::write(folder.join("flat_normal.png"), up)?;
    let texels: Vec<[u8; 4]> = (0..GRATING * GRATING)
        .map(|i| grating(i % GRATING, i / GRATING))
        .collect();
    std::fs::write(
        folder.join("grating_albedo.png"),
        encode::rgba8_png(GRATING, GRATING, &texels)?,
    )?;
    Ok(())
}

/// Steel bars, lighter along their middle; between them nothing, in the colour of the bars so that filtering makes no fringe.
fn grating(x: u32, y: u32) -> [u8; 4] {
    let from_middle = |i: u32| (2 * (i % CELL)).abs_diff(CELL - 1);
    let nearest = from_middle(x).min(from_middle(y));
    let alpha = if nearest < BAR { 255 } else { 0 };
    let light = 150u32.saturating_sub(10 * nearest.min(BAR)) as u8;
    [light, light, light + 6, alpha]
}
