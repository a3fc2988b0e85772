//! Draws the brick wall of the example scenes: `bricks_height.png`, `bricks_albedo.png`, `bricks_normal.png`.
//!
//! A running bond of 3 bricks by 8 courses over one tile of 0.66 m, raked joints, rounded and chipped edges, each brick set and
//! coloured a little differently. Tiles in both directions. Deterministic on every machine: integer hashes, and only
//! operations that IEEE 754 rounds correctly.
//!
//! ```text
//! cargo run -p bossage-assets --example make_bricks -- examples/textures
//! ```

use std::path::PathBuf;

use bossage_assets::height_to_normal::{self, Bake};
use bossage_assets::{ColorMap, EdgeMode, HeightField, NormalCodec, encode, srgb_from_linear};

/// Side of the pictures, in texels.
const SIDE: u32 = 512;
const COLUMNS: u32 = 3;
const COURSES: u32 = 8;
/// Width of the joints, in texels.
const JOINT: f64 = 9.0;
/// 20 mm of relief on a tile of 660 mm.
const HEIGHT_SCALE: f32 = 20.0 / 660.0;
/// Samples a texel, each way.
const SAMPLES: u32 = 3;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let folder = std::env::args()
        .nth(1)
        .map(PathBuf::from)
        .ok_or("usage: make_bricks FOLDER")?;
    let wall: Vec<Point> = (0..SIDE * SIDE).map(|i| texel(i % SIDE, i / SIDE)).collect();
    let at = |x: u32, y: u32| &wall[(y * SIDE + x) as usize];
    // Rounded to the 16 bits of the file, so that the normals are those of the heights that users load.
    let round = |h: f64| (h * 65535.0).round() / 65535.0;
    let field = HeightField::from_fn(SIDE, SIDE, |x, y| round(at(x, y).height) as f32);
    let bake = Bake::central(&field, [HEIGHT_SCALE; 2], EdgeMode::Wrap, NormalCodec::Unorm)?;
    let mut normals = height_to_normal::bake(&field, &bake);
    normals.texels.iter_mut().for_each(|t| t[3] = 255);
    let byte = |light: f64| (f64::from(srgb_from_linear(light as f32)) * 255.0).round() as u8;
    let color = |p: &Point| [byte(p.color[0]), byte(p.color[1]), byte(p.color[2]), 255];
    let albedo = ColorMap {
        width: SIDE,
        height: SIDE,
        texels: wall.iter().map(color).collect(),
    };
    std::fs::write(folder.join("bricks_height.png"), encode::height_png(&field)?)?;
    std::fs::write(folder.join("bricks_albedo.png"), encode::color_png(&albedo)?)?;
    std::fs::write(folder.join("bricks_normal.png"), encode::normal_png(&normals)?)?;
    Ok(())
}

/// What the wall is like at a place: height in [0, 1] and linear colour.
#[derive(Default, Clone, Copy)]
struct Point {
    height: f64,
    color: [f64; 3],
}

/// The mean over a texel.
fn texel(x: u32, y: u32) -> Point {
    let mut sum = Point::default();
    for k in 0..SAMPLES * SAMPLES {
        let inside = |i: u32| (f64::from(i) + 0.5) / f64::from(SAMPLES);
        let p = wall(
            f64::from(x) + inside(k % SAMPLES),
            f64::from(y) + inside(k / SAMPLES),
        );
        sum.height += p.height;
        (0..3).for_each(|c| sum.color[c] += p.color[c]);
    }
    let share = 1.0 / f64::from(SAMPLES * SAMPLES);
    Point {
        height: sum.height * share,
        color: sum.color.map(|c| c * share),
    }
}

fn wall(x: f64, y: f64) -> Point {
    let brick = Brick::at(x, y);
    // Hand-made edges: the outline wanders, and grit eats into it.
    let wander = 1.6 * noise(x, y, 16, 1) + 0.9 * noise(x, y, 64, 2);
    let depth = brick.inset(x, y) - wander;
    let rise = smooth(depth / 7.0);
    let grit = 0.5 * noise(x, y, 64, 3) + 0.3 * noise(x, y, 128, 4) + 0.2 * noise(x, y, 256, 5);
    let face = brick.level + brick.tilt(x, y) + 0.045 * grit - pits(x, y);
    let joint = 0.16 + 0.05 * noise(x, y, 24, 6) + 0.06 * noise(x, y, 128, 7) + 0.03 * noise(x, y, 256, 8);
    let height = (joint + (face - joint) * rise).clamp(0.0, 1.0);
    let cover = smooth((depth - 0.5) / 2.5);
    let (clay, mortar) = (brick.clay(x, y, grit), mortar(x, y));
    Point {
        height,
        color: std::array::from_fn(|c| mortar[c] + (clay[c] - mortar[c]) * cover),
    }
}

/// One brick of the bond, in texels.
struct Brick {
    id: u32,
    center: [f64; 2],
    half: [f64; 2],
    level: f64,
}

