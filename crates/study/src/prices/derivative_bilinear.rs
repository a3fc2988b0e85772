//! `derivative_bilinear`: shading normals between texels against the bilinear surface itself, in degrees.
//!
//! Relief techniques meet the bilinear surface; a normal map shades a smoother one. Normals by each difference are interpolated as a
//! filter does it; `patch` is the surface's own normal, from four heights. Places are anywhere, truth is the patch's normal in f64.
//! The reads are those of computing normals from heights on the spot: a normal map has been read beforehand.

use bossage_assets::EdgeMode;
use bossage_conformance::generate::random::stream;
use bossage_reference::texture::Texture;
use glam::{DVec3, DVec4, Vec2};
use rand::RngExt;

use super::derivative::frame_of;
use super::directions::errors_deg;
use super::frame::bytes_of;
use super::heights::Storage;
use super::variant::{self, Variant};
use super::waves::Waves;
use super::{Context, Error};
use crate::record::Price;

/// Lengths of the waves, texels.
const LENGTHS: [u32; 2] = [8, 32];

const WAYS: [(&str, &str); 4] = [
    ("forward", "forward_between"),
    ("central", "central_between"),
    ("fourth order", "fourth_order_between"),
    ("patch", "patch_between"),
];

fn places(seed: u64, count: u32) -> Vec<Vec2> {
    let mut rng = stream("derivative_bilinear", seed);
    (0..count)
        .map(|_| Vec2::new(rng.random::<f32>(), rng.random::<f32>()))
        .collect()
}

/// The bilinear surface's normals.
fn truth(surface: &Waves, places: &[Vec2]) -> Vec<DVec3> {
    let kept = surface.texels().into_iter().map(|h| Storage::Float32.kept(h));
    let texture = Texture {
        width: surface.side,
        height: surface.side,
        texels: kept.map(DVec4::splat).collect(),
    };
    let scale = surface.scale * f64::from(surface.side);
    let normal = |uv: &Vec2| {
        let footprint = texture.footprint(EdgeMode::Wrap, uv.as_dvec2());
        let [h00, h10, h01, h11] = footprint.texels.map(|texel| texel.x);
        let at = footprint.fraction;
        let along_u = (1.0 - at.y) * (h10 - h00) + at.y * (h11 - h01);
        let along_v = (1.0 - at.x) * (h01 - h00) + at.x * (h11 - h10);
        DVec3::new(-scale * along_u, -scale * along_v, 1.0)
    };
    places.iter().map(normal).collect()
}

/// The chart.
pub(super) fn prices(context: &Context<'_>) -> Result<Vec<Price>, Error> {
    let [side, items] = context.frame();
    let places = places(context.seed, items);
    let inputs = bytes_of(&places);
    let surfaces = LENGTHS.map(|length| (length, Waves::new(context.seed, side, length)));
    let mut frames = Vec::new();
    for (length, surface) in &surfaces {
        for (way, entry) in WAYS {
            let name = format!("{way}, waves of {length} texels");
            let frame = frame_of(context, entry, surface, Storage::Float32)?;
            frames.push((name, surface, frame.buffer("places", &inputs)));
        }
    }
    let mut variants = Vec::new();
    for (name, surface, frame) in &frames {
        let measured = frame.measure(context)?;
        let errors = errors_deg(&truth(surface, &places), &measured.outputs, 3);
        variants.push(Variant::new(name, measured, Storage::Float32.bytes(), errors));
    }
    variant::prices(context, "derivative_bilinear", "degrees", variants)
}

#[cfg(test)]
mod tests;
