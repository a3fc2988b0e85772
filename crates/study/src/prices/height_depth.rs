//! `height_depth`: what bits of the height cost the hit of a view ray, in texels.
//!
//! Errors are truth's own: the first hit in f64 on heights that were rounded, from the hit that counts on heights that were not, where a
//! ray that grazes a crest has two. So no technique's error is among them, and 32 bits, which truth takes, err by nothing. Rays are
//! anywhere, at 60° and 80° from the normal; the relief is a 20th of the tile deep, of waves 32 texels long.
//!
//! Times, operations and reads are those of `relief` with 16 layers and 5 halvings, which engines ship, over the map in that format.

use std::f64::consts::TAU;
use std::sync::Arc;

use bossage_assets::{EdgeMode, HeightField};
use bossage_conformance::generate::random::stream;
use bossage_reference::relief_grazing::Surface;
use bossage_reference::relief_ray::Ray;
use bossage_reference::relief_truth::first_hit;
use bossage_runner::{AddressMode, Filter, SamplerSettings};
use bossage_shaders::{HeightRead, Kernel, ReliefSearch, ReliefTechnique};
use glam::{DVec2, DVec3};
use rand::RngExt;
use rayon::prelude::*;

use super::frame::{Frame, bytes_of};
use super::heights::Storage;
use super::variant::{self, Variant};
use super::waves::Waves;
use super::{Context, Error};
use crate::record::Price;

/// Depth of the relief, in widths of the tile.
const SCALE: f64 = 0.05;

/// Length of the waves, texels.
const LENGTH: u32 = 32;

/// Angles of the views from the normal, degrees.
const VIEWS_DEG: [u32; 2] = [60, 80];

/// What engines ship.
const SEARCH: ReliefSearch = ReliefSearch {
    technique: ReliefTechnique::Relief,
    heights: HeightRead::Filtered,
};
const LAYERS: u32 = 16;
const HALVINGS: u32 = 5;

/// Where a view ray crosses the polygon, and the unit vector to the eye.
struct View {
    uv: DVec2,
    dir_ts: DVec3,
}

impl View {
    /// As the kernel reads it.
    fn floats(&self) -> [f32; 8] {
        let ([u, v], [x, y, z]) = (self.uv.to_array(), self.dir_ts.to_array());
        [u, v, 0.0, 0.0, x, y, z, 0.0].map(|x| x as f32)
    }

    fn ray(&self) -> Option<Ray> {
        Ray::through(self.uv, self.dir_ts, SCALE, -SCALE)
    }
}

fn views(seed: u64, count: u32, angle_deg: u32) -> Vec<View> {
    let mut rng = stream("height_depth", seed);
    let (sin, cos) = f64::from(angle_deg).to_radians().sin_cos();
    let mut view = || {
        let uv = DVec2::new(rng.random(), rng.random());
        let azimuth = DVec2::from_angle(TAU * rng.random::<f64>());
        View {
            uv,
            dir_ts: (sin * azimuth).extend(cos),
        }
    };
    (0..count).map(|_| view()).collect()
}

/// The map as it is read back.
fn field(surface: &Waves, storage: Storage) -> HeightField {
    let texels: Vec<f32> = surface
        .texels()
        .into_iter()
        .map(|h| storage.kept(h) as f32)
        .collect();
    let side = surface.side;
    HeightField::from_fn(side, side, |x, y| texels[(y * side + x) as usize])
}

/// How far each ray's hit on the rounded heights lies from the one that counts on the others.
fn errors(unrounded: &HeightField, rounded: &HeightField, views: &[View]) -> Vec<f64> {
    let surface = Surface::new(unrounded, EdgeMode::Wrap);
    let error = |view: &View| {
        let ray = view.ray()?;
        let hit = first_hit(rounded, EdgeMode::Wrap, &ray);
        Some(surface.answers(&ray).error_texels(hit.uv))
    };
    views.par_iter().filter_map(error).collect()
}

/// The kernel's `search`.
fn settings() -> Arc<[u8]> {
    let reals = [SCALE as f32, -SCALE as f32, 1.0, 0.0].map(f32::to_bits);
    let wrap = 0;
    let words = [LAYERS, HALVINGS, wrap, 0];
    bytes_of(&[reals, words])
}

fn frame(context: &Context<'_>, surface: &Waves, storage: Storage, views: &[View]) -> Result<Frame, Error> {
    let kernel = Kernel::ReliefHits(SEARCH);
    let assembled = context.library.assemble_kernel(kernel)?;
    let sampler = SamplerSettings {
        address: AddressMode::Wrap,
        filter: Filter::Linear,
        mip_filter: Filter::Nearest,
        anisotropy: 1,
    };
    let rays: Vec<[f32; 8]> = views.iter().map(View::floats).collect();
    Ok(Frame::of(&assembled, kernel.entry(), views.len() as u32, 16)?
        .leaving("hits")
        .texture("height_map", storage.texture(&surface.texels(), surface.side))
        .sampler("surface_sampler", sampler)
        .buffer("search", &settings())
        .buffer("rays", &bytes_of(&rays)))
}

/// The chart.
pub(super) fn prices(context: &Context<'_>) -> Result<Vec<Price>, Error> {
    let [side, items] = context.frame();
    let surface = Waves::new(context.seed, side, LENGTH);
    let mut frames = Vec::new();
    for angle_deg in VIEWS_DEG {
        let views = views(context.seed, items, angle_deg);
        for storage in Storage::ALL {
            let name = format!("{} bits, {angle_deg}°", storage.bits());
            let fields = [Storage::Float32, storage].map(|storage| field(&surface, storage));
            // Truth is dear: an eighth of the rays that are timed.
            let errors = errors(&fields[0], &fields[1], &views[..views.len() / 8]);
            frames.push((name, storage, errors, frame(context, &surface, storage, &views)?));
        }
    }
    let mut variants = Vec::new();
    for (name, storage, errors, frame) in &frames {
        variants.push(Variant {
            name: name.clone(),
            errors: errors.clone(),
            cost: frame.cost()?,
            bytes: storage.bytes(),
            timed: frame.timed(context)?,
        });
    }
    variant::prices(context, "height_depth", "texels", variants)
}

#[cfg(test)]
mod tests;