impl Brick {
    fn at(x: f64, y: f64) -> Brick {
        let (length, course_height) = (
            f64::from(SIDE / COLUMNS) + f64::from(SIDE % COLUMNS) / f64::from(COLUMNS),
            f64::from(SIDE / COURSES),
        );
        let course = (y / course_height).floor();
        let shift = if course as u32 % 2 == 1 { 0.5 } else { 0.0 };
        let column = (x / length - shift).floor();
        let id = course as u32 * COLUMNS + (column as i64).rem_euclid(i64::from(COLUMNS)) as u32;
        let jitter = |salt: u32| unit(hash(id, salt)) - 0.5;
        Brick {
            id,
            center: [
                (column + shift + 0.5) * length + 1.5 * jitter(1),
                (course + 0.5) * course_height + 1.5 * jitter(2),
            ],
            half: [
                (length - JOINT) * 0.5 + 1.2 * jitter(3),
                (course_height - JOINT) * 0.5 + 1.2 * jitter(4),
            ],
            level: 0.80 + 0.16 * jitter(5),
        }
    }

    /// Distance inward from the outline, a rectangle with round and here and there broken corners.
    fn inset(&self, x: f64, y: f64) -> f64 {
        let (px, py) = (x - self.center[0], y - self.center[1]);
        let radius = 5.0;
        let qx = px.abs() - self.half[0] + radius;
        let qy = py.abs() - self.half[1] + radius;
        let outside = (qx.max(0.0) * qx.max(0.0) + qy.max(0.0) * qy.max(0.0)).sqrt();
        let inset = radius - outside - qx.max(qy).min(0.0);
        inset.min(self.chip(px, py))
    }

    /// Distance from the broken-off corner, if this corner is one.
    fn chip(&self, px: f64, py: f64) -> f64 {
        let corner = u32::from(px > 0.0) + 2 * u32::from(py > 0.0);
        let luck = unit(hash(self.id, 20 + corner));
        if luck > 0.2 {
            return f64::INFINITY;
        }
        let (dx, dy) = (px.abs() - self.half[0], py.abs() - self.half[1]);
        (dx * dx + dy * dy).sqrt() - (3.0 + 45.0 * luck)
    }

    /// Bricks are never set quite flush.
    fn tilt(&self, x: f64, y: f64) -> f64 {
        let lean = |salt: u32, span: f64| (unit(hash(self.id, salt)) - 0.5) * 0.10 / span;
        lean(6, self.half[0]) * (x - self.center[0]) + lean(7, self.half[1]) * (y - self.center[1])
    }

    fn clay(&self, x: f64, y: f64, grit: f64) -> [f64; 3] {
        let [red, burnt, pale] = [[0.36, 0.105, 0.055], [0.16, 0.055, 0.042], [0.46, 0.19, 0.10]];
        let tone = unit(hash(self.id, 8));
        let base: [f64; 3] = std::array::from_fn(|c| {
            let toward = if tone < 0.35 { burnt[c] } else { pale[c] };
            let share = if tone < 0.35 {
                1.0 - tone / 0.35
            } else {
                (tone - 0.35) / 0.65 * 0.8
            };
            red[c] + (toward - red[c]) * share
        });
        let scorch = 1.0 + 0.28 * noise(x, y, 12, 9) + 0.30 * grit;
        base.map(|c| (c * scorch).clamp(0.01, 0.9))
    }
}

fn mortar(x: f64, y: f64) -> [f64; 3] {
    let sand = 1.0 + 0.16 * noise(x, y, 32, 10) + 0.34 * noise(x, y, 256, 11);
    [0.40, 0.37, 0.32].map(|c| (c * sand).clamp(0.02, 0.9))
}

/// Small holes where grit fell out.
fn pits(x: f64, y: f64) -> f64 {
    let deep = noise(x, y, 48, 12) * 0.7 + noise(x, y, 96, 13) * 0.5;
    0.20 * smooth((deep - 0.52) / 0.3)
}

fn smooth(t: f64) -> f64 {
    let t = t.clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

/// Gradient noise in about [−1, 1] with `cells` cells over the tile, so that it tiles.
fn noise(x: f64, y: f64, cells: u32, salt: u32) -> f64 {
    let scale = f64::from(cells) / f64::from(SIDE);
    let (x, y) = (x * scale, y * scale);
    let (left, low) = (x.floor(), y.floor());
    let (fx, fy) = (x - left, y - low);
    let corner = |i: u32, j: u32| {
        let (cx, cy) = ((left as u32 + i) % cells, (low as u32 + j) % cells);
        let h = hash(cy * cells + cx, salt.wrapping_mul(7919));
        let gradient = [unit(h) * 2.0 - 1.0, unit(hash(h, 1)) * 2.0 - 1.0];
        gradient[0] * (fx - f64::from(i)) + gradient[1] * (fy - f64::from(j))
    };
    let fade = |t: f64| t * t * t * (t * (t * 6.0 - 15.0) + 10.0);
    let (u, v) = (fade(fx), fade(fy));
    let mix = |a: f64, b: f64, t: f64| a + (b - a) * t;
    1.8 * mix(
        mix(corner(0, 0), corner(1, 0), u),
        mix(corner(0, 1), corner(1, 1), u),
        v,
    )
}

/// Mixes two numbers into one without pattern (the finaliser of the 32-bit Murmur hash).
fn hash(value: u32, salt: u32) -> u32 {
    let mut h = value.wrapping_mul(0x9e37_79b1) ^ salt.wrapping_mul(0x85eb_ca77).wrapping_add(0x27d4_eb2f);
    h = (h ^ (h >> 16)).wrapping_mul(0x85eb_ca6b);
    h = (h ^ (h >> 13)).wrapping_mul(0xc2b2_ae35);
    h ^ (h >> 16)
}

fn unit(h: u32) -> f64 {
    f64::from(h) / 4_294_967_296.0
}
