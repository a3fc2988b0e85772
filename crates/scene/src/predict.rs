//! Predicted error of a relief technique: rays of this scene, the technique in f64, against the first hit on the bilinear
//! height field.
//!
//! Error in texels is the distance between the shaded and the true texture position; in pixels, the same carried to the
//! screen by the derivative of the projection on the polygon. Percentiles over all rays of all objects of a material.
//!
//! Guarantee: deterministic, [`RAYS`] rays a material at most, each object getting its share by visible area.
//! The slope techniques read the normal map, bilinear, in the frame of the polygon. Displaced vertices are right where they
//! are; between them the grid is straight, and the height it misses is carried to the texture along the view.
//! Limits: as for views, hidden parts count; the derivative is taken at the polygon, so very large errors are only
//! roughly right in pixels.

use bossage_assets::{EdgeMode, NormalMap};
use bossage_reference::relief_ray::{Ray, Status};
use bossage_reference::{
    parallax_offset, parallax_offset_limited, parallax_slope_ao, parallax_slope_ao_directed, relief_truth,
};
use bossage_shaders::{Form, Relief};
use glam::{DVec2, DVec3};
use serde::Serialize;

use crate::model::{Elevation, HeightSource, Material};
use crate::views::{View, ViewRay};

/// Rays a material.
pub(crate) const RAYS: u32 = 4096;

/// 99th percentiles of the error.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Error {
    /// Texels.
    #[serde(rename = "error_texels_p99")]
    pub texels_p99: f64,
    /// Pixels.
    #[serde(rename = "error_px_p99")]
    pub px_p99: f64,
}

/// Rays with their true texture positions.
pub(crate) struct Truth<'a> {
    height: &'a HeightSource,
    normal: Option<&'a NormalMap>,
    edge: EdgeMode,
    rays: Vec<(ViewRay, DVec2)>,
}

impl<'a> Truth<'a> {
    /// Traces the rays of the given views over a material's heights.
    pub(crate) fn trace(material: &'a Material, height: &'a HeightSource, views: &[&View]) -> Self {
        let edge = material.address;
        let total: f64 = views.iter().map(|view| view.area_px()).sum();
        let share = |view: &View| (f64::from(RAYS) * view.area_px() / total).ceil() as u32;
        let rays = views
            .iter()
            .filter(|view| view.area_px() > 0.0)
            .flat_map(|view| view.rays(share(view)));
        let rays = rays
            .filter_map(|ray| Some((ray, true_uv(height, edge, &ray)?)))
            .collect();
        Self {
            height,
            normal: material.normal.as_ref().map(|normal| normal.map.as_ref()),
            edge,
            rays,
        }
    }

    /// The error of a technique over these rays; none when there are no rays.
    pub(crate) fn error(&self, technique: Relief, form: Form) -> Option<Error> {
        let size = DVec2::new(
            f64::from(self.height.field.width),
            f64::from(self.height.field.height),
        );
        let errors = self.rays.iter().map(|(ray, truth)| {
            let off = self.off(technique, form, ray, *truth);
            (
                (off * size).length(),
                (ray.px_per_uv[0] * off.x + ray.px_per_uv[1] * off.y).length(),
            )
        });
        let (texels, px): (Vec<f64>, Vec<f64>) = errors.unzip();
        Some(Error {
            texels_p99: percentile_99(texels)?,
            px_p99: percentile_99(px)?,
        })
    }

    /// How far the shaded texture position is from the true one.
    fn off(&self, technique: Relief, form: Form, ray: &ViewRay, truth: DVec2) -> DVec2 {
        match technique {
            Relief::Displacement => self.missed_by_grid(ray),
            Relief::None
            | Relief::ParallaxOffset
            | Relief::ParallaxOffsetLimited
            | Relief::ParallaxSlopeAo
            | Relief::ParallaxSlopeAoDirected => self.shifted(technique, form, ray) - truth,
        }
    }

    /// Where the view meets the grid, against where it meets the heights between the grid's vertices.
    fn missed_by_grid(&self, ray: &ViewRay) -> DVec2 {
        let at = |uv| relief_truth::height_at(&self.height.field, self.edge, uv);
        let grid: f64 = ray.corners.iter().map(|(uv, share)| share * at(*uv)).sum();
        (grid - at(ray.uv)) * self.height.elevation.scale * ray.view_ts.truncate() / ray.view_ts.z
    }

