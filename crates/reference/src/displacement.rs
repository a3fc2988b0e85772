//! `displacement`: the vertices of a fine grid moved along N by the elevation, and the normals recomputed: the expensive truth
//! that the articles avoid.
//!
//! Source: the first article's description (*Displacement Mapping*: small triangles, vertices moved along the surface normal by a
//! height texture, new normals). P' = P + z·N; with N constant over the polygon the new tangents are P'_u = P_u + z_u·N and
//! P'_v = P_v + z_v·N, and the new normal is their cross product.
//!
//! Units: z(h) = scale·h + bias in UV units (1 = one tile); `Tile` turns UV units into the mesh's. Heights between texels are
//! bilinear. Limits: curvature of the base surface is left out of the normal, as it is zero on polygons.

use bossage_assets::{EdgeMode, HeightField};
use glam::{DVec2, DVec3};

use crate::parallax_offset::elevation;
use crate::vector::{normalize_or_zero, sign_not_zero};

/// The tangent plane of the polygon at a vertex, in the mesh's space and units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tile {
    /// Unit normal, outward.
    pub normal: DVec3,
    /// ∂P/∂u: as long as a tile is wide.
    pub along_u: DVec3,
    /// ∂P/∂v: as long as a tile is high.
    pub along_v: DVec3,
}

/// The height at a uv: the bilinear interpolant of the texel centres.
#[must_use]
pub fn height(field: &HeightField, edge: EdgeMode, uv: DVec2) -> f64 {
    let (corner, fraction) = cell(field, edge, uv);
    let across = |row: [f64; 2]| row[0] + fraction.x * (row[1] - row[0]);
    across(corner[0]) + fraction.y * (across(corner[1]) - across(corner[0]))
}

/// (∂h/∂u, ∂h/∂v) of the bilinear interpolant, exactly; between cells it jumps, and the cell after the border is taken.
#[must_use]
pub fn gradient_bilinear(field: &HeightField, edge: EdgeMode, uv: DVec2) -> DVec2 {
    let ([[h00, h10], [h01, h11]], f) = cell(field, edge, uv);
    let along_u = (h10 - h00) + f.y * ((h11 - h01) - (h10 - h00));
    let along_v = (h01 - h00) + f.x * ((h11 - h10) - (h01 - h00));
    DVec2::new(along_u, along_v) * sides(field)
}

/// (∂h/∂u, ∂h/∂v) by central differences of the interpolant, one texel to either side: continuous, of second order.
#[must_use]
pub fn gradient_central(field: &HeightField, edge: EdgeMode, uv: DVec2) -> DVec2 {
    let step = 1.0 / sides(field);
    let h = |offset: DVec2| height(field, edge, uv + offset);
    let (du, dv) = (DVec2::new(step.x, 0.0), DVec2::new(0.0, step.y));
    DVec2::new(h(du) - h(-du), h(dv) - h(-dv)) / (2.0 * step)
}

/// The slopes ∂z/∂u and ∂z/∂v from the heights one texel to either side: left, right along u, before, after along v.
/// `slope` is what a height difference of 1 stands for: scale · side / 2, with the scale in the mesh's units.
#[must_use]
pub fn slope([left, right, before, after]: [f64; 4], slope: DVec2) -> DVec2 {
    DVec2::new(right - left, after - before) * slope
}

/// P + z(h)·unit·N: the elevation in UV units times `unit`, the mesh's length of one UV unit.
#[must_use]
pub fn position(position: DVec3, normal: DVec3, height: f64, scale: f64, bias: f64, unit: f64) -> DVec3 {
    position + elevation(height, scale, bias) * unit * normal
}

/// The unit normal of the displaced surface from the slopes ∂z/∂u and ∂z/∂v, z in the mesh's units. For a mirrored tile the
/// cross product is turned outward again; a tile without area gives zero.
#[must_use]
pub fn normal(tile: &Tile, slope: DVec2) -> DVec3 {
    let Tile {
        normal,
        along_u,
        along_v,
    } = *tile;
    let level = along_u.cross(along_v);
    let outward = sign_not_zero(level.dot(normal));
    // (P_u + s N) × (P_v + t N) without N × N = 0: where the slopes are 2⁵³ times the axes, f64 too would lose the axes in the sums.
    normalize_or_zero(outward * (level + slope.x * normal.cross(along_v) + slope.y * along_u.cross(normal)))
}

/// The same in tangent space on a square tile of one unit: (−z_u, −z_v, 1), normalised.
#[must_use]
pub fn normal_ts(slope: DVec2) -> DVec3 {
    normalize_or_zero(DVec3::new(-slope.x, -slope.y, 1.0))
}

fn sides(field: &HeightField) -> DVec2 {
    DVec2::new(f64::from(field.width), f64::from(field.height))
}

