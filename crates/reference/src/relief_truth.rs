//! Where a view ray first meets the height field: the truth for every relief technique, and of the technique `exact`.
//!
//! The surface is the **bilinear interpolant of the texel centres**: between the centres of four texels it is the patch
//! h₀₀ + b·x + c·y + k·x·y, and edges follow the sampler's mode. Along a straight ray a patch is a quadratic in t, so the first
//! crossing in each cell has a closed form, and walking the cells in the ray's order finds the first of all. Nothing is stepped
//! over, and float64 rounding is the only error.
//!
//! Conventions of the ray: [`relief_ray`](crate::relief_ray). The layer's floor closes it: where rounding hides a meeting at the very
//! bottom, or heights are NaN, the hit is at t = 1.
//!
//! Limits. A ray that grazes a crest is ill-conditioned: there both the crest and what lies behind are right answers to an
//! input perturbed in its last bit. [`Hit::clearance`] says how close the ray came to an earlier crest, and
//! [`relief_grazing`](crate::relief_grazing) which answers count.

use bossage_assets::{EdgeMode, HeightField};
use glam::{DVec2, DVec3};

use crate::relief_ray::{Entry, HitRecord, Layer, Ray, Status};

pub(crate) mod cells;

use cells::{Patch, Walk, sides};

/// Cells walked before giving up. At the largest image side of 16,384 texels this is a ray of 256 tiles.
pub const MAX_CELLS: u32 = 1 << 22;

/// What the walk found.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit {
    /// [`Status::Hit`] or [`Status::CapReached`].
    pub status: Status,
    /// Ray parameter: depth below the layer's top as a share of its thickness.
    pub t: f64,
    /// Where the surface was met, in UV, not wrapped.
    pub uv: DVec2,
    /// The smallest height by which the ray cleared a local crest before the hit, in units of h; infinite if it passed none.
    pub clearance: f64,
    /// Cells visited.
    pub cells: u32,
}

/// The hit record of a view: what `exact` answers, for any input.
#[must_use]
pub fn trace(field: &HeightField, edge: EdgeMode, uv: DVec2, view_ts: DVec3, layer: &Layer) -> HitRecord {
    Entry::new(uv, view_ts, layer).search(|ray| {
        let hit = first_hit(field, edge, ray);
        (hit.t, hit.status == Status::Hit)
    })
}

/// The first meeting of the ray and the bilinear surface.
#[must_use]
pub fn first_hit(field: &HeightField, edge: EdgeMode, ray: &Ray) -> Hit {
    first_hit_lifted(field, edge, ray, 0.0)
}

/// The first meeting of the ray and the bilinear surface lifted by a height.
#[must_use]
pub fn first_hit_lifted(field: &HeightField, edge: EdgeMode, ray: &Ray, lift: f64) -> Hit {
    first_hit_over(field, edge, ray, |_| lift)
}

/// The first meeting of the ray and the bilinear surface, each cell of it lifted by a height of its own.
pub(crate) fn first_hit_over(
    field: &HeightField,
    edge: EdgeMode,
    ray: &Ray,
    lift: impl Fn([i64; 2]) -> f64,
) -> Hit {
    let mut walk = Walk::new(field, ray, 1.0);
    let mut clearance = f64::INFINITY;
    let finish = |walk: &Walk, status, t: f64, clearance| Hit {
        status,
        t,
        uv: ray.at(t),
        clearance,
        cells: walk.cells,
    };
    loop {
        let length = walk.exit() - walk.t;
        let above = walk.quadratic(field, edge, 1.0 - lift(walk.cell), -1.0);
        match above.first_root(length) {
            Some(step) => return finish(&walk, Status::Hit, (walk.t + step).min(1.0), clearance),
            None => clearance = clearance.min(above.crest_gap(length)),
        }
        if walk.is_last() {
            return finish(&walk, Status::Hit, 1.0, clearance);
        }
        if walk.cells >= MAX_CELLS {
            return finish(&walk, Status::CapReached, walk.exit(), clearance);
        }
        walk.advance();
    }
}

/// The height of the bilinear surface at a uv.
#[must_use]
pub fn height_at(field: &HeightField, edge: EdgeMode, uv: DVec2) -> f64 {
    let (patch, f) = patch_at(field, edge, uv);
    patch.height(f)
}

/// The gradient (∂h/∂u, ∂h/∂v) of the bilinear patch that holds the uv; on a cell's edge, of the cell after it.
#[must_use]
pub fn gradient_at(field: &HeightField, edge: EdgeMode, uv: DVec2) -> DVec2 {
    let (patch, f) = patch_at(field, edge, uv);
    let along = DVec2::new(
        patch.along_x + patch.twist * f.y,
        patch.along_y + patch.twist * f.x,
    );
    along * sides(field)
}

/// The patch that holds a uv, and where in it the uv lies.
fn patch_at(field: &HeightField, edge: EdgeMode, uv: DVec2) -> (Patch, DVec2) {
    let p = uv * sides(field) - 0.5;
    let cell = p.floor();
    (Patch::new(field, edge, [cell.x as i64, cell.y as i64]), p - cell)
}

#[cfg(test)]
mod tests;
