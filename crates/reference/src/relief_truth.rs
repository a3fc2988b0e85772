//! Where a view ray first meets the height field: the truth for every relief technique.
//!
//! The surface is the **bilinear interpolant of the texel centres**: between the centres of four texels it is the patch
//! h₀₀ + b·x + c·y + k·x·y, and edges follow the sampler's mode. Along a straight ray a patch is a quadratic in t, so the first
//! crossing in each cell has a closed form, and walking the cells in ray order finds the first of all. Nothing is stepped
//! over, and float64 rounding is the only error.
//!
//! Conventions. Elevation over the polygon z(h) = scale · h + bias in UV units, scale > 0. V is the unit vector from the
//! surface to the eye in tangent space. The ray enters the layer at its top, z = scale + bias, where t = 0, and leaves it at
//! z = bias, where t = 1: uv(t) = uv_top + t · d with d = −scale · V.xy / V.z, and the hit is the first t with
//! h(uv(t)) ≥ 1 − t. With bias = −scale the layer hangs below the polygon and uv_top is the polygon's uv.
//!
//! Limits. A ray that grazes a crest is ill-conditioned: there both the crest and what lies behind are right answers to an
//! input perturbed in its last bit. [`Hit::clearance`] says how close the ray came to an earlier crest.

use bossage_assets::{EdgeMode, HeightField};
use glam::{DVec2, DVec3};

/// Cells walked before giving up. At the largest image side of 16,384 texels this is a ray of 256 tiles.
pub const MAX_CELLS: u32 = 1 << 22;

/// A ray through the relief layer.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ray {
    /// uv where the ray enters the layer (t = 0).
    pub uv_top: DVec2,
    /// uv travelled while crossing the layer (t from 0 to 1).
    pub delta: DVec2,
}

impl Ray {
    /// The view ray that crosses the polygon at `uv`. `None` where the view direction does not look down on the polygon
    /// (V.z ≤ 0), is not finite, or is so flat that the shift overflows.
    #[must_use]
    pub fn through(uv: DVec2, view_ts: DVec3, scale: f64, bias: f64) -> Option<Self> {
        let slope = view_ts.truncate() / view_ts.z;
        let ray = Self {
            uv_top: uv + (scale + bias) * slope,
            delta: -scale * slope,
        };
        (view_ts.z > 0.0 && ray.uv_top.is_finite() && ray.delta.is_finite()).then_some(ray)
    }

    /// The uv at parameter t.
    #[must_use]
    pub fn at(&self, t: f64) -> DVec2 {
        self.uv_top + t * self.delta
    }
}

/// How the walk ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Status {
    /// The surface was met.
    Hit,
    /// The ray left the layer's bottom without meeting the surface: possible only where heights are below 0 or NaN.
    Missed,
    /// [`MAX_CELLS`] cells were walked; t and uv are where the walk stopped.
    CapReached,
}

/// What the walk found.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit {
    /// How the walk ended.
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

/// The first meeting of the ray and the bilinear surface.
#[must_use]
pub fn first_hit(field: &HeightField, edge: EdgeMode, ray: &Ray) -> Hit {
    let mut walk = Walk::new(field, ray);
    let mut clearance = f64::INFINITY;
    loop {
        let (entry, exit) = (walk.t, walk.exit());
        let cell = Quadratic::new(
            field,
            edge,
            walk.cell,
            walk.origin + entry * walk.delta,
            walk.delta,
            entry,
        );
        match cell.first_root(exit - entry) {
            Some(step) => return walk.finish(ray, Status::Hit, entry + step, clearance),
            None => clearance = clearance.min(cell.crest_gap(exit - entry)),
        }
        if exit >= 1.0 {
            return walk.finish(ray, Status::Missed, 1.0, clearance);
        }
        if walk.cells >= MAX_CELLS {
            return walk.finish(ray, Status::CapReached, exit, clearance);
        }
        walk.advance(exit);
    }
}

/// The height of the bilinear surface at a uv.
#[must_use]
pub fn height_at(field: &HeightField, edge: EdgeMode, uv: DVec2) -> f64 {
    let p = uv * size(field) - 0.5;
    let cell = p.floor();
    let patch = Patch::new(field, edge, [cell.x as i64, cell.y as i64]);
    patch.height(p - cell)
}

/// The gradient (∂h/∂u, ∂h/∂v) of the bilinear patch that holds the uv; on a cell's edge, of the cell after it.
#[must_use]
pub fn gradient_at(field: &HeightField, edge: EdgeMode, uv: DVec2) -> DVec2 {
    let p = uv * size(field) - 0.5;
    let cell = p.floor();
    let patch = Patch::new(field, edge, [cell.x as i64, cell.y as i64]);
    let f = p - cell;
    DVec2::new(
        patch.along_x + patch.twist * f.y,
        patch.along_y + patch.twist * f.x,
    ) * size(field)
}