    fn slope_shift(&self, technique: Relief, form: Form, ray: &ViewRay, height: f64) -> DVec2 {
        let Some(map) = self.normal else { return ray.uv };
        let (n, scale) = (normal_at(map, self.edge, ray.uv), self.height.elevation.scale);
        let delta = |view| match form {
            Form::Published => parallax_slope_ao::delta_published(n, DVec3::Z, view, height, scale.x),
            Form::Hardened => parallax_slope_ao::delta_hardened(n, DVec3::Z, view, height, scale.x),
        };
        // Occlusion does not move anything.
        let still = 0.0;
        match (technique, form) {
            (Relief::ParallaxSlopeAoDirected, _) => {
                let view = ray.view_ts * DVec3::new(1.0, scale.y / scale.x, 1.0);
                parallax_slope_ao_directed::shift(ray.uv, view, delta(ray.view_ts), still).uv
            }
            (_, Form::Published) => parallax_slope_ao::published(ray.uv, delta(ray.backward_ts), still).uv,
            (_, Form::Hardened) => parallax_slope_ao::hardened(ray.uv, delta(ray.view_ts), still).uv,
        }
    }

    fn shifted(&self, technique: Relief, form: Form, ray: &ViewRay) -> DVec2 {
        let height = relief_truth::height_at(&self.height.field, self.edge, ray.uv);
        let by_axis = |formula: fn(DVec2, DVec3, f64, f64, f64) -> DVec2| {
            let Elevation { scale, bias } = self.height.elevation;
            let u = formula(ray.uv, ray.view_ts, height, scale.x, bias.x).x;
            let v = formula(ray.uv, ray.view_ts, height, scale.y, bias.y).y;
            DVec2::new(u, v)
        };
        match (technique, form) {
            (Relief::None | Relief::Displacement, _) => ray.uv,
            (Relief::ParallaxSlopeAo | Relief::ParallaxSlopeAoDirected, form) => {
                self.slope_shift(technique, form, ray, height)
            }
            (Relief::ParallaxOffset, Form::Published) => by_axis(parallax_offset::published),
            (Relief::ParallaxOffset, Form::Hardened) => by_axis(parallax_offset::hardened),
            (Relief::ParallaxOffsetLimited, _) => by_axis(parallax_offset_limited::offset),
        }
    }
}

/// Where the view ray first meets the surface; none for rays so flat that the walk gives up.
fn true_uv(height: &HeightSource, edge: EdgeMode, ray: &ViewRay) -> Option<DVec2> {
    let Elevation { scale, bias } = height.elevation;
    let slope = ray.view_ts.truncate() / ray.view_ts.z;
    let ray = Ray {
        uv_top: ray.uv + (scale + bias) * slope,
        delta: -scale * slope,
    };
    if !(ray.uv_top.is_finite() && ray.delta.is_finite()) {
        return None;
    }
    let hit = relief_truth::first_hit(&height.field, edge, &ray);
    (hit.status == Status::Hit).then_some(hit.uv)
}

/// The filtered normal of a map, decoded, not normalised.
fn normal_at(map: &NormalMap, edge: EdgeMode, uv: DVec2) -> DVec3 {
    let p = uv * DVec2::new(f64::from(map.width), f64::from(map.height)) - 0.5;
    let (cell, f) = (p.floor(), p - p.floor());
    let texel = |dx: i64, dy: i64| {
        let x = edge.resolve(cell.x as i64 + dx, map.width);
        let y = edge.resolve(cell.y as i64 + dy, map.height);
        map.decode(x, y).as_dvec3()
    };
    let row = |dy| texel(0, dy).lerp(texel(1, dy), f.x);
    row(0).lerp(row(1), f.y)
}

/// The smallest value that at least 99 % of the values do not exceed.
fn percentile_99(mut values: Vec<f64>) -> Option<f64> {
    values.sort_by(f64::total_cmp);
    let rank = (values.len() as f64 * 0.99).ceil() as usize;
    values.get(rank.checked_sub(1)?).copied()
}

#[cfg(test)]
mod tests {
    use super::percentile_99;

    #[test]
    fn percentile_is_a_value_of_the_sample() {
        assert_eq!(percentile_99((1..=200).map(f64::from).collect()), Some(198.0));
        assert_eq!(percentile_99(vec![3.0]), Some(3.0));
        assert_eq!(percentile_99(Vec::new()), None);
    }
}
