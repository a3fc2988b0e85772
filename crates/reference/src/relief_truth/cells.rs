//! The walk from cell to cell along a straight line over the height field, and the patch in each cell.
//!
//! Positions in texels: cell (i, j) spans from the centre of texel (i, j) to that of texel (i+1, j+1). The line's parameter
//! starts at 0 and ends where the caller says. Sides are crossed at parameters computed from the side's own number, so that no
//! error builds up from cell to cell.

use bossage_assets::{EdgeMode, HeightField};
use glam::DVec2;

use crate::relief_ray::Ray;

/// Sides of a field in texels.
pub(crate) fn sides(field: &HeightField) -> DVec2 {
    DVec2::new(f64::from(field.width), f64::from(field.height))
}

/// Walks cells in the order of the line.
pub(crate) struct Walk {
    pub(crate) origin: DVec2,
    pub(crate) delta: DVec2,
    pub(crate) cell: [i64; 2],
    /// Where the line enters the cell.
    pub(crate) t: f64,
    /// Where the line ends.
    end: f64,
    /// Cells visited, this one included.
    pub(crate) cells: u32,
}

impl Walk {
    /// Along `ray` from parameter 0 to `end`.
    pub(crate) fn new(field: &HeightField, ray: &Ray, end: f64) -> Self {
        let (origin, delta) = (ray.uv_top * sides(field) - 0.5, ray.delta * sides(field));
        let start = |p: f64, d: f64| {
            if d < 0.0 {
                p.ceil() as i64 - 1
            } else {
                p.floor() as i64
            }
        };
        Self {
            origin,
            delta,
            cell: [start(origin.x, delta.x), start(origin.y, delta.y)],
            t: 0.0,
            end,
            cells: 1,
        }
    }

    fn crossing(&self, axis: usize) -> f64 {
        let d = self.delta[axis];
        if d == 0.0 {
            return f64::INFINITY;
        }
        let side = self.cell[axis] + i64::from(d > 0.0);
        (side as f64 - self.origin[axis]) / d
    }

    /// Where the line leaves the cell, or ends in it.
    pub(crate) fn exit(&self) -> f64 {
        self.crossing(0).min(self.crossing(1)).clamp(self.t, self.end)
    }

    /// Whether the line ends in this cell.
    pub(crate) fn is_last(&self) -> bool {
        self.exit() >= self.end
    }

    /// On to the cell behind the side that is crossed first.
    pub(crate) fn advance(&mut self) {
        let exit = self.exit();
        let axis = usize::from(self.crossing(1) < self.crossing(0));
        self.cell[axis] += if self.delta[axis] > 0.0 { 1 } else { -1 };
        self.t = exit;
        self.cells += 1;
    }

    /// h − line along this cell, from its entry on, for a line that is at `line_start` where the walk starts and rises by
    /// `line_slope` a unit of the parameter.
    pub(crate) fn quadratic(
        &self,
        field: &HeightField,
        edge: EdgeMode,
        line_start: f64,
        line_slope: f64,
    ) -> Quadratic {
        let patch = Patch::new(field, edge, self.cell);
        let d = self.delta;
        let f = self.origin + self.t * d - DVec2::new(self.cell[0] as f64, self.cell[1] as f64);
        Quadratic {
            a: patch.twist * d.x * d.y,
            b: patch.along_x * d.x + patch.along_y * d.y + patch.twist * (f.x * d.y + f.y * d.x) - line_slope,
            c: patch.height(f) - (line_start + line_slope * self.t),
        }
    }
}

/// One cell's surface: corner + along_x·x + along_y·y + twist·x·y for x, y in [0, 1].
pub(crate) struct Patch {
    pub(crate) corner: f64,
    pub(crate) along_x: f64,
    pub(crate) along_y: f64,
    pub(crate) twist: f64,
}

impl Patch {
    pub(crate) fn new(field: &HeightField, edge: EdgeMode, [i, j]: [i64; 2]) -> Self {
        let h = |i, j| f64::from(field.texel(edge.resolve(i, field.width), edge.resolve(j, field.height)));
        let (h00, h10, h01, h11) = (h(i, j), h(i + 1, j), h(i, j + 1), h(i + 1, j + 1));
        Self {
            corner: h00,
            along_x: h10 - h00,
            along_y: h01 - h00,
            twist: h11 - h10 - h01 + h00,
        }
    }

    /// The least and the greatest slope along x, and those along y, in heights a texel.
    pub(crate) fn slopes(&self) -> [[f64; 2]; 2] {
        [self.along_x, self.along_y].map(|along| {
            let opposite = along + self.twist;
            [along.min(opposite), along.max(opposite)]
        })
    }

    pub(crate) fn height(&self, f: DVec2) -> f64 {
        self.corner + self.along_x * f.x + self.along_y * f.y + self.twist * f.x * f.y
    }
}

/// c + b·τ + a·τ²: how far the surface lies above the line, τ counted from the entry into the cell.
pub(crate) struct Quadratic {
    pub(crate) a: f64,
    pub(crate) b: f64,
    pub(crate) c: f64,
}

impl Quadratic {
    pub(crate) fn at(&self, step: f64) -> f64 {
        self.c + step * (self.b + step * self.a)
    }

    /// The smallest τ in [0, length] with c + bτ + aτ² ≥ 0, in the form that cancels nothing.
    pub(crate) fn first_root(&self, length: f64) -> Option<f64> {
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

    /// How far below the line the surface stays at a crest inside, or infinity where there is none in the cell.
    pub(crate) fn crest_gap(&self, length: f64) -> f64 {
        let summit = -self.b / (2.0 * self.a);
        if self.a < 0.0 && summit > 0.0 && summit < length {
            return -self.at(summit);
        }
        // A crest may also be a corner between two patches: the line comes nearest at the entry when it falls away from there.
        if self.b < 0.0 { -self.c } else { f64::INFINITY }
    }

    /// The greatest value on [0, length].
    pub(crate) fn maximum(&self, length: f64) -> f64 {
        let ends = self.at(0.0).max(self.at(length));
        let summit = -self.b / (2.0 * self.a);
        if self.a < 0.0 && summit > 0.0 && summit < length {
            ends.max(self.at(summit))
        } else {
            ends
        }
    }
}