fn size(field: &HeightField) -> DVec2 {
    DVec2::new(f64::from(field.width), f64::from(field.height))
}

/// Walks cells in ray order; positions in texels, cell (i, j) spans from texel centre (i, j) to (i+1, j+1).
struct Walk {
    origin: DVec2,
    delta: DVec2,
    cell: [i64; 2],
    t: f64,
    cells: u32,
}

impl Walk {
    fn new(field: &HeightField, ray: &Ray) -> Self {
        let (origin, delta) = (ray.uv_top * size(field) - 0.5, ray.delta * size(field));
        let start = |p: f64, d: f64| {
            if d < 0.0 {
                p.ceil() as i64 - 1
            } else {
                p.floor() as i64
            }
        };
        let cell = [start(origin.x, delta.x), start(origin.y, delta.y)];
        Self {
            origin,
            delta,
            cell,
            t: 0.0,
            cells: 1,
        }
    }

    /// The parameter at which the ray crosses the cell's far side on one axis, computed from the side's own number so that
    /// no error builds up from cell to cell.
    fn crossing(&self, axis: usize) -> f64 {
        let d = self.delta[axis];
        if d == 0.0 {
            return f64::INFINITY;
        }
        let side = self.cell[axis] + i64::from(d > 0.0);
        (side as f64 - self.origin[axis]) / d
    }

    fn exit(&self) -> f64 {
        self.crossing(0).min(self.crossing(1)).clamp(self.t, 1.0)
    }

    fn advance(&mut self, exit: f64) {
        let axis = usize::from(self.crossing(1) < self.crossing(0));
        self.cell[axis] += if self.delta[axis] > 0.0 { 1 } else { -1 };
        self.t = exit;
        self.cells += 1;
    }

    fn finish(&self, ray: &Ray, status: Status, t: f64, clearance: f64) -> Hit {
        let t = t.min(1.0);
        Hit {
            status,
            t,
            uv: ray.at(t),
            clearance,
            cells: self.cells,
        }
    }
}

/// One cell's surface: corner + along_x·x + along_y·y + twist·x·y for x, y in [0, 1].
struct Patch {
    corner: f64,
    along_x: f64,
    along_y: f64,
    twist: f64,
}

impl Patch {
    fn new(field: &HeightField, edge: EdgeMode, [i, j]: [i64; 2]) -> Self {
        let h = |i, j| f64::from(field.texel(edge.resolve(i, field.width), edge.resolve(j, field.height)));
        let (h00, h10, h01, h11) = (h(i, j), h(i + 1, j), h(i, j + 1), h(i + 1, j + 1));
        Self {
            corner: h00,
            along_x: h10 - h00,
            along_y: h01 - h00,
            twist: h11 - h10 - h01 + h00,
        }
    }

    fn height(&self, f: DVec2) -> f64 {
        self.corner + self.along_x * f.x + self.along_y * f.y + self.twist * f.x * f.y
    }
}

/// f(τ) = h(uv(t)) − (1 − t) for t = entry + τ inside one cell: c + b·τ + a·τ². The surface is met where f reaches 0.
struct Quadratic {
    a: f64,
    b: f64,
    c: f64,
}

impl Quadratic {
    fn new(field: &HeightField, edge: EdgeMode, cell: [i64; 2], p: DVec2, d: DVec2, entry: f64) -> Self {
        let patch = Patch::new(field, edge, cell);
        let f = p - DVec2::new(cell[0] as f64, cell[1] as f64);
        Self {
            a: patch.twist * d.x * d.y,
            b: patch.along_x * d.x + patch.along_y * d.y + patch.twist * (f.x * d.y + f.y * d.x) + 1.0,
            c: patch.height(f) - (1.0 - entry),
        }
    }

    /// The smallest τ in [0, length] with f(τ) ≥ 0, in the form that cancels nothing.
    fn first_root(&self, length: f64) -> Option<f64> {
        if self.c >= 0.0 {
            return Some(0.0);
        }
        let discriminant = self.b * self.b - 4.0 * self.a * self.c;
        if discriminant < 0.0 {
            return None;
        }
        let root = discriminant.sqrt();
        let step = if self.b >= 0.0 {
            -2.0 * self.c / (self.b + root)
        } else if self.a > 0.0 {
            (root - self.b) / (2.0 * self.a)
        } else {
            return None;
        };
        (step <= length).then_some(step)
    }

    /// How far below the ray the surface stays at an inner maximum of f, or infinity where there is none in the cell.
    fn crest_gap(&self, length: f64) -> f64 {
        let summit = -self.b / (2.0 * self.a);
        if self.a < 0.0 && summit > 0.0 && summit < length {
            return -(self.c + summit * (self.b + summit * self.a));
        }
        // A crest may also be a corner between two patches: the ray comes nearest at the entry when f falls from there.
        if self.b < 0.0 { -self.c } else { f64::INFINITY }
    }
}

#[cfg(test)]
mod tests;