/// The four heights around a uv, row by row, and where it lies between them.
fn cell(field: &HeightField, edge: EdgeMode, uv: DVec2) -> ([[f64; 2]; 2], DVec2) {
    let p = uv * sides(field) - 0.5;
    let base = p.floor();
    let (i, j) = (base.x as i64, base.y as i64);
    let h = |dx: i64, dy: i64| {
        f64::from(field.texel(
            edge.resolve(i + dx, field.width),
            edge.resolve(j + dy, field.height),
        ))
    };
    ([[h(0, 0), h(1, 0)], [h(0, 1), h(1, 1)]], p - base)
}

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

    use bossage_assets::{EdgeMode, HeightField};
    use glam::{DVec2, DVec3};

    use super::{Tile, gradient_bilinear, gradient_central, height, normal, normal_ts, position};

    const SQUARE: Tile = Tile {
        normal: DVec3::Z,
        along_u: DVec3::X,
        along_v: DVec3::Y,
    };

    #[test]
    fn a_ramp_is_known() {
        let ramp = HeightField::from_fn(8, 4, |x, _| x as f32 / 8.0);
        let uv = DVec2::new(0.4, 0.5);
        // Texel i holds i/8 at u = (i + ½)/8: h = u − 1/16, slope 1. Four roundings of 2^-53.
        assert!((height(&ramp, EdgeMode::Clamp, uv) - (0.4 - 0.0625)).abs() < 1e-15);
        for gradient in [gradient_bilinear, gradient_central] {
            assert!((gradient(&ramp, EdgeMode::Clamp, uv) - DVec2::X).length() < 1e-14);
        }
        assert_eq!(
            position(DVec3::X, DVec3::Z, 0.5, 0.5, -0.125, 4.0),
            DVec3::new(1.0, 0.0, 0.5)
        );
    }

    #[test]
    fn a_saddle_has_the_gradient_of_its_patch() {
        // Corners 0 1 / 1 0: h = x + y − 2xy in cell units of half a tile, so h_x = 1 − 2y and h_u = 2·h_x.
        let field = HeightField::from_fn(2, 2, |x, y| (x ^ y) as f32);
        let at = |x: f64, y: f64| gradient_bilinear(&field, EdgeMode::Clamp, (DVec2::new(x, y) + 0.5) / 2.0);
        assert_eq!(at(0.25, 0.25), DVec2::new(1.0, 1.0));
        assert_eq!(at(0.5, 0.5), DVec2::ZERO);
        assert_eq!(at(0.25, 0.75), DVec2::new(-1.0, 1.0));
    }

    #[test]
    fn the_bilinear_gradient_is_the_derivative_of_the_height() {
        let field = HeightField::from_fn(16, 16, |x, y| ((x * 7 + y * 11) % 13) as f32 / 12.0);
        for i in 0..100 {
            let uv = DVec2::new(0.013 + f64::from(i) * 0.0097, 0.9 - f64::from(i) * 0.0083);
            let step = 1e-7;
            let along = |d: DVec2| {
                (height(&field, EdgeMode::Wrap, uv + step * d)
                    - height(&field, EdgeMode::Wrap, uv - step * d))
                    / (2.0 * step)
            };
            let numeric = DVec2::new(along(DVec2::X), along(DVec2::Y));
            // On a patch h is linear along each axis, so the quotient is exact but for rounding: 4·2^-53/1e-7 = 4e-9, and the
            // rounding of uv·16: 2^-53·16/1e-7·slope 32. No sample is within 1e-7 of a cell's border.
            assert!(
                (gradient_bilinear(&field, EdgeMode::Wrap, uv) - numeric).length() < 1e-6,
                "{uv}"
            );
        }
    }

    #[test]
    fn central_differences_are_of_second_order() {
        for n in [8, 16, 32] {
            let phase = |u: f64| TAU * u;
            let field = HeightField::from_fn(n, 1, |x, _| {
                (0.5 + 0.25 * phase((f64::from(x) + 0.5) / f64::from(n)).sin()) as f32
            });
            let step = TAU / f64::from(n);
            for i in 0..n {
                let u = (f64::from(i) + 0.5) / f64::from(n);
                // (sin(a + φ) − sin(a − φ))/2φ = cos(a)·sin(φ)/φ, and sin(φ)/φ = 1 − φ²/6 + …: second order.
                let exact = 0.25 * TAU * phase(u).cos() * step.sin() / step;
                let found = gradient_central(&field, EdgeMode::Wrap, DVec2::new(u, 0.5)).x;
                // Two heights below 1 rounded to f32, each by 2^-25, over two texels of 1/n.
                assert!((found - exact).abs() <= f64::from(n) * 2f64.powi(-25), "{n} {i}");
            }
        }
    }

    #[test]
    fn normals_of_the_displaced_surface() {
        let slope = DVec2::new(0.75, 0.0);
        assert!((normal(&SQUARE, slope) - DVec3::new(-0.6, 0.0, 0.8)).length() < 1e-15);
        assert_eq!(normal(&SQUARE, slope), normal_ts(slope));
        // A tile three units wide: the same rise over three times the way.
        let wide = Tile {
            along_u: 3.0 * DVec3::X,
            ..SQUARE
        };
        assert!((normal(&wide, DVec2::new(2.25, 0.0)) - DVec3::new(-0.6, 0.0, 0.8)).length() < 1e-15);
        // Mirrored along u: the rise is toward −x, and the normal still outward.
        let mirrored = Tile {
            along_u: -DVec3::X,
            ..SQUARE
        };
        assert!((normal(&mirrored, slope) - DVec3::new(0.6, 0.0, 0.8)).length() < 1e-15);
        assert_eq!(
            normal(
                &Tile {
                    along_u: DVec3::ZERO,
                    ..SQUARE
                },
                DVec2::ZERO
            ),
            DVec3::ZERO
        );
    }
}
